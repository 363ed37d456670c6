# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# `cmake --install <build>` gives a package: find_package(ism 0.3) → ism::ism.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_DATADIR}/cmake/ism")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/ism" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        COMPONENT ism_development FILES_MATCHING PATTERN "*.hpp")

# ism_install_copyright(<component> <package> [<library>...]): our licence and those of the libraries that are compiled in, from
# packaging/licenses, where Debian looks for it.
function(ism_install_copyright component package)
    file(READ "${PROJECT_SOURCE_DIR}/LICENSE" text)
    foreach(library IN LISTS ARGN)
        file(READ "${PROJECT_SOURCE_DIR}/packaging/licenses/${library}" licence)
        string(APPEND text "\n--\n\nCompiled in: ${licence}")
    endforeach()
    set(file "${PROJECT_BINARY_DIR}/copyright/${package}/copyright")
    file(WRITE "${file}" "${text}")
    install(FILES "${file}" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" COMPONENT ${component})
endfunction()
ism_install_copyright(ism_development libism-dev)

install(TARGETS ism EXPORT ism_targets INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(EXPORT ism_targets FILE ism-targets.cmake NAMESPACE ism:: DESTINATION "${package_dir}"
        COMPONENT ism_development)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/ism-config.cmake.in" "${PROJECT_BINARY_DIR}/ism-config.cmake"
                              INSTALL_DESTINATION "${package_dir}")
# Below 1.0 a new minor version may break what was written for the one before.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/ism-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/ism-config.cmake" "${PROJECT_BINARY_DIR}/ism-config-version.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/ism_dependencies.cmake"
        DESTINATION "${package_dir}" COMPONENT ism_development)

# For pkg-config; -std=c++20 is the program's own choice. It finds the headers from where it lies itself, unless that is
# outside of the prefix.
set(pkgconfig_dir "${CMAKE_INSTALL_DATADIR}/pkgconfig")
if(IS_ABSOLUTE "${pkgconfig_dir}")
    set(ism_pc_prefix "${CMAKE_INSTALL_PREFIX}")
else()
    file(RELATIVE_PATH ism_pc_prefix "/prefix/${pkgconfig_dir}" "/prefix")
    set(ism_pc_prefix "\${pcfiledir}/${ism_pc_prefix}")
endif()
set(ism_pc_includedir "\${prefix}")
cmake_path(APPEND ism_pc_includedir "${CMAKE_INSTALL_INCLUDEDIR}") # which an absolute path replaces
configure_file("${PROJECT_SOURCE_DIR}/cmake/ism.pc.in" "${PROJECT_BINARY_DIR}/ism.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/ism.pc" DESTINATION "${pkgconfig_dir}" COMPONENT ism_development)
