# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# Every tests/must_not_compile/*.cpp begins with a line `// expect: text`: compiling it fails and says the text.
file(GLOB sources CONFIGURE_DEPENDS "${test_dir}/must_not_compile/*.cpp")

# The include folders of ism::ism and all it links to, as the compiler gets them.
add_library(ism_include_dirs OBJECT EXCLUDE_FROM_ALL "${test_dir}/support/control.cpp")
target_link_libraries(ism_include_dirs PRIVATE ism_dev_options)
set(flags "-I$<JOIN:$<TARGET_PROPERTY:ism_include_dirs,INCLUDE_DIRECTORIES>,$<SEMICOLON>-I>")

set(all_errors "")
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang") # tells 20 otherwise
    set(all_errors -ferror-limit=0)
endif()
add_test(NAME must_not_compile
         COMMAND "${CMAKE_COMMAND}" "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DFLAGS=${flags};${all_errors}" "-DSCRATCH=${test_build_dir}/must_not_compile"
                 "-DSOURCES=${sources}" -P "${test_dir}/support/check_compile_error.cmake")
set_tests_properties(must_not_compile PROPERTIES LABELS must_not_compile)
