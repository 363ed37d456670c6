# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

file(GLOB_RECURSE library_headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/include" "${PROJECT_SOURCE_DIR}/include/ism/*.hpp")
list(FILTER library_headers EXCLUDE REGEX "/adapt/(eigen|opencv|pcl)") # see bridge/
file(GLOB toy_headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/examples" "${PROJECT_SOURCE_DIR}/examples/toy/*.hpp")
set(all_headers ${library_headers} ${toy_headers})

# Every header alone: what it names of ours it includes.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    set(clang "${CMAKE_CXX_COMPILER}")
else()
    find_program(ISM_CLANG clang++)
    set(clang "${ISM_CLANG}")
endif()
if(clang)
    add_test(NAME headers/alone
             COMMAND "${CMAKE_COMMAND}" "-DCLANG=${clang}" "-DFLAGS=${flags}" "-DHEADERS=${all_headers}"
                     "-DFOLDERS=${PROJECT_SOURCE_DIR}/include;${PROJECT_SOURCE_DIR}/examples" "-DSCRATCH=${test_build_dir}/headers/alone"
                     -P "${test_dir}/headers/check_alone.cmake")
    # One that names what it does not include is found.
    add_test(NAME headers/refused
             COMMAND "${CMAKE_COMMAND}" "-DCLANG=${clang}" "-DHEADERS=declares.hpp;names.hpp" "-DFOLDERS=${test_dir}/headers/refused"
                     "-DSCRATCH=${test_build_dir}/headers/refused" -P "${test_dir}/headers/check_alone.cmake")
    set_tests_properties(headers/refused PROPERTIES LABELS headers
                         PASS_REGULAR_EXPRESSION "names.hpp:[0-9:]+ error: .*'Declared' must be imported")
else()
    add_test(NAME headers/alone COMMAND "${CMAKE_COMMAND}" -E echo "skipped: clang++ is not installed")
endif()
set_tests_properties(headers/alone PROPERTIES LABELS headers TIMEOUT 300 COST 100 SKIP_REGULAR_EXPRESSION "^skipped: ")

# All headers in one source, a second time too, and in another from the last to the first: each guards itself, needs no other
# before it nor is confused by one, and what is defined in one is inline.
set(together ${all_headers})
list(REMOVE_ITEM together ism/io/stb_implementation.hpp) # which is for one source of a program
list(TRANSFORM together REPLACE "(.+)" "#include \"\\1\"\n")
string(CONCAT includes ${together})
file(CONFIGURE OUTPUT "${test_build_dir}/headers/together.cpp" CONTENT "${includes}// a second time\n${includes}")
list(REVERSE together)
string(CONCAT includes ${together})
file(CONFIGURE OUTPUT "${test_build_dir}/headers/reversed.cpp" CONTENT "${includes}")
add_library(header_check OBJECT EXCLUDE_FROM_ALL "${test_build_dir}/headers/together.cpp" "${test_build_dir}/headers/reversed.cpp")
target_link_libraries(header_check PRIVATE ism_dev_options)
target_compile_options(header_check PRIVATE -O0 -Wsign-conversion) # beyond what our own code is compiled with
add_test(NAME headers/together
         COMMAND "${CMAKE_COMMAND}" "-DBUILD=${CMAKE_BINARY_DIR}" -DTARGET=header_check "-DOBJECTS=$<TARGET_OBJECTS:header_check>"
                 "-DNM=${CMAKE_NM}" -P "${test_dir}/headers/check_together.cmake")
set_tests_properties(headers/together PROPERTIES LABELS headers TIMEOUT 300 COST 100)
