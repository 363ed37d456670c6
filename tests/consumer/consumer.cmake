# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# A project of its own uses ism as its users do: installed, as a part of its source tree, and fetched.
foreach(way find_package add_subdirectory fetch_content)
    add_test(NAME consumer/${way}
             COMMAND "${CMAKE_COMMAND}" "-DWAY=${way}" "-DISM_SOURCE=${PROJECT_SOURCE_DIR}" "-DISM_BUILD=${CMAKE_BINARY_DIR}"
                     "-DSCRATCH=${test_build_dir}/consumer/${way}" "-DCOMPILER=${CMAKE_CXX_COMPILER}"
                     "-DGENERATOR=${CMAKE_GENERATOR}" "-DVERSION=${PROJECT_VERSION}"
                     -P "${test_dir}/consumer/run.cmake")
    set_tests_properties(consumer/${way} PROPERTIES LABELS consumer TIMEOUT 600 COST 60 SKIP_REGULAR_EXPRESSION "skipped: ")
endforeach()
add_test(NAME consumer/install_dirs
         COMMAND "${CMAKE_COMMAND}" "-DISM_SOURCE=${PROJECT_SOURCE_DIR}" "-DSCRATCH=${test_build_dir}/consumer/install_dirs"
                 "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DGENERATOR=${CMAKE_GENERATOR}" "-DVERSION=${PROJECT_VERSION}"
                 -P "${test_dir}/consumer/install_dirs.cmake")
set_tests_properties(consumer/install_dirs PROPERTIES LABELS consumer TIMEOUT 300)
# Programs compiled by hand.
set(hints "$<TARGET_PROPERTY:ism_include_dirs,INCLUDE_DIRECTORIES>")
foreach(way include_path single_header pkg_config own_libraries same_bits)
    add_test(NAME consumer/${way}
             COMMAND "${CMAKE_COMMAND}" "-DWAY=${way}" "-DISM_SOURCE=${PROJECT_SOURCE_DIR}" "-DISM_BUILD=${CMAKE_BINARY_DIR}"
                     "-DSCRATCH=${test_build_dir}/consumer/${way}" "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DVERSION=${PROJECT_VERSION}"
                     "-DHINTS=${hints}" -P "${test_dir}/consumer/compile.cmake")
    set_tests_properties(consumer/${way} PROPERTIES LABELS consumer TIMEOUT 600 COST 60 SKIP_REGULAR_EXPRESSION "skipped: ")
endforeach()
# The recipes of packaging/, run by stand-ins of vcpkg and Conan.
add_test(NAME consumer/vcpkg
         COMMAND "${CMAKE_COMMAND}" "-DISM_SOURCE=${PROJECT_SOURCE_DIR}" "-DSCRATCH=${test_build_dir}/consumer/vcpkg" "-DCOMPILER=${CMAKE_CXX_COMPILER}"
                 "-DGENERATOR=${CMAKE_GENERATOR}" "-DVERSION=${PROJECT_VERSION}" "-DHINTS=${hints}" -P "${test_dir}/consumer/vcpkg.cmake")
find_program(ISM_PYTHON3 python3)
if(ISM_PYTHON3)
    add_test(NAME consumer/conan COMMAND "${ISM_PYTHON3}" "${test_dir}/consumer/conan.py" "${PROJECT_SOURCE_DIR}" "${test_build_dir}/consumer/conan"
             "${CMAKE_CXX_COMPILER}" "${CMAKE_GENERATOR}" "${PROJECT_VERSION}" "${hints}")
else()
    add_test(NAME consumer/conan COMMAND "${CMAKE_COMMAND}" -E echo "skipped: python3 is not installed")
endif()
set_tests_properties(consumer/vcpkg consumer/conan PROPERTIES LABELS consumer TIMEOUT 300 SKIP_REGULAR_EXPRESSION "skipped: ")
# Without the libraries that only some headers need: they are left out in turn when configuring …
set(optional Eigen3 nanoflann nlohmann_json stb CLI11 Catch2 OpenCV PCL pybind11)
list(TRANSFORM optional REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON" OUTPUT_VARIABLE without)
add_test(NAME consumer/without_optional
         COMMAND "${CMAKE_COMMAND}" "-DWAY=add_subdirectory" "-DISM_SOURCE=${PROJECT_SOURCE_DIR}" "-DISM_BUILD=${CMAKE_BINARY_DIR}"
                 "-DSCRATCH=${test_build_dir}/consumer/without_optional" "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DGENERATOR=${CMAKE_GENERATOR}"
                 "-DVERSION=${PROJECT_VERSION}" "-DMORE=${without}" -P "${test_dir}/consumer/run.cmake")
# … and a program that trains and detects reads none of them, though they are installed.
add_test(NAME consumer/only_standard
         COMMAND "${CMAKE_COMMAND}" "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DINCLUDE=${PROJECT_SOURCE_DIR}/include"
                 "-DSOURCE=${test_dir}/consumer/main.cpp" "-DSCRATCH=${test_build_dir}/consumer/only_standard" -P "${test_dir}/consumer/only_standard.cmake")
set_tests_properties(consumer/without_optional consumer/only_standard PROPERTIES LABELS consumer TIMEOUT 600 COST 60)

# The project itself, configured without what it can do without.
foreach(case "catch2;Catch2;-DISM_BUILD_TESTS=OFF;-DISM_BUILD_BENCHMARKS=OFF" "cli11;CLI11;-DISM_BUILD_TESTS=OFF;-DISM_BUILD_BENCHMARKS=OFF"
        "json;nlohmann_json;-DISM_BUILD_TESTS=OFF;-DISM_BUILD_BENCHMARKS=OFF" "nanoflann;nanoflann"
        "bridges;OpenCV;-DISM_BUILD_BENCHMARKS=OFF;-DCMAKE_DISABLE_FIND_PACKAGE_PCL=ON;-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON;-DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON;-DISM_BUILD_PYTHON=ON")
    list(POP_FRONT case name package)
    add_test(NAME configure/without_${name}
             COMMAND "${CMAKE_COMMAND}" -S "${PROJECT_SOURCE_DIR}" -B "${test_build_dir}/configure/${name}" -G "${CMAKE_GENERATOR}"
                     "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" -DISM_BENCHMARK_PEERS=OFF -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON ${case})
    set(says "Generating done")
    if(name MATCHES "cli11|json")
        set(says "left out.*Generating done")
    endif()
    if(name STREQUAL "bridges")
        set(says "07_camera is left out.*Python module is left out.*Generating done")
    endif()
    set_tests_properties(configure/without_${name} PROPERTIES LABELS consumer PASS_REGULAR_EXPRESSION "${says}")
endforeach()
# All of it within a project that has targets of the same names.
add_test(NAME configure/within_another
         COMMAND "${CMAKE_COMMAND}" -S "${test_dir}/consumer/within_another" -B "${test_build_dir}/configure/within_another" -G "${CMAKE_GENERATOR}"
                 "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" -DISM_BENCHMARK_PEERS=OFF "-DISM_SOURCE=${PROJECT_SOURCE_DIR}")
set_tests_properties(configure/within_another PROPERTIES LABELS consumer)
add_test(NAME consumer/debian
         COMMAND "${CMAKE_COMMAND}" "-DCPACK=${CMAKE_CPACK_COMMAND}" "-DISM_BUILD=${CMAKE_BINARY_DIR}" "-DSCRATCH=${test_build_dir}/consumer/debian"
                 "-DVERSION=${PROJECT_VERSION}" "-DPROGRAM=$<TARGET_EXISTS:ism_program>" "-DPYTHON=$<TARGET_EXISTS:ism_python>" "-DNATIVE=${ISM_NATIVE}"
                 -P "${test_dir}/consumer/debian.cmake")
set_tests_properties(consumer/debian PROPERTIES LABELS consumer TIMEOUT 300 SKIP_REGULAR_EXPRESSION "skipped: ")
add_test(NAME rules/versions COMMAND "${CMAKE_COMMAND}" "-DROOT=${PROJECT_SOURCE_DIR}" "-DVERSION=${PROJECT_VERSION}"
         -P "${test_dir}/support/check_versions.cmake")
set_tests_properties(rules/versions PROPERTIES LABELS rules)
if(NOT ISM_INSTALL)
    set_tests_properties(consumer/find_package consumer/pkg_config consumer/debian PROPERTIES DISABLED ON)
endif()
