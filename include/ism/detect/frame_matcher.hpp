// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ism/codebook/match.hpp"
#include "ism/codebook/match_nearest.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/stopwatch.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/scene.hpp"
#include "ism/feature/any_extractor.hpp"
#include "ism/feature/depth.hpp"
#include "ism/model/model.hpp"

namespace ism {

/// @brief Finds the features of one frame after another and matches them to the words of a model, with the
/// same threads and memory. One frame at a time.
class FrameMatcher {
public:
    /// @param model       has to stay as long as this and its scenes
    /// @param extractors  one for each channel of the model
    /// @param pool        works on a frame; has to stay as long as this and its scenes
    /// @throws Error where an extractor is not that of its channel.
    FrameMatcher(const Model& model, const std::vector<AnyExtractor>& extractors, ThreadPool& pool)
        : model_(model), pool_(pool) {
        expect(extractors.size() == model.channels.size(), "detection: extractors, one a channel",
               model.channels.size(), extractors.size());
        std::size_t words = 0;
        for (std::size_t c = 0; c < extractors.size(); ++c) {
            const FeatureSettings &wanted = model.channels[c].features, &given = extractors[c].settings();
            expect(given.detector == wanted.detector && given.descriptor == wanted.descriptor &&
                       given.dimension == wanted.dimension,
                   "detection: features of the model", lazy_text(wanted.detector, ", ", wanted.descriptor),
                   lazy_text(given.detector, ", ", given.descriptor));
            channels_.push_back({extractors[c].start(pool), WordIndex(model.channels[c].codebook),
                                 static_cast<std::uint32_t>(words), model.channels[c].neighbours});
            words += model.channels[c].codebook.size();
        }
    }

    /// @brief A frame with its features, with depth where it has depth, and their matches.
    /// @param frame  has to stay as long as the scene
    /// @throws Error for a frame that check(Frame) refuses.
    [[nodiscard]] Scene scene(const Frame& frame) {
        check(frame);
        Scene scene{.frame = frame, .model = model_, .pool = pool_};
        for (Channel& channel : channels_) {
            Stopwatch watch;
            const FeatureSet<float>& found = channel.extract(frame);
            scene.extract_ms += watch.lap_ms();
            const auto first = static_cast<std::uint32_t>(scene.features.size());
            detail::append(scene.features, found.features);
            const bool nearest = channel.neighbours > 0;
            for (Match match :
                 nearest ? match_nearest(channel.words, found.descriptors, channel.neighbours, pool_)
                         : match(channel.words, found.descriptors, pool_)) {
                match.feature += first, match.word += channel.first_word;
                scene.matches.push_back(match);
            }
            scene.match_ms += watch.lap_ms();
        }
        if (!frame.depth_m.empty()) scene.features = with_depth(std::move(scene.features), frame.depth_m);
        return scene;
    }

private:
    struct Channel {
        ExtractFeatures extract;
        WordIndex words;
        std::uint32_t first_word;
        std::size_t neighbours;
    };

    const Model& model_;
    ThreadPool& pool_;
    std::vector<Channel> channels_;
};

}  // namespace ism
