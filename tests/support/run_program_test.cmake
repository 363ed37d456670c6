# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# Runs SCRIPT PROGRAM SCRATCH with SCRATCH made empty before; 77 from the script means skipped.
file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}")
execute_process(COMMAND bash "${SCRIPT}" "${PROGRAM}" "${SCRATCH}" WORKING_DIRECTORY "${SCRATCH}" RESULT_VARIABLE result)
if(result EQUAL 77)
    execute_process(COMMAND "${CMAKE_COMMAND}" -E echo "skipped: ${SCRIPT}")
elseif(NOT result EQUAL 0)
    message(FATAL_ERROR "${SCRIPT}: returned ${result}")
endif()
