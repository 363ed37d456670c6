// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ism/model/model.hpp"
#include "ism/model_file/model_parameters.hpp"
#include "ism/model_file/model_shapes.hpp"
#include "ism/model_file/safetensors.hpp"

namespace ism {

/// @brief What a model file says of itself.
struct ModelInfo {
    std::int64_t format_version = 0;
    std::string detector, descriptor;  ///< D::name, Desc::name
    std::string scalar;                ///< of the descriptor: "F32" or "U8"
    std::size_t dimension = 0;         ///< numbers of a descriptor
    std::size_t words = 0, occurrences = 0, objects = 0;
    std::vector<std::string> class_names;
    double max_sq_distance = 0;    ///< up to which a descriptor matches a word
    double upsampling = 1;         ///< of images before features are searched
    double reference_size_px = 0;  ///< that scale 1 stands for
    std::string parameters;        ///< of detector, descriptor and extraction, as JSON
};

namespace detail {

inline constexpr std::string_view model_format = "ism model";
inline constexpr std::int64_t model_format_version = 5;

/// A number that stands in the metadata.
[[nodiscard]] inline double metadata_number(const TensorFile& file, const std::string& key) {
    const std::string place = file.source + ", metadata";
    return to_number(parse_json(metadata_text(file, key), place + " '" + key + "'"), key, place);
}

/// Reads a file and makes sure that it is a whole model of this version.
[[nodiscard]] inline TensorFile open_model(const std::filesystem::path& path) {
    TensorFile file = read_safetensors(path);
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
    return file;
}

[[nodiscard]] inline ModelInfo model_info(const TensorFile& file) {
    ModelInfo info{.format_version = model_format_version,
                   .detector = metadata_text(file, "detector"),
                   .descriptor = metadata_text(file, "descriptor"),
                   .scalar = metadata_text(file, "scalar"),
                   .class_names = read_class_names(file),
                   .max_sq_distance = metadata_number(file, "max_sq_distance"),
                   .reference_size_px = metadata_number(file, "reference_size_px"),
                   .parameters = metadata_text(file, "parameters")};
    if (info.scalar == type_name(tensor_type<std::uint8_t>))
        (void)values<std::uint8_t>(file, "words", {any_length, any_length});
    else
        (void)values<float>(file, "words", {any_length, any_length});
    info.words = tensor(file, "words").shape[0], info.dimension = tensor(file, "words").shape[1];
    info.occurrences = values<float>(file, "occurrences", {any_length, 5}).size() / 5;
    info.objects = values<std::uint32_t>(file, "object_classes", {any_length}).size();
    const std::string place = file.source + ", parameters";
    const Json extraction = member(parse_json(info.parameters, place), "extraction", place);
    info.upsampling = number_member(extraction, "upsampling", place);
    return info;
}

/// The words, one by one checked.
template <std::size_t Dimension, DescriptorScalar Scalar>
[[nodiscard]] Codebook<Dimension, Scalar> codebook_from_tensors(const TensorFile& file, std::size_t words,
                                                                std::size_t classes) {
    const auto numbers = values<Scalar>(file, "words", {words, Dimension});
    const auto lengths = values<float>(file, "mean_sq_length", {words});
    const auto groups = values<std::uint32_t>(file, "group", {words});
    const auto sizes = values<std::uint32_t>(file, "word_sizes", {words});
    Codebook<Dimension, Scalar> codebook;
    codebook.words = Descriptors<Scalar, Dimension>(words);
    codebook.max_sq_distance = metadata_number(file, "max_sq_distance");
    expect<FileError>(words > 0, lazy_text(file.source, ": words"), "1 or more", 0);
    expect<FileError>(codebook.max_sq_distance >= 0, lazy_text(file.source, ": max_sq_distance"), "0 or more",
                      codebook.max_sq_distance);
    for (const Scalar number : numbers)
        expect<FileError>(std::isfinite(float(number)), lazy_text(file.source, ": words"), "finite numbers",
                          float(number));
    for (const float length : lengths)
        expect<FileError>(std::isfinite(length) && length >= 0, lazy_text(file.source, ": mean_sq_length"),
                          "0 or more", length);
    for (const std::uint32_t group : groups)
        expect<FileError>(group < classes, lazy_text(file.source, ": group of a word"),
                          lazy_text("below ", classes), group);
    for (const std::uint32_t size : sizes)
        expect<FileError>(size > 0, lazy_text(file.source, ": word_sizes"), "1 or more", size);
    std::copy(numbers.begin(), numbers.end(), codebook.words.values().begin());
    codebook.mean_sq_length.assign(lengths.begin(), lengths.end());
    codebook.group.assign(groups.begin(), groups.end());
    codebook.sizes.assign(sizes.begin(), sizes.end());
    return codebook;
}

/// The descriptors of training features, where they were kept, one by one checked.
template <std::size_t Dimension, DescriptorScalar Scalar>
[[nodiscard]] Descriptors<Scalar, Dimension> memory_from_tensor(const TensorFile& file,
                                                                const Shapes& shapes) {
    if (!file.tensors.contains("memory")) return {};
    const auto numbers = values<Scalar>(file, "memory", {any_length, Dimension});
    for (const Scalar number : numbers)
        expect<FileError>(std::isfinite(float(number)), lazy_text(file.source, ": memory"), "finite numbers",
                          float(number));
    Descriptors<Scalar, Dimension> memory(numbers.size() / Dimension);
    std::copy(numbers.begin(), numbers.end(), memory.values().begin());
    for (const Occurrence& o : shapes.occurrences)
        expect<FileError>(o.feature < memory.size(), lazy_text(file.source, ": feature of an occurrence"),
                          lazy_text("below the ", memory.size(), " that are kept"), o.feature);
    return memory;
}

}  // namespace detail

/// @brief Writes a model as a safetensors file, at one stroke. The same model gives the same bytes.
/// @throws FileError where the file cannot be written, a name is not UTF-8, or load_model() would refuse the
/// sizes.
template <Detector D, Descriptor Desc>
void save_model(const std::filesystem::path& path, const Model<D, Desc>& model) {
    using detail::Json;
    TensorFile file{.source = detail::file_text(path)};
    // A member that is added to Codebook does not compile here until it is kept too.
    [[maybe_unused]] const auto& [rows, lengths, groups, max_sq_distance, sizes] = model.codebook;
    const std::size_t words = model.codebook.size();
    expect<FileError>(words > 0 && model.shapes.first.size() == words + 1,
                      lazy_text(file.source, ": word ranges"), words + 1, model.shapes.first.size());
    ExtractOptions extraction = model.extractor.options;
    Json options = Json::object();
    detail::each_extract_parameter(extraction, detail::WriteParameter{options, file.source});
    const Json parameters = {
        {"detector", detail::parameters_to_json(model.extractor.detector, file.source)},
        {"descriptor", detail::parameters_to_json(model.extractor.descriptor, file.source)},
        {"extraction", options}};
    file.metadata = {{"format", std::string(detail::model_format)},
                     {"format_version", std::to_string(detail::model_format_version)},
                     {"detector", std::string(D::name)},
                     {"descriptor", std::string(Desc::name)},
                     {"scalar", std::string(type_name(tensor_type<typename Desc::Scalar>))},
                     {"parameters", detail::dump_json(parameters, file.source)},
                     {"max_sq_distance", Json(model.codebook.max_sq_distance).dump()},
                     {"reference_size_px", Json(reference_size_px).dump()},
                     {"mask_cell_px", Json(mask_cell_px).dump()}};
    file.tensors["words"] =
        make_tensor<typename Desc::Scalar>(model.codebook.words.values(), {words, Desc::dimension});
    file.tensors["mean_sq_length"] = make_tensor<float>(model.codebook.mean_sq_length, {words});
    file.tensors["group"] = make_tensor<std::uint32_t>(model.codebook.group, {words});
    file.tensors["word_sizes"] = make_tensor<std::uint32_t>(model.codebook.sizes, {words});
    if (!model.memory.empty())
        file.tensors["memory"] =
            make_tensor<typename Desc::Scalar>(model.memory.values(), {model.memory.size(), Desc::dimension});
    detail::shapes_to_tensors(model.shapes, file);
    write_safetensors(path, file);
}

/// @brief What a model file says of itself, whatever its detector and descriptor.
/// @throws FileError where it cannot be read, is no model, of another format version, or was altered.
[[nodiscard]] inline ModelInfo read_model_info(const std::filesystem::path& path) {
    return detail::model_info(detail::open_model(path));
}

/// @brief Reads a model of this detector and descriptor.
/// @throws FileError as read_model_info() does, and where the model is of another detector or descriptor or
/// contradicts itself.
template <Detector D, Descriptor Desc>
[[nodiscard]] Model<D, Desc> load_model(const std::filesystem::path& path) {
    const TensorFile file = detail::open_model(path);
    const ModelInfo info = detail::model_info(file);
    expect<FileError>(info.detector == D::name, lazy_text(file.source, ": detector"), D::name, info.detector);
    expect<FileError>(info.descriptor == Desc::name, lazy_text(file.source, ": descriptor"), Desc::name,
                      info.descriptor);
    const std::string_view scalar = type_name(tensor_type<typename Desc::Scalar>);
    expect<FileError>(info.scalar == scalar, lazy_text(file.source, ": descriptor scalar"), scalar,
                      info.scalar);
    expect<FileError>(info.dimension == Desc::dimension, lazy_text(file.source, ": descriptor dimension"),
                      Desc::dimension, info.dimension);
    Model<D, Desc> model;
    const std::string place = file.source + ", parameters";
    const detail::Json parameters = detail::parse_json(info.parameters, place);
    detail::parameters_from_json(detail::member(parameters, "detector", place), place + " of the detector",
                                 model.extractor.detector);
    detail::parameters_from_json(detail::member(parameters, "descriptor", place),
                                 place + " of the descriptor", model.extractor.descriptor);
    detail::read_parameters(
        detail::member(parameters, "extraction", place), place + " of extraction",
        [&](const auto& read) { detail::each_extract_parameter(model.extractor.options, read); });
    expect<FileError>(info.upsampling > 0, lazy_text(place, ": upsampling"), "above 0", info.upsampling);
    model.codebook = detail::codebook_from_tensors<Desc::dimension, typename Desc::Scalar>(
        file, info.words, info.class_names.size());
    model.shapes = detail::shapes_from_tensors(file, info.words);
    model.memory = detail::memory_from_tensor<Desc::dimension, typename Desc::Scalar>(file, model.shapes);
    return model;
}

}  // namespace ism
