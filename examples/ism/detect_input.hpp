// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "image_list.hpp"

#include "ism/core/frame.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/model/model.hpp"

namespace program {

/// What `ism detect` looks at, and the model it looks by.
struct DetectInput {
    ism::Model model;
    ism::Dataset dataset;                         ///< of pictures: numbered from 1 as in their list
    std::vector<std::string> names;               ///< of each image, as it is told
    std::size_t skipped = 0;                      ///< images that cannot be used
    std::shared_ptr<const ism::Frame> only = {};  ///< a single picture is read once
};

/// Reads the model and every image once, and tells on stderr what is doubtful about depth and
/// cameras.
/// @throws ism::Error for what cannot be searched, or not in the way that is asked for
[[nodiscard]] DetectInput read_detect_input(const DetectCommand& command, const ImageList& list);

/// The i-th image.
[[nodiscard]] std::shared_ptr<const ism::Frame> frame_of(const DetectInput& input, std::size_t i);

}  // namespace program
