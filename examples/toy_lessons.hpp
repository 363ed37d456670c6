// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "toy/scene.hpp"
#include "toy/toys.hpp"

#include "ism/core/frame.hpp"
#include "ism/train/training_image.hpp"

namespace toy {

/// @brief A toy picture as the library takes pictures: brightness, depth in metres, camera.
[[nodiscard]] ism::Frame to_frame(const ToyScene& scene);

/// @brief Labelled pictures of single toys to learn from: `toys` of each class, two views of each.
[[nodiscard]] std::vector<ism::TrainingImage> make_lessons(int toys);

/// @brief A cluttered table on which no toy of make_lessons() stands.
[[nodiscard]] ToyScene make_test();

/// @brief The picture of a file; a cluttered table where there is no file.
[[nodiscard]] ism::RgbImage read_or_render(const char* file);

}  // namespace toy
