# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# COMPILER, FLAGS, SOURCE, SCRATCH; GOOD=ON: the source compiles. Otherwise it fails with the text of its first
# line, `// expect: text`, while a file with nothing but its #include lines compiles.
function(compile file result_name output_name)
    execute_process(COMMAND "${COMPILER}" -std=c++20 -fsyntax-only ${FLAGS} "${file}"
                    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    set(${result_name} "${result}" PARENT_SCOPE)
    set(${output_name} "${output}" PARENT_SCOPE)
endfunction()

if(GOOD)
    compile("${SOURCE}" result output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${SOURCE}: has to compile, got\n${output}")
    endif()
    return()
endif()

file(READ "${SOURCE}" content)
if(NOT content MATCHES "^// expect: ([^\n]+)\n")
    message(FATAL_ERROR "${SOURCE}: expected '// expect: <text>' as the first line")
endif()
string(STRIP "${CMAKE_MATCH_1}" expected)

file(STRINGS "${SOURCE}" includes REGEX "^#include ")
if(NOT includes)
    message(FATAL_ERROR "${SOURCE}: expected at least one #include line")
endif()
list(JOIN includes "\n" includes)
cmake_path(GET SOURCE STEM name)
file(WRITE "${SCRATCH}/${name}_control.cpp" "${includes}\nint main() {}\n")
compile("${SCRATCH}/${name}_control.cpp" result output)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${SOURCE}: already its #include lines do not compile:\n${output}")
endif()

compile("${SOURCE}" result output)
if(result EQUAL 0)
    message(FATAL_ERROR "${SOURCE}: compiles, but has to fail with '${expected}'")
endif()
string(FIND "${output}" "${expected}" position)
if(position EQUAL -1)
    message(FATAL_ERROR "${SOURCE}: fails as it has to, but without '${expected}' in\n${output}")
endif()
