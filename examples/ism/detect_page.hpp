// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mistakes.hpp"
#include "page.hpp"

#include "ism/dataset/dataset.hpp"
#include "ism/model/training_object.hpp"

namespace program {

/// The page on what was found in the images of a data set: where labels tell, the mistakes first.
class DetectPage {
public:
    /// Chooses the images that are shown, at most `most`: those with the worst mistakes, else the first ones.
    /// @param results  of each image
    /// @param image_names  of each image, as they are told
    DetectPage(const ism::Dataset& dataset, const std::vector<std::vector<ism::Result>>& results,
               std::span<const std::string> class_names, std::vector<std::string> image_names,
               std::size_t most);

    /// Numbers of the images that are shown.
    [[nodiscard]] const std::vector<std::size_t>& images() const { return images_; }

    /// Adds what is shown of the k-th of images(); several may be added at a time.
    /// @param rows     detections that are explained
    /// @param objects  of the model, to name what a detection looks like; may be empty
    void add(std::size_t k, const ism::RgbImage& picture, ism::Detections detections, std::size_t rows,
             const PageOptions& options, std::span<const ism::TrainingObject> objects = {});

    /// The page of all that was added, under `summary`, which it adds to.
    [[nodiscard]] ism::Report report(std::string title,
                                     std::vector<std::pair<std::string, std::string>> summary) const;

private:
    /// How many images are shown, and which.
    [[nodiscard]] std::string shown_text() const;
    [[nodiscard]] ism::ReportSection mistakes_section() const;
    [[nodiscard]] ism::ReportSection images_section() const;

    const ism::Dataset& dataset_;
    const std::vector<std::vector<ism::Result>>& results_;
    std::vector<std::string> names_;  // of the model's classes, then of others in labels
    std::vector<std::string> image_names_;
    std::string folder_;  // of all images, which their names do not repeat
    std::vector<std::size_t> images_;
    std::vector<Mistakes> mistakes_;  // of all images; none without labels
    std::vector<ism::DetectionPages> pages_;
};

}  // namespace program
