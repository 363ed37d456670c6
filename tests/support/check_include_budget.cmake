# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# What a header costs whoever includes it, without a clock: the headers of ours it reaches, and the libraries among them.
# A header that comes to reach more than its line says makes every program that includes it slower to compile.
#   header | headers of ours it may reach | libraries it may reach (of those below)
set(libraries "Eigen/" "nlohmann/" "stb/" "nanoflann" "CLI/" "iostream" "memory" "regex")
set(budget
    "ism.hpp                    | 153 | "
    "vote/axes.hpp              |  17 | "
    "detect/detect.hpp          | 107 | "
    "train/train_options.hpp    |   7 | "
    "train/training_image.hpp   |  10 | "
    "train/train.hpp            | 141 | "
    "evaluate/evaluate.hpp      |  10 | "
    "core/frame.hpp             |   8 | "
    "feature/hessian_laplace.hpp|  30 | "
    "feature/sift.hpp           |  28 | "
    "dataset/dataset.hpp        |  13 | "
    "dataset/coco.hpp           |  19 | nlohmann/"
    "io/images.hpp              |  12 | stb/ memory"
    "model_file/model_file.hpp  |  74 | nlohmann/"
)
set(errors "")

# Reads each header once: `own_<header>` are those of ours it includes, `other_<header>` the rest.
file(GLOB_RECURSE headers RELATIVE "${ROOT}/include/ism" "${ROOT}/include/ism/*.hpp")
foreach(header IN LISTS headers)
    set(own_${header} "")
    set(other_${header} "")
    file(STRINGS "${ROOT}/include/ism/${header}" lines REGEX "^ *# *include")
    foreach(line IN LISTS lines)
        if(line MATCHES "\"ism/([^\"]+)\"")
            list(APPEND own_${header} "${CMAKE_MATCH_1}")
        elseif(line MATCHES "<([^>]+)>")
            list(APPEND other_${header} "${CMAKE_MATCH_1}")
        endif()
    endforeach()
endforeach()

include("${CMAKE_CURRENT_LIST_DIR}/include_reach.cmake")

foreach(line IN LISTS budget)
    if(NOT line MATCHES "^([^ |]+) *\\| *([0-9]+) *\\| *(.*)$")
        message(FATAL_ERROR "expected 'header | number | libraries', got '${line}'")
    endif()
    set(header "${CMAKE_MATCH_1}")
    set(most "${CMAKE_MATCH_2}")
    separate_arguments(allowed UNIX_COMMAND "${CMAKE_MATCH_3}")
    if(NOT header IN_LIST headers)
        list(APPEND errors "${header}: there is no such header")
        continue()
    endif()
    include_reach("${header}" reached)
    set(foreign "")
    foreach(own IN LISTS reached)
        list(APPEND foreign ${other_${own}})
    endforeach()
    list(LENGTH reached count)
    if(count GREATER most)
        list(APPEND errors "${header}: expected to reach at most ${most} headers of ours, got ${count}")
    endif()
    set(used "")
    foreach(library IN LISTS libraries)
        set(with ${foreign})
        list(FILTER with INCLUDE REGEX "^${library}")
        if(with)
            list(APPEND used "${library}")
        endif()
        if(with AND NOT library IN_LIST allowed)
            foreach(own IN LISTS reached)
                set(by ${other_${own}})
                list(FILTER by INCLUDE REGEX "^${library}")
                if(by)
                    list(APPEND errors "${header}: expected not to reach <${by}>, got it by ${own}")
                    break()
                endif()
            endforeach()
        endif()
    endforeach()
    if(VERBOSE)
        message("${header} | ${count} of ${most} | ${used}")
    endif()
endforeach()

# Whatever is included first, an old standard ends the compilation in one line: every header reaches config.hpp.
foreach(header IN LISTS headers)
    include_reach("${header}" reached)
    if(NOT "config.hpp" IN_LIST reached)
        list(APPEND errors "${header}: expected to reach ism/config.hpp")
    endif()
endforeach()

if(errors)
    list(JOIN errors "\n  " errors)
    message(FATAL_ERROR "includes cost too much or too little:\n  ${errors}")
endif()
