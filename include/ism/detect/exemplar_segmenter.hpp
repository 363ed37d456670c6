// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/box_region.hpp"
#include "ism/core/color_bins.hpp"
#include "ism/core/frame_colors.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/guided_filter.hpp"
#include "ism/core/mask_pieces.hpp"
#include "ism/core/resize_area.hpp"
#include "ism/detect/exemplar_prior.hpp"
#include "ism/detect/mask_evidence.hpp"
#include "ism/detect/sampled_region.hpp"
#include "ism/detect/scene.hpp"
#include "ism/detect/segment.hpp"
#include "ism/model/figure_color_odds.hpp"
#include "ism/model/placing.hpp"

namespace ism {

/// @brief The box of the mask of a segmentation, pixels of the image; the judged one where they hardly
/// overlap.
[[nodiscard]] inline Box cut_out_box(const Segmentation& part, const Box& judged) {
    constexpr double least_iou = 0.3;  // see most_placing_offset
    Box box = mask_box(part.mask);
    box.x += part.x, box.y += part.y;
    return iou(box, judged) >= least_iou ? box : judged;
}

/// @brief Cuts an object out by its box: the masks of training objects that look like it part by part give a
/// prior, to which the colours of the class are added; histograms of figure and ground tell what the colours
/// of this picture say, and a guided filter brings the result to its edges. What was cut out also says where
/// the object lies (Placing): templates see it in coarse cells, wherever its legs are. In the box that it is
/// placed in exemplars fit better, so that it is cut out there once more. Where the model has no exemplar of
/// the class (its labels have no masks) votes cut it out.
struct ExemplarSegmenter {
    ExemplarOptions exemplars = {};
    double margin = 0.25;         ///< how far beyond the box to look, in parts of its sides
    int max_side_px = 160;        ///< colours are compared at this size, or the picture's where it is smaller
    double class_colors = 0.3;    ///< weight of what the colours of the class say
    int color_rounds = 3;         ///< histograms from the prior by exemplars alone …
    int agreement_rounds = 3;     ///< … and from that by those that agree with the colours
    double min_prior = 0.02;      ///< of figure and of ground
    double max_log_ratio = 3;     ///< what a colour can say
    double filter_radius = 0.03;  ///< in parts of the root of the box's area
    double filter_epsilon = 1e-4;  ///< variance of colours (0 … 1) that is no edge
    double least_piece = 0.02;     ///< of a mask, in parts of its largest; smaller ones are left out
    int cuts = 2;                  ///< times it is cut out, each in the box of the one before
    PatchSegmenter votes = {};     ///< for classes without exemplars

    [[nodiscard]] Segmentation segment(const Detection& hypothesis, const Scene& scene) const;
    /// @brief Cuts out once what a box shows, by these of the model's exemplars and these colours; it is not
    /// placed.
    /// @param colors  FigureColors; may be empty
    [[nodiscard]] Segmentation cut_out(std::span<const std::uint32_t> exemplar_indices,
                                       std::span<const float> colors, const Box& box, const RgbImage& picture,
                                       const Model& model) const;
    /// @brief What was cut out speaks for or against detections, see weigh_masks().
    void judge(std::vector<Detection>& detections, const Scene& scene) const {
        weigh_masks(detections, scene.model, scene.pool);
    }
    static constexpr double most_log_odds = most_mask_log_odds;  ///< that judge() adds
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const ExemplarSegmenter& options) {
    check(options.exemplars);
    check(options.votes);
    const auto in_range = [](const char* name, double value, double least, double most, const char* range) {
        expect(value >= least && value <= most, name, range, value);
    };
    in_range("ExemplarSegmenter::margin", options.margin, 0, 10, "0 ... 10");
    in_range("ExemplarSegmenter::max_side_px", options.max_side_px, 16, 65536, "16 ... 65536");
    in_range("ExemplarSegmenter::class_colors", options.class_colors, 0, 10, "0 ... 10");
    in_range("ExemplarSegmenter::color_rounds", options.color_rounds, 0, 100, "0 ... 100");
    in_range("ExemplarSegmenter::agreement_rounds", options.agreement_rounds, 0, 100, "0 ... 100");
    in_range("ExemplarSegmenter::min_prior", options.min_prior, 1e-6, 0.5, "1e-6 ... 0.5");
    in_range("ExemplarSegmenter::max_log_ratio", options.max_log_ratio, 0, 100, "0 ... 100");
    in_range("ExemplarSegmenter::filter_radius", options.filter_radius, 0, 1, "0 ... 1");
    in_range("ExemplarSegmenter::filter_epsilon", options.filter_epsilon, 1e-6, 1e3, "1e-6 ... 1e3");
    in_range("ExemplarSegmenter::least_piece", options.least_piece, 0, 1, "0 ... 1");
    in_range("ExemplarSegmenter::cuts", options.cuts, 1, 10, "1 ... 10");
}

inline Segmentation ExemplarSegmenter::segment(const Detection& hypothesis, const Scene& scene) const {
    const Model& model = scene.model;
    std::vector<std::uint32_t> of_class;
    for (std::uint32_t e = 0; e < model.exemplars.size(); ++e)
        if (model.shapes.objects[model.exemplars[e].object].class_index == hypothesis.class_index)
            of_class.push_back(e);
    if (of_class.empty() || !(hypothesis.box.area() >= 1)) return votes.segment(hypothesis, scene);
    const std::span<const float> colors = model.figure_colors_of(hypothesis.class_index);
    const Placing placing = model.placing_of(hypothesis.class_index);
    const FrameColors picture(scene.frame);
    Segmentation part;
    Box box = hypothesis.box;
    for (int cut = 0; cut < cuts; ++cut) {
        part = {};  // given back before there is another
        part = cut_out(of_class, colors, box, picture.image(), model);
        box = placing.place(hypothesis.box, cut_out_box(part, hypothesis.box));
    }
    part.box = box;
    return part;
}

namespace detail {

/// p(figure) brought to the edges of a picture, in its own resolution: a guided filter tells how it follows
/// the colours around each pixel.
/// @param rgb     colours of the region, three numbers a pixel, 0 … 255
/// @param figure  of the region, as large
[[nodiscard]] inline Segmentation guided_segmentation(const RgbImage& picture, const BoxRegion& region,
                                                      std::span<const float> rgb, const GrayImage& figure,
                                                      int radius, double epsilon) {
    ColorPlanes guide;
    for (std::size_t k = 0; k < guide.size(); ++k) {
        guide[k] = GrayImage(figure.width(), figure.height());
        for (std::size_t i = 0; i < figure.pixels().size(); ++i) guide[k].pixels()[i] = rgb[3 * i + k] / 255;
    }
    const GuidedFit fit = guided_fit(guide, figure, radius, epsilon);
    std::vector<float> planes;  // of each pixel: what a red, a green and a blue of 1 add, and the rest
    planes.reserve(4 * figure.pixels().size());
    for (std::size_t i = 0; i < figure.pixels().size(); ++i) {
        for (const GrayImage& slope : fit.slope) planes.push_back(slope.pixels()[i]);
        planes.push_back(fit.offset.pixels()[i]);
    }
    ResizedRows<4> rows({planes, 4 * std::size_t(figure.width())}, figure.width(), figure.height(),
                        region.width, region.height);
    std::vector<float> row(4 * std::size_t(region.width));

    Segmentation result{.x = region.x,
                        .y = region.y,
                        .figure = GrayImage(region.width, region.height),
                        .ground = GrayImage(region.width, region.height),
                        .mask = Mask(region.width, region.height)};
    for (int y = 0; y < region.height; ++y) {
        rows.write(std::size_t(y), row);
        const float* plane = row.data();
        for (int x = 0; x < region.width; ++x, plane += 4) {
            const Rgb c = picture(region.x + x, region.y + y);
            const float p =
                std::clamp((plane[0] * c.r + plane[1] * c.g + plane[2] * c.b) / 255 + plane[3], 0.0f, 1.0f);
            result.figure(x, y) = p, result.ground(x, y) = 1 - p;
            result.mask(x, y) = p > 0.5f;
        }
    }
    return result;
}

}  // namespace detail

inline Segmentation ExemplarSegmenter::cut_out(std::span<const std::uint32_t> exemplar_indices,
                                               std::span<const float> colors, const Box& box,
                                               const RgbImage& picture, const Model& model) const {
    const ExemplarPrior lenders(model, exemplar_indices,
                                describe_exemplar(picture, box, compared_boxes(box, exemplars)), exemplars);
    const detail::SampledRegion sampled(box, margin, max_side_px, picture.width(), picture.height());
    const std::vector<float> rgb = region_colors(picture, sampled.region, sampled.width, sampled.height);
    const ColorBins bins(rgb);
    const std::vector<float> class_odds = figure_color_odds(colors, rgb);
    const auto log_odds = [&](const GrayImage& prior) {
        const GrayImage at_pixels = sampled.to_pixels(prior);
        std::vector<float> odds;
        odds.reserve(class_odds.size());
        const float least = float(min_prior);
        for (const float shown : at_pixels.pixels()) {
            const float p = std::clamp(shown, least, 1 - least);
            odds.push_back(std::log(p / (1 - p)) + float(class_colors) * class_odds[odds.size()]);
        }
        return odds;
    };

    GrayImage figure(sampled.width, sampled.height);
    std::vector<float> odds = log_odds(lenders.prior());
    const auto probability = [](float odd) { return 1 / (1 + std::exp(-odd)); };
    std::transform(odds.begin(), odds.end(), figure.pixels().begin(), probability);
    for (int round = 0; round < color_rounds + agreement_rounds; ++round) {
        if (round >= color_rounds) odds = log_odds(lenders.prior(sampled.to_samples(figure)));
        const std::vector<float> told = bins.log_ratio(figure.pixels(), float(max_log_ratio));
        for (std::size_t i = 0; i < told.size(); ++i) figure.pixels()[i] = probability(odds[i] + told[i]);
    }

    const int radius = std::max(1, int(std::lround(filter_radius * std::sqrt(box.area()) * sampled.zoom)));
    Segmentation result =
        detail::guided_segmentation(picture, sampled.region, rgb, figure, radius, filter_epsilon);
    result.mask = without_specks(std::move(result.mask), least_piece);
    return result;
}

}  // namespace ism
