// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/frame_colors.hpp"
#include "ism/core/random.hpp"
#include "ism/detect/exemplar_segmenter.hpp"
#include "ism/train/learn_exemplars.hpp"
#include "ism/train/masks_from_boxes.hpp"

namespace {

/// A drawn picture (synthetic) of 240 × 160 px with a rounded body on two legs that faces left or right,
/// striped, in two colours on a ground of a third, which differ from picture to picture.
ism::TrainingImage animal_picture(std::uint64_t seed, bool faces_left = true, int left = 60, int top = 40) {
    constexpr int width = 240, height = 160, w = 110, h = 80;
    ism::Random random(seed);
    const auto tint = [&] {
        return ism::Rgb{std::uint8_t(random.index(200)), std::uint8_t(random.index(200)),
                        std::uint8_t(random.index(200))};
    };
    const ism::Rgb ground{std::uint8_t(210 + random.index(30)), 225, std::uint8_t(200 + random.index(40))};
    const ism::Rgb coat = tint(), stripe = tint();
    ism::TrainingImage image{.frame = {.gray = {}, .color = ism::RgbImage(width, height)},
                             .name = std::to_string(seed)};
    ism::Mask mask(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int along = x - left, u = faces_left ? along : w - 1 - along, v = y - top;
            const bool inside = along >= 0 && along < w && v >= 0 && v < h;
            const bool head = u < 40 && v < 34, body = u >= 25 && v >= 22 && v < 55;
            const bool leg = v >= 50 && ((u >= 28 && u < 42) || (u >= 92));
            mask(x, y) = inside && (head || body || leg);
            const ism::Rgb c = mask(x, y) == 0 ? ground : (v / 9 + u / 40) % 3 == 0 ? stripe : coat;
            const auto with_noise = [&](int value) {
                return std::uint8_t(std::clamp(value + int(random.index(13)) - 6, 0, 255));
            };
            image.frame.color(x, y) = {with_noise(c.r), with_noise(c.g), with_noise(c.b)};
        }
    image.frame.gray = ism::to_gray(image.frame.color);
    image.objects.push_back({0, {double(left), double(top), w, h}, mask});
    return image;
}

/// What a box looks like by itself.
std::vector<ism::ExemplarView> view_of(const ism::TrainingImage& image) {
    const ism::Box& box = image.objects[0].box;
    return {{box, ism::describe_exemplar(image.frame.color, box)}};
}

/// What learn_exemplars() needs to know of images.
ism::TrainingFeatures features_of(const std::vector<ism::TrainingImage>& images, bool pixels = true) {
    ism::TrainingFeatures all{.class_names = {"animal", "thing"}};
    for (const ism::TrainingImage& image : images) {
        const int width = image.frame.gray.width(), height = image.frame.gray.height();
        ism::TrainingView view{.width = width, .height = height};
        view.first_object = std::uint32_t(all.objects.size());
        for (const ism::LabelledObject& object : image.objects) {
            view.labels.push_back(object.label());
            all.objects.push_back(
                ism::describe_object(object.label(), ism::object_mask(object, width, height), image.name));
        }
        view.end_object = std::uint32_t(all.objects.size());
        if (pixels) view.pixels = ism::FrameColors(image.frame).image();
        all.views.push_back(std::move(view));
    }
    return all;
}

/// A model that knows the objects alone.
ism::Model unlearnt(const ism::TrainingFeatures& features) {
    ism::Model model;
    model.shapes.class_names = features.class_names, model.shapes.objects = features.objects;
    return model;
}

ism::Model model_of(const ism::TrainingFeatures& features, std::size_t most = 300, unsigned threads = 1) {
    return ism::learn_exemplars(unlearnt(features), features, most, threads);
}

const ism::Model& animals() {
    static const ism::Model model = [] {
        std::vector<ism::TrainingImage> images;
        for (std::uint64_t seed = 1; seed <= 6; ++seed) images.push_back(animal_picture(seed));
        return model_of(features_of(images));
    }();
    return model;
}

ism::Segmentation cut_out(const ism::Model& model, const ism::Frame& frame, const ism::Box& box,
                          const ism::ExemplarSegmenter& segmenter = {}, std::uint32_t class_index = 0) {
    ism::ThreadPool pool(1);
    const ism::Scene scene{.frame = frame, .model = model, .pool = pool};
    ism::Detection hypothesis;
    hypothesis.class_index = class_index, hypothesis.box = box;
    return segmenter.segment(hypothesis, scene);
}

double iou_with_truth(const ism::Segmentation& part, const ism::TrainingImage& image) {
    const ism::Mask& truth = image.objects[0].mask;
    return ism::mask_iou(ism::whole_mask(part, truth.width(), truth.height()), truth);
}

}  // namespace

TEST_CASE("a box as a mask has the pixels whose middles lie in it") {
    ism::Random random(3);
    for (int k = 0; k < 200; ++k) {
        const double x = random.uniform(-6, 14), y = random.uniform(-6, 10);
        const ism::Box box = k % 2 == 0 ? ism::Box{x, y, random.uniform(0.1, 15), random.uniform(0.1, 12)}
                                        : ism::Box{std::round(x) + 0.5, std::round(y) - 0.5, 3, 4};
        const ism::Mask mask = ism::object_mask({.box = box}, 12, 9);
        for (int row = 0; row < 9; ++row)
            for (int column = 0; column < 12; ++column)
                CHECK((mask(column, row) != 0) ==
                      (column + 0.5 >= box.x && column + 0.5 <= box.x + box.width && row + 0.5 >= box.y &&
                       row + 0.5 <= box.y + box.height));
    }
}

TEST_CASE("an exemplar is what its box looks like, and its mirror image what a mirror shows") {
    const auto left = animal_picture(7, true, 65), right = animal_picture(7, false, 65);
    const auto cells = ism::describe_exemplar(left.frame.color, left.objects[0].box);
    REQUIRE(cells.size() == ism::exemplar_bytes);
    const auto mirrored = ism::mirrored_exemplar(cells);
    CHECK(ism::mirrored_exemplar(mirrored) == cells);
    const auto other = ism::describe_exemplar(ism::mirrored(left.frame.color), left.objects[0].box);
    double difference = 0, energy = 0, unmirrored = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        difference += std::abs(double(mirrored[i]) - other[i]);
        unmirrored += std::abs(double(cells[i]) - other[i]);
        energy += other[i];
    }
    CHECK(difference <
          0.1 * energy);  // the picture is mirrored to the pixel, its box with it: 65 + 110 + 65 = 240
    CHECK(unmirrored > 3 * difference);
}

TEST_CASE("the prior of a box is the mask of what looks like it, on either side") {
    ism::Model model = animals();
    for (const bool faces_left : {true, false}) {
        const auto image = animal_picture(3, faces_left);
        const ism::Box& box = image.objects[0].box;
        const std::vector<std::uint32_t> among{0, 1, 2, 3, 4, 5};
        const ism::ExemplarPrior lenders(model, among, view_of(image), {});
        const ism::GrayImage prior = lenders.prior();
        REQUIRE(prior.width() == ism::ExemplarPrior::side);
        CHECK(std::all_of(prior.pixels().begin(), prior.pixels().end(),
                          [](float p) { return p >= 0 && p <= 1.0001f; }));
        std::size_t right = 0, inside = 0;
        for (int y = 0; y < prior.height(); ++y)
            for (int x = 0; x < prior.width(); ++x) {
                const double cells_x = (x + 0.5) / ism::ExemplarPrior::samples - ism::ExemplarPrior::margin;
                const double cells_y = (y + 0.5) / ism::ExemplarPrior::samples - ism::ExemplarPrior::margin;
                const int px = int(box.x + cells_x / ism::exemplar_cells * box.width),
                          py = int(box.y + cells_y / ism::exemplar_cells * box.height);
                ++inside;
                right += (prior(x, y) > 0.5f) == (image.objects[0].mask(px, py) != 0);
            }
        CHECK(double(right) > 0.96 * double(inside));
    }
}

TEST_CASE("a box is compared in sizes and places around it, and follows the object where it was off") {
    const ism::Box box{100, 50, 80, 40};
    const auto boxes = ism::compared_boxes(box, {.size_step = 0.1, .place_step = 0.05});
    REQUIRE(boxes.size() == 7);
    CHECK(ism::iou(boxes[0], box) == 1);
    CHECK(ism::iou(boxes[1], {104, 52, 72, 36}) == Approx(1));
    CHECK(ism::iou(boxes[2], {96, 48, 88, 44}) == Approx(1));
    CHECK(ism::iou(boxes[3], {96, 48, 80, 40}) == Approx(1));
    CHECK(ism::iou(boxes[6], {104, 52, 80, 40}) == Approx(1));
    CHECK(ism::compared_boxes(box, {.size_step = 0, .place_step = 0}).size() == 1);

    const auto image = animal_picture(3);
    const ism::Box& truth = image.objects[0].box;
    const ism::Mask& mask = image.objects[0].mask;
    const auto right_samples = [&](const ism::Box& seen, const ism::ExemplarOptions& options) {
        const auto views =
            ism::describe_exemplar(image.frame.color, seen, ism::compared_boxes(seen, options));
        const std::vector<std::uint32_t> among{2};  // the same picture
        const ism::GrayImage prior = ism::ExemplarPrior(animals(), among, views, options).prior();
        std::size_t right = 0;
        for (int y = 0; y < prior.height(); ++y)
            for (int x = 0; x < prior.width(); ++x) {
                const auto px = [&](int at, double first, double length) {
                    const double cells =
                        (at + 0.5) / ism::ExemplarPrior::samples - ism::ExemplarPrior::margin;
                    return int(first + cells / ism::exemplar_cells * length);
                };
                right += (prior(x, y) > 0.5f) ==
                         (mask(px(x, seen.x, seen.width), px(y, seen.y, seen.height)) != 0);
            }
        return right;
    };
    const auto grown = [&](double by, double right, double down) {
        return ism::Box{truth.x + (right - by / 2) * truth.width, truth.y + (down - by / 2) * truth.height,
                        (1 + by) * truth.width, (1 + by) * truth.height};
    };
    for (const ism::Box& off :
         {grown(0, 0.03, 0.03), grown(0, -0.03, 0.03), grown(0.05, 0, 0), grown(-0.05, 0, 0)}) {
        CAPTURE(off.x, off.y, off.width, off.height);
        CHECK(right_samples(off, {}) > right_samples(off, {.size_step = 0, .place_step = 0}));
    }
}

TEST_CASE("a prior of exemplars that agree with the picture follows those of two kinds that fit") {
    // Two objects that look the same have different masks: only the picture can tell which is right.
    auto first = animal_picture(3), second = animal_picture(3);
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 240; ++x) second.objects[0].mask(x, y) = 0;
    const ism::Model model = model_of(features_of({first, second}));
    const std::vector<std::uint32_t> among{0, 1};
    const ism::ExemplarPrior lenders(model, among, view_of(first), {});
    const int middle = ism::ExemplarPrior::side / 2, above = middle - 2 * ism::ExemplarPrior::samples;
    CHECK(lenders.prior()(middle, above) == Approx(0.5).margin(0.1));
    const ism::ExemplarPrior own(model, std::vector<std::uint32_t>{0}, view_of(first), {});
    const ism::ExemplarPrior others(model, std::vector<std::uint32_t>{1}, view_of(first), {});
    CHECK(lenders.prior(own.prior())(middle, above) > 0.8);
    CHECK(lenders.prior(others.prior())(middle, above) < 0.2);
}

TEST_CASE("objects are cut out to the pixel by exemplars of other colours") {
    for (const std::uint64_t seed : {21, 24})
        for (const bool faces_left : {true, false}) {
            CAPTURE(seed, faces_left);
            const auto image = animal_picture(seed, faces_left, 70, 30);
            ism::Box box = image.objects[0].box;
            const auto exact = cut_out(animals(), image.frame, box);
            CHECK(iou_with_truth(exact, image) > 0.93);
            box = {box.x + 6, box.y - 4, box.width * 0.95, box.height * 1.06};
            CHECK(iou_with_truth(cut_out(animals(), image.frame, box), image) > 0.85);
            std::size_t wrong = 0;
            for (int y = 0; y < exact.mask.height(); ++y)
                for (int x = 0; x < exact.mask.width(); ++x) {
                    const float figure = exact.figure(x, y), ground = exact.ground(x, y);
                    wrong +=
                        std::abs(figure + ground - 1) > 1e-6f || (exact.mask(x, y) != 0) != (figure > ground);
                }
            CHECK(wrong == 0);
        }
}

TEST_CASE("the box of what was cut out is that of its mask, unless that is hardly where it was judged") {
    ism::Segmentation part;
    part.x = 7, part.y = 11, part.mask = ism::Mask(20, 10);
    const ism::Box judged{10, 12, 12, 4};
    CHECK(ism::cut_out_box(part, judged) == judged);  // no mask
    part.mask(4, 2) = part.mask(13, 5) = 1;
    CHECK(ism::cut_out_box(part, judged) == ism::Box{11, 13, 10, 4});
    const ism::Box elsewhere{18, 12, 12, 4};
    CHECK(ism::iou(elsewhere, ism::cut_out_box(part, judged)) < 0.3);
    CHECK(ism::cut_out_box(part, elsewhere) == elsewhere);
}

TEST_CASE("what was cut out says where an object lies whose box was off") {
    for (const std::uint64_t seed : {21, 24}) {
        CAPTURE(seed);
        const auto image = animal_picture(seed, true, 70, 30);
        const ism::Box truth = image.objects[0].box;
        for (const ism::Box& box : {ism::Box{truth.x + 10, truth.y - 6, truth.width, truth.height},
                                    {truth.x - 5, truth.y - 4, truth.width * 1.15, truth.height * 1.1},
                                    {truth.x + 8, truth.y + 6, truth.width * 0.85, truth.height * 0.9}}) {
            const auto part = cut_out(animals(), image.frame, box);
            REQUIRE(part.box.has_value());
            CHECK(ism::iou(*part.box, truth) > ism::iou(box, truth) + 0.05);
        }
        const auto exact = cut_out(animals(), image.frame, truth);
        REQUIRE(exact.box.has_value());
        CHECK(ism::iou(*exact.box, truth) > 0.93);
        ism::Model still = animals();  // as if masks of the class said nothing of where an object lies
        still.placings.resize(1);
        for (ism::Placing::Side& side : still.placings[0].sides) side.share = 0;
        const auto unmoved = cut_out(still, image.frame, truth);
        REQUIRE(unmoved.box.has_value());
        CHECK(ism::iou(*unmoved.box, truth) == Approx(1));
    }
}

TEST_CASE("the colours of a class are those of its figures, against those around them") {
    std::vector<ism::RgbImage> pictures;
    const ism::Rgb brown{130, 90, 50}, green{60, 140, 60}, white{250, 250, 250};
    for (const ism::Rgb ground : {green, white}) {  // a third of each figure is white
        ism::RgbImage picture(400, 300);
        for (int y = 0; y < 300; ++y)
            for (int x = 0; x < 400; ++x) {
                const bool figure = x >= 100 && x < 250 && y >= 100 && y < 180;
                picture(x, y) = !figure ? ground : x < 150 ? white : brown;
            }
        pictures.push_back(std::move(picture));
    }
    ism::Mask whole(30, 16), none(30, 16);
    for (std::uint8_t& share : whole.pixels()) share = 255;
    const ism::Box box{100, 100, 150, 80};
    const std::vector<ism::ColoredObject> objects{{pictures[0], box, &whole}, {pictures[1], box, &whole}};
    const ism::FigureColors colors = ism::learn_figure_colors(objects);
    REQUIRE(colors.size() == ism::figure_color_bins);
    const auto says = [&](ism::Rgb c) {
        const float rgb[] = {float(c.r), float(c.g), float(c.b)};
        return ism::figure_color_odds(colors, rgb).at(0);
    };
    CHECK(says(brown) == 3);
    CHECK(says(green) == -3);
    CHECK(says(white) == Approx(std::log((1 / 3.0) / 0.5)).margin(0.01));
    CHECK(says({20, 20, 200}) == 0);  // never seen
    CHECK(ism::figure_color_odds({}, std::vector<float>(6, 9)) == std::vector<float>(2, 0));
    CHECK(ism::learn_figure_colors({}).empty());
    const ism::ColoredObject without_figure{pictures[0], box, &none};
    CHECK(ism::learn_figure_colors(std::span(&without_figure, 1)).empty());
}

TEST_CASE("what has the colours of its class is cut out, and what has those around it is not") {
    ism::Model model = animals();
    REQUIRE(model.figure_colors.size() == 2);
    CHECK(model.figure_colors[0].size() == ism::figure_color_bins);
    CHECK(model.figure_colors[1].empty());
    const auto image = animal_picture(21);
    const auto sum_of_figure = [&](float said) {
        model.figure_colors[0].assign(ism::figure_color_bins, said);
        const auto part = cut_out(model, image.frame, image.objects[0].box);
        return std::accumulate(part.figure.pixels().begin(), part.figure.pixels().end(), 0.0);
    };
    const double unsaid = sum_of_figure(0);
    CHECK(sum_of_figure(3) > 1.001 * unsaid);
    CHECK(sum_of_figure(-3) < 0.999 * unsaid);
    model.figure_colors.clear();
    CHECK(iou_with_truth(cut_out(model, image.frame, image.objects[0].box), image) > 0.93);
}

TEST_CASE("masks lie within the picture, wherever the box is, and grey pictures have some too") {
    const auto image = animal_picture(31, true, 5, 70);
    ism::Frame gray = image.frame;
    gray.color = {};
    const auto check_mask = [](const ism::Frame& frame, const ism::Box& box) {
        CAPTURE(box.x, box.y, box.width, box.height);
        const auto part = cut_out(animals(), frame, box);
        CHECK(part.x >= 0);
        CHECK(part.y >= 0);
        CHECK(part.x + part.mask.width() <= 240);
        CHECK(part.y + part.mask.height() <= 160);
        CHECK(part.mask.width() >= 1);
        CHECK(part.mask.width() == part.figure.width());
        CHECK(part.mask.height() == part.ground.height());
        CHECK(std::all_of(part.figure.pixels().begin(), part.figure.pixels().end(),
                          [](float p) { return p >= 0 && p <= 1; }));
    };
    for (const ism::Box& box : {ism::Box{-40, -30, 110, 80},
                                {200, 120, 110, 80},
                                {5, 70, 110, 80},
                                {-500, 20, 30, 9},
                                {100, 900, 60, 40},
                                {10, 10, 1, 1},
                                {-300, -300, 900, 900},
                                {3.5, 4.25, 300, 2}})
        check_mask(image.frame, box);
    check_mask(gray, {-40, -30, 110, 80});
    CHECK(iou_with_truth(cut_out(animals(), gray, image.objects[0].box), image) > 0.8);
}

TEST_CASE("labels without masks are no exemplars, and their class is cut out by its votes") {
    auto animal = animal_picture(1), boxes = animal_picture(2), things = animal_picture(3);
    boxes.objects[0].mask = {};
    things.objects[0].class_index = 1, things.objects[0].mask = {};
    const auto features = features_of({boxes, animal, things});
    const ism::Model model = model_of(features);
    REQUIRE(model.exemplars.size() == 1);
    CHECK(model.exemplars[0].object == 1);
    ism::ThreadPool pool(1);
    const ism::Scene scene{.frame = things.frame, .model = model, .pool = pool};
    ism::Detection hypothesis;
    hypothesis.class_index = 1, hypothesis.box = things.objects[0].box;
    const auto by_votes = ism::PatchSegmenter{}.segment(hypothesis, scene);
    const auto got = ism::ExemplarSegmenter{}.segment(hypothesis, scene);
    CHECK(got.mask == by_votes.mask);
    CHECK(got.figure == by_votes.figure);
    CHECK_FALSE(got.box.has_value());
}

TEST_CASE("exemplars are the same for any number of threads, and of many every second or third is taken") {
    std::vector<ism::TrainingImage> images;
    for (std::uint64_t seed = 1; seed <= 7; ++seed) images.push_back(animal_picture(seed));
    const auto features = features_of(images);
    CHECK(model_of(features, 300, 1).exemplars == model_of(features, 300, 2).exemplars);
    const ism::Model few = model_of(features, 3);
    REQUIRE(few.exemplars.size() == 3);
    CHECK(few.exemplars[1].object == 3);
    CHECK(few.exemplars[2].object == 6);
}

TEST_CASE("what exemplars cannot be learnt or used with is refused by name") {
    const auto features = features_of({animal_picture(1)}, false);
    CHECK_THROWS_WITH(model_of(features),
                      "exemplars: training images with pixels: expected 1 or more, got 0");
    CHECK_THROWS_WITH(ism::learn_exemplars({}, features),
                      Catch::Contains("exemplars: objects of the model: expected 1, got 0"));
    CHECK_THROWS_WITH(model_of(features, 0), Catch::Contains("expected 1 or more"));
    ism::Model late = unlearnt(features);
    late.templates.resize(1);
    CHECK_THROWS_WITH(ism::learn_exemplars(late, features),
                      "exemplars: templates of the model: expected none before learn_exemplars(), got 1");
    using Segmenter = ism::ExemplarSegmenter;
    const auto error = [](const char* name, const Segmenter& options) {
        CHECK_THROWS_WITH(ism::check(options), Catch::Contains(name));
    };
    CHECK_NOTHROW(ism::check(Segmenter{}));
    error("ExemplarOptions::max_exemplars", {.exemplars = {.max_exemplars = 0}});
    error("ExemplarOptions::size_step", {.exemplars = {.size_step = 0.2}});
    error("ExemplarOptions::place_step", {.exemplars = {.place_step = 0.06}});
    error("ExemplarOptions::sharpness", {.exemplars = {.sharpness = -1}});
    error("ExemplarOptions::shift_cost", {.exemplars = {.shift_cost = 3}});
    error("ExemplarOptions::agreement", {.exemplars = {.agreement = std::nan("")}});
    error("ExemplarSegmenter::least_piece", {.least_piece = 2});
    error("ExemplarSegmenter::cuts", {.cuts = 0});
    error("ExemplarSegmenter::margin", {.margin = -1});
    error("ExemplarSegmenter::max_side_px", {.max_side_px = 2});
    error("ExemplarSegmenter::class_colors", {.class_colors = -1});
    error("ExemplarSegmenter::color_rounds", {.color_rounds = -1});
    error("ExemplarSegmenter::agreement_rounds", {.agreement_rounds = -1});
    error("ExemplarSegmenter::min_prior", {.min_prior = 0});
    error("ExemplarSegmenter::max_log_ratio", {.max_log_ratio = -1});
    error("ExemplarSegmenter::filter_radius", {.filter_radius = 2});
    error("ExemplarSegmenter::filter_epsilon", {.filter_epsilon = 0});
    error("PatchSegmenter::margin", {.votes = {.margin = -1}});
}

namespace {

/// IoU of the mask of a training object with the one that it was drawn with.
double iou_with_drawn(const ism::TrainingObject& object, const ism::TrainingImage& image) {
    const ism::Mask drawn = ism::describe_object(image.objects[0].label(), image.objects[0].mask, {}).mask;
    double both = 0, any = 0;
    for (std::size_t i = 0; i < drawn.pixels().size(); ++i) {
        const bool is = object.mask.pixels()[i] > 127, was = drawn.pixels()[i] > 127;
        both += is && was, any += is || was;
    }
    return both / any;
}

}  // namespace

TEST_CASE("objects that were labelled by boxes get masks from their colours and from each other") {
    std::vector<ism::TrainingImage> images, boxes;
    for (std::uint64_t seed = 21; seed <= 24; ++seed) images.push_back(animal_picture(seed, seed % 2 == 0));
    for (ism::TrainingImage image : images) {
        image.objects[0].mask = {};
        boxes.push_back(image);
    }
    boxes[3].objects[0].mask = images[3].objects[0].mask;  // one has a mask
    const ism::TrainingFeatures features = features_of(boxes);
    const ism::Model model = ism::masks_from_boxes(unlearnt(features), features, 1);
    for (std::size_t i = 0; i < images.size(); ++i) {
        CAPTURE(i);
        const ism::TrainingObject &own = model.shapes.objects[i], &labelled = features.objects[i];
        CHECK((own.mask == labelled.mask) == (i == 3));
        CHECK((own.reach == labelled.reach) == (i == 3));
        CHECK(iou_with_drawn(labelled, images[i]) < (i == 3 ? 1.01 : 0.6));
        CHECK(iou_with_drawn(own, images[i]) > 0.85);
    }
    CHECK(ism::learn_exemplars(model, features).exemplars.size() == images.size());
    CHECK(ism::learn_exemplars(unlearnt(features), features).exemplars.size() == 1);

    const ism::Model again = ism::masks_from_boxes(unlearnt(features), features, 3);
    for (std::size_t i = 0; i < images.size(); ++i)
        CHECK(again.shapes.objects[i].mask == model.shapes.objects[i].mask);
}

TEST_CASE("a mask that fills its box is a mask") {
    std::vector<ism::TrainingImage> images;
    for (std::uint64_t seed = 21; seed <= 24; ++seed) images.push_back(animal_picture(seed));
    for (std::size_t i = 0; i < 4; ++i) {
        ism::LabelledObject& object = images[i].objects[0];
        object.mask = i < 2 ? ism::object_mask({.box = object.box}, 240, 160) : ism::Mask();
    }
    const ism::TrainingFeatures features = features_of(images);
    const ism::Model model = ism::masks_from_boxes(unlearnt(features), features, 1);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(features.views[i].labels[0].masked == (i < 2));
        CHECK((model.shapes.objects[i].mask == features.objects[i].mask) == (i < 2));
    }
    CHECK(ism::learn_exemplars(unlearnt(features), features).exemplars.size() == 2);
}

TEST_CASE("crops borrow masks, but where most are crops all keep their boxes") {
    ism::TrainingImage image = animal_picture(31), crop = image;
    image.objects = {{.class_index = 0, .box = {60, 40, 110, 80}}};
    crop.objects = {{.class_index = 0, .box = {10, 5, 220, 150}}};
    const ism::TrainingFeatures half = features_of({image, crop}), most = features_of({crop, image, crop});
    const ism::Model borrowed = ism::masks_from_boxes(unlearnt(half), half),
                     kept = ism::masks_from_boxes(unlearnt(most), most);
    for (std::size_t i = 0; i < 2; ++i) CHECK(borrowed.shapes.objects[i].mask != half.objects[i].mask);
    for (std::size_t i = 0; i < 3; ++i) CHECK(kept.shapes.objects[i].mask == most.objects[i].mask);
}

TEST_CASE("boxes of images whose pixels were not kept stay") {
    ism::TrainingImage image = animal_picture(31);
    image.objects = {{.class_index = 0, .box = {60, 40, 110, 80}}};
    const ism::TrainingFeatures kept = features_of({image}), left = features_of({image}, false);
    CHECK(ism::masks_from_boxes(unlearnt(left), left).shapes.objects[0].mask == left.objects[0].mask);
    CHECK(ism::masks_from_boxes(unlearnt(kept), kept).shapes.objects[0].mask != kept.objects[0].mask);
    CHECK_THROWS_WITH(ism::masks_from_boxes({}, kept),
                      Catch::Contains("masks: objects of the model: expected 1, got 0"));
}
