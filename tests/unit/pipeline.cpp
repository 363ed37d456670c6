// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
//
// One suite of properties for every vote space with every descriptor, on small drawn pictures (synthetic).
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/detect/detect.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/train.hpp"

namespace {

/// A picture with a patterned square of 80 px, whose pattern tells the class, on a faint noise, 1 m or 2 m
/// away.
ism::TrainingImage picture(std::size_t class_index, int left, int top, std::uint64_t seed,
                           bool with_depth = true) {
    constexpr int width = 200, height = 160, side = 80;
    ism::Random noise(seed), pattern(100 + class_index);
    ism::TrainingImage image;
    image.name = "picture " + std::to_string(seed);
    image.frame.gray = ism::GrayImage(width, height, 0.5f);
    for (float& v : image.frame.gray.pixels()) v += float(0.01 * noise.normal());
    ism::Mask mask(width, height);
    if (with_depth) image.frame.depth_m = ism::DepthMap(width, height, 2.0f);
    image.frame.camera = ism::Camera{200, 200, 99.5, 79.5};
    for (int blob = 0; blob < 40; ++blob) {
        const double x = left + pattern.uniform(8, side - 8), y = top + pattern.uniform(8, side - 8);
        const double sigma = pattern.uniform(1.5, 5), height_of = pattern.uniform() < 0.5 ? -0.4 : 0.4;
        for (int v = 0; v < height; ++v)
            for (int u = 0; u < width; ++u)
                image.frame.gray(u, v) += float(
                    height_of * std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / (2 * sigma * sigma)));
    }
    for (int v = top; v < top + side; ++v)
        for (int u = left; u < left + side; ++u) {
            mask(u, v) = 1;
            if (with_depth) image.frame.depth_m(u, v) = 1.0f;
        }
    image.objects.push_back({class_index, {double(left), double(top), side, side}, mask});
    return image;
}

const std::vector<std::string> names{"first", "second"};

std::vector<ism::TrainingImage> training_set() {
    std::vector<ism::TrainingImage> images;
    for (std::uint64_t i = 0; i < 6; ++i)
        images.push_back(picture(i % 2, 40 + 7 * int(i), 30 + 3 * int(i), i));
    return images;
}

template <class Desc>
ism::Model<ism::HessianLaplace, Desc> trained(unsigned threads = 1) {
    const auto images = training_set();
    return ism::train<ism::HessianLaplace, Desc>(names, images, {.threads = threads});
}

bool same(const ism::Detections& a, const ism::Detections& b) {
    if (a.features != b.features || a.objects.size() != b.objects.size()) return false;
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
        const auto &p = a.objects[i], &q = b.objects[i];
        if (p.score != q.score || !(p.box == q.box) || p.class_index != q.class_index ||
            p.support.size() != q.support.size() || !(p.segmentation.mask == q.segmentation.mask) ||
            !(p.segmentation.figure == q.segmentation.figure))
            return false;
    }
    return true;
}

}  // namespace

TEMPLATE_PRODUCT_TEST_CASE("every vote space finds the object with every descriptor", "", std::tuple,
                           ((ism::Ism, ism::Sift), (ism::Jism, ism::Sift), (ism::Ji3sm1, ism::Sift),
                            (ism::Ji3sm2, ism::Sift), (ism::Ji3sm3, ism::Sift), (ism::Ism, ism::RootSift),
                            (ism::Jism, ism::RootSift), (ism::Ji3sm1, ism::RootSift),
                            (ism::Ji3sm2, ism::RootSift), (ism::Ji3sm3, ism::RootSift),
                            (ism::Ism, ism::GrayPatch), (ism::Jism, ism::GrayPatch),
                            (ism::Ji3sm1, ism::GrayPatch), (ism::Ji3sm2, ism::GrayPatch),
                            (ism::Ji3sm3, ism::GrayPatch))) {
    using Space = std::tuple_element_t<0, TestType>;
    using Desc = std::tuple_element_t<1, TestType>;
    static const auto model = trained<Desc>();
    for (const std::size_t class_index : {std::size_t{0}, std::size_t{1}}) {
        const auto test = picture(class_index, 70, 50, 77 + class_index);
        const auto found = ism::detect<Space>(model, test.frame);
        REQUIRE_FALSE(found.objects.empty());
        const ism::Detection& best = found.objects.front();
        CHECK(best.class_index == class_index);
        CHECK(ism::iou(best.box, test.objects[0].box) > 0.7);
        CHECK(ism::mask_iou(ism::whole_mask(best.segmentation, 200, 160), test.objects[0].mask) > 0.6);
        CHECK(best.depth_m == Approx(1).margin(0.05));
        REQUIRE(best.position_m);
        CHECK(best.position_m->x == Approx((109.5 - 99.5) / 200).margin(0.02));
        CHECK(best.position_m->y == Approx((89.5 - 79.5) / 200).margin(0.02));
        CHECK(best.score > 0);
        REQUIRE_FALSE(best.support.empty());
        for (const ism::Support& s : best.support) {
            CHECK(s.feature < found.features.size());
            CHECK(model.shapes.occurrences.at(s.occurrence).class_index == best.class_index);
            CHECK(s.occurrence >= model.shapes.first.at(s.word));
            CHECK(s.occurrence < model.shapes.first.at(s.word + 1));
            CHECK((!Space::needs_depth || ism::is_depth(found.features[s.feature].depth_m)));
        }
        CHECK(same(found, ism::detect<Space>(model, test.frame, {.threads = 2})));
        CHECK(same(found, ism::detect<Space, ism::EpanechnikovKernel>(model, test.frame, {.threads = 1})));
    }
}

TEST_CASE("training gives the same model for one and two threads") {
    const auto one = trained<ism::RootSift>(1), two = trained<ism::RootSift>(2);
    REQUIRE(one.codebook.size() == two.codebook.size());
    CHECK(std::equal(one.codebook.words.values().begin(), one.codebook.words.values().end(),
                     two.codebook.words.values().begin()));
    REQUIRE(one.shapes.occurrences.size() == two.shapes.occurrences.size());
    for (std::size_t i = 0; i < one.shapes.occurrences.size(); ++i)
        CHECK(one.shapes.occurrences[i].weight == two.shapes.occurrences[i].weight);
}

TEST_CASE("the occurrences of a word weigh 1 together") {
    const auto model = trained<ism::Sift>();
    for (std::size_t w = 0; w < model.codebook.size(); ++w) {
        double sum = 0;
        for (const auto& o : model.shapes.of_word(w)) sum += o.weight;
        CHECK(sum == Approx(1).margin(1e-4));
    }
}

TEST_CASE("other kernels and plain suppression find the object too") {
    const auto model = trained<ism::RootSift>();
    const auto test = picture(1, 30, 60, 5);
    const auto flat =
        ism::detect<ism::Jism, ism::FlatKernel>(model, test.frame, {}, ism::NonMaximumSuppression{});
    const auto gauss = ism::detect<ism::Jism, ism::GaussianKernel>(model, test.frame);
    REQUIRE_FALSE((flat.objects.empty() || gauss.objects.empty()));
    CHECK(ism::iou(flat.objects[0].box, test.objects[0].box) > 0.7);
    CHECK(ism::iou(gauss.objects[0].box, test.objects[0].box) > 0.7);
}

TEST_CASE("the judge sees all candidates before the best of them are cut out") {
    auto model = trained<ism::RootSift>();
    model.shapes.appearance = {};
    for (const float bias : {-20.0f, 20.0f}) model.shapes.appearance.push_back({}, bias);
    const auto scene = picture(0, 70, 50, 9);
    const auto one_candidate = ism::detect<ism::Jism>(model, scene.frame, {.keep = 0, .max_candidates = 1});
    REQUIRE(one_candidate.objects.size() == 1);
    CHECK(one_candidate.objects[0].class_index == 0);
    const auto one_cut_out = ism::detect<ism::Jism>(model, scene.frame, {.keep = 0, .max_hypotheses = 1});
    REQUIRE(one_cut_out.objects.size() == 1);
    CHECK(one_cut_out.objects[0].class_index == 1);
}

TEST_CASE("an empty scene gives an empty result, not an error") {
    const auto model = trained<ism::RootSift>();
    const ism::Frame blank{.gray = ism::GrayImage(120, 90, 0.3f)};
    CHECK(ism::detect<ism::Jism>(model, blank).objects.empty());
}

TEST_CASE("wrong frames are refused by name") {
    const auto model = trained<ism::RootSift>();
    const auto good = picture(0, 50, 50, 3).frame;
    const auto refuses = [&](ism::Frame frame, const char* what) {
        CHECK_THROWS_WITH(ism::detect<ism::Ji3sm3>(model, frame), Catch::Contains(what));
    };
    refuses({.gray = ism::GrayImage()}, "image size");
    refuses({.gray = ism::GrayImage(15, 200)}, "image size: expected at least 16x16, got 15x200");
    refuses({.gray = ism::GrayImage(64, 64, NAN)}, "image brightness");
    refuses({.gray = good.gray}, "depth image: expected one");
    refuses({.gray = good.gray, .depth_m = ism::DepthMap(10, 10, 1.0f)},
            "depth image size: expected 200x160");
    refuses({.gray = good.gray, .depth_m = ism::DepthMap(200, 160, 0.0f)},
            "depth image: expected at least one");
    refuses({.gray = good.gray, .depth_m = good.depth_m, .camera = ism::Camera{0, 1, 0, 0}},
            "camera focal lengths");
    CHECK_THROWS_WITH(ism::detect<ism::Jism>(model, good, {.keep = 1.5}), Catch::Contains("T_ratio"));
    const ism::Model<ism::HessianLaplace, ism::RootSift> untrained;
    CHECK_THROWS_WITH(ism::detect<ism::Jism>(untrained, good),
                      Catch::Contains("training objects of the model"));
}

TEST_CASE("wrong training images are refused by name") {
    auto images = training_set();
    const auto train = [&](const ism::TrainOptions& options = {}) {
        return ism::train<ism::HessianLaplace, ism::RootSift>(names, images, options);
    };
    CHECK_THROWS_WITH(train({.min_similarity = 2}), Catch::Contains("similarity"));
    CHECK_THROWS_WITH(train({.min_cluster_size = 0}), Catch::Contains("cluster size"));
    CHECK_THROWS_WITH(train({.min_cluster_size = 100000}), Catch::Contains("at least 100000 features"));
    CHECK_THROWS_WITH(train({.min_information_gain = 1}), Catch::Contains("information gain"));
    images[2].objects[0].mask = ism::Mask(5, 5, 1);
    CHECK_THROWS_WITH(train(), Catch::Contains("picture 2: mask size: expected 200x160, got 5x5"));
    images[2].objects[0].mask = ism::Mask(200, 160);
    images[2].objects[0].mask(3, 3) = 1;
    CHECK_THROWS_WITH(train(), Catch::Contains("picture 2: mask: expected at least 2 figure pixels, got 1"));
    images[2].objects[0].mask = {};
    CHECK_NOTHROW(train());  // the box is the mask
    images[2].objects[0].class_index = 7;
    CHECK_THROWS_WITH(train(), Catch::Contains("picture 2: class of an object"));
    images[2].objects.clear();
    CHECK_NOTHROW(train());  // background
    for (auto& image : images) std::erase_if(image.objects, [](const auto& o) { return o.class_index == 1; });
    CHECK_THROWS_WITH(train(), Catch::Contains("objects of class second"));
    images = training_set();
    for (std::size_t i : {0u, 2u, 4u}) images[i].frame.gray = ism::GrayImage(200, 160, 0.5f);
    CHECK_THROWS_WITH(train(), Catch::Contains("features on objects of class first"));
}

TEST_CASE("small training objects are enlarged, as the data asks") {
    CHECK(trained<ism::RootSift>().extractor.options.upsampling == Approx(150.0 / 80));
}
