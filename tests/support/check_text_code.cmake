# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# COMPILER, FLAGS, TEXT, SCRATCH: each ```cpp block of a page compiles. What a reader has to fill in, an ellipsis,
# is a default value; `picture` is an image of the reader's.
file(READ "${TEXT}" text)
string(REPLACE "[" "<:" text "${text}") # brackets mean something in CMake's lists; these digraphs are the same in C++
string(REPLACE "]" ":>" text "${text}")
string(REPLACE ";" "<semicolon>" text "${text}")
string(REGEX MATCHALL "\n```cpp\n[^`]*\n```\n" blocks "${text}")
list(LENGTH blocks count)
if(count EQUAL 0)
    message(FATAL_ERROR "${TEXT}: expected a block ```cpp")
endif()
set(number 0)
foreach(block IN LISTS blocks)
    math(EXPR number "${number} + 1")
    string(REGEX REPLACE "^\n```cpp\n|```\n$" "" block "${block}")
    string(REPLACE "<semicolon>" ";" block "${block}")
    string(REPLACE "= …" "= {}" block "${block}")
    string(REGEX MATCHALL "#include [^\n]+\n" includes "${block}")
    string(CONCAT includes ${includes})
    string(REGEX REPLACE "#include [^\n]+\n" "" block "${block}")
    set(source "${SCRATCH}/block_${number}.cpp")
    file(WRITE "${source}" "#include <iostream>\n#include <string>\n#include <vector>\n${includes}
int main() {\nconst ism::GrayImage picture(64, 64);\n${block}\n}\n")
    execute_process(COMMAND "${COMPILER}" -std=c++20 -fsyntax-only ${FLAGS} "${source}" RESULT_VARIABLE result ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${TEXT}: block ${number} does not compile:\n${output}")
    endif()
endforeach()
message(STATUS "${count} blocks compile")
