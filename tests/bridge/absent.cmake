# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# COMPILER, INCLUDE, SCRATCH: without its library a header of ism/adapt says in few lines what it needs; those that need
# none compile, and read none.
file(MAKE_DIRECTORY "${SCRATCH}")
foreach(bridge "opencv;OpenCV;opencv2/core.hpp" "eigen;Eigen;Eigen/Core" "pcl;PCL;pcl/point_cloud.h" "ros" "pixels")
    list(POP_FRONT bridge name library header)
    file(WRITE "${SCRATCH}/${name}.cpp" "#include \"ism/adapt/${name}.hpp\"\n")
    execute_process(COMMAND "${COMPILER}" -std=c++20 -fsyntax-only -MD -MF "${SCRATCH}/${name}.d" "-I${INCLUDE}" "${SCRATCH}/${name}.cpp"
                    RESULT_VARIABLE result ERROR_VARIABLE output)
    if(library)
        file(WRITE "${SCRATCH}/here.cpp" "#if __has_include(<${header}>)\n#error here\n#endif\n")
        execute_process(COMMAND "${COMPILER}" -fsyntax-only "${SCRATCH}/here.cpp" RESULT_VARIABLE here ERROR_QUIET)
        if(NOT here EQUAL 0)
            message(STATUS "${library} is where every compiler looks: not tested without it")
            continue()
        endif()
        string(REGEX MATCHALL "\n" lines "${output}")
        list(LENGTH lines count)
        if(result EQUAL 0 OR NOT output MATCHES "ism/adapt/${name}.hpp needs ${library}" OR count GREATER 10)
            message(FATAL_ERROR "ism/adapt/${name}.hpp: expected 'needs ${library}' in few lines, got\n${output}")
        endif()
    else()
        file(READ "${SCRATCH}/${name}.d" files)
        if(NOT result EQUAL 0 OR files MATCHES "/(opencv|Eigen|pcl|ros|sensor_msgs)[^/ \n]*/")
            message(FATAL_ERROR "ism/adapt/${name}.hpp: expected to compile without any library, got\n${output}")
        endif()
    endif()
endforeach()
