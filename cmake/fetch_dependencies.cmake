# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# Downloads what is not installed. Only their headers are used: none of their own build files is run.
include(FetchContent)
set(ism_timestamps "") # the argument is new in CMake 3.24, which warns where it is missing
if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.24)
    set(ism_timestamps DOWNLOAD_EXTRACT_TIMESTAMP ON)
endif()

function(ism_fetch package target url include_dir)
    if(TARGET ${target})
        return()
    endif()
    find_package(${package} CONFIG QUIET)
    if(TARGET ${target})
        return()
    endif()
    string(TOLOWER ${package} name)
    message(STATUS "ism: downloading ${package}")
    FetchContent_Declare(ism_${name} URL ${url} ${ism_timestamps} SOURCE_SUBDIR no_build_files)
    FetchContent_MakeAvailable(ism_${name})
    add_library(${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${target} SYSTEM INTERFACE "${ism_${name}_SOURCE_DIR}/${include_dir}")
endfunction()

ism_fetch(nanoflann nanoflann::nanoflann https://github.com/jlblancoc/nanoflann/archive/v1.5.5.tar.gz include)
ism_fetch(nlohmann_json nlohmann_json::nlohmann_json https://github.com/nlohmann/json/archive/v3.11.3.tar.gz include)

find_path(ISM_stb_INCLUDE_DIR stb/stb_image.h)
if(NOT ISM_stb_INCLUDE_DIR)
    # Its headers are included as <stb/stb_image.h>, so the folder itself has to be called stb.
    message(STATUS "ism: downloading stb")
    FetchContent_Declare(ism_stb_source SOURCE_DIR "${CMAKE_BINARY_DIR}/_deps/stb_include/stb"
        URL https://github.com/nothings/stb/archive/8b5f1f37b5b75829fc72d38e7b5d4bcbf8a26d55.tar.gz
        ${ism_timestamps} SOURCE_SUBDIR no_build_files)
    FetchContent_MakeAvailable(ism_stb_source)
    set(ISM_stb_INCLUDE_DIR "${CMAKE_BINARY_DIR}/_deps/stb_include" CACHE PATH "" FORCE)
endif()

if(ISM_BUILD_EXAMPLES)
    ism_fetch(CLI11 CLI11::CLI11 https://github.com/CLIUtils/CLI11/archive/v2.4.2.tar.gz include)
endif()
if(ISM_BUILD_TESTS OR ISM_BUILD_BENCHMARKS)
    ism_fetch(Catch2 Catch2::Catch2 https://github.com/catchorg/Catch2/archive/v2.13.10.tar.gz single_include)
endif()
