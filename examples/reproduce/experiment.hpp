// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"

#include "ism/core/stopwatch.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/evaluate/evaluate.hpp"
#include "ism/model/model.hpp"
#include "ism/show/report.hpp"
#include "ism/train/training_features.hpp"

namespace reproduce {

/// How much is done with which data.
struct Settings {
    std::filesystem::path data, folder = "ism-reproduce";
    bool quick = false;        ///< a few images of each set
    bool depth_alone = false;  ///< only the experiments on depth
    unsigned threads = 0;
};

/// Images to learn from and images to search.
struct Images {
    ism::Dataset train, test;
};

/// @param name  of the folder of the set
/// @param test  of its file of images to search
[[nodiscard]] Images read_images(const Settings& settings, const std::string& name, const std::string& test);

/// The features of training images, from which models are learnt.
/// @param whole  also what box classifiers and templates need
[[nodiscard]] ism::TrainingFeatures extract(const ism::Dataset& train, std::string_view detector,
                                            std::string_view descriptor, bool whole, unsigned threads);

/// What one way to search found.
struct Outcome {
    ism::Evaluation evaluation;
    double ms_per_image = 0;  ///< on one thread, features and words included
};

/// Searches the images in several ways; features and words are found once.
[[nodiscard]] std::vector<Outcome> search(const ism::Model& model, const ism::Dataset& images,
                                          std::span<const program::SearchOptions> ways,
                                          const ism::EvaluateOptions& rule, unsigned threads);

/// The paper's own way: votes alone, verified by minimum description length.
[[nodiscard]] program::SearchOptions votes_alone(std::string_view space = "jism");

/// Adds a table that is also printed.
void add_table(ism::ReportSection& section, ism::ReportTable table);

/// How long each part took.
class Times {
public:
    /// What was done since the last call, or since this was made.
    void add(std::string what);
    [[nodiscard]] const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }

private:
    ism::Stopwatch watch_;
    std::vector<std::pair<std::string, double>> seconds_;
};

}  // namespace reproduce
