// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "ism/core/callable.hpp"
#include "ism/core/error.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/image_turn.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/move_to.hpp"
#include "ism/detect/rivals.hpp"
#include "ism/detect/verify.hpp"
#include "ism/feature/feature.hpp"
#include "ism/model/calibration.hpp"

namespace ism {

/// @brief A frame turned about its middle, without its camera: between pixels brightness and colours are
/// interpolated and depth is the nearest; beyond its edges they go on, and there is no depth.
[[nodiscard]] inline Frame turned_frame(const Frame& frame, const ImageTurn& turn) {
    const auto between = [](const auto& image) {
        return [&image](Point2 at) { return sample_bilinear(image.view(), float(at.x), float(at.y)); };
    };
    Frame turned{.gray = turned_image<float>(turn, between(frame.gray))};
    if (!frame.color.empty()) turned.color = turned_image<Rgb>(turn, between(frame.color));
    if (!frame.depth_m.empty())
        turned.depth_m = turned_image<float>(turn, [&](Point2 at) {
            const int x = int(std::lround(at.x)), y = int(std::lround(at.y));
            return frame.depth_m.contains(x, y) ? frame.depth_m(x, y) : no_depth;
        });
    if (!has_reading(turned.depth_m)) turned.depth_m = {};
    return turned;
}

/// @brief What was cut out of a turned image as it lies in the image, which has width × height pixels; its
/// box is that of the mask. Empty where all of it lies outside.
[[nodiscard]] inline Segmentation turned_back(const Segmentation& part, const ImageTurn& turn, int width,
                                              int height) {
    double left = width, top = height, right = -1, bottom = -1;
    for (const int x : {part.x, part.x + part.mask.width() - 1})
        for (const int y : {part.y, part.y + part.mask.height() - 1}) {
            const Point2 corner = turn.back(Point2{double(x), double(y)});
            left = std::min(left, corner.x), right = std::max(right, corner.x);
            top = std::min(top, corner.y), bottom = std::max(bottom, corner.y);
        }
    Segmentation result;
    result.x = std::max(0, int(std::floor(left))), result.y = std::max(0, int(std::floor(top)));
    const int columns = std::min(width, int(std::ceil(right)) + 1) - result.x,
              rows = std::min(height, int(std::ceil(bottom)) + 1) - result.y;
    if (part.mask.empty() || columns <= 0 || rows <= 0) return {};
    result.figure = result.ground = GrayImage(columns, rows);
    result.mask = Mask(columns, rows);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const Point2 at = turn.turned({double(result.x + x), double(result.y + y)});
            const int u = int(std::lround(at.x)) - part.x, v = int(std::lround(at.y)) - part.y;
            if (!part.mask.contains(u, v)) continue;
            result.figure(x, y) = part.figure(u, v), result.ground(x, y) = part.ground(u, v);
            result.mask(x, y) = part.mask(u, v);
        }
    const Box figure = mask_box(result.mask);
    if (figure.area() > 0)
        result.box = Box{result.x + figure.x, result.y + figure.y, figure.width, figure.height};
    return result;
}

namespace detail {

/// An object of a frame that was turned by -angle_rad, as it lies in the frame; none where it lies outside.
[[nodiscard]] inline std::optional<Detection> turned_back(Detection object, const ImageTurn& turn,
                                                          double angle_rad, const Frame& frame) {
    const int width = frame.gray.width(), height = frame.gray.height();
    const Point2 centre = turn.back(object.centre);
    if (!(centre.x >= 0 && centre.y >= 0 && centre.x <= width - 1 && centre.y <= height - 1)) return {};
    object.segmentation = ism::turned_back(object.segmentation, turn, width, height);
    move_to(object, object.segmentation.box.value_or(turn.back(object.box)), frame.camera);
    object.angle = std::remainder(object.angle + angle_rad, 2 * std::numbers::pi);
    object.cells = {};
    return object;
}

inline void add_stats(DetectionStats& sum, const DetectionStats& more) {
    sum.features += more.features, sum.matches += more.matches, sum.votes += more.votes;
    sum.hypotheses += more.hypotheses, sum.candidates += more.candidates, sum.segmented += more.segmented;
    sum.extract_ms += more.extract_ms, sum.match_ms += more.match_ms, sum.vote_ms += more.vote_ms;
    sum.rescore_ms += more.rescore_ms, sum.segment_ms += more.segment_ms, sum.verify_ms += more.verify_ms;
}

}  // namespace detail

/// @brief At how many angles detect_turned() looks, and which of what it finds it tells.
struct TurnOptions {
    int turns = 24;  ///< 1 … 360, evenly over the circle; templates find what is turned by about 7 degrees
    RivalOptions rivals = {};    ///< of objects seen at any angle
    double min_probability = 0;  ///< as DetectOptions::min_probability
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const TurnOptions& options) {
    expect(options.turns >= 1 && options.turns <= 360, "turns", "1 ... 360", options.turns);
    check(options.rivals);
    expect(options.min_probability >= 0 && options.min_probability <= 1, "TurnOptions::min_probability",
           "0 ... 1", options.min_probability);
}

/// @brief Finds objects however they are turned in the image by a model that knows them upright: looks at the
/// frame turned by each angle, and of what it finds at one place the strongest stays, of all classes; or,
/// where the calibration of the model's templates is given, of each class, which yields to more probable ones
/// as upright. It takes as many times as long. Turned objects have their Detection::angle and the box of
/// their mask, and no Detection::cells; of depth they have what features see.
/// @param find         Detections find(const Frame&), such as a lambda that calls FrameDetector::detect(); it
///                     is given the frame itself first, then turned ones without camera
/// @param calibration  Model::template_calibration where find() judges by templates
/// @throws Error for a frame that check(Frame) refuses, or an option out of range.
template <Callable<const Frame&> Find>
[[nodiscard]] Detections detect_turned(const Frame& frame, const TurnOptions& options, const Find& find,
                                       const Calibration& calibration = {}) {
    check(options);
    check(frame);
    Detections all = find(frame);
    for (int k = 1; k < options.turns; ++k) {
        const double angle_rad = 2 * std::numbers::pi * k / options.turns;
        const ImageTurn turn(frame.gray.width(), frame.gray.height(), -angle_rad);
        Detections found = find(turned_frame(frame, turn));
        const auto first = std::uint32_t(all.features.size());
        for (Feature feature : found.features) {
            const Point2 at = turn.back(Point2{double(feature.x), double(feature.y)});
            feature.x = float(at.x), feature.y = float(at.y);
            feature.angle = float(std::remainder(feature.angle + angle_rad, 2 * std::numbers::pi));
            all.features.push_back(feature);
        }
        const auto back = [&](Detection&& object) {
            for (Support& support : object.support) support.feature += first;
            return detail::turned_back(std::move(object), turn, angle_rad, frame);
        };
        for (Detection& object : found.objects)
            if (auto here = back(std::move(object))) all.objects.push_back(std::move(*here));
        if (found.next_best)
            if (auto here = back(std::move(*found.next_best)))
                detail::keep_more_probable(all.next_best, std::move(*here));
        detail::add_stats(all.stats, found.stats);
    }
    if (options.turns > 1 && !calibration.empty()) yield_to_rivals(all.objects, calibration, options.rivals);
    const NonMaximumSuppression suppression{.max_inside = calibration.tells_apart() ? 1 : 0.5,
                                            .across_classes = calibration.empty()};
    std::vector<Detection> strongest;
    for (const Verified& verified : suppression.verify(all.objects)) {
        Detection& object = all.objects[verified.index];
        if (!(object.probability < options.min_probability))
            strongest.push_back(std::move(object));
        else
            detail::keep_more_probable(all.next_best, std::move(object));
    }
    all.objects = std::move(strongest);
    // What one look was not sure of another may have told.
    if (all.next_best && detail::any_of(all.objects, [&](const Detection& object) {
            return object.class_index == all.next_best->class_index &&
                   is_one_object(object.box, all.next_best->box);
        }))
        all.next_best.reset();
    return all;
}

}  // namespace ism
