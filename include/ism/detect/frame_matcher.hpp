// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/match.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/shared.hpp"
#include "ism/core/stopwatch.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/scene.hpp"
#include "ism/feature/any_extractor.hpp"
#include "ism/feature/depth.hpp"
#include "ism/model/model.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief How the descriptors of a channel with so many neighbours (Channel::neighbours) are matched.
using MatchWords = std::vector<Match>(const WordIndex& words, const Descriptors<float>& descriptors,
                                      std::size_t neighbours, ThreadPool& pool);

/// @brief With all words within the codebook's threshold: see match().
/// @throws Error for a channel that was learnt for its nearest words.
[[nodiscard]] inline std::vector<Match> match_within(const WordIndex& words,
                                                     const Descriptors<float>& descriptors,
                                                     std::size_t neighbours, ThreadPool& pool) {
    expect(neighbours == 0, "matching within a threshold: neighbours of the model's channel",
           "0, since others are for a vote space with poses", neighbours);
    return match(words, descriptors, pool);
}

/// @brief With the nearest words where the channel asks for them: in ism/detect/metric.hpp.
[[nodiscard]] inline std::vector<Match> match_neighbours(const WordIndex& words,
                                                         const Descriptors<float>& descriptors,
                                                         std::size_t neighbours, ThreadPool& pool);

/// @brief How features are matched for a vote space.
template <VoteSpaceType Space>
[[nodiscard]] constexpr MatchWords* match_in() {
    if constexpr (Space::needs_pose)
        return match_neighbours;
    else
        return match_within;
}

/// @brief Finds the features of one frame after another and matches them to the words of a model, with the
/// same threads and memory. One frame at a time.
class FrameMatcher {
public:
    /// @param model       has to stay as long as this and its scenes
    /// @param extractors  one for each channel of the model
    /// @param pool        works on a frame; has to stay as long as this and its scenes
    /// @throws Error where an extractor is not that of its channel.
    FrameMatcher(const Model& model, std::span<const AnyExtractor> extractors, ThreadPool& pool)
        : model_(model), pool_(pool), channels_(extractors.size()) {
        expect(extractors.size() == model.channels.size(), "detection: extractors, one a channel",
               model.channels.size(), extractors.size());
        for (std::size_t c = 0; c < extractors.size(); ++c) {
            const FeatureSettings &wanted = model.channels[c].features, &given = extractors[c].settings();
            expect(given.detector == wanted.detector && given.descriptor == wanted.descriptor &&
                       given.dimension == wanted.dimension,
                   "detection: features of the model", lazy_text(wanted.detector, ", ", wanted.descriptor),
                   lazy_text(given.detector, ", ", given.descriptor));
            expect(is_same_way(given, wanted), "detection: options of features",
                   "those of the model (Model::channels)", "others");
            channels_[c] = {extractors[c].start(pool),
                            Shared<const WordIndex>::make(model.channels[c].codebook), model.first_word(c),
                            model.channels[c].neighbours};
        }
    }

    /// @brief The same of a list, which may be written in braces.
    FrameMatcher(const Model& model, const std::vector<AnyExtractor>& extractors, ThreadPool& pool)
        : FrameMatcher(model, std::span<const AnyExtractor>(extractors), pool) {}

    /// @brief The model that frames are matched to.
    [[nodiscard]] const Model& model() const { return model_; }

    /// @brief A frame with its features, with depth where it has depth, and their matches.
    /// @param frame        has to stay as long as the scene
    /// @param match_words  as match_in() gives it
    /// @throws Error for a frame that check(Frame) refuses.
    [[nodiscard]] Scene scene(const Frame& frame, MatchWords* match_words = match_within) {
        check(frame);
        Scene scene{.frame = frame, .model = model_, .pool = pool_, .memory = &memory_};
        for (Channel& channel : channels_) {
            Stopwatch watch;
            const FeatureSet<float>& found = channel.extract(frame);
            scene.extract_ms += watch.lap_ms();
            add_channel(scene, found.features,
                        match_words(*channel.words, found.descriptors, channel.neighbours, pool_),
                        channel.first_word);
            scene.match_ms += watch.lap_ms();
        }
        if (!frame.depth_m.empty()) scene.features = with_depth(std::move(scene.features), frame.depth_m);
        return scene;
    }

private:
    struct Channel {
        ExtractFeatures extract;
        Shared<const WordIndex> words;
        std::size_t first_word = 0, neighbours = 0;
    };

    const Model& model_;
    ThreadPool& pool_;
    std::vector<Channel> channels_;
    FrameMemory memory_;
};

}  // namespace ism
