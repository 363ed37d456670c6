// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "page.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

#include "input.hpp"

#include "ism/io/paths.hpp"
#include "ism/io/write_file.hpp"

namespace program {

namespace fs = std::filesystem;

namespace {

/// Lists what a page has written into the folder of its pictures, after the page's name.
constexpr const char* list_name = "made-by-ism.txt";

/// The pictures that an earlier page of this name has written; none where the folder is not of such a page.
std::optional<std::set<std::string>> earlier_pictures(const fs::path& folder, const fs::path& page) {
    std::error_code failure;
    if (!fs::is_regular_file(folder / list_name, failure)) return {};
    std::istringstream lines(ism::read_text(folder / list_name, std::size_t(1) << 26));
    std::string line;
    std::getline(lines, line);
    if (line != ism::path_to_utf8(page.filename())) return {};
    std::set<std::string> names;
    while (std::getline(lines, line))
        if (line == ism::path_to_utf8(ism::path_from_utf8(line).filename())) names.insert(line);
    return names;
}

void write_list(const fs::path& folder, const fs::path& page, const std::set<std::string>& names) {
    std::string text = ism::path_to_utf8(page.filename()) + "\n";
    for (const std::string& name : names) text += name + "\n";
    ism::write_file(folder / list_name, text);
}

/// @throws ism::FileError where something else is in the folder than pictures of an earlier page of this
/// name.
void check_pictures_folder(const fs::path& page) {
    const fs::path folder = pictures_folder(page);
    std::error_code failure;
    if (!fs::exists(fs::symlink_status(folder, failure))) return;
    make_folder(folder);
    const auto names = earlier_pictures(folder, page);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = ism::path_to_utf8(entry.path().filename());
        if (name.starts_with(".")) continue;  // of a file browser, never written over
        if (names && (names->contains(name) || name == list_name)) continue;
        throw ism::FileError(ism::join_text("folder '", ism::one_line(folder.string()),
                                            "': expected nothing but pictures of an earlier page '",
                                            ism::one_line(page.filename().string()), "', got '",
                                            ism::one_line(name), "'"));
    }
}

/// A path as an address in a page.
std::string address_of(const fs::path& path) {
    std::string address;
    for (const char c : ism::path_to_utf8(path)) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           std::string_view("-._~/").find(c) != std::string_view::npos;
        address += plain ? std::string(1, c) : "%" + ism::hex_text(std::uint8_t(c), 2);
    }
    return address;
}

}  // namespace

ism::ReportPictureOptions picture_options(const PageOptions& options, std::size_t pictures) {
    if (options.link) return {.side_px = 1600, .most_bytes = 0};
    constexpr std::size_t all_bytes = 380000;
    return {.side_px = 720,
            .most_bytes = std::min<std::size_t>(60000, all_bytes / std::max<std::size_t>(1, pictures))};
}

fs::path pictures_folder(const fs::path& page) {
    fs::path folder = page.extension() == ".html" ? page.parent_path() / page.stem() : page;
    return folder += "-images";
}

void check_page(const fs::path& file, std::span<const fs::path> inputs, const PageOptions& options) {
    ism::expect(file != "-", "--report", "a file", "standard output");
    check_output(file, inputs);
    if (options.link) check_pictures_folder(file);
}

void write_page(const fs::path& file, const ism::Report& report, const PageOptions& options) {
    if (!options.link) return ism::write_file(file, ism::to_html(report));
    const fs::path folder = pictures_folder(file);
    ism::LinkedPictures pictures{.folder = address_of(folder.filename())};
    const std::string html = ism::to_html(report, &pictures);
    check_pictures_folder(file);
    make_folder(folder);
    const std::set<std::string> earlier = earlier_pictures(folder, file).value_or(std::set<std::string>());
    std::set<std::string> names, all = earlier;
    for (const ism::LinkedPictures::File& picture : pictures.files) names.insert(picture.name);
    all.insert(names.begin(), names.end());
    write_list(folder, file, all);
    for (const ism::LinkedPictures::File& picture : pictures.files)
        ism::write_file(folder / picture.name, picture.bytes);
    ism::write_file(file, html);
    std::error_code ignored;
    for (const std::string& name : earlier)
        if (!names.contains(name)) fs::remove(folder / name, ignored);
    write_list(folder, file, names);
}

}  // namespace program
