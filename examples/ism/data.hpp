// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "ism/dataset/any_dataset.hpp"

namespace program {

/// The one way to a data set, whatever its form: COCO's JSON, Pascal VOC, YOLO, labelme,
/// folders of classes, or images alone.
/// Labels and images that make no sense are named on stderr, and left out with `skip_bad`.
/// @param part  where a data set has several
/// @throws ism::Error where it cannot be read, or something makes no sense and `skip_bad` is not given.
[[nodiscard]] ism::Dataset read_data(const std::filesystem::path& path, ism::DatasetPart part, bool skip_bad);

/// The same, but tells what makes no sense only in `faults`, and leaves it out; masks are not looked at.
[[nodiscard]] ism::Dataset read_labels(const std::filesystem::path& path, ism::DatasetPart part,
                                       ism::Faults& faults);

}  // namespace program
