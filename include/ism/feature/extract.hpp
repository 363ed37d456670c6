// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "ism/feature/descriptor.hpp"
#include "ism/feature/detector.hpp"
#include "ism/feature/orientation.hpp"
#include "ism/feature/resize.hpp"

namespace ism {

/// @brief What is done around detector and descriptor.
struct ExtractOptions {
    ScaleSpaceOptions scale_space = {};
    double upsampling = 1;         ///< the image is resized by this factor before; > 0
    bool oriented = false;         ///< features get dominant directions, and may multiply
    std::size_t max_features = 0;  ///< keep so many, strong and spread over the image; 0 = all
};

/// @brief How features are got from an image: a detector, a descriptor, options.
template <Detector D, Descriptor Desc>
struct Extractor {
    using DetectorType = D;
    using DescriptorType = Desc;
    D detector = {};
    Desc descriptor = {};
    ExtractOptions options = {};
};

/// @brief Features with their descriptors: row i describes feature i.
template <Descriptor Desc>
struct FeatureSet {
    std::vector<Feature> features;
    Descriptors<typename Desc::Scalar, Desc::dimension> descriptors;
};

/// @brief At most `count` of the features, strong ones and such that they cover the image evenly, in the
/// order they came in: the image (width × height pixels) is cut into cells which take turns giving their
/// strongest.
[[nodiscard]] inline std::vector<Feature> strongest_evenly(std::vector<Feature> features, std::size_t count,
                                                           int width, int height) {
    if (features.size() <= count) return features;
    const double area = std::max(1.0, double(width) * height);
    const double side = std::sqrt(area / std::max(1.0, double(count) / 8));
    const auto cell = [&](const Feature& f) {
        return std::pair(std::floor(double(f.y) / side), std::floor(double(f.x) / side));
    };
    std::vector<std::size_t> order(features.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tuple(cell(features[a]), -features[a].strength, a) <
               std::tuple(cell(features[b]), -features[b].strength, b);
    });
    std::vector<std::size_t> turn(features.size(), 0);
    for (std::size_t i = 1; i < order.size(); ++i)
        if (cell(features[order[i]]) == cell(features[order[i - 1]])) turn[order[i]] = turn[order[i - 1]] + 1;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tuple(turn[a], -features[a].strength, a) < std::tuple(turn[b], -features[b].strength, b);
    });
    order.resize(count);
    std::sort(order.begin(), order.end());
    std::vector<Feature> kept;
    kept.reserve(count);
    for (const std::size_t i : order) kept.push_back(features[i]);
    return kept;
}

/// @brief Features of `image` (brightness 0 … 1) and their descriptors; positions and scales are in pixels of
/// `image` whatever it was resized by. `workspace` lends its memory and holds the scale space afterwards (of
/// the resized image). The same for any number of threads (0 = all the machine has).
/// @throws Error where the image, resized or not, is smaller than 16×16, a pixel is not finite or an option
/// is out of range.
template <Detector D, Descriptor Desc>
[[nodiscard]] FeatureSet<Desc> extract(ImageView<const float> image, const Extractor<D, Desc>& extractor,
                                       ScaleSpace& workspace, unsigned threads = 1) {
    const ExtractOptions& options = extractor.options;
    const double factor = options.upsampling;
    expect(std::isfinite(factor) && factor > 0, "upsampling", "a positive number", factor);
    expect(image.width() >= 16 && image.height() >= 16, "image size", "at least 16x16", size_text(image));
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (!std::isfinite(image(x, y)))
                throw Error(join_text("image brightness at (", x, ", ", y, "): expected a finite value, got ",
                                      image(x, y)));

    ScaleSpaceOptions scale_space = options.scale_space;
    if (factor == 1) {
        workspace.build(image, scale_space, threads);
    } else {
        const GrayImage other = resized(image, factor, scale_space.input_sigma, threads);
        expect(other.width() >= 16 && other.height() >= 16, "image size after upsampling", "at least 16x16",
               size_text(other));
        scale_space.input_sigma *= float(std::max(1.0, factor));
        workspace.build(other, scale_space, threads);
    }
    const auto limited = [&](std::vector<Feature> features) {
        if (options.max_features == 0) return features;
        return strongest_evenly(std::move(features), options.max_features, workspace.width(),
                                workspace.height());
    };
    FeatureSet<Desc> set;
    set.features = limited(extractor.detector.detect(workspace, threads));
    if (options.oriented) set.features = limited(assign_orientations(workspace, set.features, threads));
    set.descriptors = extractor.descriptor.describe(workspace, set.features, threads);
    if (factor != 1)
        for (Feature& f : set.features) {
            f.x = float(f.x / factor), f.y = float(f.y / factor), f.scale = float(f.scale / factor);
        }
    return set;
}

/// @brief The same with a workspace of its own.
template <Detector D, Descriptor Desc>
[[nodiscard]] FeatureSet<Desc> extract(ImageView<const float> image, const Extractor<D, Desc>& extractor,
                                       unsigned threads = 1) {
    ScaleSpace workspace;
    return extract(image, extractor, workspace, threads);
}

}  // namespace ism
