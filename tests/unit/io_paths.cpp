// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/io/paths.hpp"

using ism::FileError;
using ism::test::error_message;

namespace fs = std::filesystem;

TEST_CASE("A file is named as seen from a folder, whether it is there or not") {
    CHECK(ism::relative_to("/a/b/c.png", "/a/b") == "c.png");
    CHECK(ism::relative_to("/a/b/c.png", "/a/b/") == "c.png");
    CHECK(ism::relative_to("/a/x/../b/c.png", "/a/d") == "../b/c.png");
    CHECK(ism::relative_to("b/c.png", "b") == "c.png");
    CHECK(ism::relative_to("b/c.png", "") == "b/c.png");
    CHECK(ism::relative_to("./c.png", fs::current_path()) == "c.png");
}

TEST_CASE("A file without a place is refused as one of ours, not of the standard library") {
    CHECK(error_message<FileError>([] {
              (void)ism::relative_to("", "/a");
          }).starts_with("file '': expected a name with a place, got "));
    const ism::test::TemporaryFolder folder;
    const ism::test::WorkingFolder gone(folder.path());
    fs::remove(folder.path());
    CHECK(error_message<FileError>([] {
              (void)ism::relative_to("c.png", "/a");
          }).starts_with("file 'c.png': expected a name with a place, got "));
}

TEST_CASE("An error gets its place before it and becomes one of files") {
    CHECK(ism::at_place("there", [] { return 3; }) == 3);
    const auto fails = [] { ism::at_place("there", [] { ism::expect(false, "a", "b", "c"); }); };
    CHECK(error_message<FileError>(fails) == "there: a: expected b, got c");
}

TEST_CASE("File names are UTF-8 in other files and come back") {
    const std::string name = "b\xc3\xa4ume/\xe6\xa8\xb9.png";
    CHECK(ism::path_to_utf8(ism::path_from_utf8(name)) == name);
    CHECK(ism::path_to_utf8(fs::path("a") / "b.png") == "a/b.png");
    CHECK(ism::file_text("a/b.png") == "file 'a/b.png'");
}
