// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/train/learn_mask_judge.hpp"

namespace {

using ism::MaskCues;

ism::MaskJudge fitted(const std::vector<MaskCues>& cues, const std::vector<std::uint8_t>& right,
                      double cost) {
    ism::MaskJudge judge;
    ism::detail::fit_mask_weights(judge, cues, right, cost);
    return judge;
}

/// What the fit makes small: ½ |w|² + cost · Σ log(1 + exp(∓logit)).
double loss(const ism::MaskJudge& judge, const std::vector<MaskCues>& cues,
            const std::vector<std::uint8_t>& right, double cost) {
    double sum = 0;
    for (const float w : judge.weights) sum += 0.5 * double(w) * w;
    for (std::size_t i = 0; i < cues.size(); ++i) {
        const double logit = judge.logit(cues[i]);
        sum += cost * std::log1p(std::exp(right[i] != 0 ? -logit : logit));
    }
    return sum;
}

/// The least loss, by trying ever smaller steps along each weight and the bias.
double least_loss(ism::MaskJudge judge, const std::vector<MaskCues>& cues,
                  const std::vector<std::uint8_t>& right, double cost) {
    judge.weights = {};
    judge.bias = 0;
    double best = loss(judge, cues, right, cost);
    for (float step = 1; step > 1e-5f;) {
        bool better = false;
        for (std::size_t k = 0; k <= ism::mask_cue_count; ++k)
            for (const float move : {step, -step}) {
                float& number = k < ism::mask_cue_count ? judge.weights[k] : judge.bias;
                const float before = number;
                number += move;
                if (const double now = loss(judge, cues, right, cost); now < best)
                    best = now, better = true;
                else
                    number = before;
            }
        if (!better) step /= 2;
    }
    return best;
}

}  // namespace

TEST_CASE("the weights of cues are those of the least loss") {
    ism::Random random(3);
    std::vector<MaskCues> cues(60);
    std::vector<std::uint8_t> right;
    for (MaskCues& c : cues) {
        for (float& cue : c) cue = float(3 + 2 * random.normal());
        right.push_back(c[0] - 0.5f * c[7] + float(random.normal()) > 1.5f);
    }
    for (const double cost : {0.02, 0.1, 1.0}) {
        const ism::MaskJudge judge = fitted(cues, right, cost);
        CAPTURE(cost);
        CHECK(loss(judge, cues, right, cost) == Approx(least_loss(judge, cues, right, cost)).epsilon(1e-4));
        CHECK(judge.mean[4] == Approx(3).margin(1));
        CHECK(judge.deviation[4] == Approx(2).margin(0.7));
        CHECK(judge.weights[0] > 0);
        CHECK(judge.weights[7] < 0);
    }
}

TEST_CASE("a rule that one cue tells is found") {
    ism::Random random(4);
    std::vector<MaskCues> cues(2000);
    std::vector<std::uint8_t> right;
    for (MaskCues& c : cues) {
        for (float& cue : c) cue = float(random.uniform());
        right.push_back(c[9] > 0.7f);
    }
    const ism::MaskJudge judge = fitted(cues, right, 0.1);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < cues.size(); ++i) wrong += (judge.logit(cues[i]) > 0) != (right[i] != 0);
    CHECK(wrong < 40);
    for (std::size_t k = 0; k < ism::mask_cue_count; ++k)
        if (k != 9) CHECK(std::abs(judge.weights[k]) < 0.1f * judge.weights[9]);
}

TEST_CASE("cues that never change, or classes that are never or always right, give finite weights") {
    ism::Random random(5);
    std::vector<MaskCues> cues(40);
    std::vector<std::uint8_t> right;
    for (MaskCues& c : cues) {
        c.fill(4.3f);
        c[2] = float(random.normal());
        right.push_back(c[2] > 0);
    }
    for (const auto& labels : {right, std::vector<std::uint8_t>(40, 0), std::vector<std::uint8_t>(40, 1)}) {
        const ism::MaskJudge judge = fitted(cues, labels, 0.1);
        CHECK(std::isfinite(judge.bias));
        for (std::size_t k = 0; k < ism::mask_cue_count; ++k) {
            CHECK(std::isfinite(judge.weights[k]));
            CHECK(judge.deviation[k] > 0);
            if (k != 2) CHECK(judge.weights[k] == 0);
        }
        MaskCues other = cues[0];
        other[5] = -100;  // of which training knew nothing
        CHECK(judge.logit(other) == Approx(judge.logit(cues[0])));
    }
}

TEST_CASE("a region shows an object where mask and box overlap enough, else background or nothing") {
    const std::vector<ism::RegionMask> masks{{0, 0, ism::Mask(10, 10, 1)}, {20, 0, ism::Mask(10, 10, 1)}};
    const std::vector<ism::ObjectLabel> labels{{3, {0, 0, 10, 10}}, {4, {20, 0, 10, 10}}};
    const ism::MaskJudgeOptions options;
    const auto shown = [&](const ism::RegionMask& region) {
        return ism::detail::shown_object(region, masks, labels, options);
    };
    CHECK(shown(masks[0]) == 0u);
    CHECK(shown({20, 0, ism::Mask(10, 6, 1)}) == 1u);
    CHECK_FALSE(shown({20, 0, ism::Mask(10, 4, 1)}));
    CHECK(shown({20, 0, ism::Mask(10, 3, 1)}) == ism::MaskExample::background);
    CHECK(shown({100, 100, ism::Mask(10, 3, 1)}) == ism::MaskExample::background);
    CHECK(ism::detail::shown_object(masks[0], {}, {}, options) == ism::MaskExample::background);
}

TEST_CASE("images of one thing are one group, of things of two classes that are named alike they are not") {
    ism::TrainingFeatures features{.class_names = {"cup", "tin"}};
    const auto add = [&](std::uint32_t class_index, const char* instance) {
        ism::TrainingView view{.labels = {{class_index, {0, 0, 9, 9}}}};
        view.depth = ism::TrainingDepth{.instances = {instance}};
        features.views.push_back(view);
    };
    add(0, "1"), add(1, "1"), add(0, "2"), add(0, "1"), add(1, "");
    const ism::DepthViews grouped = ism::depth_views(features);
    REQUIRE(grouped.views.size() == 5);
    CHECK((grouped.views[0] == &features.views[0] && grouped.views[1] == &features.views[3]));
    CHECK(grouped.group_first == std::vector<std::size_t>{0, 0, 2, 3, 4});
    CHECK(grouped.group_end == std::vector<std::size_t>{2, 2, 3, 4, 5});
}
