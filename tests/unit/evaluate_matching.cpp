// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/evaluate/matching.hpp"

using ism::Box;
using ism::FoundObject;
using ism::IouRule;
using ism::Judgement;
using ism::TruthObject;
using ism::UiucRule;
using ism::Verdict;

namespace {

const Judgement wrong{};
const Judgement ignored{Verdict::ignored, ism::no_object};
Judgement right(std::size_t truth) {
    return {Verdict::true_positive, truth};
}
FoundObject found_at(double x, double score, std::size_t image = 0, std::uint32_t class_index = 0) {
    return {image, class_index, {x, 0, 10, 10}, score};
}
TruthObject truth_at(double x, std::size_t image = 0, std::uint32_t class_index = 0) {
    return {image, class_index, {x, 0, 10, 10}, false};
}

}  // namespace

TEST_CASE("A rule of an absurd threshold is refused") {
    const std::vector<FoundObject> found;
    for (const double threshold : {-1.0, 50.0, std::nan("")})
        CHECK_THROWS_WITH(ism::match({}, found, IouRule{threshold}),
                          Catch::Contains("IouRule::threshold: expected 0 ... 1"));
}

TEST_CASE("An IoU of exactly the threshold is right, less is wrong") {
    const IouRule half;
    // a box twice as long as the one inside it: IoU ½
    CHECK(half.fit({0, 0, 20, 10}, {0, 0, 10, 10}) == 0.5);
    CHECK_FALSE(half.fit({0, 0, 20.001, 10}, {0, 0, 10, 10}).has_value());
    CHECK_FALSE(IouRule{0}.fit({20, 0, 10, 10}, {0, 0, 10, 10}).has_value());
    CHECK(IouRule{0}.fit({9, 0, 10, 10}, {0, 0, 10, 10}).has_value());
}

TEST_CASE("A detection is ignored with half of it in an ignored region, not with less") {
    const Box region{0, 0, 100, 10};
    CHECK(IouRule{}.ignores({95, 0, 10, 10}, region));
    CHECK_FALSE(IouRule{}.ignores({95.001, 0, 10, 10}, region));
    CHECK(UiucRule{}.ignores({95, 0, 10, 10}, region));
    CHECK_FALSE(UiucRule{}.ignores({95.001, 0, 10, 10}, region));
    CHECK(IouRule{0}.ignores({99, 0, 10, 10}, region));
    CHECK_FALSE(IouRule{0}.ignores({100, 0, 10, 10}, region));
    CHECK_FALSE(IouRule{}.ignores({5, 5, 0, 0}, region));
    CHECK_FALSE(UiucRule{}.ignores({5, 5, 0, 0}, region));
}

TEST_CASE("The UIUC rule takes centres on the edge of the ellipse and none beyond") {
    const UiucRule rule;
    const Box truth{200, 100, 100, 40};
    const auto moved = [&](double dx, double dy) {
        return rule.fit({truth.x + dx, truth.y + dy, 100, 40}, truth).has_value();
    };
    CHECK(moved(0, 0));
    for (const int sign : {-1, 1}) {
        CHECK(moved(25 * sign, 0));
        CHECK(moved(0, 10 * sign));
        CHECK(moved(15 * sign, 8));  // (15/25)² + (8/10)² = 1
        CHECK(moved(20 * sign, 6));
        CHECK_FALSE(moved(25.001 * sign, 0));
        CHECK_FALSE(moved(0, 10.001 * sign));
        CHECK_FALSE(moved(15 * sign, 8.001));
    }
    // only centres count: a box of another size at the same place is right
    CHECK(rule.fit({240, 110, 20, 20}, truth) == 1.0);
    CHECK_FALSE(rule.fit({0, 0, 10, 10}, {5, 5, 0, 0}).has_value());
}

TEST_CASE("The UIUC rule agrees with the ellipse's equation away from its edge") {
    ism::Random random(3);
    for (int i = 0; i < 2000; ++i) {
        const Box truth{random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(5, 200),
                        random.uniform(5, 200)};
        const double u = random.uniform(-1.5, 1.5), v = random.uniform(-1.5, 1.5);
        const Box box{truth.x + u * truth.width / 4, truth.y + v * truth.height / 4, truth.width,
                      truth.height};
        if (std::abs(u * u + v * v - 1) < 1e-9) continue;
        REQUIRE(UiucRule{}.fit(box, truth).has_value() == (u * u + v * v < 1));
    }
}

TEST_CASE("An object is found once, by the detection of the best score") {
    const std::vector<TruthObject> truth{truth_at(0)};
    const std::vector<FoundObject> found{found_at(0, 0.4), found_at(2, 0.9), found_at(1, 0.8)};
    CHECK(match(truth, found, IouRule{}) == std::vector{wrong, right(0), wrong});
}

TEST_CASE("A detection takes the object that fits best among those still free") {
    const std::vector<TruthObject> truth{truth_at(0), truth_at(2)};
    const std::vector<FoundObject> found{found_at(1.8, 0.9), found_at(1.9, 0.8), found_at(1.9, 0.7)};
    CHECK(match(truth, found, IouRule{}) == std::vector{right(1), right(0), wrong});
}

TEST_CASE("Equal scores and equal fits go to the earlier one") {
    const std::vector<TruthObject> twins{truth_at(0), truth_at(0)};
    const std::vector<FoundObject> found{found_at(0, 0.5), found_at(0, 0.5), found_at(0, 0.5)};
    CHECK(match(twins, found, IouRule{}) == std::vector{right(0), right(1), wrong});
}

TEST_CASE("The earlier one goes first among many too") {
    const std::vector<TruthObject> truth(100, truth_at(0));
    const std::vector<FoundObject> found(100, found_at(0, 0.5));
    const auto judgements = match(truth, found, IouRule{});
    for (std::size_t i = 0; i < 100; ++i) REQUIRE(judgements[i] == right(i));
}

TEST_CASE("Objects of other images and classes are not found") {
    const std::vector<TruthObject> truth{truth_at(0, 1, 0), truth_at(0, 0, 1), truth_at(0, 1, 1)};
    const std::vector<FoundObject> found{found_at(0, 0.9, 0, 0), found_at(0, 0.8, 1, 1),
                                         found_at(0, 0.7, 1, 0), found_at(0, 0.6, 2, 0)};
    CHECK(match(truth, found, IouRule{}) == std::vector{wrong, right(2), right(0), wrong});
}

TEST_CASE("Ignored objects neither help nor hurt, and take any number of detections") {
    std::vector<TruthObject> truth{{0, 0, {0, 0, 100, 10}, true}, truth_at(50)};
    const std::vector<FoundObject> found{found_at(10, 0.9), found_at(20, 0.8), found_at(50, 0.7),
                                         found_at(51, 0.6), found_at(300, 0.5)};
    const std::vector expected{ignored, ignored, right(1), ignored, wrong};
    CHECK(match(truth, found, IouRule{}) == expected);
    CHECK(match(truth, found, UiucRule{}) == expected);
    std::swap(truth[0], truth[1]);
    CHECK(match(truth, found, IouRule{})[2] == right(0));
}

TEST_CASE("Nothing found and nothing to find") {
    const std::vector<TruthObject> truth{truth_at(0)};
    const std::vector<FoundObject> found{found_at(0, 1)};
    CHECK(match(truth, {}, IouRule{}).empty());
    CHECK(match({}, found, IouRule{}) == std::vector{wrong});
}

TEST_CASE("Scores and boxes that are not numbers are refused") {
    std::vector<FoundObject> found{found_at(0, std::nan(""))};
    CHECK_THROWS_AS(match({}, found, IouRule{}), ism::Error);
    for (double Box::*side : {&Box::x, &Box::y, &Box::width, &Box::height}) {
        found = {found_at(0, 1)};
        found[0].box.*side = std::numeric_limits<double>::infinity();
        CHECK_THROWS_AS(match({}, found, IouRule{}), ism::Error);
    }
}
