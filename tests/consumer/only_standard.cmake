# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# COMPILER, INCLUDE, SOURCE, SCRATCH: a program that trains and detects reads our headers and the compiler's own, whatever
# other libraries are installed.
file(MAKE_DIRECTORY "${SCRATCH}")
execute_process(COMMAND "${COMPILER}" -std=c++20 -fsyntax-only -MD -MF "${SCRATCH}/read.d" "-I${INCLUDE}" "${SOURCE}"
                RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${SOURCE}: expected to compile without any library, got\n${output}")
endif()
file(READ "${SCRATCH}/read.d" files)
string(REGEX MATCHALL "[^ \n]+" files "${files}")
set(foreign ${files})
list(FILTER foreign INCLUDE REGEX "/(Eigen|nlohmann|stb|CLI|catch2|opencv[24]|boost|pcl[-0-9.]*|pybind11)/|nanoflann")
if(foreign)
    list(JOIN foreign "\n  " foreign)
    message(FATAL_ERROR "${SOURCE}: expected to read no library, got\n  ${foreign}")
endif()
list(FILTER files INCLUDE REGEX "ism/train/train.hpp$")
if(NOT files)
    message(FATAL_ERROR "${SOURCE}: expected to read ism/train/train.hpp, so this test tests nothing")
endif()
