// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "ism/feature/extractor.hpp"
#include "ism/feature/keep_strongest.hpp"
#include "ism/feature/orientation.hpp"
#include "ism/feature/resize.hpp"
#include "ism/feature/row_detector.hpp"
#include "ism/feature/workspace.hpp"

namespace ism {

/// @brief A part of an image, whole pixels: columns x … x + width − 1, rows y … y + height − 1.
struct Region {
    int x = 0, y = 0, width = 0, height = 0;
};

/// @brief Finds and describes the features of one image after another with the same threads and memory: after
/// the first of a size nothing is allocated any more. One image at a time.
template <Detector D, Descriptor Desc>
class FeatureExtractor {
public:
    /// @param threads  of the pool that works on an image (0 = all the machine has)
    explicit FeatureExtractor(Extractor<D, Desc> extractor = {}, unsigned threads = 1)
        : extractor_(std::move(extractor)), workspace_(threads) {}

    /// @brief Features of `image` (brightness 0 … 1) and their descriptors, until the next call; positions
    /// and scales are in pixels of `image` whatever it was resized by. The same for any number of threads.
    /// With a region only features whose centre lies in it; those of scales up to 8 pixels are the same as
    /// without.
    /// @throws Error where the image, resized or not, or the region is smaller than 16×16, a pixel is not a
    /// number or beyond ±max_brightness, or an option is out of range.
    const FeatureSet<Desc>& extract(ImageView<const float> image, std::optional<Region> region = {}) {
        check_size(image);
        check_brightness(image, workspace_);
        return part(image, region);
    }

    /// @brief The same for an image of 8 bits, 0 (black) … 255 (white).
    const FeatureSet<Desc>& extract(ImageView<const std::uint8_t> image, std::optional<Region> region = {}) {
        check_size(image);
        GrayImage gray = workspace_.image(image.width(), image.height());
        workspace_.each_row(image.height(), [&](int y) {
            const std::uint8_t* from = image.row(y).data();
            float* to = gray.row(y).data();
            for (int x = 0; x < image.width(); ++x) to[x] = float(from[x]) / 255.0f;
        });
        part(gray.view(), region);
        workspace_.reuse(std::move(gray));
        return set_;
    }

    /// @brief What the last image gave, to keep.
    [[nodiscard]] FeatureSet<Desc> take() { return std::move(set_); }
    /// @brief Scale space of the last image, resized by its upsampling.
    [[nodiscard]] const ScaleSpace& scale_space() const { return space_; }

private:
    template <class T>
    void check_size(ImageView<const T> image) const {
        check(extractor_);
        expect(image.width() >= 16 && image.height() >= 16, "image size", "at least 16x16", size_text(image));
    }

    /// The features of a region, or of the whole image.
    const FeatureSet<Desc>& part(ImageView<const float> image, const std::optional<Region>& region) {
        if (!region) return run(image, 0, 0, {0, 0, image.width(), image.height()});
        (void)image.region(region->x, region->y, region->width, region->height);
        expect(region->width >= 16 && region->height >= 16, "image region size", "at least 16x16",
               lazy_text(region->width, "x", region->height));
        // around it what descriptors and blur reach; from such pixels on that the octaves keep their places
        constexpr int margin = 64, grid = 32;
        const int x0 = std::max(0, region->x - margin) / grid * grid;
        const int y0 = std::max(0, region->y - margin) / grid * grid;
        const int x1 = std::min(image.width(), region->x + region->width + margin);
        const int y1 = std::min(image.height(), region->y + region->height + margin);
        return run(image.region(x0, y0, x1 - x0, y1 - y0), x0, y0, *region);
    }

    /// The features of an image in pixels of the scale space.
    [[nodiscard]] std::vector<Feature> detect(ImageView<const float> image) {
        const ExtractOptions& options = extractor_.options;
        if (options.upsampling == 1) return detect(image, options.scale_space);
        ScaleSpaceOptions scale_space = options.scale_space;
        GrayImage other = resized(image, options.upsampling, scale_space.input_sigma, workspace_);
        expect(other.width() >= 16 && other.height() >= 16, "image size after upsampling", "at least 16x16",
               size_text(other));
        scale_space.input_sigma =
            std::min(max_input_sigma, scale_space.input_sigma * float(std::max(1.0, options.upsampling)));
        std::vector<Feature> found = detect(other, scale_space);
        workspace_.reuse(std::move(other));
        return found;
    }

    [[nodiscard]] std::vector<Feature> detect(ImageView<const float> image,
                                              const ScaleSpaceOptions& options) {
        const D& detector = extractor_.detector;
        if constexpr (RowDetector<D>) {
            check(detector);
            const auto found = workspace_.lists(workspace_.pool().size());
            space_.build(image, options, workspace_, D::search_reach,
                         [&](int octave, int first, int end, unsigned worker) {
                             detector.search(space_, octave, first, end, workspace_, worker, found[worker]);
                         });
            return detail::in_order(found, workspace_);
        } else {
            space_.build(image, options, workspace_);
            return detector.detect(space_, workspace_);
        }
    }

    /// `image` is the part of the whole that begins at (x0, y0); kept is what lies in the region of the
    /// whole.
    const FeatureSet<Desc>& run(ImageView<const float> image, int x0, int y0, const Region& region) {
        const ExtractOptions& options = extractor_.options;
        const float factor = float(options.upsampling);
        std::vector<Feature>& features = set_.features;
        const auto replace = [&](std::vector<Feature> other) {
            std::swap(features, other);
            workspace_.reuse(std::move(other));
        };
        const auto limit = [&] {
            if (options.max_features > 0)
                keep_strongest_evenly(features, options.max_features, space_.width(), space_.height(),
                                      workspace_);
        };
        replace(detect(image));
        const float left = float(region.x - x0) * factor, top = float(region.y - y0) * factor;
        const float right = left + float(region.width) * factor, bottom = top + float(region.height) * factor;
        if (image.width() != region.width || image.height() != region.height)
            std::erase_if(features, [&](const Feature& f) {
                return f.x < left || f.y < top || f.x >= right || f.y >= bottom;
            });
        limit();
        if (options.oriented) {
            replace(assign_orientations(space_, features, workspace_));
            limit();
        }
        describe();
        for (Feature& f : features)
            f.x = f.x / factor + float(x0), f.y = f.y / factor + float(y0), f.scale = f.scale / factor;
        return set_;
    }

    void describe() {
        constexpr std::size_t features_per_task = 32;
        const std::size_t count = set_.features.size();
        set_.descriptors.resize(count);
        workspace_.pool().for_each(
            (count + features_per_task - 1) / features_per_task, [&](std::size_t task, unsigned) {
                const std::size_t first = task * features_per_task;
                for (std::size_t i = first; i < std::min(count, first + features_per_task); ++i)
                    extractor_.descriptor.describe(space_, set_.features[i], set_.descriptors.row(i));
            });
    }

    Extractor<D, Desc> extractor_;
    Workspace workspace_;
    ScaleSpace space_;
    FeatureSet<Desc> set_;
};

/// @brief Features of one image: FeatureExtractor::extract() with threads and memory of its own.
template <Detector D, Descriptor Desc>
[[nodiscard]] FeatureSet<Desc> extract(ImageView<const float> image, const Extractor<D, Desc>& extractor,
                                       unsigned threads = 1) {
    FeatureExtractor<D, Desc> once(extractor, threads);
    once.extract(image);
    return once.take();
}

}  // namespace ism
