// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/lists.hpp"
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

/// @brief Largest scale space, in bytes, that is held as a whole: that of an image of about 3 megapixels.
inline constexpr std::size_t default_space_bytes = std::size_t(512) << 20;

/// @brief Finds and describes the features of one image after another with the same threads and memory: after
/// the first of a size nothing is allocated. One image at a time.
///
/// The scale space of a large image takes 160 bytes a pixel. Where that is more than `space_bytes`, it is
/// made in bands of rows, once to detect, once more to describe (and to orient): the results are the same
/// bits. This asks for a RowDetector and a LocalDescriptor; with others all of it is held.
template <Detector D, Descriptor Desc>
class FeatureExtractor {
public:
    using Set = FeatureSet<typename Desc::Scalar>;

    /// @param threads  of the pool that works on an image (0 = all hardware threads)
    /// @param space_bytes  most memory for the scale space before it is made in bands
    explicit FeatureExtractor(Extractor<D, Desc> extractor = {}, unsigned threads = 1,
                              std::size_t space_bytes = default_space_bytes)
        : extractor_(std::move(extractor)), workspace_(threads), space_bytes_(space_bytes) {}

    /// @param pool  works on an image; has to stay as long as this
    FeatureExtractor(Extractor<D, Desc> extractor, ThreadPool& pool,
                     std::size_t space_bytes = default_space_bytes)
        : extractor_(std::move(extractor)), workspace_(pool), space_bytes_(space_bytes) {}

    /// @brief Features of `image` (brightness 0 … 1) and their descriptors, until the next call; positions
    /// and scales are in pixels of `image` whatever it was resized by. The same for any number of threads.
    /// With a region only features whose centre lies in it; those of scales up to 8 pixels are the same as
    /// without.
    /// @throws Error where the image, resized or not, or the region is smaller than 16×16, a pixel is not a
    /// number or beyond ±max_brightness, or an option is out of range.
    const Set& extract(ImageView<const float> image, std::optional<Region> region = {}) {
        check_size(image);
        check_brightness(image, workspace_);
        return part(image, region);
    }

    /// @brief The same for an image of 8 bits, 0 (black) … 255 (white).
    const Set& extract(ImageView<const std::uint8_t> image, std::optional<Region> region = {}) {
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

    /// @brief Moves out the features of the last image.
    [[nodiscard]] Set take() {
        return std::exchange(set_, {.features = {}, .descriptors = empty_descriptors()});
    }

private:
    [[nodiscard]] static Descriptors<typename Desc::Scalar> empty_descriptors() {
        return Descriptors<typename Desc::Scalar>(Desc::dimension);
    }

    template <class T>
    void check_size(ImageView<const T> image) const {
        check(extractor_);
        expect(image.width() >= 16 && image.height() >= 16, "image size", "at least 16x16", size_text(image));
    }

    /// The features of a region, or of the whole image.
    const Set& part(ImageView<const float> image, const std::optional<Region>& region) {
        if (region) {
            (void)image.region(region->x, region->y, region->width, region->height);
            expect(region->width >= 16 && region->height >= 16, "image region size", "at least 16x16",
                   lazy_text(region->width, "x", region->height));
        }
        const ExtractOptions& options = extractor_.options;
        ScaleSpaceOptions scale_space = options.scale_space;
        if (options.upsampling == 1) return cut(image, scale_space, region);
        GrayImage other = resized(image, options.upsampling, scale_space.input_sigma, workspace_);
        expect(other.width() >= 16 && other.height() >= 16, "image size after upsampling", "at least 16x16",
               size_text(other));
        scale_space.input_sigma =
            std::min(max_input_sigma, scale_space.input_sigma * float(std::max(1.0, options.upsampling)));
        cut(other, scale_space, region);
        workspace_.reuse(std::move(other));
        return set_;
    }

    /// The same of an image that is resized already; the region is in pixels of the image as it was.
    const Set& cut(ImageView<const float> image, const ScaleSpaceOptions& scale_space,
                   const std::optional<Region>& region) {
        if (!region) return run(image, scale_space, 0, 0, {});
        const double factor = extractor_.options.upsampling;
        const Box kept{region->x * factor, region->y * factor, region->width * factor,
                       region->height * factor};
        // around it what descriptors and blur reach; from such pixels on that the octaves keep their places
        constexpr int grid = 32;
        const double margin = 96 * std::max(1.0, factor);
        const int x0 = int(std::max(0.0, kept.x - margin)) / grid * grid;
        const int y0 = int(std::max(0.0, kept.y - margin)) / grid * grid;
        const int x1 = int(std::min(double(image.width()), kept.x + kept.width + margin));
        const int y1 = int(std::min(double(image.height()), kept.y + kept.height + margin));
        return run(image.region(x0, y0, x1 - x0, y1 - y0), scale_space, x0, y0, kept);
    }

    /// The features of an image in its pixels.
    [[nodiscard]] std::vector<Feature> detect(ImageView<const float> image,
                                              const ScaleSpaceOptions& options) {
        if constexpr (RowDetector<D> && LocalDescriptor<Desc>) {
            space_.begin(image, options, workspace_, space_bytes_);
            return detail::search_advancing(extractor_.detector, space_, workspace_);
        } else {
            space_.begin(image, options, workspace_);
            while (space_.advance(workspace_)) continue;
            return extractor_.detector.detect(space_, workspace_);
        }
    }

    /// What extract() gives, of a resized image or the part of it that begins at (x0, y0); where there is a
    /// box, in pixels of the whole resized image, what lies in it alone.
    const Set& run(ImageView<const float> resized_image, const ScaleSpaceOptions& scale_space, int x0, int y0,
                   const std::optional<Box>& kept) {
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
        replace(detect(resized_image, scale_space));
        if (kept) {
            const auto left = float(kept->x - x0), top = float(kept->y - y0);
            const auto right = float(left + kept->width), bottom = float(top + kept->height);
            detail::drop_if(features, [&](const Feature& f) {
                return f.x < left || f.y < top || f.x >= right || f.y >= bottom;
            });
        }
        limit();
        if (options.oriented) {
            replace(assign_orientations(space_, features, workspace_));
            limit();
        }
        describe();
        for (Feature& f : features)
            f.x = (f.x + float(x0)) / factor, f.y = (f.y + float(y0)) / factor, f.scale = f.scale / factor;
        return set_;
    }

    void describe() {
        const std::vector<Feature>& features = set_.features;
        set_.descriptors.resize(features.size());
        const auto describe_one = [&](std::size_t i) {
            extractor_.descriptor.describe(
                space_, features[i],
                std::span<typename Desc::Scalar, Desc::dimension>(set_.descriptors.row(i)));
        };
        if constexpr (LocalDescriptor<Desc>)
            detail::for_each_feature(space_, features, Desc::reach, Desc::level_scale, workspace_,
                                     describe_one);
        else
            detail::for_each_feature(
                space_, features, 0, [](const Feature& f) { return f.scale; }, workspace_, describe_one);
    }

    Extractor<D, Desc> extractor_;
    Workspace workspace_;
    std::size_t space_bytes_;
    ScaleSpace space_;
    Set set_{.features = {}, .descriptors = empty_descriptors()};
};

/// @brief Features of one image: FeatureExtractor::extract() with threads and memory of its own.
template <Detector D, Descriptor Desc>
[[nodiscard]] FeatureSet<typename Desc::Scalar> extract(ImageView<const float> image,
                                                        const Extractor<D, Desc>& extractor,
                                                        unsigned threads = 1) {
    FeatureExtractor<D, Desc> once(extractor, threads);
    once.extract(image);
    return once.take();
}

}  // namespace ism
