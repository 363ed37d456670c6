// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/train/learn_appearance.hpp"

namespace {

using ism::AppearanceSample;
using Approx = Catch::Detail::Approx;

ism::Feature feature_at(float x, float y) {
    ism::Feature f;
    f.x = x, f.y = y;
    return f;
}

}  // namespace

TEST_CASE("a word histogram is the roots of shares, whole and by quarters") {
    // Three features in the box: left top twice word 1, right bottom word 0; one outside.
    const std::vector<ism::Feature> features{feature_at(12, 21), feature_at(14, 22), feature_at(19, 38),
                                             feature_at(20, 25)};
    const std::vector<ism::Match> matches{
        {0, 1, 1.0f}, {1, 0, 0.5f}, {1, 1, 0.5f}, {2, 0, 1.0f}, {3, 0, 1.0f}};
    const auto bins = ism::word_histogram(features, matches, 2, {10, 20, 10, 20});
    // Weights: whole: word 0 1.5, word 1 1.5; quarter 1: 0.5 and 1.5; quarter 4: 1. Their sum is 6.
    const std::vector<std::pair<std::uint32_t, double>> expected{
        {0, 1.5}, {1, 1.5}, {2, 0.5}, {3, 1.5}, {8, 1.0}};
    REQUIRE(bins.size() == expected.size());
    double squares = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        CHECK(bins[i].bin == expected[i].first);
        CHECK(bins[i].value == Approx(std::sqrt(expected[i].second / 6)));
        squares += double(bins[i].value) * bins[i].value;
    }
    CHECK(squares == Approx(1));
    CHECK(ism::word_histogram(features, matches, 2, {100, 100, 10, 10}).empty());
}

TEST_CASE("a judge's probability is the logistic function of its sum") {
    ism::Appearance judge;
    judge.push_back({}, 0);
    judge.push_back(std::vector<ism::BinValue>{{0, 1}, {1, 2}, {3, 7}, {4, 5}, {9, 8}}, -1);
    const std::vector<ism::BinValue> box{{1, 0.5f}, {2, 0.125f}, {4, 0.25f}, {12, 1}};
    CHECK(judge.classes() == 2);
    CHECK(judge.probability(0, box) == Approx(0.5));
    CHECK(judge.probability(1, box) == Approx(1 / (1 + std::exp(-(-1 + 0.5 * 2 + 0.25 * 5)))));
    CHECK(ism::Appearance{}.probability(7, box) == 1);
}

TEST_CASE("fitted judges sit where the loss has no slope, and tell classes and background apart") {
    // Class 0 has word 0, class 1 has word 1, background word 2, each among noise.
    ism::Random random(3);
    constexpr std::size_t words = 3;
    std::vector<AppearanceSample> samples;
    for (std::size_t i = 0; i < 60; ++i) {
        const auto kind = static_cast<std::uint32_t>(i % 3);
        AppearanceSample sample{.box = {}, .shows = kind, .taken_for = kind};
        if (kind == 2) sample.shows = AppearanceSample::background, sample.taken_for = i / 3 % 2;
        for (std::uint32_t word = 0; word < words; ++word)
            sample.box.push_back({word, float(random.uniform(0, 0.3) + (word == kind ? 0.6 : 0))});
        samples.push_back(sample);
    }
    const ism::AppearanceOptions options{.regularisation = 1e-2, .iterations = 3000};
    const auto judge = ism::fit_appearance(samples, words, 2, options, 1);
    for (std::size_t c = 0; c < 2; ++c) {
        double right = 0, wrong = 0;
        std::vector<double> slope(words + 1, 0);
        const auto used = [&](const AppearanceSample& s) {
            return s.shows != AppearanceSample::background || s.taken_for == c;
        };
        for (const auto& s : samples)
            if (used(s)) (s.shows == c ? right : wrong) += 1;
        for (const auto& s : samples) {
            const double p = judge.probability(c, s.box);
            CHECK((p > 0.5) == (s.shows == c));
            if (!used(s)) continue;
            const double error = s.shows == c ? (p - 1) * 0.5 / right : p * 0.5 / wrong;
            for (std::uint32_t w = 0; w < words; ++w) slope[w] += error * double(s.box[w].value);
            slope[words] += error;
        }
        REQUIRE(judge.of_class(c).size() == words);
        for (std::size_t w = 0; w < words; ++w) {
            CHECK(judge.of_class(c)[w].bin == w);
            CHECK(std::abs(slope[w] + options.regularisation * double(judge.of_class(c)[w].value)) < 1e-4);
        }
        CHECK(std::abs(slope[words]) < 1e-4);
    }
    const auto two_threads = ism::fit_appearance(samples, words, 2, options, 2);
    CHECK(two_threads.weights == judge.weights);
    CHECK(two_threads.bias == judge.bias);
}

TEST_CASE("a judge sees the bins of its own boxes and an even part of the others") {
    constexpr auto background = AppearanceSample::background;
    std::vector<AppearanceSample> samples = {
        {.box = {{1, 1}}, .shows = 0, .taken_for = 0},
        {.box = {{2, 0.5f}, {9, 0.5f}}, .shows = background, .taken_for = 0},
        {.box = {{1, 0.5f}, {3, 0.5f}}, .shows = 1, .taken_for = 0},
        {.box = {{4, 1}}, .shows = background, .taken_for = 1},
    };
    for (std::uint32_t i = 0; i < 9; ++i)
        samples.push_back({.box = {{1, float(i + 1)}, {4, 1}}, .shows = 1 + i % 2, .taken_for = 1});
    const auto lessons = ism::detail::judge_lessons(samples, 2, 0, 3);
    CHECK(lessons.bins == std::vector<std::uint32_t>{1, 2, 3, 9});
    REQUIRE(lessons.rows() == 6);
    CHECK(lessons.shows == std::vector<bool>{true, false, false, false, false, false});
    const std::vector<std::vector<ism::BinValue>> expected = {
        {{0, 1}}, {{1, 0.5f}, {3, 0.5f}}, {{0, 0.5f}, {2, 0.5f}}, {{0, 1}}, {{0, 4}}, {{0, 7}}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto row = lessons.row(i);
        CHECK(std::vector<ism::BinValue>(row.begin(), row.end()) == expected[i]);
    }
    samples.push_back({.box = {}, .shows = background, .taken_for = 0});  // a box without words
    CHECK(ism::detail::judge_lessons(samples, 2, 0, 100).rows() == 13);
    CHECK(ism::fit_appearance(samples, 2, 3).classes() == 3);
    samples.pop_back();
    CHECK(ism::detail::judge_lessons(samples, 2, 0, 0).rows() == 3);
    CHECK(ism::detail::judge_lessons(samples, 2, 5, 3).bins.empty());  // nothing shows this class
    CHECK_THROWS_WITH(ism::fit_appearance(samples, 1, 2),
                      "judge of boxes: bin of a sample: expected below 5, got 9");
}

TEST_CASE("shapes without objects: the others of a word say what these said") {
    ism::Shapes shapes;
    shapes.class_names = {"only"};
    shapes.objects.resize(3);
    for (const auto& [object, weight] : {std::pair(0u, 0.5f), {1u, 0.25f}, {2u, 0.25f}, {0u, 1.0f}}) {
        ism::Occurrence o;
        o.object = object, o.weight = weight;
        shapes.occurrences.push_back(o);
    }
    shapes.first = {0, 3, 4};
    const auto rest = ism::detail::without_objects(shapes, 0, 1);
    CHECK(rest.occurrences[0].weight == 0);
    CHECK(rest.occurrences[1].weight == Approx(0.5));
    CHECK(rest.occurrences[2].weight == Approx(0.5));
    CHECK(rest.occurrences[3].weight == 0);  // nobody else has seen this word
    const auto all = ism::detail::without_objects(shapes, 1, 1);
    CHECK(all.occurrences[0].weight == 0.5f);
}

TEST_CASE("a mirror exchanges left and right of an image and its labels, and twice is once") {
    ism::TrainingImage image;
    image.frame.gray = ism::GrayImage(4, 2, {0, 1, 2, 3, 4, 5, 6, 7});
    image.frame.color = ism::RgbImage(4, 2, {{1}, {2}, {3}, {4}, {5}, {6}, {7}, {8}});
    image.frame.depth_m = ism::DepthMap(4, 2, {1, 1, 2, 2, 3, 3, 4, 4});
    image.frame.camera = ism::Camera{.fx = 10, .fy = 10, .cx = 1, .cy = 0.5};
    image.objects = {
        {.class_index = 1, .box = {0, 1, 2, 1}, .mask = ism::Mask(4, 2, {0, 0, 0, 0, 1, 1, 0, 0})},
        {.class_index = 0, .box = {3, 0, 1, 2}}};
    const ism::TrainingImage other = mirrored(image);
    CHECK(other.frame.gray == ism::GrayImage(4, 2, {3, 2, 1, 0, 7, 6, 5, 4}));
    CHECK(other.frame.color == ism::RgbImage(4, 2, {{4}, {3}, {2}, {1}, {8}, {7}, {6}, {5}}));
    CHECK(other.frame.depth_m == ism::DepthMap(4, 2, {2, 2, 1, 1, 4, 4, 3, 3}));
    CHECK(other.frame.camera->cx == 2);
    CHECK(other.objects[0].box == ism::Box{2, 1, 2, 1});
    CHECK(other.objects[0].mask == ism::Mask(4, 2, {0, 0, 0, 0, 0, 0, 1, 1}));
    CHECK(other.objects[1].box == ism::Box{0, 0, 1, 2});
    CHECK(other.objects[1].mask.empty());
    const ism::TrainingImage again = mirrored(other);
    CHECK(again.frame.gray == image.frame.gray);
    CHECK(again.frame.camera->cx == image.frame.camera->cx);
    CHECK(again.objects[0].box == image.objects[0].box);
}
