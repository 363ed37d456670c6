// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/detect/detection.hpp"
#include "ism/show/font.hpp"

namespace program {

/// A font of the system for the names of classes in pictures; what it lacks is told on stderr.
[[nodiscard]] ism::Font overlay_font(std::span<const std::string> class_names);

/// The images of detections: for each image one with all of them and a row of four for the strongest.
class OverlayFiles {
public:
    static constexpr std::size_t rows = 3;

    /// Chooses file names in `folder` that are all different: the image's name without its ending, with a
    /// number where that is taken.
    /// @throws ism::FileError where it is the folder of an image of the data set.
    OverlayFiles(std::filesystem::path folder, const ism::Dataset& dataset);

    /// Writes those of image i.
    void write(std::size_t i, const ism::RgbImage& image, const ism::Detections& detections,
               std::span<const std::string> class_names, const ism::Font& font) const;

private:
    std::filesystem::path folder_;
    std::vector<std::string> stems_;
};

}  // namespace program
