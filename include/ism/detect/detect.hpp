// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ism/core/frame.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/frame_matcher.hpp"
#include "ism/detect/recognition.hpp"
#include "ism/feature/any_extractor.hpp"
#include "ism/model/model.hpp"

namespace ism {

/// @brief Finds, cuts out and places the objects of one frame after another with one model, with the same
/// threads and the same memory. One frame at a time; for several at once make several.
class FrameDetector {
public:
    /// @param model    is referred to, so it has to stay as long as this
    /// @param threads  that work on a frame (0 = all hardware threads)
    template <Detector D, Descriptor Desc>
    explicit FrameDetector(const TypedModel<D, Desc>& model, unsigned threads = 0)
        : FrameDetector(model, extractor_of(model), threads) {}
    template <Detector D, Descriptor Desc>
    explicit FrameDetector(const TypedModel<D, Desc>&& model, unsigned threads = 0) = delete;

    /// @brief For a model whose features are known at run time only, or that has several channels.
    /// @param extractors  one for each channel of the model
    /// @throws Error where an extractor is not that of its channel.
    FrameDetector(const Model& model, const std::vector<AnyExtractor>& extractors, unsigned threads = 0)
        : pool_(threads), matcher_(model, extractors, pool_) {}
    FrameDetector(const Model&& model, const std::vector<AnyExtractor>& extractors,
                  unsigned threads = 0) = delete;

    /// @brief Detects the objects of a frame; an empty list where nothing is found.
    /// @throws Error for a frame that check(Frame) refuses, an option out of range, or a space that needs
    /// depth where the frame has none.
    template <VoteSpaceType Space, Kernel K, Rescorer R, Segmenter S, Verifier V>
    [[nodiscard]] Detections detect(const Frame& frame, const Recognition<Space, K, R, S, V>& recognition) {
        check(frame);
        check(recognition, frame);
        return recognise(matcher_.scene(frame, match_in<Space>()), recognition);
    }

    /// @brief The same in a vote space with default policies.
    template <VoteSpaceType Space, Kernel K = EpanechnikovKernel>
    [[nodiscard]] Detections detect(const Frame& frame, const DetectOptions& options = {}) {
        return detect(frame, Recognition<Space, K>{.options = options});
    }

private:
    template <Detector D, Descriptor Desc>
    [[nodiscard]] static AnyExtractor extractor_of(const TypedModel<D, Desc>& model) {
        const Extractor<D, Desc> extractor = model.extractor();  // refuses a model without channels
        return AnyExtractor(extractor, model.channels[0].features);
    }
    FrameDetector(const Model& model, const AnyExtractor& extractor, unsigned threads)
        : pool_(threads), matcher_(model, {&extractor, 1}, pool_) {}

    ThreadPool pool_;
    FrameMatcher matcher_;
};

/// @brief Detects the objects of one frame: see FrameDetector, which is made for this once. A model may be
/// used from several threads at once.
/// @param threads  0 = all hardware threads
template <Detector D, Descriptor Desc, VoteSpaceType Space, Kernel K, Rescorer R, Segmenter S, Verifier V>
[[nodiscard]] Detections detect(const TypedModel<D, Desc>& model, const Frame& frame,
                                const Recognition<Space, K, R, S, V>& recognition, unsigned threads = 0) {
    return FrameDetector(model, threads).detect(frame, recognition);
}

/// @brief The same in a vote space with default policies.
template <VoteSpaceType Space, Kernel K = EpanechnikovKernel, Detector D, Descriptor Desc>
[[nodiscard]] Detections detect(const TypedModel<D, Desc>& model, const Frame& frame,
                                const DetectOptions& options = {}, unsigned threads = 0) {
    return FrameDetector(model, threads).template detect<Space, K>(frame, options);
}

}  // namespace ism
