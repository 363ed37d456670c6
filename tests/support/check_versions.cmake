# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.22)

# ROOT, VERSION: files that tell the version beside include/ism/version.hpp tell the same.
foreach(file "CHANGELOG.md|\n## ([0-9.]+)" "CITATION.cff|\nversion: ([0-9.]+)" "packaging/vcpkg/ism/vcpkg.json|\"version\": \"([0-9.]+)\"")
    string(REPLACE "|" ";" file "${file}")
    list(GET file 0 name)
    list(GET file 1 pattern)
    file(READ "${ROOT}/${name}" text)
    if(NOT text MATCHES "${pattern}" OR NOT CMAKE_MATCH_1 STREQUAL VERSION)
        message(FATAL_ERROR "${name}: expected version ${VERSION} first, got '${CMAKE_MATCH_1}'")
    endif()
endforeach()
# What users are told to ask for is the same but for the last number.
string(REGEX REPLACE "\\.[0-9]+$" "" asked "${VERSION}")
file(READ "${ROOT}/docs/bridges.md" text)
if(NOT text MATCHES "find_package\\(ism ([0-9.]+)" OR NOT CMAKE_MATCH_1 STREQUAL asked)
    message(FATAL_ERROR "docs/bridges.md: expected find_package(ism ${asked} …), got '${CMAKE_MATCH_1}'")
endif()
