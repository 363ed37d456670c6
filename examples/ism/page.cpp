// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "page.hpp"

#include <algorithm>

#include "input.hpp"

#include "ism/io/paths.hpp"
#include "ism/io/write_file.hpp"

namespace program {

namespace fs = std::filesystem;

namespace {

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
    fs::path folder = page.parent_path() / page.stem();
    return folder += "-images";
}

void write_page(const fs::path& file, const ism::Report& report, const PageOptions& options) {
    if (!options.link) return ism::write_file(file, ism::to_html(report));
    const fs::path folder = pictures_folder(file);
    ism::LinkedPictures pictures{.folder = address_of(folder.filename())};
    const std::string html = ism::to_html(report, &pictures);
    make_folder(folder);
    for (const ism::LinkedPictures::File& picture : pictures.files)
        ism::write_file(folder / picture.name, picture.bytes);
    ism::write_file(file, html);
}

}  // namespace program
