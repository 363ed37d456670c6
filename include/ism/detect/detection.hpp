// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/rotation.hpp"
#include "ism/feature/feature.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/model/box_cues.hpp"

namespace ism {

/// @brief One vote that a hypothesis stands on: which feature cast it, through which word and occurrence.
struct Support {
    std::uint32_t feature = 0;     ///< index of the feature in the image
    std::uint32_t word = 0;        ///< index of the matched word in the codebook
    std::uint32_t occurrence = 0;  ///< index of the occurrence in the model
    float weight = 0;              ///< what it adds to the score
};

/// @brief Why a mask is taken for an object of a class (MaskJudge): what votes, colour and shape add to the
/// logarithm of the odds, and the training objects it looks like.
struct MaskReasons {
    double votes = 0, color = 0, shape = 0;
    double look = 0;                                                    ///< colour and shape together
    double outline = 0;                                                 ///< how the mask ends
    std::optional<std::uint32_t> color_object = {}, shape_object = {};  ///< indices into ShapeModel::objects
};

/// @brief Which pixels belong to an object. All images are of one size and cover the part of the image
/// whose first pixel is (x, y).
struct Segmentation {
    int x = 0, y = 0;  ///< where the part begins, pixels of the image
    GrayImage figure;  ///< p(figure), ≥ 0; by votes that which they carry, 0 where no patch reaches
    GrayImage ground;  ///< p(ground), ≥ 0
    Mask mask;         ///< 1 where figure outweighs ground
    std::optional<Box> box =
        {};  ///< where the object lies by what was cut out; none: where it was seen before
};

/// @brief Validates a segmentation.
/// @throws Error where a map is of another size than the mask, or the box is none.
inline void check(const Segmentation& part) {
    for (const GrayImage* map : {&part.figure, &part.ground})
        expect(map->width() == part.mask.width() && map->height() == part.mask.height(),
               "segmentation: maps of figure and ground", size_text(part.mask), size_text(*map));
    if (const std::optional<Box>& box = part.box)
        expect(std::isfinite(box->x + box->y) && box->width > 0 && box->height > 0 &&
                   std::isfinite(box->width + box->height),
               "segmentation: box", "finite numbers, with sides above 0",
               lazy_text(box->x, ", ", box->y, ", ", box->width, ", ", box->height));
}

/// @brief The mask of a segmentation at image resolution; what reaches outside the image is cut off.
[[nodiscard]] inline Mask whole_mask(const Segmentation& part, int width, int height) {
    Mask whole(width, height);
    for (int y = 0; y < part.mask.height(); ++y)
        for (int x = 0; x < part.mask.width(); ++x)
            if (part.mask(x, y) != 0 && whole.contains(part.x + x, part.y + y))
                whole(part.x + x, part.y + y) = 1;
    return whole;
}

/// @brief An object found in an image.
struct Detection {
    std::uint32_t class_index = 0;  ///< into the model's class names
    double score = 0;               ///< larger is more confident; within an image
    double probability = std::numeric_limits<double>::quiet_NaN();  ///< 0 … 1, comparable between images and
                                                                    ///< classes; NaN = model not calibrated
    Point2 centre;                     ///< of the object, pixels
    Box box;                           ///< pixels; may reach outside the image
    double scale = 1;                  ///< s: the object's size relative to the reference size
    double angle = 0;                  ///< turned by so much, radians from x towards y; 0 where upright
    double depth_m = no_depth;         ///< along the optical axis, metres; NaN = not known
    std::optional<Point3> position_m;  ///< in the camera frame; where camera and depth are known
    double position_error_m =
        std::numeric_limits<double>::quiet_NaN();  ///< what position_m may be off by: how far its
                                                   ///< votes scatter, r.m.s.; NaN = not known
    double size_m =
        std::numeric_limits<double>::quiet_NaN();  ///< of the training objects of its votes, as
                                                   ///< TrainingObject::size_m; NaN = not of votes with poses
    std::optional<Rotation> rotation =
        {};                     ///< against the training image of the heaviest vote; only of votes with poses
    Segmentation segmentation;  ///< figure and ground maps and mask
    std::vector<Support> support;             ///< why it was found, strongest first
    CellShares cells;                         ///< what its template saw; empty unless TemplateScore::explain
    std::optional<MaskReasons> reasons = {};  ///< why its mask is of this class; of MaskJudgeScore
    BoxReasons box_reasons = {};              ///< why its box is, in log odds; empty unless of TemplateScore
};

/// @brief How much each station of the way had to do, and how long it took.
struct DetectionStats {
    std::size_t features = 0, matches = 0, votes = 0;
    std::size_t hypotheses = 0;  ///< places where votes agree
    std::size_t candidates = 0;  ///< what rescoring made of them
    std::size_t segmented = 0;   ///< of these, those that were cut out
    double extract_ms = 0, match_ms = 0, vote_ms = 0, rescore_ms = 0, segment_ms = 0, verify_ms = 0;
};

/// @brief All that was found in an image, with the features it was found by.
struct Detections {
    std::vector<Detection> objects = {};  ///< strongest first
    std::vector<Feature> features = {};   ///< what Support::feature points into
    DetectionStats stats = {};
    std::optional<Detection> next_best = {};  ///< the most probable of what DetectOptions::min_probability
                                              ///< left out. It may lack a mask: then none has judged it
};

namespace detail {

inline void keep_more_probable(std::optional<Detection>& best, Detection other) {
    if (!best || other.probability > best->probability) best = std::move(other);
}

}  // namespace detail

}  // namespace ism
