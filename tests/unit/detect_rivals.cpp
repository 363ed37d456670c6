// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/catch.hpp"

#include "ism/detect/rivals.hpp"

namespace {

const ism::Calibration calibration{.curves = {{.slope = 2, .offset = -1}, {.slope = 4, .offset = 0.5}}};

/// A box that a template judged by a margin.
ism::Detection judged(std::uint32_t class_index, const ism::Box& box, double margin) {
    ism::Detection detection;
    detection.class_index = class_index, detection.box = box;
    detection.score = std::exp(margin);
    detection.probability = calibration.probability(class_index, detection.score);
    const ism::Calibration::Curve& curve = calibration.curves[class_index];
    detection.box_reasons = ism::BoxReasons{.look = margin}.in_odds(curve.slope, curve.offset);
    return detection;
}

/// The same by its probability.
ism::Detection probable(std::uint32_t class_index, const ism::Box& box, double probability) {
    const ism::Calibration::Curve& curve = calibration.curves[class_index];
    return judged(class_index, box, (std::log(probability / (1 - probability)) - curve.offset) / curve.slope);
}

double log_odds(const ism::Detection& detection) {
    return std::log(detection.probability / (1 - detection.probability));
}

}  // namespace

TEST_CASE("odds of a class whose curve is nearly flat change without leaving the numbers") {
    const ism::Calibration flat{.curves = {{.slope = 0.01, .offset = 0}}};
    for (const double change : {-10.0, 10.0}) {
        ism::Detection detection;
        detection.score = 1, detection.probability = 0.5;
        ism::change_log_odds(detection, change, flat);
        CHECK((detection.probability > 0.5) == (change > 0));
        CHECK(std::isfinite(detection.score));
        CHECK(detection.score > 0);
        ism::change_log_odds(detection, -change, flat);
        CHECK(std::isfinite(detection.score));
        CHECK(detection.probability > 0);
        CHECK(detection.probability < 1);
    }
}

TEST_CASE("of two classes at one place the less probable yields") {
    const ism::Box here{10, 10, 40, 40}, beside{20, 10, 40, 40}, elsewhere{200, 10, 40, 40};
    const std::vector<ism::Detection> all = {
        judged(0, here, 1),          // odds of e
        judged(1, beside, -0.375),   // 1 / e, e² below the first
        judged(1, elsewhere, -0.5),  // nothing else is there
        judged(0, beside, -0.5),     // of the class of the first; the second is more probable
    };
    auto found = all;
    ism::yield_to_rivals(found, calibration);
    CHECK(found[0].probability == all[0].probability);
    CHECK(found[0].score == all[0].score);
    CHECK(found[0].box_reasons.rivals == 0);
    CHECK(log_odds(found[1]) == Approx(-1 - 0.5 * 2));
    CHECK(found[1].box_reasons.rivals == Approx(-1));
    CHECK(found[1].box_reasons.sum() == Approx(log_odds(found[1])));
    CHECK(std::log(found[1].score) == Approx(-0.375 - 1 / 4.0));
    CHECK(found[2].probability == all[2].probability);
    CHECK(log_odds(found[3]) == Approx(-2 - 0.5 * 1));

    found = all;
    ism::yield_to_rivals(found, calibration, {.other_classes = 0});
    for (std::size_t i = 0; i < all.size(); ++i) CHECK(found[i].probability == Approx(all[i].probability));
    ism::yield_to_rivals(found, calibration, {.other_classes = 1});
    CHECK(log_odds(found[1]) == Approx(-1 - 2));
    found.clear();
    ism::yield_to_rivals(found, calibration);
    CHECK(found.empty());
}

TEST_CASE("a whole and what lies in it exclude each other") {
    const ism::Box whole{0, 0, 120, 80}, left{10, 40, 30, 30}, right{70, 40, 30, 30};
    const auto told = [](const std::vector<ism::Detection>& all) {
        auto found = all;
        ism::yield_to_rivals(found, calibration);
        ism::yield_to_rivals(found, calibration);  // from the start again
        std::vector<double> probabilities;
        for (const ism::Detection& detection : found) {
            probabilities.push_back(detection.probability);
            CHECK(detection.box_reasons.sum() == Approx(log_odds(detection)).margin(1e-9));
        }
        return probabilities;
    };

    // One of four things is there: nothing, the whole (4), one of the parts (1, 0.25) or both (0.25).
    const double all_odds = (1 + 1) * (1 + 0.25) + 4;
    auto found = told({probable(0, left, 0.5), probable(0, whole, 0.8), probable(0, right, 0.2)});
    CHECK(found[0] == Approx((1 + 0.25) / all_odds));
    CHECK(found[1] == Approx(4 / all_odds));
    CHECK(found[2] == Approx((0.25 + 0.25) / all_odds));

    // Another box of a part is no part more, yet excluded too.
    found = told({probable(0, whole, 0.8), probable(0, left, 0.5), probable(0, {12, 38, 30, 30}, 0.2)});
    CHECK(found[0] == Approx(4 / (1 + 1 + 4.0)));
    CHECK(found[2] == Approx(0.2 * (1 - found[0])));

    // What lies in a part is no part more of the whole either.
    found = told({probable(0, whole, 0.8), probable(0, left, 0.5), probable(0, {14, 42, 12, 12}, 0.2)});
    CHECK(found[0] == Approx(4 / (1 + 1 + 4.0)));
    CHECK(found[1] == Approx(1 / (1 + 0.25 + 1) * (1 - found[0])));
    CHECK(found[2] == Approx(0.2 * (1 - found[0])));

    // Neither what is of another class, nor what lies beside, nor what is of the same object.
    const std::vector<ism::Detection> apart = {probable(0, whole, 0.8), probable(1, left, 0.5),
                                               probable(0, {100, 10, 60, 60}, 0.3),
                                               probable(0, {10, 5, 110, 75}, 0.7)};
    found = told(apart);
    for (std::size_t i = 0; i < apart.size(); ++i) {
        INFO("detection " << i);
        CHECK(found[i] == apart[i].probability);
    }
    auto kept = std::vector{probable(0, whole, 0.8), probable(0, left, 0.5)};
    ism::yield_to_rivals(kept, calibration, {.wholes_and_parts = false});
    CHECK(kept[1].probability == Approx(0.5));
}

TEST_CASE("flat curves do not tell hypotheses apart") {
    CHECK(calibration.tells_apart());
    CHECK_FALSE(ism::Calibration{}.tells_apart());
    CHECK_FALSE(ism::Calibration{{{.slope = 0, .offset = 1}}}.tells_apart());
}

TEST_CASE("softplus takes any number") {
    CHECK(ism::softplus(0) == Approx(std::log(2)));
    CHECK(ism::softplus(1) == Approx(std::log1p(std::exp(1))));
    CHECK(ism::softplus(-1) == Approx(std::log1p(std::exp(-1))));
    CHECK(ism::softplus(1000) == 1000);
    CHECK(ism::softplus(-1000) == 0);
    CHECK(ism::softplus(-std::numeric_limits<double>::infinity()) == 0);
}
