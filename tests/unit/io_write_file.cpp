// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/io/write_file.hpp"

using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

long files_in(const std::filesystem::path& folder) {
    return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

}  // namespace

TEST_CASE("What is written to a file is read back, byte for byte") {
    const TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 200000; ++i) text.push_back(static_cast<char>(i * 7));
    ism::write_file(folder / "a", text);
    CHECK(ism::read_text(folder / "a") == text);
    const std::vector<std::uint8_t> bytes = ism::read_bytes(folder / "a");
    CHECK(std::equal(bytes.begin(), bytes.end(), text.begin(), text.end(),
                     [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }));
    ism::write_file(folder / "a", std::string_view());
    CHECK(ism::read_text(folder / "a").empty());
    CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("A write that fails halfway leaves the old file and nothing beside it") {
    const TemporaryFolder folder;
    ism::write_file(folder / "a", std::string_view("old"));
    const auto fail = [](std::ostream& stream) {
        stream << "half";
        throw std::runtime_error("stop");
    };
    CHECK_THROWS_AS(ism::write_file(folder / "a", fail), std::runtime_error);
    CHECK_THROWS_AS(ism::write_file(folder / "b", fail), std::runtime_error);
    CHECK_THROWS_AS(ism::write_file(folder / "b", [](std::ostream& s) { s.setstate(std::ios::badbit); }),
                    ism::FileError);
    CHECK(ism::read_text(folder / "a") == "old");
    CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("A file is not replaced where it is write-protected, and keeps its permissions where it is not") {
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    ism::write_file(folder / "a", std::string_view("old"));
    fs::permissions(folder / "a", fs::perms::owner_read);
    CHECK(error_message<ism::FileError>([&] {
              ism::write_file(folder / "a", std::string_view("new"));
          }).ends_with("/a': expected a file that may be replaced, got a write-protected one"));
    CHECK(ism::read_text(folder / "a") == "old");
    fs::permissions(folder / "a", fs::perms::owner_read | fs::perms::owner_write);
    ism::write_file(folder / "a", std::string_view("new"));
    CHECK(ism::read_text(folder / "a") == "new");
    CHECK(fs::status(folder / "a").permissions() == (fs::perms::owner_read | fs::perms::owner_write));
    CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("A link to a file stays a link when the file is written") {
    const TemporaryFolder folder;
    ism::write_file(folder / "a", std::string_view("old"));
    std::filesystem::create_symlink("a", folder / "link");
    ism::write_file(folder / "link", std::string_view("new"));
    CHECK(std::filesystem::is_symlink(folder / "link"));
    CHECK(ism::read_text(folder / "a") == "new");
}

TEST_CASE("Files that cannot be read or written are named with the reason") {
    const TemporaryFolder folder;
    const std::string name = folder.path().string();
    CHECK(error_message<ism::FileError>([&] { (void)ism::read_text(folder / "none"); }) ==
          "file '" + name + "/none': expected a file to read, got none of this name");
    CHECK(error_message<ism::FileError>([&] { (void)ism::read_bytes(folder.path()); }) ==
          "file '" + name + "': expected a file to read, got a folder");
    CHECK(error_message<ism::FileError>([&] { ism::write_file(folder.path(), std::string_view("x")); }) ==
          "file '" + name + "': expected a file to write, got a folder");
    CHECK(error_message<ism::FileError>([&] { ism::write_file(folder / "no/a", std::string_view("x")); }) ==
          "file '" + name + "/no/a': expected a place to write to, got No such file or directory");
    ism::write_file(folder / "a", std::string_view("12345"));
    CHECK(ism::read_text(folder / "a", 5) == "12345");
    CHECK(error_message<ism::FileError>([&] { (void)ism::read_text(folder / "a", 4); }) ==
          "file '" + name + "/a': expected at most 4 bytes, got 5");
    CHECK(files_in(folder.path()) == 1);
}
