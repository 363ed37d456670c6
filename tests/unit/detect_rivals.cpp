// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
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

double log_odds(const ism::Detection& detection) {
    return std::log(detection.probability / (1 - detection.probability));
}

}  // namespace

TEST_CASE("of two classes at one place the less probable yields") {
    const ism::Box here{10, 10, 40, 40}, beside{20, 10, 40, 40}, elsewhere{200, 10, 40, 40};
    const std::vector<ism::Detection> all = {
        judged(0, here, 1),          // odds of e
        judged(1, beside, -0.375),   // 1 / e, e² below the first
        judged(1, elsewhere, -0.5),  // nothing else is there
        judged(0, beside, -0.5),     // of the class of the first; the second is more probable
    };
    auto found = all;
    ism::yield_to_rivals(found, calibration, 0.5);
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
    ism::yield_to_rivals(found, calibration, 0);
    for (std::size_t i = 0; i < all.size(); ++i) CHECK(found[i].probability == Approx(all[i].probability));
    ism::yield_to_rivals(found, calibration, 1);
    CHECK(log_odds(found[1]) == Approx(-1 - 2));
    found.clear();
    ism::yield_to_rivals(found, calibration, 0.5);
    CHECK(found.empty());
}
