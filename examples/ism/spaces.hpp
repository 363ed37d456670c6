// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "commands.hpp"

#include "ism/core/frame.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/frame_matcher.hpp"
#include "ism/detect/scene.hpp"
#include "ism/model/model.hpp"

namespace program {

/// Detects the objects of a scene by the policies of these names.
[[nodiscard]] ism::Detections find_objects(ism::Scene scene, const SearchOptions& search);

/// Finds the features of one frame after another and matches them to the words of a model.
class Matcher {
public:
    /// @param model  has to stay as long as this and its scenes, as has the pool
    Matcher(const ism::Model& model, ism::ThreadPool& pool);

    /// @param space  in which the scene will be searched
    [[nodiscard]] ism::Scene scene(const ism::Frame& frame, std::string_view space);
    /// Detects the objects of a frame.
    [[nodiscard]] ism::Detections find(const ism::Frame& frame, const SearchOptions& search);

private:
    ism::FrameMatcher matcher_;
};

/// Whether a model learnt how probable scores make an object; of one object a class it cannot.
[[nodiscard]] bool learnt_probabilities(const ism::Model& model);

/// Whether a vote space uses depth.
[[nodiscard]] bool needs_depth(std::string_view space);

}  // namespace program
