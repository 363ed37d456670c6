# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# COMPILER, FLAGS, SCRATCH, HEADER: with C++17 it says in few lines what is needed, with C++20 it compiles.
file(WRITE "${SCRATCH}/old_standard.cpp" "#include \"${HEADER}\"\nint main() {}\n")
foreach(standard 20 17)
    execute_process(COMMAND "${COMPILER}" -std=c++${standard} -fsyntax-only ${FLAGS} "${SCRATCH}/old_standard.cpp"
                    RESULT_VARIABLE result_${standard} OUTPUT_VARIABLE output_${standard} ERROR_VARIABLE output_${standard})
endforeach()
if(NOT result_20 EQUAL 0)
    message(FATAL_ERROR "${HEADER}: does not compile with C++20:\n${output_20}")
endif()
if(result_17 EQUAL 0 OR NOT output_17 MATCHES "ism needs C\\+\\+20: compile with -std=c\\+\\+20")
    message(FATAL_ERROR "${HEADER}: expected 'ism needs C++20: compile with -std=c++20' with C++17, got\n${output_17}")
endif()
string(REGEX MATCHALL "\n" lines "${output_17}")
list(LENGTH lines count)
if(count GREATER_EQUAL 40)
    message(FATAL_ERROR "${HEADER}: expected fewer than 40 lines with C++17, got ${count}:\n${output_17}")
endif()
