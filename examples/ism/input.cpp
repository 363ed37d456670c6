// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "input.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <optional>
#include <random>
#include <string_view>
#include <system_error>

#include "progress.hpp"

#include "ism/core/number_text.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/dataset/coco_write.hpp"
#include "ism/dataset/image_files.hpp"
#include "ism/io/paths.hpp"
#include "ism/io/write_file.hpp"

namespace program {

namespace fs = std::filesystem;

std::string shell_word(const std::string& text) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) != 0 || std::string_view("/._-+,:@%=").find(char(c)) != std::string_view::npos;
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

std::string short_name(const ism::Dataset& dataset, const ism::DatasetImage& image) {
    return ism::path_to_utf8(ism::relative_to(image.file, dataset.source.parent_path()));
}

void tell_faults(std::span<const std::string> faults, const std::string& of_what, bool skip_bad) {
    constexpr std::size_t most_named = 20;
    for (std::size_t i = 0; i < std::min(most_named, faults.size()); ++i)
        std::fprintf(stderr, "ism: %s\n", faults[i].c_str());
    if (faults.size() > most_named)
        std::fprintf(stderr, "ism: ... and %zu more\n", faults.size() - most_named);
    if (!faults.empty() && !skip_bad)
        throw ism::Error(
            ism::join_text(faults.size(), " ", of_what,
                           " cannot be used; nothing was written (--skip-bad goes on without them)"));
}

void tell_depth_left_out(std::size_t count) {
    if (count == 0) return;
    std::fprintf(stderr, "ism: note: left out as depth: %zu of the images, which are grey PNG of 16 bits\n",
                 count);
}

void Doubts::add(const fs::path& file, const std::string& text) {
    if (text.empty()) return;
    const std::lock_guard lock(mutex_);
    texts_.insert(ism::file_text(file) + ": " + text);
}

void Doubts::tell() const {
    if (texts_.empty()) return;
    std::string line = *texts_.begin();
    if (texts_.size() > 1)
        line += ism::join_text(" (and ", texts_.size() - 1,
                               texts_.size() == 2 ? " other file)" : " other files)");
    std::fprintf(stderr, "ism: note: %s\n", line.c_str());
}

std::vector<std::string> short_names(const ism::Dataset& dataset) {
    std::vector<std::string> names;
    for (const ism::DatasetImage& image : dataset.images) names.push_back(short_name(dataset, image));
    return names;
}

std::string take_folder(std::vector<std::string>& names) {
    if (names.size() < 2) return {};
    std::string folder = names[0].substr(0, names[0].rfind('/') + 1);
    for (const std::string& name : names)
        while (!name.starts_with(folder))
            folder.resize(folder.size() < 2 ? 0 : folder.rfind('/', folder.size() - 2) + 1);
    for (std::string& name : names) name.erase(0, folder.size());
    return folder;
}

std::size_t check_images(ism::Dataset& dataset, unsigned threads, bool skip_bad,
                         const std::function<void(ism::DatasetImage&)>& read) {
    const std::size_t count = dataset.images.size();
    std::vector<std::optional<std::string>> faults(count);
    {
        ProgressLine progress;
        ism::parallel_for(count, threads, [&](std::size_t i) {
            try {
                read(dataset.images[i]);
            } catch (const ism::Error& error) {
                faults[i] = error.what();
            }
            progress.step("checking images", count);
        });
    }
    std::vector<ism::DatasetImage> good;
    std::vector<std::string> told;
    for (std::size_t i = 0; i < count; ++i) {
        if (faults[i])
            told.push_back(std::move(*faults[i]));
        else
            good.push_back(std::move(dataset.images[i]));
    }
    if (count == 1 && !told.empty()) throw ism::Error(told[0]);
    tell_faults(told, ism::join_text("of ", count, " images"), skip_bad);
    ism::expect(!good.empty(), "images that can be used", "1 or more", ism::lazy_text("none of ", count));
    dataset.images = std::move(good);
    return told.size();
}

bool is_standard_output(const fs::path& file) {
    return file == "-" || file == "/dev/stdout";
}

void check_output(const fs::path& file, std::span<const fs::path> inputs) {
    const std::string text = ism::file_text(file);
    std::error_code failure;
    if (file.filename().empty()) throw ism::FileError(text + ": expected a file to write, got no file name");
    if (fs::is_directory(file, failure))
        throw ism::FileError(text + ": expected a file to write, got a folder");
    for (const fs::path& input : inputs)
        if (!input.empty() && fs::equivalent(file, input, failure) && !failure)
            throw ism::FileError(text + ": expected another file than an input, got one");
    if (ism::detail::is_image_name(file) && fs::exists(file, failure))
        throw ism::FileError(text + ": expected a file to write that is no picture, got one");
    if (fs::exists(file, failure) && !fs::is_regular_file(file, failure)) return;
    ism::detail::check_replaceable(file);
    const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
    if (!fs::is_directory(folder, failure))
        throw ism::FileError(text + ": expected an existing folder to write to, got none");
    // Writing atomically needs a temporary file beside it: only trying shows whether that works.
    std::random_device device;
    const fs::path probe =
        folder / ism::join_text(".ism-", ism::hex_text(device(), 8), ism::hex_text(device(), 8));
    try {
        ism::write_file(probe, std::string_view());
    } catch (const ism::FileError&) {
        throw ism::FileError(text + ": expected a folder that can be written to, got one that cannot");
    }
    fs::remove(probe, failure);
}

void check_not_labels(const ism::Dataset& dataset, std::span<const fs::path> outputs) {
    std::error_code failure;
    for (const fs::path& output : outputs)
        for (const ism::DatasetImage& image : dataset.images)
            if (!output.empty() && !image.label_file.empty() &&
                fs::equivalent(output, image.label_file, failure) && !failure)
                throw ism::FileError(ism::file_text(output) +
                                     ": expected another file than the labels of an image, got these");
}

void make_folder(const fs::path& folder) {
    std::error_code failure;
    const std::string text = "folder '" + folder.string() + "'";
    if (fs::exists(folder, failure) && !fs::is_directory(folder, failure))
        throw ism::FileError(text + ": expected a folder, got a file");
    fs::create_directories(folder, failure);
    if (failure) throw ism::FileError(text + ": expected to make it, got " + failure.message());
    check_output(folder / "ism", {});
}

}  // namespace program
