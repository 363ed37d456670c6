# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# Read by cpack itself, before it packs.
if(NOT CPACK_GENERATOR STREQUAL "DEB" OR NOT CPACK_COMPONENTS_ALL MATCHES "ism_(program|python)")
    return()
endif()
# What a program is linked to is told by dpkg-shlibdeps; cpack asks `file` for programs, and fails where that is missing.
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
find_program(FILE_UTILITY file)
if(DPKG_SHLIBDEPS AND FILE_UTILITY)
    set(CPACK_DEBIAN_ISM_PROGRAM_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_ISM_PYTHON_PACKAGE_SHLIBDEPS ON)
else()
    message(WARNING "ism: dpkg-shlibdeps or file is not installed: the packages do not depend on the libraries that they need "
                    "(run scripts/install_dependencies packages)")
endif()
if(CPACK_ISM_NATIVE)
    message(WARNING "ism: ISM_NATIVE is on: the packages run on processors like this one alone (cmake --preset portable)")
endif()
