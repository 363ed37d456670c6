// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
//
// Training features: what is taken from images, joined, kept and learnt from again, on small drawn pictures
// (synthetic).
#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"
#include "support/pictures.hpp"

#include "ism/detect/detect.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/train/append_training_features.hpp"
#include "ism/train/train.hpp"
#include "ism/train/training_boxes.hpp"

using ism::test::pattern_picture;
using ism::test::TemporaryFolder;

namespace {

const std::vector<ism::AnyExtractor> extractors{ism::Extractor<ism::HessianLaplace, ism::RootSift>{}};
const std::vector<std::string> class_names{"first", "second", "third"};

/// Three pictures of a class, labelled as class 0 or as its own of `class_names`.
std::vector<ism::TrainingImage> pictures_of(std::uint32_t pattern, bool own_class = false) {
    std::vector<ism::TrainingImage> images;
    for (int i = 0; i < 3; ++i) {
        images.push_back(pattern_picture(pattern, 30 + 9 * i, 20 + 5 * i, std::uint64_t(i)));
        images.back().objects[0].class_index = own_class ? pattern : 0;
    }
    return images;
}

ism::TrainingFeatures features_of(std::span<const std::string> classes,
                                  const std::vector<ism::TrainingImage>& images, unsigned threads = 0) {
    return ism::extract_training_features(classes, ism::training_set(images), extractors,
                                          {.choose_upsampling = false}, threads);
}

bool same_model(const ism::Model& a, const ism::Model& b) {
    const TemporaryFolder folder;
    ism::save_model(folder / "a", a);
    ism::save_model(folder / "b", b);
    return ism::read_bytes(folder / "a") == ism::read_bytes(folder / "b");
}

}  // namespace

TEST_CASE("training asks for each image once, and for labels before") {
    const auto images = pictures_of(0);
    ism::TrainingSet set = ism::training_set(images);
    std::atomic<int> image_calls = 0;
    const auto inner = set.image;
    set.image = [&](std::size_t i) {
        ++image_calls;
        return inner(i);
    };
    const auto model = ism::train<ism::HessianLaplace, ism::RootSift>(std::span(class_names).first(1), set);
    CHECK(image_calls == 3);
    CHECK_FALSE(model.box_classifier.empty());
    CHECK_FALSE(model.calibration.empty());
    CHECK(model.training.images == 3);
    CHECK(model.training.features_used == model.training.features_found);
}

TEST_CASE("mirrored images are seen for the words alone, where neither colours nor depth are kept") {
    const auto images = pictures_of(0);
    const auto views = [&](const ism::TrainingFeatureOptions& options) {
        return ism::extract_training_features(std::span(class_names).first(1), ism::training_set(images),
                                              extractors, options)
            .views;
    };
    const auto by_words = views({});
    REQUIRE(by_words.size() == 6);
    for (std::size_t v = 0; v < by_words.size(); ++v) CHECK(by_words[v].mirrored == (v % 2 == 1));
    CHECK(views({.pixels = true}).size() == 3);
    CHECK(views({.depth = true}).size() == 3);
    CHECK(views({.views = false}).empty());
}

TEST_CASE("what lies where labels say to ignore it is neither an object nor background") {
    const ism::Box left{0, 0, 60, 160};
    CHECK(ism::is_ignored({0, 0, 10, 10}, {left}));
    CHECK(ism::is_ignored({55, 0, 10, 10}, {{}, left}));
    CHECK_FALSE(ism::is_ignored({56, 0, 10, 10}, {left}));
    CHECK_FALSE(ism::is_ignored({0, 0, 10, 10}, {}));

    // The last picture shows the pattern, but nobody labelled it.
    auto images = pictures_of(0);
    images.push_back(pattern_picture(0, 100, 40, 7));
    images[3].objects.clear();
    const auto learnt = [&] { return features_of(std::span(class_names).first(1), images); };
    const auto count = [](const ism::TrainingView& view, double left_of) {
        return std::ranges::count_if(view.channels[0].features,
                                     [&](const ism::Feature& f) { return f.x + 0.5 < left_of; });
    };
    const auto wrong = [&](const ism::TrainingFeatures& all) {
        const auto boxes = ism::training_boxes(ism::learn(all), all, 300);
        return std::ranges::count_if(boxes, [](const ism::TrainingBox& box) {
            return box.view >= 6 && box.is_hypothesis() && box.overlap < 0.5;
        });
    };
    const auto seen = learnt();
    REQUIRE(seen.views.size() == 8);  // each image and its mirror image
    CHECK(count(seen.views[6], 190) > 0);
    CHECK(wrong(seen) > 0);

    images[3].ignored = {{0, 0, 190, 160}};
    const auto half = learnt();
    CHECK(half.views[6].ignored == images[3].ignored);
    CHECK(half.views[7].ignored == std::vector{ism::Box{10, 0, 190, 160}});
    CHECK(half.views[0].ignored.empty());
    CHECK(count(half.views[6], 190) == 0);
    CHECK(count(half.views[6], 200) == count(seen.views[6], 200) - count(seen.views[6], 190));
    CHECK(half.views[6].channels[0].features.size() == half.views[6].channels[0].descriptors.size());
    CHECK(wrong(half) == 0);

    // Of objects that lie there all features are learnt.
    images[0].ignored = {{0, 0, 200, 160}};
    CHECK(learnt().feature_count() == seen.feature_count());
    CHECK(count(learnt().views[0], 200) > 0);

    images[1].ignored = {{500, 0, 10, 10}};
    CHECK_THROWS_WITH(ism::check(images[1], 1), Catch::Contains("a part in the image of 200x160"));
}

TEST_CASE("the limit of features leaves the strongest of each object, and the summary tells of it") {
    const auto images = pictures_of(0);
    const auto all = features_of(std::span(class_names).first(1), images);
    const auto few =
        ism::extract_training_features(std::span(class_names).first(1), ism::training_set(images), extractors,
                                       {.max_features = 1, .choose_upsampling = false});
    CHECK(all.summary.features_used == all.feature_count());
    CHECK(all.summary.features_found == all.feature_count());
    REQUIRE(all.feature_count() > 3 * 30);
    CHECK(few.feature_count() == 3 * 30);  // an object keeps 30 at least
    CHECK(few.summary.features_used == 3 * 30);
    CHECK(few.summary.features_found == all.feature_count());
}

TEST_CASE("the same training features and model for any number of threads") {
    const auto images = pictures_of(1);
    const auto one = features_of(std::span(class_names).first(1), images, 1),
               two = features_of(std::span(class_names).first(1), images, 2);
    CHECK(one.samples[0].descriptors == two.samples[0].descriptors);
    CHECK(same_model(ism::learn(one, {.threads = 1}), ism::learn(two, {.threads = 2})));
}

TEST_CASE("classes learnt one after another give the model of all at once") {
    std::vector<ism::TrainingImage> all;
    ism::TrainingFeatures joined;
    for (const std::uint32_t pattern : {0u, 1u, 2u}) {
        const auto own = pictures_of(pattern, true);
        all.insert(all.end(), own.begin(), own.end());
        const auto features = features_of(std::span(class_names).subspan(pattern, 1), pictures_of(pattern));
        joined = pattern == 0 ? features : ism::append(std::move(joined), features);
    }
    const auto at_once = features_of(class_names, all);
    CHECK(joined.class_names == class_names);
    CHECK(joined.summary == at_once.summary);
    CHECK(same_model(ism::learn(joined), ism::learn(at_once)));
}

TEST_CASE("more examples of a class that is known join it by name") {
    const std::vector<std::string> first{"a", "b"}, more{"c", "b"};
    std::vector<ism::TrainingImage> images = pictures_of(0), others = pictures_of(2);
    images[1].objects[0].class_index = 1;
    others[1].objects[0].class_index = 1;
    const auto joined = ism::append(features_of(first, images), features_of(more, others));
    CHECK(joined.class_names == std::vector<std::string>{"a", "b", "c"});
    REQUIRE(joined.objects.size() == 6);
    CHECK(joined.objects[3].class_index == 2);
    CHECK(joined.objects[4].class_index == 1);
    for (const ism::Occurrence& o : joined.samples[0].occurrences)
        CHECK(o.class_index == joined.objects[o.object].class_index);
    for (std::size_t i = 0; i < joined.feature_count(); ++i)
        CHECK(joined.samples[0].occurrences[i].feature == i);
    REQUIRE(joined.views.size() == 12);
    CHECK(joined.views[8].labels[0].class_index == 1);
    CHECK(joined.views[8].first_object == 4);
    CHECK(joined.views[9].mirrored);
}

TEST_CASE("what one picture shows by later labels is no background of it before") {
    const auto with_label = [](const ism::Box& box, std::uint8_t shade) {
        ism::TrainingFeatures features;
        features.class_names = {"a"};
        features.views.resize(1);
        features.views[0].labels = {{.class_index = 0, .box = box}};
        features.views[0].pixels = ism::RgbImage(20, 20, {shade, 0, 0});
        return features;
    };
    const ism::Box left{0, 0, 8, 8}, right{10, 0, 8, 8};
    const auto joined = ism::append(with_label(left, 1), with_label(right, 1));
    REQUIRE(joined.views.size() == 2);
    CHECK(joined.views[0].ignored == std::vector<ism::Box>{right});
    CHECK(joined.views[1].ignored == std::vector<ism::Box>{left});
    const ism::Box below{0, 10, 8, 8};
    const auto thrice = ism::append(joined, with_label(below, 1));
    CHECK(thrice.views[1].ignored == std::vector<ism::Box>{left, below});
    CHECK(thrice.views[2].ignored == std::vector<ism::Box>{left, right});
    const auto others = ism::append(with_label(left, 1), with_label(right, 2));
    CHECK(others.views[0].ignored.empty());
    CHECK(others.views[1].ignored.empty());
}

TEST_CASE("category ids of classes that are joined stay, and a new class never gets one that is taken") {
    ism::TrainingFeatures first, more;
    first.class_names = {"a", "b"}, first.category_ids = {5, 2};
    more.class_names = {"c", "b", "d"}, more.category_ids = {5, 9, 8};
    const auto joined = ism::append(first, more);
    CHECK(joined.class_names == std::vector<std::string>{"a", "b", "c", "d"});
    CHECK(joined.category_ids == std::vector<std::int64_t>{5, 2, 6, 8});
    more.category_ids.clear();
    CHECK(ism::append(first, more).category_ids.empty());
}

TEST_CASE("training features that were found in another way cannot be joined") {
    const auto own = features_of(std::span(class_names).first(1), pictures_of(0));
    ism::TrainingFeatures other = own;
    other.settings[0].options.upsampling = 2;
    CHECK_THROWS_WITH(ism::append(own, other), Catch::Contains("upsampling: expected 1, got 2"));
    other = own;
    other.settings[0].options.oriented = true;
    CHECK_THROWS_WITH(ism::append(own, other), Catch::Contains("oriented: expected 0, got 1"));
    other = own;
    other.settings[0].descriptor = "sift";
    CHECK_THROWS_WITH(ism::append(own, other),
                      Catch::Contains("expected hessian-laplace, root-sift, got hessian-laplace, sift"));
    other.settings.clear();
    CHECK_THROWS_WITH(ism::append(own, other), Catch::Contains("channels: expected 1, got 0"));
    CHECK_THROWS_WITH(ism::learn(ism::TrainingFeatures{}), Catch::Contains("objects and features"));
}

TEST_CASE("training features are kept beside a model and learnt from again") {
    const TemporaryFolder folder;
    auto images = pictures_of(0);
    images[2].ignored = {{0, 0, 20.5, 30}, {150, 100, 40, 40}};
    const auto features = features_of(std::span(class_names).first(1), images);
    const ism::Model model = ism::learn(features);
    ism::save_model(folder / "with", model, &features);
    ism::save_model(folder / "without", model);
    CHECK(std::filesystem::file_size(folder / "with") > 2 * std::filesystem::file_size(folder / "without"));
    CHECK(same_model(ism::load_model(folder / "with"), model));
    const ism::TrainingFeatures none;
    CHECK_THROWS_AS(ism::save_model(folder / "other", model, &none), ism::FileError);
    CHECK_FALSE(std::filesystem::exists(folder / "other"));
    CHECK_THROWS_WITH(ism::load_training_features(folder / "without"),
                      Catch::Contains("expected a model with training features"));

    const ism::TrainingFeatures read = ism::load_training_features(folder / "with");
    CHECK(read.class_names == features.class_names);
    CHECK(read.summary == features.summary);
    CHECK(read.samples[0].descriptors == features.samples[0].descriptors);
    REQUIRE(read.views.size() == features.views.size());
    for (std::size_t v = 0; v < read.views.size(); ++v) {
        const auto &a = read.views[v], &b = features.views[v];
        CHECK((a.width == b.width && a.height == b.height && a.mirrored == b.mirrored));
        CHECK((a.first_object == b.first_object && a.end_object == b.end_object));
        CHECK(a.ignored == b.ignored);
        CHECK(a.ignored.size() == (v < 4 ? 0 : 2));
        REQUIRE(a.labels.size() == b.labels.size());
        CHECK(a.labels[0].box == b.labels[0].box);
        CHECK((a.labels[0].masked && b.labels[0].masked));
        REQUIRE(a.channels[0].features.size() == b.channels[0].features.size());
        const auto now = a.channels[0].descriptors.values(), before = b.channels[0].descriptors.values();
        for (std::size_t i = 0; i < now.size(); ++i) REQUIRE(std::abs(now[i] - before[i]) < 1.0f / 255);
    }
    // Words and occurrences are the same; what judges boxes saw descriptors in bytes.
    const ism::Model again = ism::learn(read);
    CHECK(again.channels[0].codebook.means() == model.channels[0].codebook.means());
    CHECK(again.shapes.occurrences.values().size() == model.shapes.occurrences.values().size());
    CHECK(again.box_classifier.classes() == 1);
    // … and other options need no images.
    CHECK(ism::learn(read, {.selection = {.max_words = 5}}).words() == 5);
    CHECK(ism::learn(read, {.box_classifier = {}, .calibrate = false}).box_classifier.empty());
}

TEST_CASE("training images are searched in the vote space that is asked for") {
    const auto of_one = features_of(std::span(class_names).first(1), pictures_of(0));
    CHECK(same_model(ism::learn<ism::Ism>(of_one), ism::learn(of_one)));  // one class, the same votes

    std::vector<ism::TrainingImage> images = pictures_of(0, true);
    const auto more = pictures_of(1, true);
    images.insert(images.end(), more.begin(), more.end());
    const auto of_two = features_of(std::span(class_names).first(2), images);
    const ism::Model pooled = ism::learn<ism::Ism>(of_two), by_class = ism::learn<ism::Jism>(of_two);
    CHECK(pooled.channels[0].codebook.means() == by_class.channels[0].codebook.means());
    CHECK(pooled.calibration.curves != by_class.calibration.curves);
}

TEST_CASE("a codebook of words a class matches own features alone") {
    std::vector<ism::TrainingImage> images = pictures_of(0, true);
    const auto more = pictures_of(1, true);
    images.insert(images.end(), more.begin(), more.end());
    const ism::Model model = ism::learn(features_of(std::span(class_names).first(2), images),
                                        {.codebook = {.kind = ism::CodebookKind::per_class}});
    const ism::Codebook& words = model.channels[0].codebook;
    CHECK(words[0].group == 0);
    CHECK(words[words.size() - 1].group == 1);
    for (std::size_t w = 0; w < words.size(); ++w)
        for (const ism::Occurrence& o : model.shapes.occurrences[w]) REQUIRE(o.class_index == words[w].group);
}

TEST_CASE("wrong training options are refused by name") {
    const auto features = features_of(std::span(class_names).first(1), pictures_of(0));
    const auto refuses = [&](const ism::TrainOptions& options, const char* what) {
        CHECK_THROWS_WITH(ism::learn(features, options), Catch::Contains(what));
    };
    for (const double bad : {-1.0, 1.5, std::nan("")})
        refuses({.codebook = {.min_similarity = bad}}, "CodebookOptions::min_similarity");
    refuses({.codebook = {.min_cluster_size = 0}}, "CodebookOptions::min_cluster_size");
    refuses({.codebook = {.max_features = 1}}, "CodebookOptions::max_features");
    for (const double bad : {-1.0, std::nan("")}) {
        refuses({.selection = {.min_information_gain = bad}}, "WordSelection::min_information_gain");
        refuses({.box_classifier = ism::BoxClassifierOptions{.regularisation = bad}}, "regularisation");
        refuses({.box_classifier = ism::BoxClassifierOptions{.tolerance = bad}}, "tolerance");
        refuses({.box_classifier = ism::BoxClassifierOptions{.same_iou = bad}}, "same_iou");
        refuses({.box_classifier = ism::BoxClassifierOptions{.other_iou = bad}}, "other_iou");
    }
    refuses({.box_classifier = ism::BoxClassifierOptions{.max_rounds = -1}}, "max_rounds");
    refuses({.features = {.max_features = 0}}, "TrainingFeatureOptions::max_features");
    ism::TrainOptions enough;
    enough.selection.min_information_gain = 100;
    refuses(enough, "least information gain");
}
