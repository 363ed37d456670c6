# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# PYTHON, PACKAGE, TESTS, PROGRAM: pytest, where it and numpy are installed.
execute_process(COMMAND "${PYTHON}" -c "import numpy, pytest" RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(NOT result EQUAL 0)
    message(STATUS "skipped: ${PYTHON} has no numpy or no pytest")
    return()
endif()
set(ENV{PYTHONPATH} "${PACKAGE}")
set(ENV{PYTHONDONTWRITEBYTECODE} 1)
set(ENV{ISM_PROGRAM} "${PROGRAM}")
execute_process(COMMAND "${PYTHON}" -m pytest -q -p no:cacheprovider "${TESTS}" RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "pytest: failed")
endif()
