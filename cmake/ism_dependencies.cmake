# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# Finds the header libraries that ism's headers include and gathers them in the target `ism_dependencies`.
# Used by the project itself and by its installed package. Nothing here is a failure: a program needs only
# the libraries of the headers it includes (nlohmann_json and stb are for ism/io alone).
function(ism_find_dependencies)
    if(TARGET ism_dependencies)
        return()
    endif()
    # The project itself makes what it finds global: it is the folder above that links to ism.
    set(global "")
    if(ism_dependencies_global)
        set(global GLOBAL)
    endif()
    add_library(ism_dependencies INTERFACE IMPORTED ${global})
    set(missing "")

    foreach(library "nanoflann;nanoflann::nanoflann" "nlohmann_json;nlohmann_json::nlohmann_json")
        list(GET library 0 package)
        list(GET library 1 target)
        if(NOT TARGET ${target})
            find_package(${package} CONFIG QUIET)
            if(ism_dependencies_global AND TARGET ${target})
                set_target_properties(${target} PROPERTIES IMPORTED_GLOBAL ON)
            endif()
        endif()
        if(TARGET ${target})
            target_link_libraries(ism_dependencies INTERFACE ${target})
        else()
            list(APPEND missing ${package})
        endif()
    endforeach()

    # Packages without a CMake file. stb is a folder in Debian, and files without one by vcpkg and Conan.
    foreach(library "nanoflann;nanoflann.hpp" "nlohmann_json;nlohmann/json.hpp" "stb;stb_image.h;stb/stb_image.h")
        list(POP_FRONT library package)
        if(package IN_LIST missing OR package STREQUAL "stb")
            list(REMOVE_ITEM missing ${package})
            if(NOT CMAKE_DISABLE_FIND_PACKAGE_${package})
                find_path(ISM_${package}_INCLUDE_DIR NAMES ${library})
                mark_as_advanced(ISM_${package}_INCLUDE_DIR)
            endif()
            if(ISM_${package}_INCLUDE_DIR)
                target_include_directories(ism_dependencies SYSTEM INTERFACE "${ISM_${package}_INCLUDE_DIR}")
            else()
                list(APPEND missing ${package})
            endif()
        endif()
    endforeach()

    set(ism_missing ${missing} PARENT_SCOPE)
    if(missing AND NOT ism_FIND_QUIETLY)
        list(JOIN missing ", " missing)
        message(STATUS "ism: not found: ${missing} (only the headers that include them cannot be used)")
    endif()
endfunction()
