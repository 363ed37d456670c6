# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# BUILD, TARGET, OBJECTS, NM: sources of nothing but headers compile, and their objects have no symbol that another could not
# have too, which a definition that is not inline would bring.
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${BUILD}" --target ${TARGET} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "all headers together: do not compile\n${output}")
endif()
execute_process(COMMAND "${NM}" --demangle --defined-only --extern-only ${OBJECTS} RESULT_VARIABLE result OUTPUT_VARIABLE symbols ERROR_VARIABLE error)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${NM} ${OBJECTS}: ${error}")
endif()
string(REGEX MATCHALL "[^\n]* [TDBRSGC] [^\n]*" strong "${symbols}")
if(strong)
    list(JOIN strong "\n" strong)
    message(FATAL_ERROR "defined in a header, and not inline:\n${strong}")
endif()
