// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/frame_colors.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/core/progress.hpp"
#include "ism/core/shared.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/any_extractor.hpp"
#include "ism/feature/depth.hpp"
#include "ism/train/describe_object.hpp"
#include "ism/train/train_options.hpp"
#include "ism/train/training_features.hpp"
#include "ism/train/training_set.hpp"
#include "ism/vote/placement.hpp"

namespace ism {

/// @brief How much images should be enlarged before features are searched, so that the middle one of the
/// objects has enough of them: small objects are brought to 150 px, large ones stay.
/// @param sizes_px  roots of the boxes' areas, at least one
[[nodiscard]] inline double choose_upsampling(std::vector<double> sizes_px) {
    constexpr double wanted_px = 150, most = 4;
    detail::sort_by(sizes_px, [](double size) { return detail::rising(size); });
    return std::clamp(wanted_px / sizes_px[sizes_px.size() / 2], 1.0, most);
}

namespace detail {

/// Features without those that lie in regions to ignore and on no labelled object: they are neither of an
/// object nor of background.
[[nodiscard]] inline FeatureSet<float> without_ignored(FeatureSet<float> set, const TrainingView& view) {
    if (view.ignored.empty()) return set;
    FeatureSet<float> kept{{}, Descriptors<float>(set.descriptors.dimension())};
    for (std::size_t i = 0; i < set.features.size(); ++i) {
        const Feature& feature = set.features[i];
        const double x = feature.x + 0.5, y = feature.y + 0.5;  // a pixel's corner is half beside its centre
        const auto lies_in = [&](const Box& box) {
            return x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height;
        };
        if (any_of(view.ignored, lies_in) &&
            !any_of(view.labels, [&](const ObjectLabel& label) { return lies_in(label.box); }))
            continue;
        kept.features.push_back(feature);
        kept.descriptors.push_back(set.descriptors.row(i));
    }
    return kept;
}

/// Finds the features of one training image after another.
class TrainingExtractor {
public:
    explicit TrainingExtractor(const std::vector<AnyExtractor>& extractors) {
        for (const AnyExtractor& extractor : extractors) channels_.push_back(extractor.start(pool_));
    }

    /// All features of an image, with depth where it has depth.
    [[nodiscard]] TrainingView view(const TrainingImage& image) {
        TrainingView view{
            .width = image.frame.gray.width(), .height = image.frame.gray.height(), .ignored = image.ignored};
        for (const LabelledObject& object : image.objects) view.labels.push_back(object.label());
        view.end_object = static_cast<std::uint32_t>(image.objects.size());
        for (const ExtractFeatures& extract : channels_) {
            view.channels.push_back(without_ignored(extract(image.frame), view));
            std::vector<Feature>& features = view.channels.back().features;
            if (!image.frame.depth_m.empty()) features = with_depth(std::move(features), image.frame.depth_m);
        }
        return view;
    }

private:
    ThreadPool pool_{1};
    std::vector<ExtractFeatures> channels_;
};

/// Depth, camera and masks of an image that has both.
[[nodiscard]] inline std::optional<TrainingDepth> training_depth(const TrainingImage& image) {
    const Frame& frame = image.frame;
    if (frame.depth_m.empty() || !frame.camera) return {};
    TrainingDepth depth{.depth_m = frame.depth_m, .camera = *frame.camera};
    for (const LabelledObject& object : image.objects) {
        depth.masks.push_back(region_of(object_mask(object, frame.gray.width(), frame.gray.height())));
        depth.instances.push_back(object.instance);
        depth.positions_m.push_back(object.position_m);
    }
    return depth;
}

/// What the objects of one image add; they are numbered within the image.
/// @param most  features of an object in a channel
[[nodiscard]] inline TrainingFeatures object_features(const TrainingImage& image, const TrainingView& view,
                                                      std::size_t most) {
    TrainingFeatures result;
    for (const auto& channel : view.channels)
        result.samples.push_back({{}, Descriptors<float>(channel.descriptors.dimension())});
    for (const LabelledObject& object : image.objects) {
        const Mask mask = object_mask(object, view.width, view.height);
        const float depth_m = object.position_m             ? static_cast<float>(object.position_m->z)
                              : image.frame.depth_m.empty() ? no_depth
                                                            : object_depth(image.frame, mask);
        const Placement lies = upright_in(object.box);
        for (std::size_t c = 0; c < view.channels.size(); ++c) {
            const auto& [features, descriptors] = view.channels[c];
            const std::vector<std::uint32_t> on = features_on(mask, features);
            const std::vector<std::uint32_t> used = strongest(on, features, most);
            result.summary.features_found += on.size();
            result.summary.features_used += used.size();
            for (const std::uint32_t i : used) {
                Occurrence o = as_occurrence(features[i], lies);
                o.depth_m = features[i].depth_m - depth_m;
                o.class_index = object.class_index;
                o.object = static_cast<std::uint32_t>(result.objects.size());
                result.samples[c].occurrences.push_back(o);
                result.samples[c].descriptors.push_back(descriptors.row(i));
            }
        }
        TrainingObject described = describe_object(object.label(), mask, image.name);
        result.objects.push_back(image.frame.camera
                                     ? placed_in_space(std::move(described), object.box, object.position_m,
                                                       depth_m, *image.frame.camera)
                                     : std::move(described));
    }
    return result;
}

}  // namespace detail

/// @brief Finds and describes the features of training images; each image is read once. Small objects are
/// enlarged before, as all labels together ask, unless `choose_upsampling` is off.
/// @param extractors  one for each channel of words
/// @throws Error where an image cannot be learnt from, or a class has no object or no feature.
[[nodiscard]] inline TrainingFeatures extract_training_features(
    std::span<const std::string> class_names, const TrainingSet& set, std::vector<AnyExtractor> extractors,
    const TrainingFeatureOptions& options = {}, unsigned threads = 0, const Progress& progress = {}) {
    const std::size_t classes = class_names.size();
    expect(classes > 0, "training: number of classes", "1 or more", 0);
    for (std::size_t c = 0; c < classes; ++c)
        expect(std::find(class_names.begin(), class_names.begin() + std::ptrdiff_t(c), class_names[c]) ==
                   class_names.begin() + std::ptrdiff_t(c),
               "training: names of classes", "each once", class_names[c]);
    expect(set.size > 0, "training: number of images", "1 or more", 0);
    expect(!extractors.empty(), "training: number of extractors", "1 or more", 0);
    expect(set.category_ids.empty() || set.category_ids.size() == classes, "training: category ids",
           lazy_text("none or ", classes), set.category_ids.size());
    expect(options.max_features > 0, "TrainingFeatureOptions::max_features", "1 or more", 0);
    expect(options.views || !(options.pixels || options.depth), "TrainingFeatureOptions::views",
           "true, to keep pixels or depth", "false");

    std::vector<double> sizes_px;
    std::vector<std::uint32_t> objects_of(classes, 0), features_of(classes, 0);
    for (std::size_t i = 0; i < set.size; ++i)
        for (const ObjectLabel& label : set.labels(i)) {
            // What is wrong with a label is said with its image.
            if (label.class_index >= classes || !(label.box.area() > 0)) continue;
            sizes_px.push_back(std::sqrt(label.box.area()));
            ++objects_of[label.class_index];
        }
    for (std::size_t c = 0; c < classes; ++c)
        expect(objects_of[c] > 0, lazy_text("training: objects of class ", class_names[c]), "1 or more", 0);
    if (options.choose_upsampling)
        for (AnyExtractor& extractor : extractors)
            extractor.options().upsampling *= choose_upsampling(sizes_px);

    const std::size_t most = std::max<std::size_t>(30, options.max_features / sizes_px.size());
    ThreadPool pool(unsigned(std::min<std::size_t>(thread_count(threads), set.size)));
    std::vector<Shared<detail::TrainingExtractor>> workers(pool.size());
    std::vector<TrainingFeatures> parts(set.size);
    ProgressCounter counter(progress, "extracting features", set.size);
    pool.for_each(set.size, [&](std::size_t i, unsigned worker) {
        TrainingImage image = set.image(i);
        check(image, classes);
        if (!workers[worker]) workers[worker] = Shared<detail::TrainingExtractor>::make(extractors);
        if (options.views || !image.objects.empty()) {
            TrainingView view = workers[worker]->view(image);
            parts[i] = detail::object_features(image, view, most);
            if (options.views) parts[i].views.push_back(std::move(view));
            if (options.views && options.pixels)
                parts[i].views.back().pixels = FrameColors(image.frame).image();
            if (options.views && options.depth)
                parts[i].views.back().depth = detail::training_depth(std::as_const(image));
            if (options.mirror()) {
                parts[i].views.push_back(workers[worker]->view(mirrored(std::move(image))));
                parts[i].views.back().mirrored = true;
            }
        }
        counter.step();
    });

    TrainingFeatures none{.class_names = {class_names.begin(), class_names.end()},
                          .category_ids = set.category_ids};
    for (const AnyExtractor& extractor : extractors) {
        none.settings.push_back(extractor.settings());
        none.samples.push_back({{}, Descriptors<float>(extractor.settings().dimension)});
    }
    none.summary.images = set.size;
    TrainingFeatures all = detail::join_images(std::move(none), std::move(parts));
    for (const TrainingSamples& channel : all.samples)
        for (const Occurrence& o : channel.occurrences) ++features_of[o.class_index];
    for (std::size_t c = 0; c < classes; ++c)
        expect(features_of[c] > 0, lazy_text("training: features on objects of class ", class_names[c]),
               "1 or more", 0);
    return all;
}

}  // namespace ism
