# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# COMPILER, INCLUDE, SOURCE, SCRATCH: a program that trains and detects reads our headers and the compiler's own, whatever
# other libraries are installed.
file(MAKE_DIRECTORY "${SCRATCH}")
execute_process(COMMAND "${COMPILER}" -std=c++20 -E -o "${SCRATCH}/read.ii" "-I${INCLUDE}" "${SOURCE}"
                RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${SOURCE}: expected to find all it includes, got\n${output}")
endif()
file(STRINGS "${SCRATCH}/read.ii" files ENCODING UTF-8 REGEX "^# [0-9]+ \"/.*\" 1") # where a file begins
list(TRANSFORM files REPLACE "^# [0-9]+ \"(.*)\".*" "\\1")
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
