// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/frame.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/frame_matcher.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/detect/segment.hpp"
#include "ism/detect/verify.hpp"
#include "ism/model/appearance.hpp"
#include "ism/model/model.hpp"

namespace ism {

/// @brief Detects objects from features already matched: votes, mean shift, the judge of boxes,
/// segmentation, verification.
template <AnyVoteSpace Space, Kernel K = EpanechnikovKernel, Verifier V = Mdl>
[[nodiscard]] Detections detect_from_matches(std::vector<Feature> features, std::span<const Match> matches,
                                             const Shapes& shapes, const Frame& frame,
                                             const DetectOptions<Space>& options = {},
                                             const V& verifier = {}) {
    auto hypotheses = vote_for<Space, K>(features, matches, shapes, frame, options);
    if (!shapes.appearance.empty()) {
        const std::size_t words = shapes.first.size() - 1;
        parallel_for(hypotheses.size(), options.threads, [&](std::size_t i) {
            const auto box = word_histogram(features, matches, words, hypotheses[i].box);
            hypotheses[i].score *= shapes.appearance.probability(hypotheses[i].class_index, box);
        });
        std::stable_sort(hypotheses.begin(), hypotheses.end(),
                         [](const Detection& a, const Detection& b) { return a.score > b.score; });
    }
    if (hypotheses.size() > options.max_hypotheses) hypotheses.resize(options.max_hypotheses);
    parallel_for(hypotheses.size(), options.threads, [&](std::size_t i) {
        hypotheses[i].segmentation = segment(features, shapes, hypotheses[i].support, hypotheses[i].box,
                                             frame.gray.width(), frame.gray.height(), options.segmentation);
    });
    Detections result{.objects = {}, .features = std::move(features)};
    for (const Verified& verified : verifier.verify(std::span<const Detection>(hypotheses))) {
        result.objects.push_back(std::move(hypotheses[verified.index]));
        result.objects.back().score = verified.score;
    }
    std::stable_sort(result.objects.begin(), result.objects.end(),
                     [](const Detection& a, const Detection& b) { return a.score > b.score; });
    std::erase_if(result.objects, [&](const Detection& object) {
        return object.score < options.keep * result.objects.front().score;
    });
    return result;
}

/// @brief Finds, cuts out and places the objects of one picture after another with one model, with the same
/// threads and memory for features. One picture at a time; for several at once make several.
template <Detector D, Descriptor Desc>
class FrameDetector {
public:
    /// @param model    is referred to, so it has to stay as long as this
    /// @param threads  for features and matching (0 = all the machine has)
    explicit FrameDetector(const Model<D, Desc>& model, unsigned threads = 0)
        : shapes_(model.shapes), matcher_(model, threads) {}

    /// @brief Detects the objects of a picture; an empty list where nothing is found.
    /// @tparam Space  the vote space: Ism, Jism, Ji3sm1, Ji3sm2, Ji3sm3 or one of your own
    /// @throws Error for a frame that is none (see check(Frame)), an option out of range, or a space that
    /// needs depth where the frame has none.
    template <AnyVoteSpace Space, Kernel K = EpanechnikovKernel, Verifier V = Mdl>
    [[nodiscard]] Detections detect(const Frame& frame, const DetectOptions<Space>& options = {},
                                    const V& verifier = {}) {
        check(options);
        MatchedFeatures found = matcher_.match(frame);
        expect(!Space::needs_depth || !frame.depth_m.empty(), "depth image",
               "one, since the vote space uses depth", "none");
        return detect_from_matches<Space, K>(std::move(found.features), found.matches, shapes_, frame,
                                             options, verifier);
    }

private:
    const Shapes& shapes_;
    FrameMatcher<D, Desc> matcher_;
};

/// @brief Detects the objects of one picture: see FrameDetector, which is made for this once. A model may be
/// used from several threads at once.
template <AnyVoteSpace Space, Kernel K = EpanechnikovKernel, Verifier V = Mdl, Detector D, Descriptor Desc>
[[nodiscard]] Detections detect(const Model<D, Desc>& model, const Frame& frame,
                                const DetectOptions<Space>& options = {}, const V& verifier = {}) {
    return FrameDetector<D, Desc>(model, options.threads).template detect<Space, K>(frame, options, verifier);
}

}  // namespace ism
