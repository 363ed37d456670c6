# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# A project of its own uses ism as its users do: installed, and as a part of its source tree.
foreach(way find_package add_subdirectory)
    add_test(NAME consumer/${way}
             COMMAND "${CMAKE_COMMAND}" "-DWAY=${way}" "-DISM_SOURCE=${PROJECT_SOURCE_DIR}" "-DISM_BUILD=${CMAKE_BINARY_DIR}"
                     "-DSCRATCH=${test_build_dir}/consumer/${way}" "-DCOMPILER=${CMAKE_CXX_COMPILER}"
                     "-DGENERATOR=${CMAKE_GENERATOR}" "-DVERSION=${PROJECT_VERSION}"
                     -P "${test_dir}/consumer/run.cmake")
    set_tests_properties(consumer/${way} PROPERTIES LABELS consumer TIMEOUT 600)
endforeach()
if(NOT ISM_INSTALL)
    set_tests_properties(consumer/find_package PROPERTIES DISABLED ON)
endif()
