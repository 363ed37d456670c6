# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# Every header alone: what it names it includes, and it guards itself. All sources are linked into one program, so what
# is defined in a header is inline. A header that another includes, directly or not, may stand before it: what the other
# then sees is still only what it includes itself. So a source tests a chain of headers, a third of them the work of all.
file(GLOB_RECURSE library_headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/include" "${PROJECT_SOURCE_DIR}/include/ism/*.hpp")
list(FILTER library_headers EXCLUDE REGEX "/adapt/(eigen|opencv|pcl)") # see bridge/
file(GLOB toy_headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/examples" "${PROJECT_SOURCE_DIR}/examples/toy/*.hpp")

foreach(header IN LISTS library_headers toy_headers)
    set(folder "${PROJECT_SOURCE_DIR}/include")
    if(header IN_LIST toy_headers)
        set(folder "${PROJECT_SOURCE_DIR}/examples")
    endif()
    file(STRINGS "${folder}/${header}" lines REGEX "^ *# *include *\"(ism|toy)/")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${folder}/${header}") # other includes, other chains
    list(TRANSFORM lines REPLACE ".*\"([^\"]+)\".*" "\\1" OUTPUT_VARIABLE own_${header})
endforeach()
include("${test_dir}/support/include_reach.cmake")
set(by_reach "") # those that reach most first
foreach(header IN LISTS library_headers toy_headers)
    include_reach("${header}" reached_${header})
    list(LENGTH reached_${header} count)
    math(EXPR order "1000 + ${count}")
    list(APPEND by_reach "${order} ${header}")
endforeach()
list(SORT by_reach ORDER DESCENDING)
list(TRANSFORM by_reach REPLACE "^[0-9]+ " "")

set(sources "${test_build_dir}/headers/main.cpp")
file(CONFIGURE OUTPUT "${test_build_dir}/headers/main.cpp" CONTENT "int main() {}\n")
while(by_reach)
    list(GET by_reach 0 last)
    set(chain "")
    set(before ${by_reach})
    while(before) # the first of them that the chain's first header reaches is its next
        list(GET before 0 header)
        list(PREPEND chain "${header}")
        list(REMOVE_ITEM by_reach "${header}")
        set(reachable "")
        foreach(other IN LISTS by_reach)
            if(other IN_LIST reached_${header})
                list(APPEND reachable "${other}")
            endif()
        endforeach()
        set(before ${reachable})
    endwhile()
    list(TRANSFORM chain REPLACE "(.+)" "#include \"\\1\"\n")
    string(CONCAT includes ${chain})
    string(MAKE_C_IDENTIFIER "${last}" name)
    file(CONFIGURE OUTPUT "${test_build_dir}/headers/${name}.cpp" CONTENT "${includes}// a second time\n${includes}")
    list(APPEND sources "${test_build_dir}/headers/${name}.cpp")
endwhile()

add_executable(header_check EXCLUDE_FROM_ALL ${sources})
set_target_properties(header_check PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${test_build_dir}/headers")
target_link_libraries(header_check PRIVATE ism_dev_options)
target_compile_options(header_check PRIVATE -O0)
# What most of the time would go to, read once; that each includes what it names of it is for check_standard_includes and,
# of JSON, check_includes to say.
target_precompile_headers(header_check PRIVATE <algorithm> <array> <cmath> <filesystem> <functional> <fstream> <map> <memory> <optional> <span> <string>
                          <thread> <variant> <vector> <nlohmann/json.hpp>)

# All that fail are told, not the first alone.
set(keep_going "")
if(CMAKE_GENERATOR MATCHES "Ninja")
    set(keep_going -- -k 0 --quiet)
elseif(CMAKE_GENERATOR MATCHES "Makefiles")
    set(keep_going -- -k)
endif()
add_test(NAME headers COMMAND "${CMAKE_COMMAND}" --build "${CMAKE_BINARY_DIR}" --target header_check ${keep_going})
set_tests_properties(headers PROPERTIES LABELS headers TIMEOUT 900 PROCESSORS 2 COST 200)
