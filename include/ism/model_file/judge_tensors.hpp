// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/hog/box_template.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/model/box_cues.hpp"
#include "ism/model/calibration.hpp"
#include "ism/model/figure_colors.hpp"
#include "ism/model/mask_exemplar.hpp"
#include "ism/model/placing.hpp"
#include "ism/model/typical_mask.hpp"
#include "ism/model_file/shape_tensors.hpp"
#include "ism/model_file/tensor.hpp"

/// What judges hypotheses and cuts them out, as tensors.
namespace ism::detail {

inline void box_classifier_to_tensors(const BoxClassifier& classifier, TensorFile& file) {
    std::vector<std::uint32_t> bins;
    std::vector<float> weights;
    for (const SparseEntry& weight : classifier.weights.values()) {
        bins.push_back(weight.index);
        weights.push_back(weight.value);
    }
    file.tensors["box_classifier_offsets"] = offsets_tensor(classifier.weights.offsets());
    file.tensors["box_classifier_bins"] = make_tensor<std::uint32_t>(bins, {bins.size()});
    file.tensors["box_classifier_weights"] = make_tensor<float>(weights, {weights.size()});
    file.tensors["box_classifier_bias"] = make_tensor<float>(classifier.bias, {classifier.bias.size()});
}

/// Reads what box_classifier_to_tensors() wrote, for this number of words and classes; it may be empty.
[[nodiscard]] inline BoxClassifier box_classifier_from_tensors(const TensorFile& file, std::size_t words,
                                                               std::size_t classes) {
    const auto bias = values<float>(file, "box_classifier_bias", {any_length});
    expect<FileError>(bias.empty() || bias.size() == classes, lazy_text(file.source, ": box_classifier_bias"),
                      lazy_text("0 or ", classes, " numbers"), bias.size());
    const auto weights = values<float>(file, "box_classifier_weights", {any_length});
    const auto bins = values<std::uint32_t>(file, "box_classifier_bins", {weights.size()});
    const auto offsets = offsets_from_tensor(file, "box_classifier_offsets", bias.size(), weights.size());
    for (const auto& numbers : {bias, weights})
        for (const float number : numbers)
            expect<FileError>(std::isfinite(number), lazy_text(file.source, ": box classifier"),
                              "finite numbers", number);
    BoxClassifier classifier;
    for (std::size_t c = 0; c < bias.size(); ++c) {
        std::vector<SparseEntry> own;
        for (std::size_t i = offsets[c]; i < offsets[c + 1]; ++i) {
            expect<FileError>(
                bins[i] < BoxClassifier::cells * words && (own.empty() || own.back().index < bins[i]),
                lazy_text(file.source, ": box_classifier_bins"),
                lazy_text("rising numbers below ", BoxClassifier::cells * words), bins[i]);
            own.push_back({bins[i], weights[i]});
        }
        classifier.push_back(own, bias[c]);
    }
    return classifier;
}

inline void calibration_to_tensors(const Calibration& calibration, const std::string& name,
                                   TensorFile& file) {
    std::vector<double> curves;
    for (const auto& [slope, offset] : calibration.curves) curves.insert(curves.end(), {slope, offset});
    file.tensors[name] = make_tensor<double>(curves, {calibration.curves.size(), 2});
}

[[nodiscard]] inline Calibration calibration_from_tensors(const TensorFile& file, const std::string& name,
                                                          std::size_t classes) {
    const auto curves = values<double>(file, name, {any_length, 2});
    expect<FileError>(curves.empty() || curves.size() == 2 * classes, lazy_text(file.source, ": ", name),
                      lazy_text("0 or ", classes, " curves"), curves.size() / 2);
    Calibration calibration;
    for (std::size_t c = 0; 2 * c < curves.size(); ++c) {
        expect<FileError>(std::isfinite(curves[2 * c]) && std::isfinite(curves[2 * c + 1]),
                          lazy_text(file.source, ": calibration"), "finite numbers",
                          lazy_text(curves[2 * c], ", ", curves[2 * c + 1]));
        calibration.curves.push_back({curves[2 * c], curves[2 * c + 1]});
    }
    return calibration;
}

/// The weights of all classes one after another; how many each has follows from its grid.
inline void templates_to_tensors(std::span<const BoxTemplate> templates, TensorFile& file) {
    std::vector<std::uint32_t> grids;
    std::vector<float> numbers, all_weights;
    for (const auto& [grid, bias, log_aspect, log_aspect_spread, weights] : templates) {
        grids.insert(grids.end(),
                     {std::uint32_t(grid.columns), std::uint32_t(grid.rows), std::uint32_t(grid.ring)});
        numbers.insert(numbers.end(), {bias, log_aspect, log_aspect_spread});
        all_weights.insert(all_weights.end(), weights.begin(), weights.end());
    }
    file.tensors["template_grids"] = make_tensor<std::uint32_t>(grids, {templates.size(), 3});
    file.tensors["template_numbers"] = make_tensor<float>(numbers, {templates.size(), 3});
    file.tensors["template_weights"] = make_tensor<float>(all_weights, {all_weights.size()});
}

[[nodiscard]] inline std::vector<BoxTemplate> templates_from_tensors(const TensorFile& file,
                                                                     std::size_t classes) {
    const auto grids = values<std::uint32_t>(file, "template_grids", {any_length, 3});
    const auto numbers = values<float>(file, "template_numbers", {grids.size() / 3, 3});
    const auto weights = values<float>(file, "template_weights", {any_length});
    expect<FileError>(grids.empty() || grids.size() == 3 * classes, lazy_text(file.source, ": templates"),
                      lazy_text("0 or ", classes), grids.size() / 3);
    for (const auto& part : {numbers, weights})
        for (const float number : part)
            expect<FileError>(std::isfinite(number), lazy_text(file.source, ": templates"), "finite numbers",
                              number);
    std::vector<BoxTemplate> templates;
    std::size_t first = 0;
    for (std::size_t c = 0; 3 * c < grids.size(); ++c) {
        const std::uint32_t* grid = grids.data() + 3 * c;
        expect<FileError>(grid[0] >= 1 && grid[0] <= 1000 && grid[1] >= 1 && grid[1] <= 1000 && grid[2] <= 1,
                          lazy_text(file.source, ": template_grids"),
                          "1 ... 1000 columns and rows, a ring or none",
                          lazy_text(grid[0], "x", grid[1], ", ", grid[2]));
        expect<FileError>(numbers[3 * c + 2] > 0, lazy_text(file.source, ": spread of a template's aspect"),
                          "above 0", numbers[3 * c + 2]);
        BoxTemplate one{.grid = {int(grid[0]), int(grid[1]), grid[2] != 0},
                        .bias = numbers[3 * c],
                        .log_aspect = numbers[3 * c + 1],
                        .log_aspect_spread = numbers[3 * c + 2]};
        const std::size_t count = one.grid.cells() * cell_numbers;
        expect<FileError>(count <= weights.size() - first, lazy_text(file.source, ": template_weights"),
                          lazy_text(first + count, " or more"), weights.size());
        one.weights.assign(weights.begin() + std::ptrdiff_t(first),
                           weights.begin() + std::ptrdiff_t(first + count));
        first += count;
        templates.push_back(std::move(one));
    }
    expect<FileError>(first == weights.size(), lazy_text(file.source, ": template_weights"), first,
                      weights.size());
    return templates;
}

inline void cue_weights_to_tensor(const CueWeights& weights, TensorFile& file) {
    const auto& [patches, words, votes, share, contrast, colors, size] = weights;
    file.tensors["cue_weights"] =
        make_tensor<double>(std::array{patches, words, votes, share, contrast, colors, size}, {7});
}

[[nodiscard]] inline CueWeights cue_weights_from_tensor(const TensorFile& file) {
    const auto weights = values<double>(file, "cue_weights", {7});
    for (const double weight : weights)
        expect<FileError>(weight >= 0 && weight <= 1000, lazy_text(file.source, ": cue_weights"),
                          "0 ... 1000", weight);
    return {weights[0], weights[1], weights[2], weights[3], weights[4], weights[5], weights[6]};
}

inline void figures_to_tensor(std::span<const ClassFigure> figures, TensorFile& file) {
    std::vector<float> numbers;
    for (const ClassFigure& figure : figures) numbers.insert(numbers.end(), figure.begin(), figure.end());
    file.tensors["class_figures"] = make_tensor<float>(numbers, {figures.size(), figure_numbers});
}

[[nodiscard]] inline std::vector<ClassFigure> figures_from_tensor(const TensorFile& file,
                                                                  std::size_t classes) {
    const auto numbers = values<float>(file, "class_figures", {any_length, figure_numbers});
    const std::size_t count = numbers.size() / figure_numbers;
    expect<FileError>(count == 0 || count == classes, lazy_text(file.source, ": class_figures"),
                      lazy_text("0 or ", classes), count);
    for (const float number : numbers)
        expect<FileError>(number >= 0 && number <= 1, lazy_text(file.source, ": class_figures"), "0 ... 1",
                          number);
    std::vector<ClassFigure> figures;
    for (std::size_t c = 0; c < count; ++c) {
        const auto own = numbers.subspan(c * figure_numbers, figure_numbers);
        figures.emplace_back(own.begin(), own.end());
    }
    return figures;
}

inline void exemplars_to_tensors(std::span<const MaskExemplar> exemplars, TensorFile& file) {
    std::vector<std::uint32_t> objects;
    std::vector<std::uint8_t> all_cells;
    for (const auto& [object, cells] : exemplars) {
        objects.push_back(object);
        all_cells.insert(all_cells.end(), cells.begin(), cells.end());
    }
    file.tensors["exemplar_objects"] = make_tensor<std::uint32_t>(objects, {objects.size()});
    file.tensors["exemplar_cells"] = make_tensor<std::uint8_t>(all_cells, {objects.size(), exemplar_bytes});
}

[[nodiscard]] inline std::vector<MaskExemplar> exemplars_from_tensors(const TensorFile& file,
                                                                      std::size_t object_count) {
    const auto objects = values<std::uint32_t>(file, "exemplar_objects", {any_length});
    const auto cells = values<std::uint8_t>(file, "exemplar_cells", {objects.size(), exemplar_bytes});
    std::vector<MaskExemplar> exemplars;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        expect<FileError>(objects[i] < object_count, lazy_text(file.source, ": object of an exemplar"),
                          lazy_text("below ", object_count), objects[i]);
        const auto own = cells.subspan(i * exemplar_bytes, exemplar_bytes);
        exemplars.push_back({objects[i], {own.begin(), own.end()}});
    }
    return exemplars;
}

inline void typical_masks_to_tensor(std::span<const TypicalMask> masks, TensorFile& file) {
    std::vector<double> numbers;
    for (const TypicalMask& mask : masks)
        for (const auto& values : {mask.mean.values(), mask.deviation.values()})
            numbers.insert(numbers.end(), values.begin(), values.end());
    file.tensors["typical_masks"] = make_tensor<double>(numbers, {masks.size(), 2, 3});
}

[[nodiscard]] inline std::vector<TypicalMask> typical_masks_from_tensor(const TensorFile& file,
                                                                        std::size_t classes) {
    const auto numbers = values<double>(file, "typical_masks", {any_length, 2, 3});
    const std::size_t count = numbers.size() / 6;
    expect<FileError>(count == 0 || count == classes, lazy_text(file.source, ": typical_masks"),
                      lazy_text("0 or ", classes), count);
    std::vector<TypicalMask> masks;
    for (std::size_t c = 0; c < count; ++c) {
        const auto own = numbers.subspan(6 * c, 6);
        for (std::size_t k = 0; k < own.size(); ++k)
            expect<FileError>(std::isfinite(own[k]) && (k < 3 || own[k] >= 0),
                              lazy_text(file.source, ": typical_masks"),
                              "finite numbers, deviations of 0 or more", own[k]);
        masks.push_back({.mean = {own[0], own[1], own[2]}, .deviation = {own[3], own[4], own[5]}});
    }
    return masks;
}

/// Of each class: of square pixels, of parts of the picture.
inline void typical_sizes_to_tensor(std::span<const TypicalSize> sizes, TensorFile& file) {
    std::vector<double> numbers;
    for (const TypicalSize& size : sizes) numbers.insert(numbers.end(), {size.log_px, size.log_part});
    file.tensors["typical_sizes"] = make_tensor<double>(numbers, {sizes.size(), 2});
}

[[nodiscard]] inline std::vector<TypicalSize> typical_sizes_from_tensor(const TensorFile& file,
                                                                        std::size_t classes) {
    const auto numbers = values<double>(file, "typical_sizes", {any_length, 2});
    const std::size_t count = numbers.size() / 2;
    expect<FileError>(count == 0 || count == classes, lazy_text(file.source, ": typical_sizes"),
                      lazy_text("0 or ", classes), count);
    for (const double number : numbers)
        expect<FileError>(std::isfinite(number), lazy_text(file.source, ": typical_sizes"), "finite numbers",
                          number);
    std::vector<TypicalSize> sizes;
    for (std::size_t c = 0; c < count; ++c) sizes.push_back({numbers[2 * c], numbers[2 * c + 1]});
    return sizes;
}

/// Of each class and each side, left, top, right, bottom: share and offset.
inline void placings_to_tensor(std::span<const Placing> placings, TensorFile& file) {
    std::vector<double> numbers;
    for (const Placing& placing : placings)
        for (const auto& [share, offset] : placing.sides) numbers.insert(numbers.end(), {share, offset});
    file.tensors["placings"] = make_tensor<double>(numbers, {placings.size(), 4, 2});
}

[[nodiscard]] inline std::vector<Placing> placings_from_tensor(const TensorFile& file, std::size_t classes) {
    const auto numbers = values<double>(file, "placings", {any_length, 4, 2});
    const std::size_t count = numbers.size() / 8;
    expect<FileError>(count == 0 || count == classes, lazy_text(file.source, ": placings"),
                      lazy_text("0 or ", classes), count);
    std::vector<Placing> placings(count);
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
        const double share = numbers[i], offset = numbers[i + 1];
        expect<FileError>(share >= 0 && share <= 1 && std::abs(offset) <= most_placing_offset,
                          lazy_text(file.source, ": placings"),
                          "shares of 0 ... 1, offsets of -0.14 ... 0.14", lazy_text(share, ", ", offset));
        placings[i / 8].sides[i / 2 % 4] = {share, offset};
    }
    return placings;
}

/// Those that are known one after another, and of which classes they are.
inline void figure_colors_to_tensors(std::span<const FigureColors> colors, TensorFile& file) {
    std::vector<std::uint32_t> classes;
    std::vector<float> numbers;
    for (std::size_t c = 0; c < colors.size(); ++c)
        if (!colors[c].empty()) {
            classes.push_back(std::uint32_t(c));
            numbers.insert(numbers.end(), colors[c].begin(), colors[c].end());
        }
    file.tensors["figure_color_classes"] = make_tensor<std::uint32_t>(classes, {classes.size()});
    file.tensors["figure_colors"] = make_tensor<float>(numbers, {classes.size(), figure_color_bins});
}

[[nodiscard]] inline std::vector<FigureColors> figure_colors_from_tensors(const TensorFile& file,
                                                                          std::size_t classes) {
    const auto known = values<std::uint32_t>(file, "figure_color_classes", {any_length});
    const auto numbers = values<float>(file, "figure_colors", {known.size(), figure_color_bins});
    for (const float number : numbers)
        expect<FileError>(std::isfinite(number), lazy_text(file.source, ": figure_colors"), "finite numbers",
                          number);
    std::vector<FigureColors> colors(known.empty() ? 0 : classes);
    for (std::size_t i = 0; i < known.size(); ++i) {
        expect<FileError>(known[i] < classes && colors[known[i]].empty(),
                          lazy_text(file.source, ": figure_color_classes"),
                          lazy_text("each once, below ", classes), known[i]);
        const auto own = numbers.subspan(i * figure_color_bins, figure_color_bins);
        colors[known[i]].assign(own.begin(), own.end());
    }
    return colors;
}

}  // namespace ism::detail
