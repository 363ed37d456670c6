# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# What our own tests, examples and benchmarks share; nothing of it reaches users of ism::ism.
if(PROJECT_IS_TOP_LEVEL)
    set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
    set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Kind of build" FORCE)
    endif()
endif()
set(CMAKE_CXX_EXTENSIONS OFF)

# ism_group(<name>): a target ism_<name> of several programs, called <name> too where no other project can have one called so.
function(ism_group name)
    add_custom_target(ism_${name})
    if(PROJECT_IS_TOP_LEVEL)
        add_custom_target(${name})
        add_dependencies(${name} ism_${name})
    endif()
endfunction()

add_library(ism_dev_options INTERFACE)
target_compile_options(ism_dev_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow)
if(ISM_WERROR)
    target_compile_options(ism_dev_options INTERFACE -Werror)
endif()
if(ISM_NATIVE)
    target_compile_options(ism_dev_options INTERFACE -march=native)
endif()
# A product is rounded before it is added to, also where the processor could do both at once: whether a compiler joins them
# depends on what it inlines, and programs built apart, or for other processors, would differ in last bits.
target_compile_options(ism_dev_options INTERFACE -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU") # its garbage collector begins at 700 MB, not at 128: about a tenth of the time
    target_compile_options(ism_dev_options INTERFACE --param=ggc-min-heapsize=700000)
    if(CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.") # which warns of "text" + string where nothing overlaps (gcc's bug 105651)
        target_compile_options(ism_dev_options INTERFACE -Wno-restrict)
    endif()
endif()
target_include_directories(ism_dev_options INTERFACE "${PROJECT_SOURCE_DIR}/examples")
target_link_libraries(ism_dev_options INTERFACE ism::ism)

# Where speed matters, features, words and votes, the flags of the build type stand. What only reads options, writes
# JSON or checks results links to these instead: compiled in two thirds of the time, it runs for no longer than anyone notices.
add_library(ism_quick_options INTERFACE)
target_link_libraries(ism_quick_options INTERFACE ism_dev_options)
target_compile_options(ism_quick_options INTERFACE $<$<CONFIG:Release>:-O1>)

# stb's implementation, compiled once. An archive: a program that compiles its own copy does not clash with it.
if(EXISTS "${PROJECT_SOURCE_DIR}/include/ism/io/stb_implementation.hpp")
    add_library(ism_stb STATIC EXCLUDE_FROM_ALL "${PROJECT_SOURCE_DIR}/tests/support/stb.cpp")
    target_link_libraries(ism_stb PRIVATE ism::ism)
    target_compile_options(ism_stb PRIVATE $<$<CONFIG:Debug>:-O0>)
    if(ISM_BUILD_PYTHON) # whose module draws
        set_target_properties(ism_stb PROPERTIES POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden)
    endif()
else()
    add_library(ism_stb INTERFACE)
endif()

# The toy scenes, compiled once for the program, the examples, a test and a benchmark.
file(GLOB toy_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/examples/toy/*.cpp" "${PROJECT_SOURCE_DIR}/examples/toy_lessons.cpp")
add_library(ism_toys STATIC EXCLUDE_FROM_ALL ${toy_sources})
target_link_libraries(ism_toys PUBLIC ism_dev_options PRIVATE ism_stb)
target_compile_options(ism_toys PRIVATE $<$<CONFIG:Release>:-O2>)
set_source_files_properties("${PROJECT_SOURCE_DIR}/examples/toy/toy_set.cpp" PROPERTIES
                            SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS "$<IF:$<CONFIG:Debug>,-O0,-O1>") # which writes JSON
set_target_properties(ism_toys PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 7)

# Catch2, version 2.13 or 3, and our own main: Debian's prebuilt main lacks the benchmark half.
function(ism_find_catch2)
    if(NOT TARGET Catch2::Catch2)
        find_package(Catch2 QUIET)
    endif()
    if(NOT TARGET Catch2::Catch2)
        message(FATAL_ERROR "Catch2 2.13 or newer is needed for tests and benchmarks: run scripts/install_dependencies, "
                            "or set ISM_FETCH_DEPENDENCIES, or switch ISM_BUILD_TESTS and ISM_BUILD_BENCHMARKS off")
    endif()
    if(NOT TARGET ism_catch_main)
        add_library(ism_catch_main OBJECT EXCLUDE_FROM_ALL "${PROJECT_SOURCE_DIR}/tests/support/main.cpp")
        target_include_directories(ism_catch_main PUBLIC "${PROJECT_SOURCE_DIR}/tests")
        target_compile_definitions(ism_catch_main PUBLIC CATCH_CONFIG_ENABLE_BENCHMARKING)
        target_compile_features(ism_catch_main PUBLIC cxx_std_20)
        target_link_libraries(ism_catch_main PUBLIC Catch2::Catch2)
        target_compile_options(ism_catch_main PRIVATE -O0 -fno-sanitize=all) # what reports the tests is not what they test
    endif()
endfunction()
