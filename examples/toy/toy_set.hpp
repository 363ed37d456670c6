// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "toy/cluttered.hpp"
#include "toy/isolated.hpp"

#include "ism/dataset/dataset.hpp"

namespace toy {

/// @brief How large a set of toy pictures is.
struct ToySetOptions {
    int train_cars = 14, train_others = 8;      ///< toys of class car, of each other class
    int views_per_toy = 2;                      ///< training pictures of each toy
    double train_distance_m = 0.8;              ///< in the training pictures, ± 5 %
    int train_width = 320, train_height = 240;  ///< pixels
    int backgrounds = 0;                        ///< training pictures of tables without toys
    int test_scenes = 24;
    std::uint64_t seed = 1;
    unsigned threads = 0;  ///< 0 = all the machine has
    ClutterOptions clutter = {.instances =
                                  14};  ///< its first_instance is set so that no test toy was learnt from
    ToyOptions picture = {};            ///< its seed is replaced by the set's
};

/// @brief A set that was written: what read_dataset() gives, and the truth COCO has no room for.
struct ToySet {
    ism::Dataset train, test;
    std::vector<std::vector<ToyObject>> train_truth,
        test_truth;  ///< for each image its objects, in their order
};

/// @brief Renders a set of toy pictures into `folder`: train.json with toys alone, test.json with cluttered
/// tables, both COCO with masks, boxes, depth (`depth_file_name`, `depth_scale`), `camera`, and for each
/// annotation `position_m` (the toy's middle, camera frame) and `instance`. No toy is in both. The
/// same options give the same bytes for any number of threads.
/// @throws ism::Error for options that cannot be; ism::FileError where a file cannot be written.
ToySet write_toy_set(const std::filesystem::path& folder, const ToySetOptions& options = {});

}  // namespace toy
