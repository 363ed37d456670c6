// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// A vote space of your own. The paper's spaces vote with the depth of the feature; here a sixth one votes
// with the depth of the object's centre, d_f − d_i: what lies before or behind the centre votes for it all
// the same.
#include <cmath>
#include <cstdio>
#include <exception>

#include "toy_lessons.hpp"

#include "ism/detect/detect.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/train.hpp"

namespace {

/// d_f − d_i: depth of the object's centre, metres.
struct CentreDepth {
    static constexpr std::string_view name = "d - d_i", unit = "m";
    static constexpr double bandwidth = 0.1;
    static constexpr ism::BandwidthScaling bandwidth_scaling = ism::BandwidthScaling::none;
    static constexpr bool needs_depth = true;
    static double vote(const ism::VoteSource& v) {
        const float behind_m = v.occurrence.depth_m;  // NaN where it was learnt without depth
        return v.feature.depth_m - (std::isfinite(behind_m) ? behind_m : 0);
    }
};

using OwnSpace = ism::VoteSpace<ism::X, ism::Y, ism::Scale, CentreDepth, ism::Class>;
static_assert(OwnSpace::dimension == 4 && OwnSpace::needs_depth);

template <ism::VoteSpaceType Space, class Model>
void show(const char* title, const Model& model, const ism::Frame& frame) {
    std::printf("%s\n", title);
    for (const ism::Detection& object : ism::detect<Space>(model, frame).objects)
        std::printf("  %-6s score %.2f, %.2f m away\n", model.shapes.class_names[object.class_index].c_str(),
                    object.score, object.depth_m);
}

}  // namespace

int main() try {
    const auto model =
        ism::train<ism::HessianLaplace, ism::RootSift>(toy::class_names(), toy::make_lessons(6));
    const ism::Frame frame = toy::to_frame(toy::make_test());
    show<ism::Ji3sm1>("x, y, s, d, class (the paper's JI3SM-1):", model, frame);
    show<OwnSpace>("x, y, s, d - d_i, class (our own):", model, frame);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
