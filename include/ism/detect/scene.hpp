// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "ism/codebook/match.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/local_frame.hpp"
#include "ism/core/shared.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/feature.hpp"
#include "ism/model/model.hpp"

namespace ism {

struct Surface;
class HogPyramid;

/// @brief Large memory that policies of detection keep from one frame to the next: new memory is cleared by
/// the system, page by page, which takes longer than much of what is done with it.
struct FrameMemory {
    Shared<HogPyramid> pyramid = {};  ///< of the last frame; none before the first
};

/// @brief A frame with its features and the words they look like: all that hypotheses are found, judged and
/// cut out from, and what every policy of detection sees. FrameMatcher makes it.
struct Scene {
    const Frame& frame;
    const Model& model;
    ThreadPool& pool;  ///< works on this scene alone; not to be used within one of its loops
    std::vector<Feature> features = {};   ///< of all channels, with depth where the frame has depth
    std::vector<Match> matches = {};      ///< all words within the threshold, by feature
    double extract_ms = 0, match_ms = 0;  ///< what it took to find features and matches
    /// Where there are depth and camera and the vote space, or a policy, asks for them (add_surface()):
    Shared<const Surface> surface = {};                  ///< points and normals
    std::vector<std::optional<LocalFrame>> frames = {};  ///< of the features
    FrameMemory* memory = nullptr;                       ///< of the FrameMatcher that made this
};

/// @brief Adds the features of a channel and their matches to a scene.
/// @param first_word  of the channel; features and words are counted through all channels
inline void add_channel(Scene& scene, const std::vector<Feature>& features, const std::vector<Match>& matches,
                        std::size_t first_word) {
    const std::size_t first = scene.features.size();
    detail::append(scene.features, features);
    for (Match match : matches) {
        match.feature += static_cast<std::uint32_t>(first);
        match.word += static_cast<std::uint32_t>(first_word);
        scene.matches.push_back(match);
    }
}

/// @brief Adds surface and local frames to a scene: in ism/detect/surface_scene.hpp, which a vote space with
/// poses needs.
inline void add_surface(Scene& scene);

}  // namespace ism
