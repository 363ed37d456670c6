# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# All sources are as clang-format 14 writes them; other versions write some lines differently.
find_program(clang_format NAMES clang-format-14 clang-format)
if(NOT clang_format)
    message("skipped: clang-format is not installed")
    return()
endif()
execute_process(COMMAND "${clang_format}" --version OUTPUT_VARIABLE version)
if(NOT version MATCHES "version 14\\.")
    message("skipped: expected clang-format 14, got ${version}")
    return()
endif()
file(GLOB_RECURSE sources "${ROOT}/include/*.hpp" "${ROOT}/tests/*.hpp" "${ROOT}/tests/*.cpp" "${ROOT}/examples/*.hpp"
     "${ROOT}/examples/*.cpp" "${ROOT}/benchmarks/*.hpp" "${ROOT}/benchmarks/*.cpp")
execute_process(COMMAND "${clang_format}" --dry-run -Werror ${sources} RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 0)
    string(REGEX MATCHALL "[^\n]+:[0-9]+:[0-9]+: error:" places "${output}")
    list(TRANSFORM places REPLACE ":[0-9]+:[0-9]+: error:" "")
    list(REMOVE_DUPLICATES places)
    list(TRANSFORM places REPLACE "^${ROOT}/" "")
    list(JOIN places " " places)
    message(FATAL_ERROR "not formatted; run in the project's root:\n  clang-format -i ${places}")
endif()
