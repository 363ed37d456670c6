// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/search_box.hpp"
#include "ism/train/cross_judge.hpp"
#include "ism/train/fit_box_templates.hpp"
#include "ism/train/learn_templates.hpp"
#include "ism/train/training_features.hpp"

namespace {

constexpr std::size_t fold_count = 3;
const ism::Box shown_box{24, 16, 48, 36};

/// An object with lines along or across on a ground of noise.
ism::RgbImage lined(std::uint32_t class_index, ism::Random& random) {
    ism::RgbImage image(96, 72);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const bool object = x >= shown_box.x && y >= shown_box.y && x < shown_box.x + shown_box.width &&
                                y < shown_box.y + shown_box.height;
            const double wave = std::sin((class_index == 0 ? x : y) * 0.8);
            const auto value = static_cast<std::uint8_t>(object ? 128 + 90 * wave : random.uniform(0, 255));
            image(x, y) = {value, value, value};
        }
    return image;
}

/// Images of two classes in turn, those of one fold with pixels of another seed, where both classes are asked
/// about all proposals.
struct Lined {
    std::vector<ism::RgbImage> pixels = {};
    std::vector<ism::TemplateImage> images = {};
    std::vector<std::size_t> fold_of = {};

    Lined(std::size_t count, std::size_t other_fold) {
        for (std::uint32_t i = 0; i < count; ++i) {
            fold_of.push_back(i / 2 % fold_count);
            ism::Random random(i + (fold_of[i] == other_fold ? 100 : 0));
            pixels.push_back(lined(i % 2, random));
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            images.push_back({.color = pixels[i],
                              .labels = {{i % 2, shown_box}},
                              .proposals = {{0, {2, 2, 40, 30}}, {1, {50, 30, 40, 40}}, {i % 2, shown_box}}});
            images[i].asked = {2, images[i].proposals};
        }
    }

    /// Described, mined once and fitted twice.
    [[nodiscard]] ism::detail::TemplateFitter fitted() const {
        ism::detail::TemplateFitter fitter(images, fold_of, fold_count, 2,
                                           {.cells = 16, .jittered_copies = 1});
        ism::ThreadPool pool(1);
        std::vector<std::size_t> all;
        for (std::size_t f = 0; f < fitter.fits().size(); ++f) all.push_back(f);
        for (int round = 0; round < 2; ++round) {
            for (std::size_t i = 0; i < images.size(); ++i) {
                const ism::HogPyramid pyramid(pixels[i], ism::HogPyramid::finest, pool);
                std::vector<std::size_t> seeing;
                for (const std::size_t f : all)
                    if (fitter.sees(fitter.fits()[f], i)) seeing.push_back(f);
                if (round == 0)
                    fitter.describe(i, pyramid, pool);
                else
                    fitter.mine(i, seeing, round, pyramid, pool);
            }
            fitter.fit(all, pool);
        }
        return fitter;
    }
};

/// Six images, and the same with other pixels in one of class 0.
struct ChangedImage {
    static constexpr std::size_t image = 4;
    Lined set{6, fold_count}, changed{6, fold_count};

    ChangedImage() {
        ism::Random random(200);
        changed.pixels[image] = lined(0, random);
        changed.images[image].color = changed.pixels[image];
    }
    /// Of each class: whether the change is seen in its template.
    [[nodiscard]] std::vector<bool> seen() const {
        const auto before = set.fitted(), after = changed.fitted();
        std::vector<bool> result;
        for (std::size_t c = 0; c < 2; ++c)
            result.push_back(before.fits()[0].templates[c] != after.fits()[0].templates[c]);
        return result;
    }
};

}  // namespace

TEST_CASE("templates that are fitted without a fold know nothing of its pixels") {
    const std::size_t other_fold = 1;
    const Lined set(12, fold_count), changed(12, other_fold);
    const auto fitter = set.fitted(), other = changed.fitted();
    REQUIRE(fitter.fits().size() == 1 + fold_count);
    for (std::size_t f = 0; f < fitter.fits().size(); ++f) {
        const auto &before = fitter.fits()[f], &after = other.fits()[f];
        CHECK((before.templates == after.templates) == (before.fold == other_fold));
        std::size_t searched = 0;
        for (std::size_t i = 0; i < set.images.size(); ++i) {
            searched += !before.taken[i].empty();
            if (!fitter.sees(before, i)) CHECK(before.taken[i].empty());
        }
        CHECK(searched == (before.fold < fold_count ? 8 : 12));
    }
}

TEST_CASE("what is learnt is the mean of all fits, each on the side that is more like the first") {
    const Lined set(12, fold_count);
    const auto fitter = set.fitted();
    const std::vector<ism::BoxTemplate> means = fitter.mean_templates();
    REQUIRE(means.size() == 2);
    const auto dot = [](const std::vector<float>& a, const std::vector<float>& b) {
        double sum = 0;
        for (std::size_t k = 0; k < a.size(); ++k) sum += double(a[k]) * double(b[k]);
        return sum;
    };
    for (std::size_t c = 0; c < 2; ++c) {
        const ism::BoxTemplate& first = fitter.fits()[0].templates[c];
        std::vector<double> expected(first.weights.size(), 0);
        double bias = 0;
        for (const auto& fit : fitter.fits()) {
            std::vector<float> weights = fit.templates[c].weights;
            const std::vector<float> mirrored = ism::mirrored_cells(weights, first.grid);
            if (dot(first.weights, mirrored) > dot(first.weights, weights)) weights = mirrored;
            for (std::size_t k = 0; k < weights.size(); ++k) expected[k] += double(weights[k]) / 4;
            bias += double(fit.templates[c].bias) / 4;
        }
        CHECK(means[c].grid == first.grid);
        CHECK(double(means[c].bias) == Approx(bias));
        double worst = 0;
        for (std::size_t k = 0; k < expected.size(); ++k)
            worst = std::max(worst, std::abs(double(means[c].weights[k]) - expected[k]));
        CHECK(worst < 1e-6);
        CHECK(means[c].weights != first.weights);
    }
}

TEST_CASE("the classifier of patches that is learnt is the mean of those of all judges") {
    std::vector<ism::detail::FoldJudges> judges(2);
    judges[0].patches.weights = {{1, 2}, {3, 4}}, judges[0].patches.bias = {5, 6};
    judges[1].patches.weights = {{3, 0}, {-3, 6}}, judges[1].patches.bias = {-1, 8};
    const ism::PatchClassifier mean = ism::detail::mean_patches(judges);
    CHECK(mean.weights == std::vector<std::vector<float>>{{2, 1}, {0, 5}});
    judges.push_back(judges[1]);
    judges[2].patches.weights = {{2, 7}, {}}, judges[2].patches.bias = {5, 0};  // knows the first class alone
    const auto three = ism::detail::mean_patches(judges);
    CHECK(std::abs(three.weights[0][1] - 3) < 1e-5f);
    CHECK(three.weights[1] == std::vector<float>{0, 5});
    CHECK((std::abs(three.bias[0] - 3) < 1e-5f && three.bias[1] == 7));
    CHECK(mean.bias == std::vector<float>{2, 7});
}

TEST_CASE("a class learns nothing from an image that it is not asked about") {
    ChangedImage two;
    CHECK(two.seen() == std::vector<bool>{true, true});
    for (Lined* one : {&two.set, &two.changed}) one->images[two.image].asked[1].clear();
    CHECK(two.seen() == std::vector<bool>{true, false});
    CHECK(ism::detail::learns_from(two.set.images[two.image], 0));
    CHECK(!ism::detail::learns_from(two.set.images[two.image], 1));
}

TEST_CASE("a class learns nothing from what is to be ignored but its own objects") {
    ChangedImage two;
    CHECK(two.seen() == std::vector<bool>{true, true});
    for (Lined* one : {&two.set, &two.changed}) one->images[two.image].ignored = {{0, 0, 96, 72}};
    CHECK(two.seen() == std::vector<bool>{true, false});
}

TEST_CASE("of many images that do not show it a class learns from an even choice") {
    constexpr std::size_t classes = 40, shown = 25;
    std::vector<ism::TrainingView> views(600);
    for (std::size_t i = 0; i < views.size(); ++i) views[i].labels = {{i < shown ? 7u : 8u, shown_box}};
    std::vector<const ism::TrainingView*> all;
    for (const ism::TrainingView& view : views) all.push_back(&view);
    const std::vector<bool> left_out = ism::detail::left_out_images(all, 7, classes);
    REQUIRE(left_out.size() == all.size());
    const auto learnt = [&](std::size_t begin, std::size_t end) {
        return std::count(left_out.begin() + std::ptrdiff_t(begin), left_out.begin() + std::ptrdiff_t(end),
                          false);
    };
    CHECK(learnt(0, shown) == shown);
    CHECK(learnt(shown, 600) == 200);
    CHECK(std::abs(learnt(shown, 312) - 100) <= 1);
    CHECK(ism::detail::left_out_images(all, 7, 2) ==
          std::vector<bool>(600, false));  // few classes search all
    CHECK(ism::detail::left_out_images(std::span(all).first(200), 7, classes) ==
          std::vector<bool>(200, false));
}

TEST_CASE("without a fold that shows all there is of a class the other classes are fitted alone") {
    Lined set(12, fold_count);
    for (std::size_t i = 0; i < set.images.size(); ++i)
        if (set.fold_of[i] != 2) set.images[i].labels[0].class_index = 0;
    const auto fitter = set.fitted();
    REQUIRE(fitter.fits().size() == 1 + fold_count);
    const auto is_blank = [](const ism::BoxTemplate& one) {
        return one.bias == 0 && std::ranges::all_of(one.weights, [](float w) { return w == 0; });
    };
    const std::vector<ism::BoxTemplate> means = fitter.mean_templates();
    double bias[2] = {};
    for (const auto& fit : fitter.fits()) {
        CHECK(fit.known == std::vector<bool>{true, fit.fold != 2});
        CHECK_FALSE(is_blank(fit.templates[0]));
        CHECK(is_blank(fit.templates[1]) == (fit.fold == 2));
        for (std::size_t c = 0; c < 2; ++c) bias[c] += double(fit.templates[c].bias);
    }
    CHECK(double(means[0].bias) == Approx(bias[0] / 4));
    CHECK(double(means[1].bias) == Approx(bias[1] / 3));
    for (std::uint32_t i = 0; i < set.images.size(); ++i) set.images[i].labels[0].class_index = i != 0;
    CHECK(set.fitted().fits()[1].known == std::vector<bool>{false, true});
}

TEST_CASE("a search moves a box that is off to the object, and leaves one that no move betters") {
    const Lined set(12, fold_count);
    const auto fitter = set.fitted();
    const ism::TemplateScorer& scorer = fitter.fits()[0].scorers[1];
    ism::ThreadPool pool(1);
    const ism::HogPyramid pyramid(set.pixels[3], ism::HogPyramid::finest, pool);
    ism::CellScratch scratch;
    const auto at = [&](const ism::Box& box) {
        const auto score = scorer.score(scorer.describe(pyramid, box, scratch), box);
        return ism::SearchedBox{box, score.value, score.mirrored};
    };
    for (const ism::Box& off : {ism::Box{30, 20, 48, 36}, {20, 10, 58, 44}, {24, 22, 40, 26}}) {
        const ism::SearchedBox start = at(off), found = ism::search_box(scorer, pyramid, start, scratch);
        CHECK(found.score > start.score);
        CHECK(ism::iou(found.box, shown_box) > ism::iou(off, shown_box));
        CHECK(found.score == scorer.of_side(pyramid, found.box, found.mirrored, scratch));
    }
    ism::SearchedBox best = at(shown_box);
    best.score += 100;
    const ism::SearchedBox found = ism::search_box(scorer, pyramid, best, scratch);
    CHECK((found.box == best.box && found.score == best.score));
}

TEST_CASE("several templates find of the same proposals what each finds alone") {
    const Lined set(12, fold_count);
    const auto fitter = set.fitted();
    ism::ThreadPool pool(1);
    const ism::HogPyramid pyramid(set.pixels[3], ism::HogPyramid::finest, pool);
    std::vector<const ism::TemplateScorer*> scorers;
    for (const auto& fit : fitter.fits()) scorers.push_back(&fit.scorers[1]);
    const auto found = ism::propose_boxes(scorers, 1, pyramid, set.images[3].proposals, 5, pool);
    REQUIRE(found.size() == scorers.size());
    bool differ = false;
    for (std::size_t s = 0; s < scorers.size(); ++s) {
        const auto alone = ism::propose_boxes(*scorers[s], 1, pyramid, set.images[3].proposals, 5, pool);
        REQUIRE(found[s].size() == alone.size());
        REQUIRE(!alone.empty());
        for (std::size_t k = 0; k < alone.size(); ++k) {
            CHECK(found[s][k].box == alone[k].box);
            CHECK(found[s][k].score == alone[k].score);
            CHECK(found[s][k].mirrored == alone[k].mirrored);
        }
        differ = differ || found[s][0].score != found[0][0].score;
    }
    CHECK(differ);
}

TEST_CASE("a template asks at the places proposed, with its aspect, and at the better third again") {
    const std::vector<ism::ProposedBox> proposals{{0, {10, 20, 40, 10}}, {1, {30, 5, 25, 36}}};
    const auto places = ism::detail::asked_places(proposals, 0, std::log(4.0));
    REQUIRE(places.size() == 2);
    CHECK(places[0] == proposals[0].box);
    CHECK(places[1].width == Approx(60));
    CHECK(places[1].height == Approx(15));
    CHECK(places[1].centre().x == Approx(proposals[1].box.centre().x));
    CHECK(places[1].centre().y == Approx(proposals[1].box.centre().y));

    const auto better = [](const std::vector<double>& scores) {
        std::vector<ism::SearchedBox> boxes;
        for (const double score : scores) boxes.push_back({.box = {}, .score = score});
        return ism::detail::better_third(boxes);
    };
    CHECK(better({-1, 5, -3, 2}) == std::vector<std::uint8_t>{0, 1, 0, 1});
    CHECK(better({1, 1, 1}) == std::vector<std::uint8_t>{1, 0, 0});
    CHECK(better({-7}) == std::vector<std::uint8_t>{1});
    CHECK(better({}).empty());
}

TEST_CASE("images of a class are shared out among folds, those of a rare one first") {
    using Labels = std::vector<std::vector<ism::ObjectLabel>>;
    const auto shown = [](std::initializer_list<std::uint32_t> classes) {
        std::vector<ism::ObjectLabel> labels;
        for (const std::uint32_t c : classes) labels.push_back({c, shown_box});
        return labels;
    };
    // One object each: they take turns, and so do images without.
    Labels one(9);
    for (std::size_t i = 0; i < 8; ++i) one[i] = shown({std::uint32_t(i % 2)});
    CHECK(ism::detail::balanced_folds(one, 2, 3) == std::vector<std::size_t>{0, 0, 1, 1, 2, 2, 0, 0, 0});
    // The second class is in every third image, beside the first.
    Labels beside;
    for (std::size_t i = 0; i < 9; ++i) beside.push_back(i % 3 == 0 ? shown({0, 1, 1}) : shown({0}));
    const auto folds = ism::detail::balanced_folds(beside, 2, 3);
    CHECK((folds[0] == 0 && folds[3] == 1 && folds[6] == 2));
    for (std::size_t f = 0; f < 3; ++f) CHECK(std::count(folds.begin(), folds.end(), f) == 3);
    CHECK(ism::detail::balanced_folds({}, 2, 3).empty());
}
