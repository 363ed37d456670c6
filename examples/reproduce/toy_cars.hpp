// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ism/core/frame.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/train/training_image.hpp"

namespace reproduce {

/// A picture to search, in memory, with its labels; their positions are exact.
struct Shot {
    ism::Frame frame;
    ism::DatasetImage labels;
};

/// Cars to learn and others to find.
struct CarSplit {
    std::vector<int> learnt, unseen;  ///< instances
};

/// 30 cars by chance to learn, the other 10 to find.
[[nodiscard]] CarSplit split_cars(std::uint64_t seed, std::size_t cars = 40, std::size_t unseen = 10);

/// Two side views of each car, alone on a nearly plain table, .8 m away.
[[nodiscard]] std::vector<ism::TrainingImage> car_lessons(const std::vector<int>& instances,
                                                          unsigned threads);

/// Where cars stand on cluttered tables.
struct Tables {
    std::size_t count = 12;
    double near_m = 0.5, far_m = 1.5;
};

/// Cluttered tables with two to four of the cars; what else stands there, other toys too, is not labelled.
[[nodiscard]] std::vector<Shot> car_tables(const std::vector<int>& instances, const Tables& tables,
                                           std::uint64_t seed, unsigned threads);

/// Two of the cars side by side, one well behind the other.
[[nodiscard]] std::vector<Shot> cars_side_by_side(const std::vector<int>& instances, std::size_t count,
                                                  std::uint64_t seed, unsigned threads);

/// The labels as a data set.
[[nodiscard]] ism::Dataset dataset_of(std::span<const Shot> shots, std::vector<std::string> class_names);

}  // namespace reproduce
