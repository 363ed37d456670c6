// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "ism/io/json.hpp"
#include "ism/io/paths.hpp"
#include "ism/io/write_file.hpp"
#include "ism/model/model.hpp"
#include "ism/model_file/judge_tensors.hpp"
#include "ism/model_file/patch_tensors.hpp"
#include "ism/model_file/safetensors.hpp"
#include "ism/model_file/settings_json.hpp"
#include "ism/model_file/shape_tensors.hpp"
#include "ism/model_file/surface_tensors.hpp"
#include "ism/model_file/training_tensors.hpp"

namespace ism {

namespace detail {

inline constexpr std::string_view model_format = "ism model";
inline constexpr std::int64_t model_format_version = 18;

/// A number that stands in the metadata.
[[nodiscard]] inline double metadata_number(const TensorFile& file, const std::string& key) {
    const std::string place = file.source + ", metadata";
    return to_number(parse_json(metadata_text(file, key), place + " '" + key + "'"), key, place);
}

/// Makes sure that a file is a whole model of this version.
inline void check_model(const TensorFile& file) {
    const auto format = file.metadata.find("format");
    expect<FileError>(format != file.metadata.end() && format->second == model_format, file.source,
                      "a model of ism", "another safetensors file");
    const double version = metadata_number(file, "format_version");
    expect<FileError>(version == double(model_format_version), lazy_text(file.source, ": format version"),
                      model_format_version, version);
    expect<FileError>(file.has_checksum, file.source, "a checksum", "none");
    for (const auto& [key, here] :
         {std::pair("reference_size_px", reference_size_px), std::pair("mask_cell_px", mask_cell_px)})
        expect<FileError>(metadata_number(file, key) == here, lazy_text(file.source, ": ", key), here,
                          metadata_text(file, key));
}

[[nodiscard]] inline TensorFile open_model(const std::filesystem::path& path) {
    TensorFile file = read_safetensors(path);
    check_model(file);
    return file;
}

inline void codebook_to_tensors(const Codebook& codebook, const std::string& prefix, TensorFile& file) {
    const std::size_t words = codebook.size();
    file.tensors[prefix + "words"] =
        make_tensor<float>(codebook.means().values(), {words, codebook.dimension()});
    file.tensors[prefix + "mean_sq_length"] = make_tensor<float>(codebook.mean_sq_lengths(), {words});
    file.tensors[prefix + "word_group"] = make_tensor<std::uint32_t>(codebook.groups(), {words});
    file.tensors[prefix + "word_size"] = make_tensor<std::uint32_t>(codebook.sizes(), {words});
}

/// The words, one by one checked.
[[nodiscard]] inline Codebook codebook_from_tensors(const TensorFile& file, const std::string& prefix,
                                                    std::size_t dimension, double max_sq_distance,
                                                    std::size_t classes) {
    const auto means = values<float>(file, prefix + "words", {any_length, dimension});
    const std::size_t words = means.size() / dimension;
    const auto lengths = values<float>(file, prefix + "mean_sq_length", {words});
    const auto groups = values<std::uint32_t>(file, prefix + "word_group", {words});
    const auto sizes = values<std::uint32_t>(file, prefix + "word_size", {words});
    expect<FileError>(words > 0, lazy_text(file.source, ": words"), "1 or more", 0);
    for (const float number : means)
        expect<FileError>(std::isfinite(number), lazy_text(file.source, ": words"), "finite numbers", number);
    Codebook codebook(dimension, max_sq_distance);
    for (std::size_t w = 0; w < words; ++w) {
        expect<FileError>(std::isfinite(lengths[w]) && lengths[w] >= 0,
                          lazy_text(file.source, ": mean_sq_length"), "0 or more", lengths[w]);
        expect<FileError>(groups[w] < classes, lazy_text(file.source, ": group of a word"),
                          lazy_text("below ", classes), groups[w]);
        expect<FileError>(sizes[w] > 0, lazy_text(file.source, ": word_size"), "1 or more", sizes[w]);
        codebook.push_back({means.subspan(w * dimension, dimension), lengths[w], sizes[w], groups[w]});
    }
    return codebook;
}

[[nodiscard]] inline std::string channel_prefix(std::size_t channel) {
    return join_text("channel_", channel, "_");
}

/// What the names of a model within a model begin with.
inline constexpr std::string_view rgbd_prefix = "rgbd/";

/// How messages name the model for depth within the model of a file.
[[nodiscard]] inline std::string rgbd_source(const std::string& source) {
    return source + ", model for depth";
}

/// The tensors of a model, as save_model() writes them.
[[nodiscard]] inline TensorFile model_to_tensors(const Model& model, const std::string& source) {
    TensorFile file{.source = source};
    // A member that is added to Model does not compile here until it is kept too.
    const auto& [channels, shapes, box_classifier, calibration, templates, patch_classifier, cue_weights,
                 figures, typical_sizes, template_calibration, exemplars, figure_colors, typical_masks,
                 placings, mask_judge, training, rgbd] = model;
    expect<FileError>(model.words() > 0 && shapes.occurrences.size() == model.words(),
                      lazy_text(source, ": words with occurrences"), model.words(),
                      shapes.occurrences.size());
    Json list = Json::array();
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const auto& [settings, codebook, neighbours] = channels[c];
        Json channel = settings_to_json(settings, source);
        channel["max_sq_distance"] = codebook.max_sq_distance();
        channel["neighbours"] = neighbours;
        list.push_back(channel);
        codebook_to_tensors(codebook, channel_prefix(c), file);
    }
    const auto& [images, features_found, features_used] = training;
    file.metadata = {
        {"format", std::string(model_format)},
        {"format_version", join_text(model_format_version)},
        {"channels", dump_json(list, source)},
        {"training",
         Json{{"images", images}, {"features_found", features_found}, {"features_used", features_used}}
             .dump()},
        {"reference_size_px", Json(reference_size_px).dump()},
        {"mask_cell_px", Json(mask_cell_px).dump()}};
    shapes_to_tensors(shapes, file);
    box_classifier_to_tensors(box_classifier, file);
    calibration_to_tensors(calibration, "calibration", file);
    templates_to_tensors(templates, file);
    patch_classifier_to_tensors(patch_classifier, file);
    cue_weights_to_tensor(cue_weights, file);
    figures_to_tensor(figures, file);
    typical_sizes_to_tensor(typical_sizes, file);
    calibration_to_tensors(template_calibration, "template_calibration", file);
    exemplars_to_tensors(exemplars, file);
    figure_colors_to_tensors(figure_colors, file);
    typical_masks_to_tensor(typical_masks, file);
    placings_to_tensor(placings, file);
    points_to_tensors(shapes.objects, file);
    frames_to_tensors(shapes.frames, file);
    mask_judge_to_tensors(mask_judge, file);
    expect<FileError>(rgbd.size() <= 1, lazy_text(source, ": models for depth"), "at most 1", rgbd.size());
    for (const Model& inner : rgbd) {
        TensorFile part = model_to_tensors(inner, rgbd_source(source));
        for (auto& [name, text] : part.metadata)
            file.metadata[std::string(rgbd_prefix) + name] = std::move(text);
        for (auto& [name, tensor] : part.tensors)
            file.tensors[std::string(rgbd_prefix) + name] = std::move(tensor);
    }
    return file;
}

/// What has names that begin with `prefix`, without it.
[[nodiscard]] inline TensorFile part_of(const TensorFile& file, std::string_view prefix, std::string source) {
    TensorFile part{.source = std::move(source)};
    for (const auto& [name, text] : file.metadata)
        if (name.starts_with(prefix)) part.metadata[name.substr(prefix.size())] = text;
    for (const auto& [name, tensor] : file.tensors)
        if (name.starts_with(prefix)) part.tensors[name.substr(prefix.size())] = tensor;
    return part;
}

[[nodiscard]] inline Model model_from_tensors(const TensorFile& file) {
    Model model;
    const std::size_t classes = read_class_names(file).size();
    const std::string place = file.source + ", channels";
    const Json list = parse_json(metadata_text(file, "channels"), place);
    if (!list.is_array() || list.empty())
        throw FileError(place + ": expected an array of 1 or more, got " + json_text(list));
    for (std::size_t c = 0; c < list.size(); ++c) {
        Channel channel{.features = settings_from_json(list[c], place)};
        const double max_sq_distance = number_member(list[c], "max_sq_distance", place);
        expect<FileError>(max_sq_distance >= 0, lazy_text(place, ": max_sq_distance"), "0 or more",
                          max_sq_distance);
        channel.codebook = codebook_from_tensors(file, channel_prefix(c), channel.features.dimension,
                                                 max_sq_distance, classes);
        const std::int64_t neighbours = integer_member(list[c], "neighbours", place);
        expect<FileError>(neighbours >= 0 && neighbours <= 1000, lazy_text(place, ": neighbours"),
                          "0 ... 1000", neighbours);
        channel.neighbours = static_cast<std::size_t>(neighbours);
        model.channels.push_back(std::move(channel));
    }
    const std::string training_place = file.source + ", training";
    const Json training = parse_json(metadata_text(file, "training"), training_place);
    const auto count = [&](const char* key) {
        return static_cast<std::size_t>(
            std::max<std::int64_t>(0, integer_member(training, key, training_place)));
    };
    model.training = {count("images"), count("features_found"), count("features_used")};
    model.shapes = shapes_from_tensors(file, model.words());
    model.box_classifier = box_classifier_from_tensors(file, model.words(), classes);
    model.calibration = calibration_from_tensors(file, "calibration", classes);
    model.templates = templates_from_tensors(file, classes);
    model.patch_classifier = patch_classifier_from_tensors(file, classes);
    model.cue_weights = cue_weights_from_tensor(file);
    model.figures = figures_from_tensor(file, classes);
    model.typical_sizes = typical_sizes_from_tensor(file, classes);
    model.template_calibration = calibration_from_tensors(file, "template_calibration", classes);
    model.exemplars = exemplars_from_tensors(file, model.shapes.objects.size());
    model.figure_colors = figure_colors_from_tensors(file, classes);
    model.typical_masks = typical_masks_from_tensor(file, classes);
    model.placings = placings_from_tensor(file, classes);
    model.shapes.objects = with_points_from_tensors(std::move(model.shapes.objects), file);
    model.shapes.frames = frames_from_tensors(file, model.shapes.occurrences.values());
    model.mask_judge = mask_judge_from_tensors(file, model.shapes.objects);
    if (const TensorFile inner = part_of(file, rgbd_prefix, rgbd_source(file.source));
        !inner.tensors.empty()) {
        model.rgbd.push_back(model_from_tensors(inner));
        expect<FileError>(model.rgbd[0].rgbd.empty(), inner.source, "none within it", "one");
        expect<FileError>(model.rgbd[0].shapes.class_names == model.shapes.class_names,
                          lazy_text(file.source, ": classes of the model for depth"), "those of the model",
                          "others");
    }
    return model;
}

}  // namespace detail

/// @brief Writes a model as a safetensors file, atomically. The same model gives the same bytes.
/// @param lessons  also keeps the training features, for load_training_features(): more can then be learnt
/// @throws FileError where the file cannot be written, a name is not UTF-8, or load_model() or
/// load_training_features() would refuse it; nothing is written then.
inline void save_model(const std::filesystem::path& path, const Model& model,
                       const TrainingFeatures* lessons = nullptr) {
    TensorFile file = detail::model_to_tensors(model, file_text(path));
    const Model read = detail::model_from_tensors(file);
    if (lessons != nullptr) {
        detail::training_to_tensors(*lessons, file);
        static_cast<void>(detail::training_from_tensors(file, read));
    }
    write_safetensors(path, file);
}

/// @brief Reads a model, whatever its features.
/// @throws FileError where it cannot be read, is no model, of another format version, was altered or
/// contradicts itself.
[[nodiscard]] inline Model load_model(const std::filesystem::path& path) {
    return detail::model_from_tensors(detail::open_model(path));
}

/// @brief Reads a model of this detector and descriptor.
/// @throws FileError as the other load_model() does, and where the model is of another detector or
/// descriptor.
template <Detector D, Descriptor Desc>
[[nodiscard]] TypedModel<D, Desc> load_model(const std::filesystem::path& path) {
    Model model = load_model(path);
    return at_place(file_text(path), [&] { return TypedModel<D, Desc>(std::move(model)); });
}

/// @brief Whether save_model() kept training features beside a model, so that more can be learnt.
/// @throws FileError where the file cannot be read or is no model.
[[nodiscard]] inline bool has_training_features(const std::filesystem::path& path) {
    return detail::open_model(path).tensors.contains("training_views");
}

/// @brief Reads the training features that save_model() kept beside a model: what learn() made it of, but
/// descriptors of whole images rounded to 8 bits a number.
/// @throws FileError as load_model() does, and where none were kept.
[[nodiscard]] inline TrainingFeatures load_training_features(const std::filesystem::path& path) {
    const TensorFile file = detail::open_model(path);
    const Model model = detail::model_from_tensors(file);
    return detail::training_from_tensors(file, model);
}

}  // namespace ism
