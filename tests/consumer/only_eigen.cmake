# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# COMPILER, EIGEN (the folder with Eigen/Core), INCLUDE, SOURCE, SCRATCH: a program that trains and detects reads our
# headers, the compiler's own, and of all libraries Eigen alone, wherever the others may be installed.
file(MAKE_DIRECTORY "${SCRATCH}/include")
file(CREATE_LINK "${EIGEN}/Eigen" "${SCRATCH}/include/Eigen" SYMBOLIC)
execute_process(COMMAND "${COMPILER}" -std=c++20 -fsyntax-only -MD -MF "${SCRATCH}/read.d" "-I${INCLUDE}" -isystem "${SCRATCH}/include" "${SOURCE}"
                RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${SOURCE}: expected to compile with Eigen alone, got\n${output}")
endif()
file(READ "${SCRATCH}/read.d" files)
string(REGEX MATCHALL "[^ \n]+" files "${files}")
set(foreign ${files})
list(FILTER foreign INCLUDE REGEX "/(nlohmann|stb|CLI|catch2|opencv[24]|boost)/|nanoflann")
if(foreign)
    list(JOIN foreign "\n  " foreign)
    message(FATAL_ERROR "${SOURCE}: expected to read no library but Eigen, got\n  ${foreign}")
endif()
list(FILTER files INCLUDE REGEX "/Eigen/Core$")
if(NOT files)
    message(FATAL_ERROR "${SOURCE}: expected to read Eigen/Core, so this test tests nothing")
endif()
