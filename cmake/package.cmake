# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# `cpack -G DEB` in the build folder: libism-dev, ism (the program) and python3-ism, as far as they were built. To run on
# other processors than this one they are built by the preset `portable`.
set(CPACK_PACKAGE_NAME "ism")
set(CPACK_PACKAGE_VENDOR "The ism authors")
set(CPACK_PACKAGE_CONTACT "The ism authors <ism@localhost.invalid>") # the format asks for an address
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/package_permissions.cmake")
string(REGEX REPLACE "([][+.*()^$?|\\])" "\\\\\\1" root "${PROJECT_SOURCE_DIR}")
set(CPACK_SOURCE_IGNORE_FILES "^${root}/(\\.git|\\.cache|\\.vscode|\\.idea|build|install|ism-demo)/" "/__pycache__/")
set(CPACK_COMPONENTS_ALL ism_development)
if(TARGET ism_program)
    list(APPEND CPACK_COMPONENTS_ALL ism_program)
endif()
if(TARGET ism_python)
    list(APPEND CPACK_COMPONENTS_ALL ism_python)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ISM_DEVELOPMENT_PACKAGE_NAME "libism-dev")
set(CPACK_DEBIAN_ISM_DEVELOPMENT_PACKAGE_SECTION "libdevel")
set(CPACK_DEBIAN_ISM_DEVELOPMENT_PACKAGE_ARCHITECTURE "all")
set(CPACK_DEBIAN_ISM_DEVELOPMENT_PACKAGE_DEPENDS "libnanoflann-dev, libstb-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_ISM_DEVELOPMENT_PACKAGE_SUGGESTS "libeigen3-dev, libopencv-dev, libpcl-dev")
set(CPACK_DEBIAN_ISM_PROGRAM_PACKAGE_NAME "ism")
set(CPACK_DEBIAN_ISM_PROGRAM_PACKAGE_SECTION "science")
set(CPACK_DEBIAN_ISM_PROGRAM_PACKAGE_RECOMMENDS "fonts-dejavu-core")
set(CPACK_DEBIAN_ISM_PYTHON_PACKAGE_NAME "python3-ism")
set(CPACK_DEBIAN_ISM_PYTHON_PACKAGE_SECTION "python")
if(TARGET ism_python)
    set(CPACK_DEBIAN_ISM_PYTHON_PACKAGE_DEPENDS "${ism_python_depends}") # see python/
endif()
set(CPACK_ISM_NATIVE "${ISM_NATIVE}")
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_SOURCE_DIR}/cmake/package_options.cmake")
include(CPack)
