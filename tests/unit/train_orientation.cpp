// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/pictures.hpp"

#include "ism/core/random.hpp"
#include "ism/detect/detect.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/orientation.hpp"
#include "ism/train/train.hpp"

using ism::test::pattern_picture;

namespace {

const std::vector<std::string> figure_names{"first", "second"};

/// Objects of which each shows the same 20 features of its class, turned by an angle (made up).
ism::TrainingFeatures objects_turned_by(const std::vector<double>& angles) {
    ism::TrainingFeatures features;
    features.samples.push_back({{}, ism::Descriptors<float>(8)});
    for (std::uint32_t object = 0; object < angles.size(); ++object)
        for (const std::uint32_t class_index : {0u, 1u}) {
            ism::Random random(class_index);
            for (int i = 0; i < 20; ++i) {
                const double where = random.uniform(0, 6), away = random.uniform(85, 95);
                std::vector<float> descriptor(8);
                for (float& value : descriptor) value = float(random.normal());
                ism::Occurrence o;
                o.x = float(away * std::cos(where + angles[object]));
                o.y = float(away * std::sin(where + angles[object]));
                o.scale = 3;
                o.angle = float(random.uniform(0, 6) + angles[object]);
                o.class_index = class_index, o.object = 2 * object + class_index;
                features.samples[0].occurrences.push_back(o);
                features.samples[0].descriptors.push_back(descriptor);
            }
        }
    return features;
}

}  // namespace

TEST_CASE("features that objects share tell whether the objects are turned") {
    std::vector<double> little, around;
    for (int i = 0; i < 11; ++i) little.push_back(0.02 * i), around.push_back(2 * std::numbers::pi / 11 * i);
    const auto upright = ism::shared_features(objects_turned_by(little));
    CHECK(upright.count == 2 * 11 * 10 * 20);  // each with those of the ten other objects
    CHECK(upright.upright == upright.count);
    CHECK(upright.one_side_up());
    const auto turned = ism::shared_features(objects_turned_by(around));
    CHECK(turned.count == upright.count);
    CHECK(turned.upright == 0);  // the next is turned by 33°
    CHECK_FALSE(turned.one_side_up());

    // What is elsewhere, of another size or near the centre tells nothing; nor does a single object.
    const auto changed = [&](const auto& change) {
        ism::TrainingFeatures features = objects_turned_by(little);
        for (ism::Occurrence& o : features.samples[0].occurrences) change(o);
        return ism::shared_features(features, 2).count;
    };
    const std::size_t without_first = 2 * 10 * 9 * 20;
    CHECK(changed([](ism::Occurrence&) {}) == upright.count);
    CHECK(changed([](ism::Occurrence& o) { o.x += o.object < 2 ? 60.0f : 0.0f; }) == without_first);
    CHECK(changed([](ism::Occurrence& o) { o.scale *= o.object < 2 ? 1.6f : 1.0f; }) == without_first);
    CHECK(changed([](ism::Occurrence& o) { o.x /= 3, o.y /= 3; }) == 0);
    CHECK(ism::shared_features(objects_turned_by({1})).count == 0);
    CHECK(ism::shared_features(objects_turned_by({1})).one_side_up());
    CHECK_FALSE(ism::shared_features(objects_turned_by({1})).conclusive());
}

TEST_CASE("objects that are turned at random are found however they are turned") {
    const auto pictures = [](double turn) {
        std::vector<ism::TrainingImage> images;
        for (std::uint64_t i = 0; i < 8; ++i)
            images.push_back(pattern_picture(std::uint32_t(i % 2), 50 + 2 * int(i), 45 - 2 * int(i), i, false,
                                             turn * double(i)));
        return images;
    };
    using Extractor = ism::Extractor<ism::HessianLaplace, ism::RootSift>;
    const auto upright = pictures(0), turned = pictures(1.7);
    CHECK(ism::shared_features(figure_names, ism::training_set(upright), {Extractor{}}).one_side_up());
    const auto shared = ism::shared_features(figure_names, ism::training_set(turned), {Extractor{}});
    CHECK(shared.count > 50);
    CHECK_FALSE(shared.one_side_up());

    // Nothing to be seen, nothing labelled: nothing is known, and upright is what most things are.
    auto blank = pictures(1.7);
    for (auto& image : blank) image.frame.gray = ism::GrayImage(200, 160, 0.5f);
    CHECK(ism::shared_features(figure_names, ism::training_set(blank), {Extractor{}}).one_side_up());
    for (auto& image : blank) image.objects.clear();
    CHECK(ism::shared_features(figure_names, ism::training_set(blank), {Extractor{}}).count == 0);

    Extractor oriented;
    oriented.options.oriented = true;
    const auto model = ism::train(figure_names, ism::training_set(turned), {}, oriented);
    for (const std::uint32_t class_index : {0u, 1u})
        for (const double angle : {0.4, 2.5, 4.0}) {
            CAPTURE(class_index, angle);
            const auto test = pattern_picture(class_index, 60, 40, 50 + class_index, false, angle);
            const auto found = ism::detect<ism::Jism>(model, test.frame);
            REQUIRE_FALSE(found.objects.empty());
            const ism::Detection& best = found.objects.front();
            CHECK(best.class_index == class_index);
            CHECK(ism::iou(best.box, test.objects[0].box) > 0.7);
            CHECK(ism::mask_iou(ism::whole_mask(best.segmentation, 200, 160), test.objects[0].mask) > 0.7);
        }
}
