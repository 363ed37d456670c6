// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "output.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <system_error>

#include "ism/io/paths.hpp"
#include "ism/io/png.hpp"
#include "ism/show/overlay.hpp"

namespace program {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> files_of(const std::string& stem) {
    std::vector<std::string> files = {stem + ".png"};
    for (std::size_t row = 1; row <= OverlayFiles::rows; ++row)
        files.push_back(ism::join_text(stem, "_", row, ".png"));
    return files;
}

}  // namespace

ism::Font overlay_font(std::span<const std::string> class_names) {
    ism::Font font = ism::system_font(class_names);
    const auto missing = std::find_if(class_names.begin(), class_names.end(),
                                      [&](const std::string& name) { return !font.covers(name); });
    if (font.empty())
        std::fputs("ism: no font was found: pictures are without words (Debian: fonts-dejavu-core)\n",
                   stderr);
    else if (missing != class_names.end())
        std::fprintf(stderr, "ism: no font was found for all letters of class '%s'\n",
                     ism::one_line(*missing).c_str());
    return font;
}

OverlayFiles::OverlayFiles(fs::path folder, const ism::Dataset& dataset) : folder_(std::move(folder)) {
    std::error_code failure;
    for (const ism::DatasetImage& image : dataset.images) {
        const fs::path beside = image.file.parent_path();
        if (fs::equivalent(folder_, beside.empty() ? "." : beside, failure) && !failure)
            throw ism::FileError(
                "folder '" + ism::one_line(folder_.string()) +
                "': expected another folder for overlays than that of the images, got that of " +
                ism::file_text(image.file));
    }
    std::set<std::string> taken;
    std::map<std::string, int> numbers;  // given last to images of a name
    for (const ism::DatasetImage& image : dataset.images) {
        const std::string base = image.file.stem().string();
        std::string stem = base;
        int& number = numbers.try_emplace(base, 1).first->second;
        const auto is_taken = [&] {
            const auto files = files_of(stem);
            return std::any_of(files.begin(), files.end(), [&](const auto& f) { return taken.contains(f); });
        };
        while (is_taken()) stem = ism::join_text(base, "-", ++number);
        for (const std::string& file : files_of(stem)) taken.insert(file);
        stems_.push_back(std::move(stem));
    }
}

void OverlayFiles::write(std::size_t i, const ism::RgbImage& image, const ism::Detections& detections,
                         std::span<const std::string> class_names, const ism::Font& font) const {
    const auto files = files_of(stems_[i]);
    const ism::OverlayOptions options{.font = &font};
    ism::write_png(folder_ / files[0], ism::draw_detections(image, detections, class_names, options));
    for (std::size_t row = 0; row < std::min(rows, detections.objects.size()); ++row)
        ism::write_png(folder_ / files[row + 1],
                       ism::draw_explanation(image, detections, row, class_names, options));
}

}  // namespace program
