// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/harris_laplace.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/model_file/model_bytes.hpp"

using ism::FileError;
using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

/// Adds what is known of surfaces in space: points of two objects, frames that occurrences point to, and a
/// judge of masks.
void add_surfaces(ism::Model& model, ism::Random& random) {
    const auto number = [&] { return static_cast<float>(random.uniform(-2, 2)); };
    for (const std::size_t i : {0u, 2u}) {
        ism::TrainingObject& object = model.shapes.objects[i];
        object.size_m = std::abs(number());
        object.centre_m = {number(), number(), std::abs(number())};
        for (std::size_t k = 0; k < 3 + i; ++k) object.points_m.push_back({number(), number(), number()});
    }
    std::uint32_t frames = 0;
    for (const ism::Occurrence& o : model.shapes.occurrences.values())
        frames = std::max(frames, o.feature + 1);
    for (std::uint32_t f = 0; f < frames; ++f)
        model.shapes.frames.push_back({{number(), number(), number()},
                                       ism::rotation_around({number(), number(), 1}, number()),
                                       f % 3 == 0 ? 0 : std::abs(number())});
    ism::MaskJudge& judge = model.mask_judge;
    for (std::uint32_t i = 0; i < 4; ++i) {
        ism::MaskExample example;
        if (i < 3) example.class_index = model.shapes.objects[i].class_index, example.object = i;
        for (float& bin : example.look.color) bin = static_cast<float>(random.uniform());
        for (float& bin : example.look.shape) bin = static_cast<float>(random.uniform());
        judge.examples.push_back(example);
    }
    for (std::size_t k = 0; k < ism::mask_cue_count; ++k)
        judge.mean[k] = number(), judge.deviation[k] = 0.1f + std::abs(number()), judge.weights[k] = number();
    judge.bias = number();
    judge.shape_bin_m = 0.05f;
}

/// A model of the same classes for frames with depth, of three words.
ism::Model depth_model(const ism::Model& model, ism::Random& random) {
    ism::Model inner{.channels = {{ism::settings_of(ism::Extractor<ism::DifferenceOfGaussians, ism::Sift>{}),
                                   ism::Codebook(128, 2), 12}}};
    inner.shapes.class_names = model.shapes.class_names;
    inner.shapes.objects = model.shapes.objects;
    for (std::uint32_t w = 0; w < 3; ++w) {
        inner.channels[0].codebook.push_back({std::vector<float>(128, 0.25f * float(w)), 1});
        inner.shapes.occurrences.push_back(
            std::vector<ism::Occurrence>(w, ism::Occurrence{.class_index = 1, .object = 1, .feature = w}));
    }
    inner.training = {3, 2, 1};
    add_surfaces(inner, random);
    return inner;
}

/// A model with random content, of 3 objects in 2 classes and two channels of words, with one for frames with
/// depth in it.
ism::Model random_model(std::size_t words = 5, std::size_t each = 4, int cells = 9) {
    ism::Random random(7);
    const auto number = [&] { return static_cast<float>(random.uniform(-50, 50)); };
    ism::Extractor<ism::DenseGrid, ism::RootSift> dense{
        .options = {.upsampling = 1.75, .oriented = true, .max_features = 1234}};
    dense.options.scale_space = {.levels_per_octave = 4, .base_sigma = 1.7f, .max_octaves = 3};
    ism::Model model;
    model.channels = {
        {ism::settings_of(dense), ism::Codebook(128, 0.1)},
        {ism::settings_of(ism::Extractor<ism::HarrisLaplace, ism::GrayPatch>{}), ism::Codebook(625, 1234.5)}};
    model.shapes.class_names = {"car", "k\xC3\xBChe \"x\""};
    model.shapes.category_ids = {-7, 1LL << 40};
    for (std::uint32_t i = 0; i < 3; ++i) {
        ism::Mask mask(cells + int(i), cells);
        for (std::uint8_t& cell : mask.pixels())
            cell = static_cast<std::uint8_t>(random.index(4) == 0 ? random.index(256) : 0);
        model.shapes.objects.push_back(
            {i % 2, 100.5f + number(), 120, 33.25f, mask, "image " + std::to_string(i)});
    }
    model.shapes.objects.back().mask = ism::Mask(600, 2, 255);
    const auto add_word = [&](ism::Codebook& codebook, std::uint32_t w) {
        std::vector<float> mean(codebook.dimension());
        for (float& value : mean) value = number();
        codebook.push_back({mean, std::abs(number()), 2 + 1000 * w, w % 2});
        std::vector<ism::Occurrence> own;
        for (std::uint32_t i = 0; i < each * (w % 3); ++i)
            own.push_back({number(), number(), std::abs(number()) + 0.1f, number() / 50,
                           i % 2 == 0 ? ism::no_depth : number(), 0.25f, i % 3 % 2, i % 3, 17 * i});
        model.shapes.occurrences.push_back(own);
    };
    for (std::uint32_t w = 0; w < words; ++w) add_word(model.channels[0].codebook, w);
    for (std::uint32_t w = 0; w < 2; ++w) add_word(model.channels[1].codebook, w);
    for (const std::uint32_t step : {1u, 3u}) {
        std::vector<ism::SparseEntry> weights;
        for (std::uint32_t bin = 0; bin < ism::BoxClassifier::cells * words; bin += step)
            weights.push_back({bin, number()});
        model.box_classifier.push_back(weights, number());
    }
    model.calibration.curves = {{1.25, -3}, {0.1, 1.0 / 3}};
    for (const bool ring : {true, false}) {
        ism::BoxTemplate one{
            .grid = {3, 2, ring}, .bias = number(), .log_aspect = number(), .log_aspect_spread = 0.25f};
        for (std::size_t k = 0; k < one.grid.cells() * ism::cell_numbers; ++k)
            one.weights.push_back(number());
        model.templates.push_back(one);
    }
    auto& [mixture, patch_weights, patch_bias] = model.patch_classifier;
    const auto numbers = [&](std::size_t count) {
        std::vector<float> result(count);
        for (float& value : result) value = number();
        return result;
    };
    const auto above_zero = [&](std::size_t count) {
        std::vector<float> result = numbers(count);
        for (float& value : result) value = std::abs(value) + 0.1f;
        return result;
    };
    constexpr std::size_t gaussians = ism::PatchMixture::gaussians;
    mixture = {.mean = numbers(ism::patch_numbers),
               .axes = numbers(ism::patch_numbers * ism::patch_axes),
               .weights = above_zero(gaussians),
               .means = numbers(gaussians * ism::patch_axes),
               .spreads = above_zero(gaussians * ism::patch_axes)};
    patch_weights = {numbers(ism::PatchMixture::vector_numbers), numbers(ism::PatchMixture::vector_numbers)};
    patch_bias = numbers(2);
    model.cue_weights = {0.75, 1.0 / 3, 1.0 / 7, 2, 0.5, 1.0 / 9};
    for (int c = 0; c < 2; ++c) {
        ism::ClassFigure figure;
        for (std::size_t k = 0; k < ism::figure_numbers; ++k) figure.push_back(float(random.uniform()));
        model.figures.push_back(figure);
    }
    model.template_calibration.curves = {{2, -1}, {1.0 / 7, 0}};
    for (const std::uint32_t object : {0u, 2u}) {
        ism::MaskExemplar one{object, {}};
        for (std::size_t k = 0; k < ism::exemplar_bytes; ++k)
            one.cells.push_back(static_cast<std::uint8_t>(random.index(256)));
        model.exemplars.push_back(one);
    }
    model.figure_colors.resize(2);
    for (std::size_t k = 0; k < ism::figure_color_bins; ++k)
        model.figure_colors[1].push_back(float(random.uniform(-3, 3)));
    model.typical_masks = {{}, {.mean = {0.5, 1.0 / 3, -2}, .deviation = {0.25, 1.0 / 7, 3}}};
    model.typical_sizes = {{.log_px = 9.5, .log_part = -1.0 / 3}, {.log_px = 7, .log_part = -2}};
    model.placings.resize(2);
    model.placings[1].sides = {{{1.0 / 3, -0.125}, {1, ism::most_placing_offset}, {0, 0}, {0.5, 1.0 / 8}}};
    model.training = {12, 3456, 789};
    model.channels[1].neighbours = 7;
    model.rgbd = {depth_model(model, random)};
    add_surfaces(model, random);
    return model;
}

template <class List>
bool same_bytes(const List& a, const List& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(*a.data())) == 0);
}

void check_equal(const ism::Model& a, const ism::Model& b) {
    REQUIRE(a.channels.size() == b.channels.size());
    for (std::size_t c = 0; c < a.channels.size(); ++c) {
        const ism::Codebook &p = a.channels[c].codebook, &q = b.channels[c].codebook;
        CHECK(same_bytes(p.means().values(), q.means().values()));
        CHECK(same_bytes(p.mean_sq_lengths(), q.mean_sq_lengths()));
        CHECK(same_bytes(p.groups(), q.groups()));
        CHECK(same_bytes(p.sizes(), q.sizes()));
        CHECK(p.max_sq_distance() == q.max_sq_distance());
        CHECK(a.channels[c].neighbours == b.channels[c].neighbours);
        CHECK(ism::detail::settings_to_json(a.channels[c].features, "a") ==
              ism::detail::settings_to_json(b.channels[c].features, "b"));
    }
    CHECK(a.shapes.class_names == b.shapes.class_names);
    CHECK(a.shapes.category_ids == b.shapes.category_ids);
    CHECK(same_bytes(a.shapes.occurrences.offsets(), b.shapes.occurrences.offsets()));
    CHECK(same_bytes(a.shapes.occurrences.values(), b.shapes.occurrences.values()));
    CHECK(a.box_classifier.weights == b.box_classifier.weights);
    CHECK(a.box_classifier.bias == b.box_classifier.bias);
    CHECK(a.calibration.curves == b.calibration.curves);
    CHECK(a.templates == b.templates);
    CHECK(a.patch_classifier == b.patch_classifier);
    CHECK(a.cue_weights == b.cue_weights);
    CHECK(a.figures == b.figures);
    CHECK(a.template_calibration.curves == b.template_calibration.curves);
    CHECK(a.exemplars == b.exemplars);
    CHECK(a.figure_colors == b.figure_colors);
    CHECK(a.typical_masks == b.typical_masks);
    CHECK(a.placings == b.placings);
    CHECK(a.typical_sizes == b.typical_sizes);
    CHECK(a.training == b.training);
    REQUIRE(a.shapes.objects.size() == b.shapes.objects.size());
    for (std::size_t i = 0; i < a.shapes.objects.size(); ++i) {
        const auto &p = a.shapes.objects[i], &q = b.shapes.objects[i];
        CHECK(p.class_index == q.class_index);
        CHECK((p.width == q.width && p.height == q.height && p.size_px == q.size_px));
        CHECK(p.mask == q.mask);
        CHECK(p.image == q.image);
        CHECK((p.size_m == q.size_m && p.centre_m == q.centre_m));
        CHECK(p.points_m == q.points_m);
    }
    CHECK(a.shapes.frames == b.shapes.frames);
    CHECK(a.mask_judge == b.mask_judge);
    REQUIRE(a.rgbd.size() == b.rgbd.size());
    for (std::size_t i = 0; i < a.rgbd.size(); ++i) check_equal(a.rgbd[i], b.rgbd[i]);
}

/// A model of one channel, without words.
template <class D, class Desc>
ism::Model model_of(const ism::Extractor<D, Desc>& extractor) {
    ism::Model model = random_model();
    model.channels.resize(1);
    model.channels[0].features = ism::settings_of(extractor);
    ism::Codebook codebook(Desc::dimension, 1);
    const std::vector<float> mean(Desc::dimension, 1);
    ism::Grouped<ism::Occurrence> occurrences;
    for (std::size_t w = 0; w < 5; ++w) {
        codebook.push_back({mean, 1});
        occurrences.push_back(model.shapes.occurrences[w]);
    }
    model.channels[0].codebook = codebook;
    model.shapes.occurrences = occurrences;
    return model;
}

/// The extractor that comes back from a file.
template <class D, class Desc>
ism::Extractor<D, Desc> round_trip(const ism::Extractor<D, Desc>& extractor) {
    const TemporaryFolder folder;
    ism::save_model(folder / "m", model_of(extractor));
    const auto read = ism::load_model<D, Desc>(folder / "m");
    ism::FeatureSettings settings = ism::settings_of(extractor);
    CHECK(ism::is_same_way(settings, read.channels[0].features));
    settings.options.max_features += 1;
    CHECK(ism::is_same_way(settings, read.channels[0].features));
    REQUIRE_FALSE(settings.detector_parameters.empty());
    ism::Parameter& last = settings.detector_parameters.back();
    last.real += 1, last.whole = 1 - last.whole;
    CHECK_FALSE(ism::is_same_way(settings, read.channels[0].features));
    return read.extractor();
}

/// The message of loading a model whose file was changed and given a right checksum.
std::string load_error(const std::function<void(ism::TensorFile&)>& change) {
    const TemporaryFolder folder;
    ism::save_model(folder / "m", random_model());
    ism::TensorFile file = ism::read_safetensors(folder / "m");
    change(file);
    ism::write_safetensors(folder / "m", file);
    const std::string message = error_message<FileError>([&] { (void)ism::load_model(folder / "m"); });
    const std::string head = "file '" + (folder / "m").string() + "'";
    return message.substr(0, head.size()) == head ? message.substr(head.size()) : message;
}

template <class T>
void set(ism::TensorFile& file, const std::string& name, std::size_t index, T value) {
    std::memcpy(file.tensors.at(name).bytes.data() + index * sizeof(T), &value, sizeof(T));
}

}  // namespace

TEST_CASE("Models come back bit for bit, in the same bytes every time") {
    const TemporaryFolder folder;
    const ism::Model model = random_model();
    ism::save_model(folder / "m", model);
    const ism::Model read = ism::load_model(folder / "m");
    check_equal(model, read);
    CHECK(read.channels[0].features.options.scale_space.levels_per_octave == 4);
    CHECK(read.channels[0].features.options.upsampling == 1.75);
    CHECK(read.channels[0].features.options.oriented);
    CHECK(read.channels[1].features.detector == "harris-laplace");
    CHECK(read.channels[1].features.descriptor == "gray-patch");
    ism::save_model(folder / "again", read);
    CHECK(ism::read_bytes(folder / "m") == ism::read_bytes(folder / "again"));
    CHECK(ism::read_text(folder / "m") == ism::model_to_bytes(model));
    check_equal(model, ism::model_from_bytes(ism::model_to_bytes(model)));

    ism::Model sparse = model;  // of a surface nothing but where it is; no frames, judge or inner model
    sparse.rgbd.clear();
    sparse.mask_judge = {};
    sparse.shapes.category_ids.clear();
    sparse.shapes.frames.clear();
    for (ism::TrainingObject& object : sparse.shapes.objects) object.points_m.clear();
    ism::save_model(folder / "m", sparse);
    check_equal(sparse, ism::load_model(folder / "m"));
}

TEST_CASE("The options of every detector come back") {
    const auto dog =
        round_trip(ism::Extractor<ism::DifferenceOfGaussians, ism::Sift>{
                       .detector = {.contrast_threshold = 0.013f, .edge_ratio = 11.5f, .border = 7}})
            .detector;
    CHECK((dog.contrast_threshold == 0.013f && dog.edge_ratio == 11.5f && dog.border == 7));
    const auto harris =
        round_trip(
            ism::Extractor<ism::HarrisLaplace, ism::GrayPatch>{
                .detector = {.threshold = 3e-7f, .alpha = 0.05f, .least_laplacian = 0.1f, .border = 9}})
            .detector;
    CHECK((harris.threshold == 3e-7f && harris.alpha == 0.05f && harris.least_laplacian == 0.1f &&
           harris.border == 9));
    ism::Extractor<ism::HessianLaplace, ism::RootSift> hessian;
    hessian.detector.scale_tolerance = 0.3f;
    CHECK(round_trip(hessian).detector.scale_tolerance == 0.3f);
    const auto dense =
        round_trip(ism::Extractor<ism::DenseGrid, ism::Sift>{
                       .detector = {.spacing = 3.3f, .margin = 1, .first_scale = 1.5f, .scale_count = 2}})
            .detector;
    CHECK((dense.spacing == 3.3f && dense.first_scale == 1.5f && dense.scale_count == 2));
}

TEST_CASE("A model of another detector, descriptor or number of channels is refused by name") {
    const TemporaryFolder folder;
    ism::save_model(folder / "m", model_of(ism::Extractor<ism::DenseGrid, ism::RootSift>{}));
    CHECK_THROWS_WITH((ism::load_model<ism::DenseGrid, ism::Sift>(folder / "m")),
                      Catch::Contains("/m': descriptor: expected sift, got root-sift"));
    CHECK_THROWS_WITH((ism::load_model<ism::HessianLaplace, ism::RootSift>(folder / "m")),
                      Catch::Contains("detector: expected hessian-laplace, got dense"));
    ism::save_model(folder / "two", random_model());
    CHECK_THROWS_WITH((ism::load_model<ism::DenseGrid, ism::RootSift>(folder / "two")),
                      Catch::Contains("channels of words: expected 1, got 2"));
    ism::write_safetensors(folder / "other", {.tensors = {{"x", ism::make_tensor<float>({}, {0})}}});
    CHECK_THROWS_WITH(ism::load_model(folder / "other"),
                      Catch::Contains("expected a model of ism, got another safetensors file"));
    CHECK_THROWS_AS(ism::load_model(folder / "none"), FileError);
}

TEST_CASE("A model that could not be read again is not written") {
    const TemporaryFolder folder;
    const auto refuses = [&](const char* what, const std::function<void(ism::Model&)>& change) {
        ism::Model model = random_model();
        change(model);
        CHECK_THROWS_WITH(ism::save_model(folder / "m", model), Catch::Contains(what));
        CHECK_FALSE(std::filesystem::exists(folder / "m"));
    };
    refuses("object 1: size", [](ism::Model& m) { m.shapes.objects[1].width = 1e9f; });
    refuses("x, y", [](ism::Model& m) { m.shapes.occurrences.values()[3].x = std::nanf(""); });
    refuses("scale", [](ism::Model& m) { m.shapes.occurrences.values()[3].scale = 0; });
    refuses("upsampling", [](ism::Model& m) { m.channels[0].features.options.upsampling = 1000; });
    refuses("words with occurrences", [](ism::Model& m) { m.shapes.occurrences.push_back({}); });
    refuses("each once", [](ism::Model& m) { m.shapes.class_names[1] = "car"; });
    refuses("category_ids: expected each once", [](ism::Model& m) { m.shapes.category_ids[1] = -7; });
    refuses("category_ids: expected an array of 2", [](ism::Model& m) { m.shapes.category_ids.pop_back(); });
    refuses("calibration", [](ism::Model& m) { m.calibration.curves.pop_back(); });
    refuses("template_calibration", [](ism::Model& m) { m.template_calibration.curves.pop_back(); });
    refuses("cue_weights", [](ism::Model& m) { m.cue_weights.colors = -1; });
    refuses("patch_bias: expected 0 or 2", [](ism::Model& m) { m.patch_classifier.bias.pop_back(); });
    refuses("patch_weights", [](ism::Model& m) { m.patch_classifier.weights.pop_back(); });
    refuses("[136, 32]", [](ism::Model& m) { m.patch_classifier.mixture.axes.pop_back(); });
    refuses("classifier of patches", [](ism::Model& m) { m.patch_classifier.weights[1][5] = std::nanf(""); });
    refuses("Gaussians of patches", [](ism::Model& m) { m.patch_classifier.mixture.spreads[3] = 0; });
    refuses("class_figures: expected 0 or 2", [](ism::Model& m) { m.figures.pop_back(); });
    refuses("class_figures: expected 0 ... 1", [](ism::Model& m) { m.figures[1][7] = 1.5f; });
    refuses("templates", [](ism::Model& m) { m.templates.pop_back(); });
    refuses("template_weights", [](ism::Model& m) { m.templates[1].weights.pop_back(); });
    refuses("template_grids", [](ism::Model& m) { m.templates[0].grid.rows = 0; });
    refuses("spread of a template's aspect", [](ism::Model& m) { m.templates[0].log_aspect_spread = 0; });
    refuses("object of an exemplar", [](ism::Model& m) { m.exemplars[1].object = 3; });
    refuses("figure_colors: expected finite", [](ism::Model& m) { m.figure_colors[1][7] = std::nanf(""); });
    refuses("[1, 4096]", [](ism::Model& m) { m.figure_colors[1].pop_back(); });
    refuses("figure_color_classes", [](ism::Model& m) { m.figure_colors.push_back(m.figure_colors[1]); });
    refuses("typical_masks: expected 0 or 2", [](ism::Model& m) { m.typical_masks.pop_back(); });
    refuses("typical_masks: expected finite",
            [](ism::Model& m) { m.typical_masks[1].mean.extent = std::nan(""); });
    refuses("typical_masks: expected finite",
            [](ism::Model& m) { m.typical_masks[1].deviation.extent = -1; });
    refuses("typical_sizes: expected 0 or 2", [](ism::Model& m) { m.typical_sizes.pop_back(); });
    refuses("typical_sizes: expected finite",
            [](ism::Model& m) { m.typical_sizes[1].log_part = -std::numeric_limits<double>::infinity(); });
    refuses("placings: expected 0 or 2", [](ism::Model& m) { m.placings.pop_back(); });
    refuses("placings: expected shares", [](ism::Model& m) { m.placings[1].sides[2].share = 1.5; });
    refuses("placings: expected shares", [](ism::Model& m) { m.placings[0].sides[3].offset = -0.2; });
    refuses("placings: expected shares", [](ism::Model& m) { m.placings[0].sides[0].offset = std::nan(""); });
    refuses("finite", [](ism::Model& m) { m.templates[0].bias = std::nanf(""); });
    refuses("object_points", [](ism::Model& m) { m.shapes.objects[2].points_m[4].y = std::nanf(""); });
    refuses("depth and size of an object", [](ism::Model& m) { m.shapes.objects[0].size_m = -1; });
    refuses("unit quaternions", [](ism::Model& m) { m.shapes.frames[5].rotation.w += 0.1f; });
    refuses("the number of frames", [](ism::Model& m) { m.shapes.frames.resize(3); });
    refuses("of object 1", [](ism::Model& m) { m.mask_judge.examples[1].class_index = 0; });
    refuses("of object 3", [](ism::Model& m) { m.mask_judge.examples[1].object = 3; });
    refuses("deviation of a cue", [](ism::Model& m) { m.mask_judge.deviation[5] = 0; });
    refuses("shape_bin_m", [](ism::Model& m) { m.mask_judge.shape_bin_m = 0; });
    refuses("judge of masks", [](ism::Model& m) { m.mask_judge.bias = std::nanf(""); });
    refuses("mask_looks", [](ism::Model& m) { m.mask_judge.examples[2].look.shape[7] = 1.1f; });
    refuses("neighbours: expected 0 ... 1000", [](ism::Model& m) { m.channels[0].neighbours = 1001; });
    refuses("models for depth: expected at most 1, got 2",
            [](ism::Model& m) { m.rgbd.push_back(m.rgbd[0]); });
    refuses("classes of the model for depth",
            [](ism::Model& m) { m.rgbd[0].shapes.class_names[1] = "another"; });
    refuses("model for depth: expected none within it", [](ism::Model& m) {
        const ism::Model inner = m.rgbd[0];
        m.rgbd[0].rgbd = {inner};
    });
    refuses("model for depth: words with occurrences", [](ism::Model& m) { m.rgbd[0].channels.clear(); });
}

TEST_CASE("A model file that was cut off or altered at any place is refused") {
    const TemporaryFolder folder;
    ism::Model small = model_of(ism::Extractor<ism::DenseGrid, ism::RootSift>{});
    ism::save_model(folder / "m", small);
    const std::vector<std::uint8_t> whole = ism::read_bytes(folder / "m");
    std::size_t accepted = 0, tried = 0;
    const auto try_bytes = [&](std::span<const std::uint8_t> bytes) {
        ism::write_file(folder / "bad", bytes);
        ++tried;
        try {
            check_equal(ism::load_model(folder / "bad"), small);
            ++accepted;  // only blanks of the header may change without changing the model
        } catch (const FileError& error) {
            if (std::string(error.what()).find((folder / "bad").string()) == std::string::npos)
                FAIL(error.what());
        }
    };
    // the header closely; a checksum guards the numbers after it
    const std::size_t header = 8 + whole[0] + 256u * whole[1];
    const auto step = [&](std::size_t at) { return at < header + 100 ? 13u : 499u; };
    for (std::size_t size = 0; size < whole.size(); size += step(size))
        try_bytes(std::span(whole).first(size));
    CHECK(accepted == 0);
    for (std::size_t at = 0; at < whole.size(); at += step(at)) {
        std::vector<std::uint8_t> bytes = whole;
        bytes[at] ^= std::uint8_t(1 + at % 255);
        try_bytes(bytes);
    }
    CHECK(accepted <= 1);
    CHECK(header > 4000);
    CHECK(tried > 1000);
}

TEST_CASE("Bytes that are no whole model are refused") {
    const std::string bytes = ism::model_to_bytes(random_model());
    const auto refused = [](const std::string& altered, const std::string& message) {
        CHECK_THROWS_WITH(ism::model_from_bytes(altered), Catch::Matchers::Contains(message));
    };
    refused("", "model: expected a safetensors file, got 0 bytes");
    refused(bytes.substr(0, bytes.size() - 1), "model");
    std::string other = bytes;
    other.back() = char(other.back() ^ 1);
    refused(other, "model: expected unchanged content (checksum), got altered content");
}

TEST_CASE("A model file that contradicts itself is refused") {
    CHECK(load_error([](auto&) {}) == "nothing thrown");
    using File = ism::TensorFile;
    const auto infinity = std::numeric_limits<float>::infinity();
    const std::vector<std::pair<std::string, std::function<void(File&)>>> cases = {
        {": words: expected finite numbers", [&](File& f) { set(f, "channel_0_words", 3, infinity); }},
        {": mean_sq_length: expected 0 or more",
         [](File& f) { set(f, "channel_1_mean_sq_length", 1, -1.0f); }},
        {": word_size: expected 1 or more", [](File& f) { set(f, "channel_0_word_size", 0, 0u); }},
        {": group of a word: expected below 2, got 2",
         [](File& f) { set(f, "channel_0_word_group", 0, 2u); }},
        {": word_occurrences: expected rising", [](File& f) { set(f, "word_occurrences", 1, 9u); }},
        {": word_occurrences: expected 0 to", [](File& f) { set(f, "word_occurrences", 0, 1u); }},
        {", occurrence_0: x, y", [&](File& f) { set(f, "occurrence_x", 0, ism::no_depth); }},
        {", occurrence_2: scale: expected 1e-6", [](File& f) { set(f, "occurrence_scale", 2, 0.0f); }},
        {", occurrence_2: angle: expected", [&](File& f) { set(f, "occurrence_angle", 2, infinity); }},
        {", occurrence_3: depth", [&](File& f) { set(f, "occurrence_depth_m", 3, infinity); }},
        {", occurrence_1: weight", [](File& f) { set(f, "occurrence_weight", 1, -0.5f); }},
        {", occurrence_0: class", [](File& f) { set(f, "occurrence_class", 0, 1u); }},
        {", occurrence_1: object: expected below 3, got 3",
         [](File& f) { set(f, "occurrence_object", 1, 3u); }},
        {", object 1: class: expected below 2", [](File& f) { set(f, "object_classes", 1, 2u); }},
        {", object 0: size: expected 0.001", [](File& f) { set(f, "object_sizes", 2, 0.0f); }},
        {", object 0: mask size", [](File& f) { set(f, "mask_sizes", 0, 0u); }},
        {", object 0: mask size", [](File& f) { set(f, "mask_sizes", 0, 4000000000u); }},
        {", object 0: mask cells", [](File& f) { set(f, "mask_sizes", 0, 1000000u); }},
        {", object 0: mask run", [](File& f) { set(f, "mask_runs", 0, std::uint8_t(0)); }},
        {": box_classifier_offsets: expected rising numbers",
         [](File& f) { set(f, "box_classifier_offsets", 1, 9999u); }},
        {": box_classifier_offsets: expected 0 to", [](File& f) { set(f, "box_classifier_offsets", 2, 1u); }},
        {": box_classifier_bins: expected rising numbers below",
         [](File& f) { set(f, "box_classifier_bins", 2, 1u); }},
        {": box_classifier_bins: expected rising numbers below",
         [](File& f) { set(f, "box_classifier_bins", 3, 4000000000u); }},
        {": box classifier: expected finite",
         [&](File& f) { set(f, "box_classifier_weights", 3, infinity); }},
        {": box classifier: expected finite", [&](File& f) { set(f, "box_classifier_bias", 0, infinity); }},
        {": calibration: expected finite", [&](File& f) { set(f, "calibration", 1, double(infinity)); }},
        {": calibration: expected 0 or 2 curves",
         [](File& f) {
             f.tensors["calibration"] = ism::make_tensor<double>(std::vector<double>{1, 2}, {1, 2});
         }},
        {": object of an exemplar: expected below 3, got 4000000000",
         [](File& f) { set(f, "exemplar_objects", 1, 4000000000u); }},
        {": figure_color_classes: expected each once, below 2, got 2",
         [](File& f) { set(f, "figure_color_classes", 0, 2u); }},
        {": tensor 'exemplar_cells'",
         [](File& f) {
             f.tensors["exemplar_cells"] = ism::make_tensor<std::uint8_t>({}, {2, 0});
         }},
        {": image names: expected 3, got 1", [](File& f) { f.metadata["images"] = R"(["a"])"; }},
        {": class names: expected each once", [](File& f) { f.metadata["class_names"] = R"(["a","a"])"; }},
        {": class names: expected 1 or more", [](File& f) { f.metadata["class_names"] = "[]"; }},
        {", class_names: expected texts", [](File& f) { f.metadata["class_names"] = "[3]"; }},
        {": reference_size_px: expected 200", [](File& f) { f.metadata["reference_size_px"] = "100"; }},
        {": format version: expected 18, got 5", [](File& f) { f.metadata["format_version"] = "5"; }},
        {": object_places: expected -1e+06 ... 1e+06",
         [&](File& f) { set(f, "object_places", 4, ism::no_depth); }},
        {": depth and size of an object: expected 0 or more",
         [](File& f) { set(f, "object_places", 2, -1.0f); }},
        {": object_points: expected", [&](File& f) { set(f, "object_points", 0, infinity); }},
        {": object_point_offsets: expected rising", [](File& f) { set(f, "object_point_offsets", 1, 9u); }},
        {": object_point_offsets: expected 0 to", [](File& f) { set(f, "object_point_offsets", 3, 7u); }},
        {": expected a tensor 'object_points'", [](File& f) { f.tensors.erase("object_points"); }},
        {": occurrence_frames: expected unit quaternions",
         [](File& f) { set(f, "occurrence_frames", 8 + 3, 1.5f); }},
        {": occurrence_frames: expected unit quaternions, scales of 0 or more",
         [](File& f) { set(f, "occurrence_frames", 8 + 7, -0.1f); }},
        {": occurrence_frames: expected", [&](File& f) { set(f, "occurrence_frames", 0, ism::no_depth); }},
        {": feature of an occurrence: expected below",
         [](File& f) { set(f, "occurrence_feature", 1, 4000000000u); }},
        {": mask_classes: expected background, or the class of an object",
         [](File& f) { set(f, "mask_classes", 0, 1u); }},
        {": mask_classes: expected background", [](File& f) { set(f, "mask_classes", 7, 0u); }},
        {": mask_looks: expected", [](File& f) { set(f, "mask_looks", 0, -2.0f); }},
        {": tensor 'mask_classes'",
         [](File& f) {
             f.tensors["mask_classes"] = ism::make_tensor<std::uint32_t>({}, {0, 2});
         }},
        {": deviation of a cue: expected above 0",
         [](File& f) { set(f, "mask_regression", ism::mask_cue_count, 0.0f); }},
        {": judge of masks: expected", [&](File& f) { set(f, "mask_regression", 0, infinity); }},
        {": shape_bin_m: expected above 0", [](File& f) { set(f, "mask_numbers", 1, 0.0f); }},
        {", model for depth: words: expected finite numbers",
         [&](File& f) { set(f, "rgbd/channel_0_words", 3, infinity); }},
        {", model for depth: expected a tensor 'mask_numbers'",
         [](File& f) { f.tensors.erase("rgbd/mask_numbers"); }},
        {", model for depth: expected metadata 'channels'",
         [](File& f) { f.metadata.erase("rgbd/channels"); }},
        {": classes of the model for depth: expected those of the model",
         [](File& f) { f.metadata["rgbd/class_names"] = R"(["car","bus"])"; }},
        {": expected metadata 'channels'", [](File& f) { f.metadata.erase("channels"); }},
        {", channels: expected an array of 1 or more", [](File& f) { f.metadata["channels"] = "[]"; }},
        {", channels: dimension", [](File& f) { f.metadata["channels"] = "[{}]"; }},
        {", training: images", [](File& f) { f.metadata["training"] = "{}"; }},
        {": expected a tensor 'mask_runs'", [](File& f) { f.tensors.erase("mask_runs"); }},
        {": tensor 'channel_0_words'",
         [](File& f) {
             f.tensors["channel_0_words"] = ism::make_tensor<std::uint8_t>({}, {0, 128});
         }},
        {": words: expected 1 or more",
         [](File& f) {
             f.tensors["channel_1_words"] = ism::make_tensor<float>({}, {0, 625});
             f.tensors["channel_1_mean_sq_length"] = ism::make_tensor<float>({}, {0});
             f.tensors["channel_1_word_group"] = ism::make_tensor<std::uint32_t>({}, {0});
             f.tensors["channel_1_word_size"] = ism::make_tensor<std::uint32_t>({}, {0});
         }},
    };
    for (const auto& [expected, change] : cases) {
        INFO(expected);
        CHECK(load_error(change).substr(0, expected.size()) == expected);
    }
    const auto with = [](const std::string& from, const std::string& to) {
        return load_error([&](File& f) {
            std::string& text = f.metadata["channels"];
            text.replace(text.find(from), from.size(), to);
        });
    };
    using Catch::Contains;
    CHECK_THAT(with("\"max_sq_distance\":0.1", "\"max_sq_distance\":-1"), Contains("max_sq_distance"));
    CHECK_THAT(with("\"upsampling\":1.75", "\"upsampling\":1e-9"), Contains("upsampling"));
    CHECK_THAT(with("\"upsampling\":1.75", "\"upsampling\":1000"), Contains("upsampling"));
    CHECK_THAT(with("\"upsampling\":1.75", "\"upsampling\":\"much\""), Contains("upsampling"));
    CHECK_THAT(with("\"oriented\":true", "\"oriented\":3"), Contains("oriented"));
    CHECK_THAT(with("\"levels_per_octave\":4", "\"levels_per_octave\":2147483648"),
               Contains("levels_per_octave"));
}

TEST_CASE("Parameters that a file tells pass the checks of the options they become") {
    const TemporaryFolder folder;
    ism::save_model(folder / "m", model_of(ism::Extractor<ism::HessianLaplace, ism::Sift>{}));
    const auto error_with = [&](const std::string& name, const std::string& value) {
        ism::TensorFile file = ism::read_safetensors(folder / "m");
        ism::detail::Json channels = ism::detail::parse_json(file.metadata["channels"], "m");
        REQUIRE(channels[0]["detector_parameters"].contains(name));
        channels[0]["detector_parameters"][name] = ism::detail::parse_json(value, "m");
        file.metadata["channels"] = channels.dump();
        ism::write_safetensors(folder / "changed", file);
        return error_message<FileError>(
            [&] { (void)ism::load_model<ism::HessianLaplace, ism::Sift>(folder / "changed"); });
    };
    for (const auto& [name, value] : {std::pair("border", "2147483647"),
                                      {"border", "-1"},
                                      {"scale_tolerance", "7"},
                                      {"scale_tolerance", "0"},
                                      {"border", "true"}}) {
        CAPTURE(name, value);
        CHECK_THAT(error_with(name, value), Catch::Contains(name));
    }
    CHECK(error_with("border", "7") == "nothing thrown");
}

TEST_CASE("A model of 5000 words and 30000 occurrences takes less than 20 MB") {
    const TemporaryFolder folder;
    ism::Model model = random_model(5000, 6, 100);
    CHECK(model.shapes.occurrences.values().size() > 29000);
    const auto disc = [](int x, int y) { return std::hypot(x - 50, y - 50) < 40 ? 255 : 0; };
    while (model.shapes.objects.size() < 500) {
        ism::Mask mask(100, 100);
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 100; ++x) mask(x, y) = std::uint8_t(disc(x, y));
        model.shapes.objects.push_back({0, 200, 200, 50, mask, "another image"});
    }
    ism::save_model(folder / "m", model);
    CHECK(std::filesystem::file_size(folder / "m") < 20'000'000);
    CHECK(std::filesystem::file_size(folder / "m") < 4'350'000);
    CHECK(ism::load_model(folder / "m").shapes.objects[400].mask == model.shapes.objects[400].mask);
}
