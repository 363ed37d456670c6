// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/train/add_classes.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/detect/detect.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/train.hpp"

namespace {

using Model = ism::Model<ism::HessianLaplace, ism::GrayPatch>;
using Harvest = ism::Harvest<ism::HessianLaplace, ism::GrayPatch>;

/// A feature of a harvest whose descriptor is all zero but for its first number.
void see(Harvest& harvest, std::uint32_t class_index, std::uint32_t object, std::uint8_t value) {
    ism::Occurrence o;
    o.class_index = class_index, o.object = object;
    o.feature = std::uint32_t(harvest.seen.size());
    o.x = float(value);
    harvest.seen.push_back(o);
    std::array<std::uint8_t, ism::GrayPatch::dimension> row{};
    row[0] = value;
    harvest.descriptors.push_back(row);
}

/// One object of each class.
Harvest harvest_of(const std::vector<std::string>& names) {
    Harvest harvest;
    harvest.class_names = names;
    for (std::uint32_t c = 0; c < names.size(); ++c) {
        ism::TrainingObject object;
        object.class_index = c;
        object.image = names[c];
        harvest.objects.push_back(object);
    }
    return harvest;
}

/// Descriptors no further apart than `distance` are alike.
ism::TrainOptions alike(double distance) {
    return {.min_similarity = 1 - distance * distance / (2 * ism::GrayPatch::sq_length), .threads = 1};
}

/// Words at 10 and 100, each of two features of class a; nothing at 200.
Model two_words() {
    Harvest harvest = harvest_of({"a"});
    for (const std::uint8_t value : {9, 11, 99, 101, 200}) see(harvest, 0, 0, value);
    return ism::learn(harvest, alike(6));
}

/// Three blobs of random descriptors for each of some classes, from `first` on.
Harvest random_harvest(std::vector<std::string> names, std::uint64_t seed) {
    ism::Random random(seed);
    Harvest harvest = harvest_of(names);
    for (int i = 0; i < 240; ++i) {
        const auto c = std::uint32_t(random.index(names.size()));
        see(harvest, c, c, 0);
        const double centre = 40 + 30 * double(random.index(6));
        for (auto& value : harvest.descriptors.row(harvest.seen.size() - 1))
            value = std::uint8_t(std::lround(centre + 8 * random.uniform(-1, 1)));
    }
    return harvest;
}

/// A square of 80 px with the blobs of a pattern, on grey.
ism::TrainingImage picture(std::uint64_t pattern, int left, int top) {
    ism::Random random(pattern);
    ism::TrainingImage image;
    image.frame.gray = ism::GrayImage(180, 130, 0.5f);
    for (int blob = 0; blob < 40; ++blob) {
        const double x = left + random.uniform(8, 72), y = top + random.uniform(8, 72);
        const double sigma = random.uniform(1.5, 5), height = random.uniform() < 0.5 ? -0.4 : 0.4;
        for (int v = 0; v < 130; ++v)
            for (int u = 0; u < 180; ++u)
                image.frame.gray(u, v) += float(
                    height * std::exp(-(std::pow(u - x, 2) + std::pow(v - y, 2)) / (2 * sigma * sigma)));
    }
    image.objects.push_back({0, {double(left), double(top), 80, 80}, {}});
    return image;
}

}  // namespace

TEST_CASE("a model takes a new class in, by hand") {
    const Model before = two_words();
    REQUIRE(before.codebook.sizes == std::vector<std::uint32_t>{2, 2});
    REQUIRE(before.shapes.occurrences.size() == 4);
    // Class b has two features at word 1, a pair that makes a word, and one like nothing else.
    Harvest added = harvest_of({"b"});
    for (const std::uint8_t value : {98, 102, 150, 151, 240}) see(added, 0, 0, value);
    const auto [model, word_now, class_now] = ism::grow_model(before, added);

    CHECK(word_now == std::vector<std::uint32_t>{0, 1});
    CHECK(class_now == std::vector<std::uint32_t>{1});
    CHECK(model.codebook.sizes == std::vector<std::uint32_t>{2, 4, 2});
    CHECK(model.codebook.words.row(1)[0] == 100);
    CHECK(model.shapes.class_names == std::vector<std::string>{"a", "b"});
    REQUIRE(model.shapes.objects.size() == 2);
    CHECK(model.shapes.objects[1].class_index == 1);
    CHECK(model.shapes.objects[1].image == "b");
    CHECK(model.shapes.first == std::vector<std::uint32_t>{0, 2, 6, 8});
    const auto of_1 = model.shapes.of_word(1);
    CHECK((of_1[0].x == 99 && of_1[0].class_index == 0 && of_1[0].object == 0));
    CHECK((of_1[2].x == 98 && of_1[2].class_index == 1 && of_1[2].object == 1));
    // Each class has four features, so all weigh alike.
    for (const ism::Occurrence& o : of_1) CHECK(o.weight == Approx(0.25));
    for (const ism::Occurrence& o : model.shapes.of_word(2)) CHECK(o.weight == Approx(0.5));
    // Numbers of features are not taken twice.
    std::vector<std::uint32_t> features;
    for (const ism::Occurrence& o : model.shapes.occurrences) features.push_back(o.feature);
    std::sort(features.begin(), features.end());
    CHECK(std::adjacent_find(features.begin(), features.end()) == features.end());
}

TEST_CASE("examples of a class that the model has join it by name") {
    Harvest added = harvest_of({"c", "a"});
    see(added, 0, 0, 10), see(added, 1, 1, 100);
    const auto [model, word_now, class_now] = ism::grow_model(two_words(), added);
    CHECK(class_now == std::vector<std::uint32_t>{1, 0});
    CHECK(model.shapes.class_names == std::vector<std::string>{"a", "c"});
    CHECK(model.shapes.objects[2].class_index == 0);
    CHECK(model.shapes.of_word(1).back().class_index == 0);
    CHECK(model.shapes.of_word(1).back().object == 2);
    // c has one feature and a five, so that c's counts as much as all of a's: 1 : 1/5 : 1/5
    CHECK(model.shapes.of_word(0).back().class_index == 1);
    CHECK(model.shapes.of_word(0).back().weight == Approx(5.0 / 7));
}

TEST_CASE("a model with memory has at words that are new what looked like them before") {
    Harvest harvest = harvest_of({"a"});
    for (const std::uint8_t value : {9, 11, 14, 99, 101}) see(harvest, 0, 0, value);
    ism::TrainOptions options = alike(6);
    options.memory = true;
    const Model before = ism::learn(harvest, options);
    REQUIRE(before.codebook.size() == 2);
    CHECK(before.memory.size() == 5);
    Harvest added = harvest_of({"b"});
    for (const std::uint8_t value : {18, 19, 18}) see(added, 0, 0, value);
    const Model model = ism::grow_model(before, added).model;
    REQUIRE(model.codebook.size() == 3);
    CHECK(model.memory.size() == 8);
    // 14 is four or five from the new word, 11 more than six
    const auto of_new = model.shapes.of_word(2);
    REQUIRE(of_new.size() == 4);
    CHECK((of_new[0].x == 14 && of_new[0].class_index == 0 && of_new[0].object == 0));
    CHECK(of_new[1].class_index == 1);
    // ... and is at its old word still
    CHECK(model.shapes.of_word(0).size() == before.shapes.of_word(0).size());
    Model bad = before;
    bad.memory.resize(1);
    CHECK_THROWS_WITH(ism::grow_model(bad, added), Catch::Contains("below the 1 that are kept"));

    Model forgetful = before;
    forgetful.memory = {};
    CHECK(ism::grow_model(forgetful, added).model.shapes.of_word(2).size() == 3);
    CHECK(ism::grow_model(forgetful, added).model.memory.empty());
}

TEST_CASE("features like no word and too few for one change nothing but the lists of classes and objects") {
    const Model before = two_words();
    Harvest added = harvest_of({"b"});
    see(added, 0, 0, 240);
    const Model model = ism::grow_model(before, added).model;
    CHECK(model.codebook.mean_sq_length == before.codebook.mean_sq_length);
    CHECK(model.shapes.first == before.shapes.first);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(model.shapes.occurrences[i].x == before.shapes.occurrences[i].x);
        CHECK(model.shapes.occurrences[i].feature == before.shapes.occurrences[i].feature);
        CHECK(model.shapes.occurrences[i].weight == before.shapes.occurrences[i].weight);
    }
    CHECK(model.shapes.class_names.size() == 2);
}

TEST_CASE("a feature at two words that become one is there once") {
    ism::Shapes shapes;
    shapes.class_names = {"a"};
    const auto at = [](std::uint32_t word, std::uint32_t feature, float x) {
        ism::Occurrence o;
        o.feature = feature, o.x = x;
        return ism::detail::WordOccurrence{word, o};
    };
    ism::detail::set_occurrences(shapes, {at(0, 0, 1), at(0, 1, 2), at(0, 1, 3), at(2, 0, 4), at(0, 7, 5)},
                                 3);
    CHECK(shapes.first == std::vector<std::uint32_t>{0, 3, 3, 4});
    CHECK(shapes.occurrences[1].x == 2);
    CHECK(shapes.occurrences[2].x == 5);
    CHECK(shapes.occurrences[3].x == 4);
}

TEST_CASE("models of many features grow the same with 1 and 2 threads, and again and again") {
    Model model = ism::learn(random_harvest({"a", "b"}, 1), alike(250));
    for (const char* name : {"c", "a", "d"}) {
        const Harvest added = random_harvest({name, "e"}, std::uint64_t(name[0]));
        const auto one = ism::grow_model(model, added, {.threads = 1}).model;
        const auto two = ism::grow_model(model, added, {.threads = 2}).model;
        CHECK(one.codebook.mean_sq_length == two.codebook.mean_sq_length);
        CHECK(one.codebook.sizes == two.codebook.sizes);
        CHECK(one.shapes.first == two.shapes.first);
        REQUIRE(one.shapes.occurrences.size() == two.shapes.occurrences.size());
        for (std::size_t i = 0; i < one.shapes.occurrences.size(); ++i)
            CHECK(one.shapes.occurrences[i].weight == two.shapes.occurrences[i].weight);
        CHECK(one.codebook.size() >= model.codebook.size());
        for (std::size_t w = 0; w < one.codebook.size(); ++w) {
            double sum = 0;
            for (const ism::Occurrence& o : one.shapes.of_word(w)) sum += double(o.weight);
            if (!one.shapes.of_word(w).empty()) CHECK(sum == Approx(1));
        }
        model = one;
    }
    CHECK(model.shapes.class_names == std::vector<std::string>{"a", "b", "c", "e", "d"});
    CHECK(model.shapes.objects.size() == 8);
    const auto part = ism::grow_model(model, random_harvest({"f"}, 3), {.max_cluster_features = 100}).model;
    CHECK(part.codebook.size() >= model.codebook.size());
}

TEST_CASE("images of a new class are learnt and found, the same with 1 and 2 threads") {
    using Sift = ism::Model<ism::HessianLaplace, ism::RootSift>;
    const auto images_of = [](std::uint64_t pattern) {
        std::vector<ism::TrainingImage> images;
        for (int i = 0; i < 3; ++i) images.push_back(picture(pattern, 30 + 9 * i, 20 + 5 * i));
        return images;
    };
    const std::vector<std::string> first = {"first"}, second = {"second"};
    const auto before = ism::train<ism::HessianLaplace, ism::RootSift>(
        first, images_of(1), {.memory = true, .appearance = true, .threads = 1});
    const Sift model = ism::add_classes(before, second, images_of(2), {.threads = 1});
    CHECK(model.shapes.class_names == std::vector<std::string>{"first", "second"});
    REQUIRE(model.shapes.appearance.classes() == 2);
    CHECK(model.shapes.appearance.bias[0] == before.shapes.appearance.bias[0]);
    CHECK(model.extractor.options.upsampling == before.extractor.options.upsampling);
    for (const std::uint64_t pattern : {1, 2}) {
        const auto found = ism::detect<ism::Jism>(model, picture(pattern, 50, 24).frame, {.threads = 1});
        REQUIRE_FALSE(found.objects.empty());
        CHECK(found.objects[0].class_index == pattern - 1);
    }
    const Sift two = ism::add_classes(before, second, images_of(2), {.threads = 2});
    CHECK(two.shapes.appearance.weights == model.shapes.appearance.weights);
    CHECK(two.codebook.sizes == model.codebook.sizes);
    CHECK(two.shapes.first == model.shapes.first);
    // More examples of a class leave its judge as it is.
    const Sift more = ism::add_classes(model, first, images_of(1));
    CHECK(more.shapes.appearance.bias == model.shapes.appearance.bias);
    CHECK(ism::add_classes(before, second, images_of(2), {.appearance = false}).shapes.appearance.empty());
    std::vector<ism::TrainingImage> none = images_of(2);
    for (auto& image : none) image.objects.clear();
    CHECK_THROWS_AS(ism::add_classes(before, second, none), ism::Error);
}

TEST_CASE("what cannot be added is refused") {
    const Model model = two_words();
    CHECK_THROWS_WITH(ism::grow_model(model, Harvest{}), Catch::Contains("new objects and features"));
    Harvest added = harvest_of({"b"});
    see(added, 0, 0, 100);
    CHECK_THROWS_AS(ism::grow_model(model, added, {.min_cluster_size = 0}), ism::Error);
    CHECK_THROWS_AS(ism::grow_model(model, added, {.max_cluster_features = 1}), ism::Error);
    Harvest bad = added;
    bad.extractor.options.upsampling = 2;
    CHECK_THROWS_WITH(ism::grow_model(model, bad), Catch::Contains("upsampling of the new images"));
    bad = added;
    bad.seen[0].class_index = 1;
    CHECK_THROWS_WITH(ism::grow_model(model, bad), Catch::Contains("class of a feature"));
    bad = added;
    bad.seen[0].object = 1;
    CHECK_THROWS_WITH(ism::grow_model(model, bad), Catch::Contains("object of a feature"));
    bad = added;
    bad.descriptors = {};
    CHECK_THROWS_WITH(ism::grow_model(model, bad), Catch::Contains("descriptors: expected 1, got 0"));
    Model own = model;
    own.codebook.group[1] = 1;
    CHECK_THROWS_WITH(ism::grow_model(own, added), Catch::Contains("expected a joint one"));
}
