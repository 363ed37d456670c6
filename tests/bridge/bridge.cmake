# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# ism/adapt/NAME.hpp beside the real library: tests/bridge/NAME.cpp, one program each. Where the library is not installed
# (scripts/install_dependencies bridge-tests) the test is told as skipped.
add_custom_target(bridge_tests)
add_dependencies(ism_tested bridge_tests)
function(ism_bridge_test name package)
    if(NOT ${package}_FOUND)
        add_test(NAME bridge/${name} COMMAND "${CMAKE_COMMAND}" -E echo "skipped: ${package} is not installed")
        set_tests_properties(bridge/${name} PROPERTIES LABELS bridge SKIP_REGULAR_EXPRESSION "^skipped: ")
        return()
    endif()
    add_executable(bridge_${name} EXCLUDE_FROM_ALL "${test_dir}/bridge/${name}.cpp")
    target_link_libraries(bridge_${name} PRIVATE ism_dev_options ism_catch_main ${ARGN})
    target_include_directories(bridge_${name} SYSTEM PRIVATE ${${package}_INCLUDE_DIRS})
    target_compile_options(bridge_${name} PRIVATE -O0)
    add_dependencies(bridge_tests bridge_${name})
    add_test(NAME bridge/${name} COMMAND bridge_${name})
    set_tests_properties(bridge/${name} PROPERTIES LABELS bridge)
endfunction()

find_package(OpenCV QUIET COMPONENTS core)
ism_bridge_test(opencv OpenCV ${OpenCV_LIBS})
find_package(Eigen3 QUIET)
ism_bridge_test(eigen Eigen3 Eigen3::Eigen)
set(PCL_FIND_QUIETLY ON)
find_package(PCL QUIET COMPONENTS common)
file(GLOB pcl_headers "${PROJECT_SOURCE_DIR}/build/pcl/usr/include/pcl-*") # of scripts/install_dependencies bridge-tests
if(NOT PCL_FOUND AND pcl_headers AND Eigen3_FOUND AND NOT CMAKE_DISABLE_FIND_PACKAGE_PCL)
    get_target_property(eigen_headers Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
    set(PCL_INCLUDE_DIRS ${pcl_headers} ${eigen_headers})
    set(PCL_FOUND TRUE)
endif()
ism_bridge_test(pcl PCL ${PCL_LIBRARIES})

add_test(NAME bridge/absent COMMAND "${CMAKE_COMMAND}" "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DINCLUDE=${PROJECT_SOURCE_DIR}/include"
         "-DSCRATCH=${test_build_dir}/bridge_absent" -P "${test_dir}/bridge/absent.cmake")
set_tests_properties(bridge/absent PROPERTIES LABELS bridge)

# The code of the documentation compiles.
if(OpenCV_FOUND AND Eigen3_FOUND AND PCL_FOUND)
    set(bridge_flags ${OpenCV_INCLUDE_DIRS} ${PCL_INCLUDE_DIRS})
    list(REMOVE_DUPLICATES bridge_flags)
    list(REMOVE_ITEM bridge_flags /usr/include)
    list(TRANSFORM bridge_flags PREPEND "-isystem")
    add_test(NAME bridge/docs COMMAND "${CMAKE_COMMAND}" "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DFLAGS=${flags};${bridge_flags}"
             "-DTEXT=${PROJECT_SOURCE_DIR}/docs/bridges.md" "-DSCRATCH=${test_build_dir}/docs_code" "-DINCLUDE=${PROJECT_SOURCE_DIR}/include"
             -P "${test_dir}/support/check_text_code.cmake")
    set_tests_properties(bridge/docs PROPERTIES LABELS bridge COST 20)
endif()
