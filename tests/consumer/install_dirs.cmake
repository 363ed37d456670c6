# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# ISM_SOURCE, SCRATCH, COMPILER, GENERATOR, VERSION: installed to folders of one's own, below the prefix and outside of it, ism is found
# by find_package() and pkg-config.
function(step what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "consumer by install_dirs, ${what}: failed\n${output}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

find_program(pkg_config NAMES pkg-config pkgconf)
file(REMOVE_RECURSE "${SCRATCH}")
foreach(part CMakeLists.txt LICENSE cmake include) # apart, for CMake refuses to install headers into the source tree
    file(COPY "${ISM_SOURCE}/${part}" DESTINATION "${SCRATCH}/source")
endforeach()
foreach(case "below;own/headers;own/data" "outside;${SCRATCH}/headers;${SCRATCH}/data")
    list(POP_FRONT case name headers data)
    set(prefix "${SCRATCH}/${name}/prefix")
    step("configure ${name}" "${CMAKE_COMMAND}" -S "${SCRATCH}/source" -B "${SCRATCH}/${name}/ism" -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${COMPILER}"
         -DISM_BUILD_TESTS=OFF -DISM_BUILD_EXAMPLES=OFF -DISM_BUILD_BENCHMARKS=OFF "-DCMAKE_INSTALL_PREFIX=${prefix}"
         "-DCMAKE_INSTALL_INCLUDEDIR=${headers}" "-DCMAKE_INSTALL_DATADIR=${data}")
    step("install ${name}" "${CMAKE_COMMAND}" --install "${SCRATCH}/${name}/ism")
    cmake_path(ABSOLUTE_PATH headers BASE_DIRECTORY "${prefix}")
    cmake_path(ABSOLUTE_PATH data BASE_DIRECTORY "${prefix}")
    step("configure a consumer, ${name}" "${CMAKE_COMMAND}" -S "${ISM_SOURCE}/tests/consumer/find_package" -B "${SCRATCH}/${name}/build" -G "${GENERATOR}"
         "-DCMAKE_CXX_COMPILER=${COMPILER}" "-Dism_DIR=${data}/cmake/ism" "-DISM_VERSION=${VERSION}")
    step("build a consumer, ${name}" "${CMAKE_COMMAND}" --build "${SCRATCH}/${name}/build")
    step("run a consumer, ${name}" "${SCRATCH}/${name}/build/consumer")
    if(NOT output MATCHES "^ism ${VERSION}")
        message(FATAL_ERROR "consumer by install_dirs, ${name}: expected 'ism ${VERSION}' first, got '${output}'")
    endif()
    if(pkg_config)
        set(ENV{PKG_CONFIG_PATH} "${data}/pkgconfig")
        step("pkg-config, ${name}" "${pkg_config}" --variable=includedir ism)
        string(REGEX REPLACE "\\\\(.)" "\\1" output "${output}") # as a shell reads it
        cmake_path(SET output NORMALIZE "${output}")
        if(NOT output STREQUAL headers OR NOT EXISTS "${output}/ism/ism.hpp")
            message(FATAL_ERROR "pkg-config, ${name}: expected headers in ${headers}, got '${output}'")
        endif()
    endif()
endforeach()
