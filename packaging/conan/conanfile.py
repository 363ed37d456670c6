# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# From the root of the source tree: conan create packaging/conan -s compiler.cppstd=20 --build=missing
import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy, load


class IsmConan(ConanFile):
    name = "ism"
    license = "MIT"
    author = "The ism authors"
    description = "Implicit Shape Models: find, segment and place objects of many classes. C++20, headers only."
    package_type = "header-library"
    settings = "os", "compiler", "build_type", "arch"
    no_copy_source = True

    def set_version(self):
        text = load(self, os.path.join(self.recipe_folder, "..", "..", "include", "ism", "version.hpp"))
        self.version = ".".join(re.findall(r"#define ISM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", text))

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        copy(self, "LICENSE", root, self.export_sources_folder)
        copy(self, "include/ism/*.hpp", root, self.export_sources_folder)

    def requirements(self):
        self.requires("nanoflann/1.6.0")
        self.requires("nlohmann_json/3.11.3")
        self.requires("stb/cci.20240531")

    def validate(self):
        check_min_cppstd(self, 20)

    def package_id(self):
        self.info.clear()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        copy(self, "include/ism/*.hpp", self.source_folder, self.package_folder)

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "ism")
        self.cpp_info.set_property("cmake_target_name", "ism::ism")
        self.cpp_info.set_property("pkg_config_name", "ism")
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        if self.settings.os in ["Linux", "FreeBSD"]:
            self.cpp_info.system_libs = ["pthread"]
