// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "image_list.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <random>
#include <set>
#include <string_view>
#include <system_error>

#include "input.hpp"
#include <glob.h>
#include <unistd.h>

#include "ism/core/number_text.hpp"
#include "ism/dataset/image_files.hpp"
#include "ism/io/paths.hpp"
#include "ism/io/write_file.hpp"

namespace program {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view overlay_ending = ".ism.png";

std::vector<fs::path> files_of_pattern(const std::string& pattern) {
    glob_t found{};
    std::vector<fs::path> files;
    if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
        for (std::size_t i = 0; i < found.gl_pathc; ++i)
            if (!fs::is_directory(found.gl_pathv[i])) files.emplace_back(found.gl_pathv[i]);
    globfree(&found);
    return files;
}

}  // namespace

ImageList::ImageList(std::span<const std::string> arguments) {
    std::error_code failure;
    for (const std::string& argument : arguments) {
        if (argument == standard_input) {
            add_standard_input();
        } else if (fs::is_directory(argument, failure)) {
            add_found(ism::detail::image_files(argument), "folder '" + ism::one_line(argument) + "'",
                      "none; folders in it are not looked into");
        } else if (fs::exists(argument, failure) || argument.find_first_of("*?[") == std::string::npos) {
            ism::expect<ism::FileError>(fs::exists(argument, failure), ism::file_text(argument),
                                        "an image to read", "none of this name");
            ism::expect<ism::FileError>(!argument.ends_with(".json"), ism::file_text(argument), "an image",
                                        "JSON (a data set goes with --data)");
            add(argument);
        } else {
            add_found(files_of_pattern(argument), "pattern '" + ism::one_line(argument) + "'", "none");
        }
    }
    leave_out_overlays();
    leave_out_depth();
}

ImageList::~ImageList() {
    drop_temporary();
}

void ImageList::drop_temporary() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove_all(temporary_.parent_path(), ignored);
}

std::string ImageList::told(std::string message) const {
    if (temporary_.empty()) return message;
    const std::string name = ism::file_text(temporary_);
    if (const std::size_t at = message.find(name); at != std::string::npos)
        message.replace(at, name.size(), "standard input");
    return message;
}

void ImageList::add(const fs::path& file) {
    if (known_.insert(file.lexically_normal()).second) images_.push_back({file, file.string()});
}

void ImageList::add_standard_input() {
    const std::string place = "standard input";
    ism::expect<ism::FileError>(temporary_.empty(), place, "one '-'", "several");
    ism::expect<ism::FileError>(isatty(STDIN_FILENO) == 0, place, "an image (… - < photo.jpg)", "a terminal");
    constexpr std::size_t most_bytes = std::size_t(1) << 30;
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint8_t> part(std::size_t(1) << 16);
    while (const std::size_t count = std::fread(part.data(), 1, part.size(), stdin)) {
        bytes.insert(bytes.end(), part.begin(), part.begin() + std::ptrdiff_t(count));
        ism::expect<ism::FileError>(bytes.size() <= most_bytes, place,
                                    ism::lazy_text("at most ", most_bytes, " bytes"), "more");
    }
    ism::expect<ism::FileError>(!bytes.empty(), place, "an image", "nothing");
    std::random_device device;
    temporary_ = fs::temp_directory_path() /
                 ism::join_text("ism-", ism::hex_text(device(), 8), ism::hex_text(device(), 8)) /
                 "stdin";  // after which overlays are named
    fs::create_directory(temporary_.parent_path());
    fs::permissions(temporary_.parent_path(), fs::perms::owner_all);  // nobody else's business
    ism::write_file(temporary_, std::span<const std::uint8_t>(bytes));
    images_.push_back({temporary_, standard_input});
}

void ImageList::add_found(std::vector<fs::path> files, const std::string& place, const char* none) {
    std::sort(files.begin(), files.end());
    ism::expect<ism::FileError>(!files.empty(), place, "a file that is an image (PNG, JPEG, BMP, PNM)", none);
    for (const fs::path& file : files) add(file);
}

void ImageList::leave_out_overlays() {
    std::set<fs::path> overlays;
    for (const NamedImage& image : images_)
        for (const fs::path& own : {image.file.parent_path() / image.file.stem(), image.file})
            overlays.insert((own.string() + std::string(overlay_ending)));
    std::erase_if(images_, [&](const NamedImage& image) { return overlays.contains(image.file); });
}

void ImageList::leave_out_depth() {
    std::vector<fs::path> files;
    for (const NamedImage& image : images_) files.push_back(image.file);
    const std::set<fs::path> depth = ism::detail::depth_among(files);
    std::erase_if(images_, [&](const NamedImage& image) { return depth.contains(image.file); });
    tell_depth_left_out(depth.size());
}

std::vector<fs::path> overlay_files(std::span<const NamedImage> images) {
    std::set<fs::path> inputs, places, taken, folders;
    std::error_code failure;
    for (const NamedImage& image : images) {
        ism::expect<ism::FileError>(image.name != standard_input, "--show", "files to write beside",
                                    "standard input");
        inputs.insert(image.file.lexically_normal());
        places.insert(fs::canonical(image.file, failure));
    }
    std::vector<fs::path> files;
    for (const NamedImage& image : images) {
        const fs::path& input = image.file;
        fs::path file = input.parent_path() / input.stem();
        file += overlay_ending;
        if (!taken.insert(file.lexically_normal()).second) {
            file = input;
            file += overlay_ending;
            taken.insert(file.lexically_normal());
        }
        ism::expect<ism::FileError>(
            !inputs.contains(file.lexically_normal()), "--show",
            ism::lazy_text("no image that is named as what it writes beside '", input.string(), "'"),
            ism::lazy_text("'", file.string(), "'"));
        const bool exists = fs::exists(fs::symlink_status(file, failure));
        ism::expect<ism::FileError>(!exists || !places.contains(fs::canonical(file, failure)), "--show",
                                    ism::lazy_text("no link to an image as '", file.string(), "'"), "one");
        if (exists || folders.insert(file.parent_path()).second) check_output(file, {});
        files.push_back(std::move(file));
    }
    return files;
}

}  // namespace program
