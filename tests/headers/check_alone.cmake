# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# CLANG, FLAGS, HEADERS, FOLDERS they lie in, SCRATCH: each header names only what it includes, directly or not. To clang's
# modules each is a module of its own, which sees others only where it includes them, though all are compiled at once:
# one header after another takes ten times as long. What other libraries declare all of them see: that each includes what it
# names of the standard library and of JSON is for check_standard_includes and check_includes to say.
file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}")
set(modules "")
set(others "")
foreach(header IN LISTS HEADERS)
    foreach(folder IN LISTS FOLDERS)
        if(EXISTS "${folder}/${header}")
            set(path "${folder}/${header}")
        endif()
    endforeach()
    string(MAKE_C_IDENTIFIER "${header}" name)
    string(APPEND modules "    module ${name} { header \"${path}\" export * }\n")
    file(READ "${path}" text)
    string(REGEX MATCHALL "\n *# *include *<[^>]*>" includes "${text}")
    list(APPEND others ${includes})
endforeach()
list(FILTER others EXCLUDE REGEX "<stb") # of which macros make what they are
list(REMOVE_DUPLICATES others)
string(CONCAT others ${others})
file(WRITE "${SCRATCH}/others.hpp" "${others}\n")
file(WRITE "${SCRATCH}/module.modulemap" "module all {\n${modules}}\n")
execute_process(COMMAND "${CLANG}" -std=c++20 ${FLAGS} -Wall -Wextra -Wpedantic -Wshadow -Werror -ferror-limit=0
                        -fmodules "-fmodules-cache-path=${SCRATCH}" -fmodule-name=all -Xclang -fmodules-local-submodule-visibility
                        -include "${SCRATCH}/others.hpp" -Xclang -emit-module -x c++ -c "${SCRATCH}/module.modulemap" -o "${SCRATCH}/all.pcm"
                RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 0)
    string(REPLACE "\n" "\n  " output "${output}") # indented lines stay whole
    message(FATAL_ERROR "headers that do not include what they name:\n  ${output}")
endif()
list(LENGTH HEADERS count)
message(STATUS "${count} headers compile alone")
