# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# include_reach(<header> <variable>): the headers that one comes with, itself first, by what `own_<header>` lists of each.
function(include_reach header variable)
    set(reached "${header}")
    set(next "${header}")
    while(next)
        list(POP_FRONT next current)
        foreach(included IN LISTS own_${current})
            if(NOT included IN_LIST reached)
                list(APPEND reached "${included}")
                list(APPEND next "${included}")
            endif()
        endforeach()
    endwhile()
    set(${variable} "${reached}" PARENT_SCOPE)
endfunction()
