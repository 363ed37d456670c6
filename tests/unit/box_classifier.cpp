// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/train/fit_box_classifier.hpp"

namespace {

using ism::TrainingBox;

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
    const auto bins = ism::WordMap(features, matches, 2).histogram({10, 20, 10, 20});
    // Weights: whole: word 0 1.5, word 1 1.5; quarter 1: 0.5 and 1.5; quarter 4: 1. Their sum is 6.
    const std::vector<std::pair<std::uint32_t, double>> expected{
        {0, 1.5}, {1, 1.5}, {2, 0.5}, {3, 1.5}, {8, 1.0}};
    REQUIRE(bins.size() == expected.size());
    double squares = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        CHECK(bins[i].index == expected[i].first);
        CHECK(bins[i].value == Approx(std::sqrt(expected[i].second / 6)));
        squares += double(bins[i].value) * bins[i].value;
    }
    CHECK(squares == Approx(1));
    CHECK(ism::WordMap(features, matches, 2).histogram({100, 100, 10, 10}).empty());
}

TEST_CASE("a judge's probability is the logistic function of its sum") {
    ism::BoxClassifier judge;
    judge.push_back({}, 0);
    judge.push_back(std::vector<ism::SparseEntry>{{0, 1}, {1, 2}, {3, 7}, {4, 5}, {9, 8}}, -1);
    const std::vector<ism::SparseEntry> box{{1, 0.5f}, {2, 0.125f}, {4, 0.25f}, {12, 1}};
    CHECK(judge.classes() == 2);
    CHECK(judge.probability(0, box) == Approx(0.5));
    CHECK(judge.probability(1, box) == Approx(1 / (1 + std::exp(-(-1 + 0.5 * 2 + 0.25 * 5)))));
    CHECK(ism::BoxClassifier{}.probability(7, box) == 1);
}

TEST_CASE("fitted judges sit where the loss has no slope, and tell classes and background apart") {
    // Class 0 has word 0, class 1 has word 1, background word 2, each among noise.
    ism::Random random(3);
    constexpr std::size_t words = 3;
    std::vector<TrainingBox> samples;
    for (std::size_t i = 0; i < 60; ++i) {
        const auto kind = static_cast<std::uint32_t>(i % 3);
        TrainingBox sample{.histogram = {}, .true_class = kind, .predicted_class = kind};
        if (kind == 2) sample.true_class = TrainingBox::background, sample.predicted_class = i / 3 % 2;
        for (std::uint32_t word = 0; word < words; ++word)
            sample.histogram.push_back({word, float(random.uniform(0, 0.3) + (word == kind ? 0.6 : 0))});
        samples.push_back(sample);
    }
    const ism::BoxClassifierOptions options{.regularisation = 1e-2, .tolerance = 1e-9};
    const auto judge = ism::fit_box_classifier(samples, words, 2, options, 1);
    for (std::size_t c = 0; c < 2; ++c) {
        double right = 0, wrong = 0;
        std::vector<double> slope(words + 1, 0);
        const auto used = [&](const TrainingBox& s) {
            return s.true_class != TrainingBox::background || s.predicted_class == c;
        };
        for (const auto& s : samples)
            if (used(s)) (s.true_class == c ? right : wrong) += 1;
        for (const auto& s : samples) {
            const double p = judge.probability(c, s.histogram);
            CHECK((p > 0.5) == (s.true_class == c));
            if (!used(s)) continue;
            const double error = s.true_class == c ? (p - 1) * 0.5 / right : p * 0.5 / wrong;
            for (std::uint32_t w = 0; w < words; ++w) slope[w] += error * double(s.histogram[w].value);
            slope[words] += error;
        }
        REQUIRE(judge.weights[c].size() == words);
        for (std::size_t w = 0; w < words; ++w) {
            CHECK(judge.weights[c][w].index == w);
            CHECK(std::abs(slope[w] + options.regularisation * double(judge.weights[c][w].value)) < 1e-4);
        }
        CHECK(std::abs(slope[words] + options.regularisation * double(judge.bias[c])) < 1e-4);
    }
    const auto two_threads = ism::fit_box_classifier(samples, words, 2, options, 2);
    CHECK(two_threads.weights == judge.weights);
    CHECK(two_threads.bias == judge.bias);
}

TEST_CASE("a judge sees the bins of its own boxes and an even part of the others") {
    constexpr auto background = TrainingBox::background;
    std::vector<TrainingBox> samples = {
        {.histogram = {{1, 1}}, .true_class = 0, .predicted_class = 0},
        {.histogram = {{2, 0.5f}, {9, 0.5f}}, .true_class = background, .predicted_class = 0},
        {.histogram = {{1, 0.5f}, {3, 0.5f}}, .true_class = 1, .predicted_class = 0},
        {.histogram = {{4, 1}}, .true_class = background, .predicted_class = 1},
    };
    for (std::uint32_t i = 0; i < 9; ++i)
        samples.push_back(
            {.histogram = {{1, float(i + 1)}, {4, 1}}, .true_class = 1 + i % 2, .predicted_class = 1});
    const auto matrix = [&](std::size_t class_index, std::size_t max_others) {
        std::vector<const TrainingBox*> boxes;
        for (const TrainingBox& box : samples) boxes.push_back(&box);
        return ism::detail::design_matrix(boxes, 2, class_index, max_others);
    };
    const auto lessons = matrix(0, 3);
    CHECK(lessons.bins == std::vector<std::uint32_t>{1, 2, 3, 9});
    REQUIRE(lessons.rows.size() == 6);
    CHECK(lessons.positive == std::vector<bool>{true, false, false, false, false, false});
    const std::vector<std::vector<ism::SparseEntry>> expected = {
        {{0, 1}}, {{1, 0.5f}, {3, 0.5f}}, {{0, 0.5f}, {2, 0.5f}}, {{0, 1}}, {{0, 4}}, {{0, 7}}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto row = lessons.rows[i];
        CHECK(std::vector<ism::SparseEntry>(row.begin(), row.end()) == expected[i]);
    }
    samples.push_back({.histogram = {}, .true_class = background, .predicted_class = 0});  // without words
    CHECK(matrix(0, 100).rows.size() == 13);
    CHECK(ism::fit_box_classifier(samples, 2, 3).classes() == 3);
    samples.pop_back();
    CHECK(matrix(0, 0).rows.size() == 3);
    CHECK(matrix(5, 3).bins.empty());  // nothing shows this class
    CHECK_THROWS_WITH(ism::fit_box_classifier(samples, 1, 2),
                      "classifier of boxes: bin: expected below 5, got 9");
}

TEST_CASE("a hypothesis that overlaps an object a little is background, one between the limits is left out") {
    const auto hypothesis = [](double overlap) {
        return TrainingBox{
            .histogram = {{1, 1}}, .true_class = 0, .predicted_class = 0, .overlap = overlap, .score = 1};
    };
    const TrainingBox labelled{.histogram = {{0, 1}}, .true_class = 0, .predicted_class = 0};
    const auto fitted = [&](double overlap) {
        return ism::fit_box_classifier(std::vector{labelled, hypothesis(overlap)}, 2, 1);
    };
    const std::vector<ism::SparseEntry> in_question{{1, 1}};
    CHECK(fitted(0.2).probability(0, in_question) < 0.2);
    CHECK(fitted(0.6).probability(0, in_question) > 0.8);
    CHECK(fitted(0.4).weights[0].size() == 1);  // its bin is not even known
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
