// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "ism/detect/detection.hpp"

namespace ism::detail {

/// The smallest box around two boxes.
[[nodiscard]] inline Box enclosing(const Box& a, const Box& b) {
    const double x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

/// The part of a width × height image, whole pixels, that shows a detection, the features that vote for it
/// and some surroundings; the whole image where the detection lies outside.
[[nodiscard]] inline Box surroundings(const Detections& detections, const Detection& detection, int width,
                                      int height, double circle_scales) {
    const Box page{0, 0, double(width), double(height)};
    const Segmentation& part = detection.segmentation;
    Box seen = enclosing(detection.box, {detection.centre.x, detection.centre.y, 1, 1});
    if (!part.mask.empty())
        seen = enclosing(
            seen, {double(part.x), double(part.y), double(part.mask.width()), double(part.mask.height())});
    for (const Support& s : detection.support) {
        expect(s.feature < detections.features.size(), "feature of a vote",
               lazy_text("below ", detections.features.size()), s.feature);
        const Feature& f = detections.features[s.feature];
        const double radius = circle_scales * double(f.scale);
        seen = enclosing(seen, {double(f.x) - radius, double(f.y) - radius, 2 * radius, 2 * radius});
    }
    if (!std::isfinite(seen.x + seen.y + seen.width + seen.height)) return page;
    const double margin = std::max(8.0, 0.12 * std::max(seen.width, seen.height));
    seen = {seen.x - margin, seen.y - margin, seen.width + 2 * margin, seen.height + 2 * margin};
    const Box common = intersection(seen, page);
    if (!(common.width >= 8 && common.height >= 8)) return page;
    const double x = std::floor(common.x), y = std::floor(common.y);
    return {x, y, std::ceil(common.x + common.width) - x, std::ceil(common.y + common.height) - y};
}

/// One detection alone, with the features, in an image that begins at pixel (x, y) of its own.
[[nodiscard]] inline Detections moved_to(const Detections& detections, const Detection& detection, int x,
                                         int y) {
    Detections result{.objects = {detection}, .features = detections.features};
    Detection& object = result.objects.front();
    for (Box* box : {&object.box, &object.cells.box}) box->x -= x, box->y -= y;
    object.centre.x -= x, object.centre.y -= y;
    object.segmentation.x -= x, object.segmentation.y -= y;
    if (std::optional<Box>& box = object.segmentation.box) box->x -= x, box->y -= y;
    for (Feature& f : result.features) f.x -= float(x), f.y -= float(y);
    return result;
}

}  // namespace ism::detail
