// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/image.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/train/cross_judge.hpp"
#include "ism/train/fit_box_templates.hpp"

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

/// Images of two classes in turn, those of one fold with pixels of another seed.
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
        for (std::uint32_t i = 0; i < count; ++i)
            images.push_back({.color = pixels[i],
                              .labels = {{i % 2, shown_box}},
                              .proposals = {{0, {2, 2, 40, 30}}, {1, {50, 30, 40, 40}}, {i % 2, shown_box}}});
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

TEST_CASE("no templates are fitted without a fold that shows all there is of a class") {
    Lined set(12, fold_count);
    for (std::size_t i = 0; i < set.images.size(); ++i)
        if (set.fold_of[i] != 2) set.images[i].labels[0].class_index = 0;
    const auto fitter = set.fitted();
    REQUIRE(fitter.fits().size() == fold_count);
    for (const auto& fit : fitter.fits()) CHECK(fit.fold != 2);
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

TEST_CASE("images of a class take turns in folds") {
    std::vector<ism::TemplateImage> images(9);
    for (std::size_t i = 0; i < 8; ++i) images[i].labels = {{std::uint32_t(i % 2), shown_box}};
    CHECK(ism::detail::folds_of(images, 2, 3) == std::vector<std::size_t>{0, 0, 1, 1, 2, 2, 0, 0, 0});
}
