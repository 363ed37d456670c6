// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ism/codebook/information_gain.hpp"
#include "ism/core/parallel.hpp"
#include "ism/core/random.hpp"
#include "ism/detect/model.hpp"
#include "ism/detect/training_image.hpp"
#include "ism/feature/depth.hpp"

namespace ism {

/// @brief Whether classes share words.
enum class CodebookKind {
    joint,      ///< one codebook of all classes (the paper's)
    per_class,  ///< each class has words of its own, as separate models have
};

/// @brief Told now and then while training or detecting goes on: what is being done, how much of it is done,
/// how much there is. May be called from any of the threads, one at a time.
using Progress = std::function<void(std::string_view stage, std::size_t done, std::size_t total)>;

/// @brief How a model is trained.
struct TrainOptions {
    double min_similarity = 0.8;       ///< clustering and matching cut-off; 1 = equal, 0 = unrelated
    std::size_t min_cluster_size = 2;  ///< smaller clusters make no word (T_Q + 1)
    double min_information_gain = 0;   ///< words that tell less about the class are dropped (T_IG)
    CodebookKind codebook = CodebookKind::joint;
    std::size_t max_cluster_features =
        30000;               ///< of more features a random part is clustered; all are matched
    std::uint64_t seed = 1;  ///< chooses that part
    unsigned threads = 0;    ///< 0 = all the machine has
    Progress progress = {};
};

/// @brief Something that gives training image i, for any i and from several threads at once.
template <class S>
concept TrainingSource = requires(const S& source, std::size_t i) {
    { source(i) } -> std::convertible_to<TrainingImage>;
};

namespace detail {

/// An object brought to the reference size, without its features.
[[nodiscard]] inline TrainingObject describe_object(const LabelledObject& object, const Mask& mask,
                                                    const std::string& image) {
    const double size_px = std::sqrt(object.box.area()), to_reference = reference_size_px / size_px;
    TrainingObject result{.class_index = static_cast<std::uint32_t>(object.class_index),
                          .width = static_cast<float>(object.box.width * to_reference),
                          .height = static_cast<float>(object.box.height * to_reference),
                          .size_px = static_cast<float>(size_px),
                          .mask = {},
                          .image = image};
    const int columns = std::max(1, static_cast<int>(std::lround(result.width / mask_cell_px)));
    const int rows = std::max(1, static_cast<int>(std::lround(result.height / mask_cell_px)));
    result.mask = Mask(columns, rows);
    constexpr int samples = 3;  // a side of a cell
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            int figure = 0;
            for (int sub = 0; sub < samples * samples; ++sub) {
                const double u = (column + (sub % samples + 0.5) / samples) / columns;
                const double v = (row + (sub / samples + 0.5) / samples) / rows;
                const int x = static_cast<int>(std::floor(object.box.x + u * object.box.width));
                const int y = static_cast<int>(std::floor(object.box.y + v * object.box.height));
                figure += mask.contains(x, y) && mask(x, y) != 0;
            }
            result.mask(column, row) = static_cast<std::uint8_t>(255 * figure / (samples * samples));
        }
    return result;
}

/// The mask of an object, or its box as one.
[[nodiscard]] inline Mask object_mask(const LabelledObject& object, int width, int height) {
    if (!object.mask.empty()) return object.mask;
    Mask mask(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            mask(x, y) = x + 0.5 >= object.box.x && x + 0.5 <= object.box.x + object.box.width &&
                         y + 0.5 >= object.box.y && y + 0.5 <= object.box.y + object.box.height;
    return mask;
}

/// @throws Error unless an image and its objects can be learnt from.
inline void check_training_image(const TrainingImage& image, std::size_t classes) {
    try {
        check(image.frame);
    } catch (const Error& error) {
        throw Error(join_text(image.name, ": ", error.what()));
    }
    const GrayImage& gray = image.frame.gray;
    for (const LabelledObject& object : image.objects) {
        const Box& box = object.box;
        expect(object.class_index < classes, join_text(image.name, ": class of an object"),
               join_text("an index below ", classes), object.class_index);
        expect(std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.area()) && box.width > 0 &&
                   box.height > 0,
               join_text(image.name, ": box of an object"), "finite numbers, positive sides",
               join_text(box.x, ", ", box.y, ", ", box.width, ", ", box.height));
        if (object.mask.empty()) continue;
        expect(object.mask.width() == gray.width() && object.mask.height() == gray.height(),
               join_text(image.name, ": mask size"), size_text(gray), size_text(object.mask));
        expect(mask_area(object.mask) > 1, join_text(image.name, ": mask"), "at least 2 figure pixels",
               mask_area(object.mask));
    }
}

/// Median depth of an object's figure, metres; no_depth without readings.
[[nodiscard]] inline float object_depth(const Frame& frame, const Mask& mask) {
    std::vector<float> readings;
    for (int y = 0; y < frame.depth_m.height(); ++y)
        for (int x = 0; x < frame.depth_m.width(); ++x)
            if (mask(x, y) != 0 && is_depth(frame.depth_m(x, y))) readings.push_back(frame.depth_m(x, y));
    if (readings.empty()) return no_depth;
    const auto middle = readings.begin() + std::ptrdiff_t(readings.size() / 2);
    std::nth_element(readings.begin(), middle, readings.end());
    return *middle;
}

/// What one training image adds: its objects, and the features on them with what they tell of their object
/// (object numbered within the image).
template <std::size_t Dimension, DescriptorScalar Scalar>
struct ImageHarvest {
    std::vector<TrainingObject> objects;
    std::vector<Occurrence> occurrences;
    Descriptors<Scalar, Dimension> descriptors;
};

template <Detector D, Descriptor Desc>
[[nodiscard]] ImageHarvest<Desc::dimension, typename Desc::Scalar> harvest(
    const TrainingImage& image, const Extractor<D, Desc>& extractor) {
    ImageHarvest<Desc::dimension, typename Desc::Scalar> result;
    if (image.objects.empty()) return result;
    auto found = extract(image.frame.gray, extractor, 1);
    if (!image.frame.depth_m.empty()) found.features = with_depth(found.features, image.frame.depth_m);
    for (const LabelledObject& object : image.objects) {
        const Mask mask = object_mask(object, image.frame.gray.width(), image.frame.gray.height());
        const float depth_m = image.frame.depth_m.empty() ? no_depth : object_depth(image.frame, mask);
        const auto to_reference = static_cast<float>(reference_size_px / std::sqrt(object.box.area()));
        const Point2 centre = object.box.centre();
        for (std::size_t i = 0; i < found.features.size(); ++i) {
            const Feature& feature = found.features[i];
            const int x = static_cast<int>(std::lround(feature.x)),
                      y = static_cast<int>(std::lround(feature.y));
            if (!mask.contains(x, y) || mask(x, y) == 0) continue;
            result.occurrences.push_back({.x = (feature.x - static_cast<float>(centre.x)) * to_reference,
                                          .y = (feature.y - static_cast<float>(centre.y)) * to_reference,
                                          .scale = feature.scale * to_reference,
                                          .depth_m = feature.depth_m - depth_m,
                                          .weight = 1,
                                          .class_index = static_cast<std::uint32_t>(object.class_index),
                                          .object = static_cast<std::uint32_t>(result.objects.size()),
                                          .feature = 0});
            result.descriptors.push_back(found.descriptors.row(i));
        }
        result.objects.push_back(describe_object(object, mask, image.name));
    }
    return result;
}

/// How much images should be enlarged before features are searched, so that the middle one of the objects has
/// enough of them: small objects are brought to 150 px, large ones stay.
[[nodiscard]] inline double choose_upsampling(std::vector<double> object_sizes_px) {
    constexpr double wanted_px = 150, most = 4;
    const auto middle = object_sizes_px.begin() + std::ptrdiff_t(object_sizes_px.size() / 2);
    std::nth_element(object_sizes_px.begin(), middle, object_sizes_px.end());
    return std::clamp(wanted_px / *middle, 1.0, most);
}

/// A random part of `count` numbers below `total`, in rising order.
[[nodiscard]] inline std::vector<std::size_t> random_part(std::size_t total, std::size_t count,
                                                          Random& random) {
    std::vector<std::size_t> part;
    for (std::size_t i = 0; i < total && part.size() < count; ++i)
        if (random.uniform() * double(total - i) < double(count - part.size())) part.push_back(i);
    return part;
}

template <std::size_t Dimension, DescriptorScalar Scalar>
[[nodiscard]] Descriptors<float, Dimension> chosen_as_float(const Descriptors<Scalar, Dimension>& all,
                                                            std::span<const std::size_t> rows) {
    Descriptors<float, Dimension> part(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        std::copy(all.row(rows[i]).begin(), all.row(rows[i]).end(), part.row(i).begin());
    return part;
}

/// The words of all features, or those of each class after those of another.
template <std::size_t Dimension, DescriptorScalar Scalar>
[[nodiscard]] Codebook<Dimension> learn_words(const Descriptors<Scalar, Dimension>& descriptors,
                                              std::span<const Occurrence> seen, std::size_t classes,
                                              double max_sq_distance, const TrainOptions& options) {
    const bool joint = options.codebook == CodebookKind::joint;
    Random random(options.seed);
    Codebook<Dimension> codebook{
        .words = {}, .mean_sq_length = {}, .group = {}, .max_sq_distance = max_sq_distance};
    for (std::uint32_t group = 0; group < (joint ? 1 : classes); ++group) {
        std::vector<std::size_t> rows;
        for (std::size_t i = 0; i < descriptors.size(); ++i)
            if (joint || seen[i].class_index == group) rows.push_back(i);
        if (rows.size() > options.max_cluster_features) {
            std::vector<std::size_t> part = random_part(rows.size(), options.max_cluster_features, random);
            for (std::size_t& row : part) row = rows[row];
            rows = std::move(part);
        }
        const auto words = build_codebook(chosen_as_float(descriptors, std::span<const std::size_t>(rows)),
                                          max_sq_distance, options.min_cluster_size, group, options.threads);
        for (std::size_t w = 0; w < words.size(); ++w) {
            codebook.words.push_back(words.words.row(w));
            codebook.mean_sq_length.push_back(words.mean_sq_length[w]);
            codebook.group.push_back(group);
        }
    }
    return codebook;
}

}  // namespace detail

/// @brief Learns a model from `count` images that `source` gives: features on the objects are clustered into
/// words, then each feature is matched to all words within the threshold, and each match is an occurrence.
/// Background images are allowed. `source` is called twice for each image, from several threads.
/// @param class_names  names of the classes that LabelledObject::class_index points to
/// @throws Error where an image cannot be learnt from, a class has no object or no feature, or an option is
/// out of range.
template <Detector D, Descriptor Desc, TrainingSource Source>
[[nodiscard]] Model<D, Desc> train(std::span<const std::string> class_names, std::size_t count,
                                   const Source& source, const TrainOptions& options = {},
                                   const Extractor<D, Desc>& extractor = {}) {
    expect(!class_names.empty(), "training: number of classes", "1 or more", 0);
    expect(count > 0, "training: number of images", "1 or more", 0);
    expect(options.min_similarity > -1 && options.min_similarity <= 1, "training: similarity",
           "above -1, at most 1", options.min_similarity);
    expect(options.min_cluster_size > 0, "training: smallest cluster size", "1 or more", 0);
    expect(options.max_cluster_features > 1, "training: most features to cluster", "2 or more",
           options.max_cluster_features);

    std::mutex mutex;
    std::size_t done = 0;
    const auto tell = [&](std::string_view stage, std::size_t total) {
        if (!options.progress) return;
        const std::lock_guard lock(mutex);
        options.progress(stage, ++done, total);
    };

    // Look at all images once: are they good, and how large are the objects?
    std::vector<std::vector<double>> sizes(count);
    std::vector<std::vector<std::size_t>> classes(count);
    parallel_for(count, options.threads, [&](std::size_t i) {
        const TrainingImage image = source(i);
        detail::check_training_image(image, class_names.size());
        for (const LabelledObject& object : image.objects) {
            sizes[i].push_back(std::sqrt(object.box.area()));
            classes[i].push_back(object.class_index);
        }
        tell("looking at images", count);
    });
    std::vector<double> all_sizes;
    std::vector<std::size_t> objects_of(class_names.size(), 0);
    for (std::size_t i = 0; i < count; ++i) {
        all_sizes.insert(all_sizes.end(), sizes[i].begin(), sizes[i].end());
        for (const std::size_t c : classes[i]) ++objects_of[c];
    }
    for (std::size_t c = 0; c < class_names.size(); ++c)
        expect(objects_of[c] > 0, join_text("training: objects of class ", class_names[c]), "1 or more", 0);

    Model<D, Desc> model{.extractor = extractor, .codebook = {}, .shapes = {}};
    model.extractor.options.upsampling *= detail::choose_upsampling(all_sizes);
    model.shapes.class_names.assign(class_names.begin(), class_names.end());

    // First pass: the features on the objects.
    done = 0;
    std::vector<detail::ImageHarvest<Desc::dimension, typename Desc::Scalar>> harvests(count);
    parallel_for(count, options.threads, [&](std::size_t i) {
        if (!classes[i].empty()) {
            const TrainingImage image = source(i);
            harvests[i] = detail::harvest(image, model.extractor);
        }
        tell("extracting features", count);
    });
    std::vector<Occurrence> seen;
    Descriptors<typename Desc::Scalar, Desc::dimension> descriptors;
    std::vector<std::size_t> features_of(class_names.size(), 0);
    for (auto& harvest : harvests) {
        for (std::size_t i = 0; i < harvest.occurrences.size(); ++i) {
            Occurrence occurrence = harvest.occurrences[i];
            occurrence.object += static_cast<std::uint32_t>(model.shapes.objects.size());
            occurrence.feature = static_cast<std::uint32_t>(seen.size());
            ++features_of[occurrence.class_index];
            seen.push_back(occurrence);
            descriptors.push_back(harvest.descriptors.row(i));
        }
        std::move(harvest.objects.begin(), harvest.objects.end(), std::back_inserter(model.shapes.objects));
        harvest = {};
    }
    for (std::size_t c = 0; c < class_names.size(); ++c)
        expect(features_of[c] > 0, join_text("training: features on objects of class ", class_names[c]),
               "1 or more", 0);

    // Second pass: the words, and all that each feature looks like.
    const double max_sq_distance = 2 * (1 - options.min_similarity) * Desc::sq_length;
    done = 0;
    auto codebook = detail::learn_words(descriptors, seen, class_names.size(), max_sq_distance, options);
    tell("clustering", 1);
    std::vector<Match> matches = match(codebook, descriptors, MatchMode::all, options.threads);
    if (options.codebook == CodebookKind::per_class)
        std::erase_if(matches,
                      [&](const Match& m) { return codebook.group[m.word] != seen[m.feature].class_index; });

    // Keep the words that tell enough about the class.
    std::vector<double> counts(codebook.size() * class_names.size(), 0);
    for (const Match& m : matches) counts[m.word * class_names.size() + seen[m.feature].class_index] += 1;
    const std::vector<double> gain = information_gain(counts, class_names.size());
    constexpr std::uint32_t dropped = 0xffffffff;
    std::vector<std::uint32_t> renamed(codebook.size(), dropped);
    model.codebook.max_sq_distance = max_sq_distance;
    double best_gain = 0;
    for (std::uint32_t w = 0; w < codebook.size(); ++w) {
        best_gain = std::max(best_gain, gain[w]);
        if (gain[w] < options.min_information_gain) continue;
        renamed[w] = static_cast<std::uint32_t>(model.codebook.size());
        model.codebook.words.push_back(codebook.words.row(w));
        model.codebook.mean_sq_length.push_back(codebook.mean_sq_length[w]);
        model.codebook.group.push_back(codebook.group[w]);
    }
    expect(model.codebook.size() > 0, "training: least information gain", join_text("at most ", best_gain),
           options.min_information_gain);

    std::erase_if(matches, [&](const Match& m) { return renamed[m.word] == dropped; });
    std::stable_sort(matches.begin(), matches.end(),
                     [](const Match& a, const Match& b) { return a.word < b.word; });
    model.shapes.first.assign(model.codebook.size() + 1, 0);
    for (const Match& m : matches) {
        model.shapes.occurrences.push_back(seen[m.feature]);
        model.shapes.occurrences.back().weight = m.weight;
        ++model.shapes.first[renamed[m.word] + 1];
    }
    for (std::size_t w = 0; w < model.codebook.size(); ++w) {
        model.shapes.first[w + 1] += model.shapes.first[w];
        double sum = 0;
        const auto own =
            std::span(model.shapes.occurrences)
                .subspan(model.shapes.first[w], model.shapes.first[w + 1] - model.shapes.first[w]);
        for (const Occurrence& o : own) sum += o.weight;
        for (Occurrence& o : own) o.weight = static_cast<float>(o.weight / sum);
    }
    return model;
}

/// @brief Learns a model from images in memory.
template <Detector D, Descriptor Desc>
[[nodiscard]] Model<D, Desc> train(std::span<const std::string> class_names,
                                   std::span<const TrainingImage> images, const TrainOptions& options = {},
                                   const Extractor<D, Desc>& extractor = {}) {
    const auto source = [&](std::size_t i) -> const TrainingImage& { return images[i]; };
    return train<D, Desc>(class_names, images.size(), source, options, extractor);
}

}  // namespace ism
