// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/model_file/model_file.hpp"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
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

using ism::FileError;
using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

/// A model with random content, of 3 objects in 2 classes.
template <class D, class Desc>
ism::Model<D, Desc> random_model(std::size_t words = 5, std::size_t each = 4, int cells = 9) {
    ism::Random random(7);
    const auto number = [&] { return static_cast<float>(random.uniform(-50, 50)); };
    ism::Model<D, Desc> model;
    model.extractor.options = {.upsampling = 1.75, .oriented = true, .max_features = 1234};
    model.extractor.options.scale_space = {.levels_per_octave = 4, .base_sigma = 1.7f, .max_octaves = 3};
    model.codebook.words = ism::Descriptors<typename Desc::Scalar, Desc::dimension>(words);
    for (auto& value : model.codebook.words.values())
        value = static_cast<typename Desc::Scalar>(50 + number());
    model.codebook.max_sq_distance = 0.1;
    model.shapes.class_names = {"car", "k\xC3\xBChe \"x\""};
    for (std::uint32_t i = 0; i < 3; ++i) {
        ism::Mask mask(cells + int(i), cells);
        for (std::uint8_t& cell : mask.pixels())
            cell = static_cast<std::uint8_t>(random.index(4) == 0 ? random.index(256) : 0);
        model.shapes.objects.push_back(
            {i % 2, 100.5f + number(), 120, 33.25f, mask, "image " + std::to_string(i)});
    }
    model.shapes.objects.back().mask = ism::Mask(600, 2, 255);
    for (std::uint32_t w = 0; w < words; ++w) {
        model.codebook.mean_sq_length.push_back(std::abs(number()));
        model.codebook.group.push_back(w % 2);
        model.codebook.sizes.push_back(2 + 1000 * w);
        model.shapes.first.push_back(std::uint32_t(model.shapes.occurrences.size()));
        for (std::uint32_t i = 0; i < each * (w % 3); ++i)
            model.shapes.occurrences.push_back({number(), number(), std::abs(number()) + 0.1f,
                                                i % 2 == 0 ? ism::no_depth : number(), 0.25f, i % 3 % 2,
                                                i % 3, 17 * i});
    }
    model.shapes.first.push_back(std::uint32_t(model.shapes.occurrences.size()));
    for (const std::uint32_t step : {1u, 3u}) {
        std::vector<ism::BinValue> weights;
        for (std::uint32_t bin = 0; bin < ism::Appearance::cells * words; bin += step)
            weights.push_back({bin, number()});
        model.shapes.appearance.push_back(weights, number());
    }
    return model;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

template <class M>
void check_equal(const M& a, const M& b) {
    const auto bytes = [](const auto& words) {
        return std::vector<float>(words.values().begin(), words.values().end());
    };
    CHECK(same_bytes(bytes(a.codebook.words), bytes(b.codebook.words)));
    CHECK(same_bytes(bytes(a.memory), bytes(b.memory)));
    CHECK(same_bytes(a.codebook.mean_sq_length, b.codebook.mean_sq_length));
    CHECK(a.codebook.group == b.codebook.group);
    CHECK(a.codebook.sizes == b.codebook.sizes);
    CHECK(a.codebook.max_sq_distance == b.codebook.max_sq_distance);
    CHECK(a.shapes.class_names == b.shapes.class_names);
    CHECK(a.shapes.first == b.shapes.first);
    CHECK(a.shapes.appearance.first == b.shapes.appearance.first);
    CHECK(same_bytes(a.shapes.appearance.weights, b.shapes.appearance.weights));
    CHECK(same_bytes(a.shapes.appearance.bias, b.shapes.appearance.bias));
    CHECK(same_bytes(a.shapes.occurrences, b.shapes.occurrences));
    REQUIRE(a.shapes.objects.size() == b.shapes.objects.size());
    for (std::size_t i = 0; i < a.shapes.objects.size(); ++i) {
        const auto &p = a.shapes.objects[i], &q = b.shapes.objects[i];
        CHECK(p.class_index == q.class_index);
        CHECK((p.width == q.width && p.height == q.height && p.size_px == q.size_px));
        CHECK(p.mask == q.mask);
        CHECK(p.image == q.image);
    }
    const auto &p = a.extractor.options, &q = b.extractor.options;
    CHECK((p.upsampling == q.upsampling && p.oriented == q.oriented && p.max_features == q.max_features));
    const auto &s = p.scale_space, &t = q.scale_space;
    CHECK((s.levels_per_octave == t.levels_per_octave && s.base_sigma == t.base_sigma &&
           s.input_sigma == t.input_sigma && s.double_first_octave == t.double_first_octave &&
           s.max_octaves == t.max_octaves && s.smallest_side == t.smallest_side));
}

template <class D, class Desc>
ism::Model<D, Desc> round_trip(const ism::Model<D, Desc>& model) {
    const TemporaryFolder folder;
    ism::save_model(folder / "m", model);
    const auto read = ism::load_model<D, Desc>(folder / "m");
    check_equal(model, read);
    ism::save_model(folder / "again", read);
    CHECK(ism::read_bytes(folder / "m") == ism::read_bytes(folder / "again"));
    return read;
}

using SmallModel = ism::Model<ism::DenseGrid, ism::RootSift>;

/// The message of loading a model whose file was changed and given a right checksum.
std::string load_error(const std::function<void(ism::TensorFile&)>& change) {
    const TemporaryFolder folder;
    ism::save_model(folder / "m", random_model<ism::DenseGrid, ism::RootSift>());
    ism::TensorFile file = ism::read_safetensors(folder / "m");
    change(file);
    ism::write_safetensors(folder / "m", file);
    const std::string message =
        error_message<FileError>([&] { (void)ism::load_model<ism::DenseGrid, ism::RootSift>(folder / "m"); });
    const std::string head = "file '" + (folder / "m").string() + "'";
    return message.substr(0, head.size()) == head ? message.substr(head.size()) : message;
}

template <class T>
void set(ism::TensorFile& file, const std::string& name, std::size_t index, T value) {
    std::memcpy(file.tensors.at(name).bytes.data() + index * sizeof(T), &value, sizeof(T));
}

}  // namespace

TEST_CASE("Models come back bit for bit, whatever their detector and descriptor") {
    auto dog = random_model<ism::DifferenceOfGaussians, ism::Sift>();
    dog.extractor.detector = {.contrast_threshold = 0.013f, .edge_ratio = 11.5f, .border = 7};
    const auto dog_read = round_trip(dog).extractor.detector;
    CHECK((dog_read.contrast_threshold == 0.013f && dog_read.edge_ratio == 11.5f && dog_read.border == 7));

    auto harris = random_model<ism::HarrisLaplace, ism::GrayPatch>();
    harris.extractor.detector = {.threshold = 3e-7f, .alpha = 0.05f, .least_laplacian = 0.1f, .border = 9};
    const auto harris_read = round_trip(harris).extractor.detector;
    CHECK((harris_read.threshold == 3e-7f && harris_read.alpha == 0.05f &&
           harris_read.least_laplacian == 0.1f && harris_read.border == 9));

    auto hessian = random_model<ism::HessianLaplace, ism::RootSift>();
    hessian.extractor.detector.scale_tolerance = 0.3f;
    CHECK(round_trip(hessian).extractor.detector.scale_tolerance == 0.3f);

    auto dense = random_model<ism::DenseGrid, ism::Sift>();
    dense.extractor.detector = {.spacing = 3.3f, .margin = 1, .first_scale = 1.5f, .scale_count = 2};
    const auto dense_read = round_trip(dense).extractor.detector;
    CHECK((dense_read.spacing == 3.3f && dense_read.first_scale == 1.5f && dense_read.scale_count == 2));
}

TEST_CASE("A model file keeps the descriptors of training features") {
    auto model = random_model<ism::DenseGrid, ism::RootSift>();
    model.memory = ism::Descriptors<float, 128>(140);
    for (std::size_t i = 0; i < model.memory.values().size(); ++i) model.memory.values()[i] = float(i) / 7;
    CHECK(round_trip(model).memory.size() == 140);
    const TemporaryFolder folder;
    model.memory.resize(3);
    ism::save_model(folder / "m", model);
    CHECK_THROWS_WITH((ism::load_model<ism::DenseGrid, ism::RootSift>(folder / "m")),
                      Catch::Contains("feature of an occurrence: expected below the 3 that are kept"));
}

TEST_CASE("A model file tells what is in it") {
    const TemporaryFolder folder;
    const auto model = random_model<ism::HarrisLaplace, ism::GrayPatch>();
    ism::save_model(folder / "m", model);
    const ism::ModelInfo info = ism::read_model_info(folder / "m");
    CHECK(info.detector == "harris-laplace");
    CHECK(info.descriptor == "gray-patch");
    CHECK(info.scalar == "U8");
    CHECK(info.dimension == 625);
    CHECK(info.words == 5);
    CHECK(info.occurrences == model.shapes.occurrences.size());
    CHECK(info.objects == 3);
    CHECK(info.class_names == model.shapes.class_names);
    CHECK(info.upsampling == 1.75);
    CHECK(info.max_sq_distance == 0.1);
    CHECK(info.reference_size_px == ism::reference_size_px);
    CHECK(info.format_version == 5);
    CHECK(info.parameters.find("\"alpha\"") != std::string::npos);
}

TEST_CASE("A model of another detector or descriptor is refused by name") {
    const TemporaryFolder folder;
    ism::save_model(folder / "m", random_model<ism::DenseGrid, ism::RootSift>());
    CHECK_THROWS_WITH((ism::load_model<ism::DenseGrid, ism::Sift>(folder / "m")),
                      Catch::Contains("descriptor: expected sift, got root-sift"));
    CHECK_THROWS_WITH((ism::load_model<ism::HessianLaplace, ism::RootSift>(folder / "m")),
                      Catch::Contains("detector: expected hessian-laplace, got dense"));
    ism::write_safetensors(folder / "other", {.tensors = {{"x", ism::make_tensor<float>({}, {0})}}});
    CHECK_THROWS_WITH(ism::read_model_info(folder / "other"),
                      Catch::Contains("expected a model of ism, got another safetensors file"));
    CHECK_THROWS_AS(ism::read_model_info(folder / "none"), FileError);
}

TEST_CASE("A model file that was cut off or altered at any place is refused") {
    const TemporaryFolder folder;
    ism::save_model(folder / "m", random_model<ism::DenseGrid, ism::RootSift>(2, 2, 3));
    const std::vector<std::uint8_t> whole = ism::read_bytes(folder / "m");
    std::size_t accepted = 0, tried = 0;
    const auto try_bytes = [&](std::span<const std::uint8_t> bytes) {
        ism::write_file(folder / "bad", bytes);
        ++tried;
        try {
            check_equal(ism::load_model<ism::DenseGrid, ism::RootSift>(folder / "bad"),
                        ism::load_model<ism::DenseGrid, ism::RootSift>(folder / "m"));
            ++accepted;  // only blanks of the header may change without changing the model
        } catch (const FileError& error) {
            if (std::string(error.what()).find((folder / "bad").string()) == std::string::npos)
                FAIL(error.what());
        }
    };
    for (std::size_t size = 0; size < whole.size(); size += 41) try_bytes(std::span(whole).first(size));
    CHECK(accepted == 0);
    for (std::size_t at = 0; at < whole.size(); at += 13) {
        std::vector<std::uint8_t> bytes = whole;
        bytes[at] ^= std::uint8_t(1 + at % 255);
        try_bytes(bytes);
    }
    CHECK(accepted <= 1);
    CHECK(tried > 200);
}

TEST_CASE("A model file that contradicts itself is refused") {
    CHECK(load_error([](auto&) {}) == "nothing thrown");
    using File = ism::TensorFile;
    const auto infinity = std::numeric_limits<float>::infinity();
    const std::vector<std::pair<std::string, std::function<void(File&)>>> cases = {
        {": words: expected finite numbers", [&](File& f) { set(f, "words", 3, infinity); }},
        {": mean_sq_length: expected 0 or more", [](File& f) { set(f, "mean_sq_length", 1, -1.0f); }},
        {": word_sizes: expected 1 or more", [](File& f) { set(f, "word_sizes", 0, 0u); }},
        {": group of a word: expected below 2, got 2", [](File& f) { set(f, "group", 0, 2u); }},
        {": first_occurrence: expected rising", [](File& f) { set(f, "first_occurrence", 1, 9u); }},
        {": first_occurrence: expected 0 to", [](File& f) { set(f, "first_occurrence", 0, 1u); }},
        {", occurrence 0: x, y", [&](File& f) { set(f, "occurrences", 0, ism::no_depth); }},
        {", occurrence 0: scale: expected above 0", [](File& f) { set(f, "occurrences", 2, 0.0f); }},
        {", occurrence 0: depth", [&](File& f) { set(f, "occurrences", 3, infinity); }},
        {", occurrence 1: weight", [](File& f) { set(f, "occurrences", 9, -0.5f); }},
        {", occurrence 0: class", [](File& f) { set(f, "occurrence_indices", 0, 1u); }},
        {", occurrence 0: object: expected below 3, got 3",
         [](File& f) { set(f, "occurrence_indices", 1, 3u); }},
        {", object 1: class: expected below 2", [](File& f) { set(f, "object_classes", 1, 2u); }},
        {", object 0: size: expected above 0 px", [](File& f) { set(f, "object_sizes", 2, 0.0f); }},
        {", object 0: mask size", [](File& f) { set(f, "mask_sizes", 0, 0u); }},
        {", object 0: mask size", [](File& f) { set(f, "mask_sizes", 0, 4000000000u); }},
        {", object 0: mask cells", [](File& f) { set(f, "mask_sizes", 0, 1000000u); }},
        {", object 0: mask run", [](File& f) { set(f, "mask_runs", 0, std::uint8_t(0)); }},
        {": appearance_first: expected rising numbers",
         [](File& f) { set(f, "appearance_first", 1, 9999u); }},
        {": appearance_first: expected 0 to", [](File& f) { set(f, "appearance_first", 2, 1u); }},
        {": appearance_bins: expected rising numbers below",
         [](File& f) { set(f, "appearance_bins", 2, 1u); }},
        {": appearance_bins: expected rising numbers below",
         [](File& f) { set(f, "appearance_bins", 3, 4000000000u); }},
        {": appearance: expected finite", [&](File& f) { set(f, "appearance_weights", 3, infinity); }},
        {": appearance: expected finite", [&](File& f) { set(f, "appearance_bias", 0, infinity); }},
        {": image names: expected 3, got 1", [](File& f) { f.metadata["images"] = R"(["a"])"; }},
        {": class names: expected each once", [](File& f) { f.metadata["class_names"] = R"(["a","a"])"; }},
        {": class names: expected 1 or more", [](File& f) { f.metadata["class_names"] = "[]"; }},
        {", class_names: expected texts", [](File& f) { f.metadata["class_names"] = "[3]"; }},
        {": max_sq_distance: expected 0 or more", [](File& f) { f.metadata["max_sq_distance"] = "-1"; }},
        {": reference_size_px: expected 200", [](File& f) { f.metadata["reference_size_px"] = "100"; }},
        {": format version: expected 5, got 1", [](File& f) { f.metadata["format_version"] = "1"; }},
        {": expected metadata 'parameters'", [](File& f) { f.metadata.erase("parameters"); }},
        {", parameters: extraction", [](File& f) { f.metadata["parameters"] = "{}"; }},
        {": expected a tensor 'mask_runs'", [](File& f) { f.tensors.erase("mask_runs"); }},
        {": tensor 'words'",
         [](File& f) {
             f.tensors["words"] = ism::make_tensor<std::uint8_t>({}, {0, 128});
         }},
        {": words: expected 1 or more",
         [](File& f) {
             f.tensors["words"] = ism::make_tensor<float>({}, {0, 128});
             f.tensors["mean_sq_length"] = ism::make_tensor<float>({}, {0});
             f.tensors["group"] = ism::make_tensor<std::uint32_t>({}, {0});
             f.tensors["word_sizes"] = ism::make_tensor<std::uint32_t>({}, {0});
         }},
    };
    for (const auto& [expected, change] : cases) {
        INFO(expected);
        CHECK(load_error(change).substr(0, expected.size()) == expected);
    }
    CHECK(load_error([](File& f) {
              std::string& text = f.metadata["parameters"];
              text.replace(text.find("\"spacing\""), 9, "\"spacimg\"");
          }).find("spacing") != std::string::npos);
}

TEST_CASE("A model of 5000 words and 30000 occurrences takes less than 20 MB") {
    const TemporaryFolder folder;
    auto model = random_model<ism::HessianLaplace, ism::RootSift>(5000, 6, 100);
    CHECK(model.shapes.occurrences.size() > 29000);
    const auto disc = [](int x, int y) { return std::hypot(x - 50, y - 50) < 40 ? 255 : 0; };
    while (model.shapes.objects.size() < 500) {
        ism::Mask mask(100, 100);
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 100; ++x) mask(x, y) = std::uint8_t(disc(x, y));
        model.shapes.objects.push_back({0, 200, 200, 50, mask, "another image"});
    }
    ism::save_model(folder / "m", model);
    CHECK(std::filesystem::file_size(folder / "m") < 20'000'000);
    CHECK(std::filesystem::file_size(folder / "m") < 4'100'000);
    CHECK(ism::load_model<ism::HessianLaplace, ism::RootSift>(folder / "m").shapes.objects[400].mask ==
          model.shapes.objects[400].mask);
}
