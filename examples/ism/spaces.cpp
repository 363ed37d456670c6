// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "models.hpp"

#include "ism/detect/detect.hpp"

namespace program {

namespace {

/// A verifier chosen at run time.
struct ChosenVerifier {
    bool suppression = false;
    [[nodiscard]] std::vector<ism::Verified> verify(std::span<const ism::Detection> hypotheses) const {
        if (suppression) return ism::NonMaximumSuppression{}.verify(hypotheses);
        return ism::Mdl{}.verify(hypotheses);
    }
};

template <ism::AnyVoteSpace Space>
ism::Detections find_in(ism::MatchedFeatures matched, const ism::Shapes& shapes, const ism::Frame& frame,
                        const SearchOptions& search, unsigned threads) {
    ism::DetectOptions<Space> options;
    options.keep = search.keep.value_or(options.keep);
    options.threads = threads;
    const ChosenVerifier verifier{.suppression = search.verifier == "nms"};
    return ism::detect_from_matches<Space>(std::move(matched.features), matched.matches, shapes, frame,
                                           options, verifier);
}

/// The spaces in the order of space_names.
constexpr std::array finders = {find_in<ism::Ism>, find_in<ism::Jism>, find_in<ism::Ji3sm1>,
                                find_in<ism::Ji3sm2>, find_in<ism::Ji3sm3>};
constexpr std::array depth_needed = {ism::Ism::needs_depth, ism::Jism::needs_depth, ism::Ji3sm1::needs_depth,
                                     ism::Ji3sm2::needs_depth, ism::Ji3sm3::needs_depth};
static_assert(finders.size() == space_names.size() && depth_needed.size() == space_names.size());

std::size_t space_index(std::string_view name) {
    const auto found = std::find(space_names.begin(), space_names.end(), name);
    ism::expect(found != space_names.end(), "vote space", "one of ism, jism, ji3sm1, ji3sm2, ji3sm3", name);
    return static_cast<std::size_t>(found - space_names.begin());
}

}  // namespace

ism::Detections find_objects(ism::MatchedFeatures matched, const ism::Shapes& shapes, const ism::Frame& frame,
                             const SearchOptions& search, unsigned threads) {
    return finders[space_index(search.space)](std::move(matched), shapes, frame, search, threads);
}

bool needs_depth(std::string_view space) {
    return depth_needed[space_index(space)];
}

double default_keep() {
    return ism::DetectOptions<ism::Jism>{}.keep;
}

}  // namespace program
