# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# Every tests/must_not_compile/*.cpp begins with a line `// expect: text`: compiling it fails and says the text.
# What all of them include compiles by the same command, so a wrong path does not count as success: without this control
# they are not run.
file(GLOB sources CONFIGURE_DEPENDS "${test_dir}/must_not_compile/*.cpp")

# The include folders of ism::ism and all it links to, as the compiler gets them.
add_library(ism_include_dirs OBJECT EXCLUDE_FROM_ALL "${test_dir}/support/control.cpp")
target_link_libraries(ism_include_dirs PRIVATE ism_dev_options)
set(flags "-I$<JOIN:$<TARGET_PROPERTY:ism_include_dirs,INCLUDE_DIRECTORIES>,$<SEMICOLON>-I>")
set(compile_error "${CMAKE_COMMAND}" "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DFLAGS=${flags}")

add_test(NAME must_not_compile/control
         COMMAND ${compile_error} "-DCONTROL=${test_build_dir}/must_not_compile/control.cpp" "-DSOURCES=${sources}"
                 -P "${test_dir}/support/check_compile_error.cmake")
set_tests_properties(must_not_compile/control PROPERTIES LABELS must_not_compile FIXTURES_SETUP includes_compile COST 40)
foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    add_test(NAME must_not_compile/${name}
             COMMAND ${compile_error} "-DSOURCE=${source}" -P "${test_dir}/support/check_compile_error.cmake")
    set_tests_properties(must_not_compile/${name} PROPERTIES LABELS must_not_compile FIXTURES_REQUIRED includes_compile)
endforeach()
