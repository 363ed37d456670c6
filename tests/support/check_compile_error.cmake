# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# COMPILER, FLAGS and either
#   SOURCE            fails with the text of its first line, `// expect: text`; or
#   CONTROL, SOURCES  a file to write: nothing but the #include lines of all sources compiles.
function(compile file result_name output_name)
    execute_process(COMMAND "${COMPILER}" -std=c++20 -fsyntax-only ${FLAGS} "${file}"
                    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    set(${result_name} "${result}" PARENT_SCOPE)
    set(${output_name} "${output}" PARENT_SCOPE)
endfunction()

if(CONTROL)
    set(content "")
    foreach(source IN LISTS SOURCES)
        file(STRINGS "${source}" includes REGEX "^#include ")
        if(NOT includes)
            message(FATAL_ERROR "${source}: expected at least one #include line")
        endif()
        list(JOIN includes "\n" includes)
        string(APPEND content "${includes}\n")
    endforeach()
    file(WRITE "${CONTROL}" "${content}int main() {}\n")
    compile("${CONTROL}" result output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${CONTROL}: already the #include lines do not compile:\n${output}")
    endif()
    return()
endif()

file(READ "${SOURCE}" content)
if(NOT content MATCHES "^// expect: ([^\n]+)\n")
    message(FATAL_ERROR "${SOURCE}: expected '// expect: <text>' as the first line")
endif()
string(STRIP "${CMAKE_MATCH_1}" expected)
compile("${SOURCE}" result output)
if(result EQUAL 0)
    message(FATAL_ERROR "${SOURCE}: compiles, but has to fail with '${expected}'")
endif()
string(FIND "${output}" "${expected}" position)
if(position EQUAL -1)
    message(FATAL_ERROR "${SOURCE}: fails as it has to, but without '${expected}' in\n${output}")
endif()
