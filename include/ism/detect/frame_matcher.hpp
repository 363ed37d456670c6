// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "ism/codebook/match.hpp"
#include "ism/core/frame.hpp"
#include "ism/feature/depth.hpp"
#include "ism/feature/extract.hpp"
#include "ism/model/model.hpp"

namespace ism {

/// @brief The features of a picture and the words they look like: all that votes are cast from.
struct MatchedFeatures {
    std::vector<Feature> features;
    std::vector<Match> matches;
};

/// @brief Finds the features of one picture after another and matches them to the words of a model, with the
/// same threads and memory. One picture at a time.
template <Detector D, Descriptor Desc>
class FrameMatcher {
public:
    /// @param threads  that work on a picture (0 = all the machine has)
    explicit FrameMatcher(const Model<D, Desc>& model, unsigned threads = 0)
        : words_(model.codebook), extractor_(model.extractor, threads), threads_(threads) {}

    /// @brief The features of a picture, with depth where it has depth, and their matches.
    /// @throws Error for a frame that is none (see check(Frame)).
    [[nodiscard]] MatchedFeatures match(const Frame& frame) {
        check(frame);
        const FeatureSet<Desc>& found = extractor_.extract(frame.gray.view());
        MatchedFeatures result{.features = found.features,
                               .matches = ism::match(words_, found.descriptors, threads_)};
        if (!frame.depth_m.empty()) result.features = with_depth(std::move(result.features), frame.depth_m);
        return result;
    }

private:
    WordIndex<Desc::dimension, typename Desc::Scalar> words_;
    FeatureExtractor<D, Desc> extractor_;
    unsigned threads_;
};

}  // namespace ism
