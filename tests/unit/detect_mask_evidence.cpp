// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/detect/mask_evidence.hpp"

namespace {

/// A figure of so many columns of 40 rows, at (100, 50) of an image, told from ground by a certainty.
ism::Segmentation columns(int figure, int width, float certainty) {
    ism::Segmentation part{
        .x = 100, .y = 50, .figure = ism::GrayImage(width, 40), .ground = {}, .mask = ism::Mask(width, 40)};
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < width; ++x) {
            part.mask(x, y) = x < figure;
            part.figure(x, y) = 0.5f + (x < figure ? 0.5f : -0.5f) * certainty;
        }
    return part;
}

double log_odds(double probability) {
    return std::log(probability / (1 - probability));
}

}  // namespace

TEST_CASE("masks are measured in their boxes") {
    const ism::MaskMeasures half = ism::measure_mask(columns(20, 40, 0.75f), {100, 50, 40, 40});
    CHECK(half.extent == Approx(0.5));
    CHECK(half.certainty == Approx(0.75));
    CHECK(half.raggedness == Approx(std::log(120 * 120 / 800.0)));
    // The box is smaller than what was looked at, and reaches beyond it, where nothing is known.
    const ism::MaskMeasures inner = ism::measure_mask(columns(20, 40, 0.75f), {90, 50, 20, 40});
    CHECK(inner.extent == 1);
    CHECK(inner.raggedness == half.raggedness);

    ism::Segmentation comb = columns(20, 40, 1);
    for (int y = 0; y < 40; y += 2)
        for (int x = 0; x < 20; ++x) comb.figure(x, y) = 0;
    CHECK(ism::measure_mask(comb, {100, 50, 40, 40}).raggedness ==
          Approx(std::log(20.0 * 20 * 42 * 42 / 400)));
    CHECK(ism::measure_mask(ism::Segmentation{}, {0, 0, 5, 5}) == ism::MaskMeasures{});

    // As ragged in any size.
    const auto square = [](int side) {
        ism::Segmentation part{
            .figure = ism::GrayImage(side, side), .ground = {}, .mask = ism::Mask(side, side)};
        for (int y = side / 4; y < 3 * side / 4; ++y)
            for (int x = side / 4; x < 3 * side / 4; ++x) part.figure(x, y) = 1;
        return ism::measure_mask(part, {0, 0, double(side), double(side)});
    };
    CHECK(square(200).raggedness == Approx(std::log(16)));
    CHECK(square(1000).raggedness == Approx(std::log(16)).epsilon(0.01));
    CHECK(square(1000).extent == Approx(0.25).epsilon(0.02));
}

TEST_CASE("a mask speaks for what it is like, and no more against than three deviations in each measure") {
    const ism::TypicalMask typical{.mean = {0.5, 0.9, 4}, .deviation = {0.1, 0.05, 0.5}};
    CHECK(ism::mask_log_odds({0.5, 0.9, 4}, typical) == Approx(ism::most_mask_log_odds));
    CHECK(ism::mask_log_odds({0.6, 0.85, 4.5}, typical) == Approx(0).margin(1e-12));
    CHECK(ism::mask_log_odds({0.3, 0.9, 4}, typical) == Approx((3 - 4) * ism::mask_weight));
    CHECK(ism::mask_log_odds({0.7, 0.9, 4}, typical) == Approx((3 - 4) * ism::mask_weight));
    CHECK(ism::mask_log_odds({0, 0, 40}, typical) == Approx((3 - 3 * 9) * ism::mask_weight));
}

TEST_CASE("what was cut out changes how probable an object is") {
    ism::Model model;
    model.template_calibration.curves = {{.slope = 2, .offset = -1}, {.slope = 0, .offset = -1}};
    ism::Detection judged;
    judged.box = {100, 50, 40, 40};
    judged.segmentation = columns(20, 40, 0.8f);
    judged.score = std::exp(1.0);
    judged.probability = model.template_calibration.probability(0, judged.score);
    judged.box_reasons = ism::BoxReasons{.look = 1}.in_odds(2, -1);
    ism::ThreadPool pool(1);
    const auto weighed = [&](const ism::Detection& detection) {
        std::vector<ism::Detection> alone{detection};
        ism::weigh_masks(alone, model, pool);
        return alone[0];
    };
    CHECK(weighed(judged).probability == judged.probability);  // nothing is known of masks
    model.typical_masks = {{.mean = {0.9, 0.8, std::log(18)}, .deviation = {0.2, 0.1, 1}},
                           {.mean = {0.9, 0.8, 3}, .deviation = {0.2, 0.1, 1}}};
    const ism::Detection less = weighed(judged);
    CHECK(less.box_reasons.mask == Approx(-ism::mask_weight));
    CHECK(log_odds(less.probability) == Approx(log_odds(judged.probability) - ism::mask_weight));
    CHECK(log_odds(less.probability) == Approx(less.box_reasons.sum()));
    CHECK(std::log(less.score) == Approx(1 - ism::mask_weight / 2));
    CHECK(weighed(less).score == Approx(less.score));  // once, however often it is asked

    ism::Detection other = judged;
    other.class_index = 1;  // of which scores say nothing
    CHECK(weighed(other).score == judged.score);
    other.class_index = 2;  // unknown
    CHECK(weighed(other).score == judged.score);
    ism::Detection by_votes = judged;
    by_votes.box_reasons = {};
    CHECK(weighed(by_votes).probability == judged.probability);
    model.typical_masks[0].deviation.certainty = 0;
    CHECK(weighed(judged).score == judged.score);
}

TEST_CASE("what speaks against the most probable class of a place speaks against the others") {
    const double ragged = std::log(120 * 120 / 800.0);
    ism::Model model;
    model.template_calibration.curves = {{.slope = 2, .offset = 0}, {.slope = 1, .offset = 0}};
    model.typical_masks = {{.mean = {0.9, 0.8, ragged}, .deviation = {0.1, 0.1, 1}},   // as the mask is not
                           {.mean = {0.5, 0.8, ragged}, .deviation = {0.1, 0.1, 1}}};  // as it is
    const auto judged = [&](std::uint32_t class_index, double x, double log_odds) {
        ism::Detection detection;
        detection.class_index = class_index, detection.box = {x, 50, 40, 40};
        detection.segmentation = columns(20, 40, 0.8f);
        detection.segmentation.x = int(x);
        const double slope = model.template_calibration.curves[class_index].slope;
        detection.score = std::exp(log_odds / slope);
        detection.probability = model.template_calibration.probability(class_index, detection.score);
        detection.box_reasons = {.look = log_odds};
        return detection;
    };
    ism::ThreadPool pool(2);
    std::vector<ism::Detection> found{judged(0, 100, 2), judged(1, 110, 1), judged(1, 300, 1),
                                      judged(0, 305, -1)};
    ism::weigh_masks(found, model, pool);
    const double most = ism::most_mask_log_odds, against = (3 - 9) * ism::mask_weight;
    CHECK(found[0].box_reasons.mask == Approx(against));
    CHECK(found[1].box_reasons.mask == Approx(against));  // else it would overtake the first
    CHECK(found[2].box_reasons.mask == Approx(most));     // there it leads
    CHECK(found[3].box_reasons.mask == Approx(against));
    for (const ism::Detection& detection : found)
        CHECK(log_odds(detection.probability) == Approx(detection.box_reasons.sum()));
    const std::vector<ism::Detection> once = found;
    ism::weigh_masks(found, model, pool);
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i].score == Approx(once[i].score));
}
