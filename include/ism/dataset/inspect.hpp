// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/frame.hpp"
#include "ism/core/number_text.hpp"
#include "ism/core/order.hpp"
#include "ism/dataset/camera_doubt.hpp"
#include "ism/dataset/dataset.hpp"

namespace ism {

/// @brief What is asked of labels before they are learnt from.
struct InspectOptions {
    double min_side_px = 16;         ///< a shorter side of a box is hardly seen by detectors of features
    double max_outside_image = 0.1;  ///< share of a box's area
    double max_outside_box = 0.05;   ///< share of a mask's pixels
    double min_mask_fill = 0.5;      ///< IoU of a box with the one around its mask
    double min_depth_m = 0.1, max_depth_m = 20;  ///< of objects before a depth camera
    double min_depth_share = 0.3;                ///< of an object's pixels, with a reading
    double same_object_iou = 0.9;                ///< of two boxes that seem to be of one object
    double position_margin = 0.5;  ///< of a box's sides: what is seen further outside is not its object
};

/// @brief Something about a label or an image that looks wrong.
struct Remark {
    static constexpr std::size_t whole_image = std::numeric_limits<std::size_t>::max();
    std::string kind = {};             ///< such as "tiny box": the same for all of its kind
    std::size_t object = whole_image;  ///< index into DatasetImage::objects
    std::string text = {};             ///< what was seen
};

/// @brief What a labelled object is like.
struct ObjectFacts {
    std::size_t object = 0;  ///< index into DatasetImage::objects
    double size_px = 0;      ///< root of the box's area
    bool masked = false;
    double depth_share = 0;     ///< of its pixels, with a reading
    double depth_m = no_depth;  ///< median
};

/// @brief What an image of a data set is like.
struct ImageFacts {
    std::vector<ObjectFacts> objects = {};  ///< crowds left out
    std::vector<Remark> remarks = {};
    double depth_share = 0;         ///< of its pixels, with a reading
    std::uint64_t fingerprint = 0;  ///< the same for the same pixels
};

/// @brief Whether two images have the same labels, in any order; masks are not compared.
[[nodiscard]] inline bool same_labels(const DatasetImage& a, const DatasetImage& b) {
    const auto alike = [](const DatasetAnnotation& one, const DatasetAnnotation& other) {
        return one.class_index == other.class_index && one.box == other.box && one.crowd == other.crowd;
    };
    return std::is_permutation(a.objects.begin(), a.objects.end(), b.objects.begin(), b.objects.end(), alike);
}

namespace detail {

/// FNV-1a (Fowler, Noll, Vo) over the pixels and the size.
[[nodiscard]] inline std::uint64_t pixel_fingerprint(ImageView<const Rgb> image) {
    std::uint64_t hash = 14695981039346656037u;
    const auto add = [&](std::uint64_t byte) { hash = (hash ^ byte) * 1099511628211u; };
    add(std::uint64_t(image.width())), add(std::uint64_t(image.height()));
    for (int y = 0; y < image.height(); ++y)
        for (const Rgb& pixel : image.row(y)) add(pixel.r), add(pixel.g), add(pixel.b);
    return hash;
}

/// Remarks on box and mask of an object, and its facts.
[[nodiscard]] inline ObjectFacts inspect_object(const DatasetImage& image, std::size_t index,
                                                const Frame& frame, const InspectOptions& options,
                                                std::vector<Remark>& remarks) {
    const DatasetAnnotation& object = image.objects[index];
    const Box& box = object.box;
    ObjectFacts facts{.object = index, .size_px = std::sqrt(box.area())};
    const auto remark = [&](const char* kind, std::string text) {
        remarks.push_back({kind, index, std::move(text)});
    };
    const auto percent = [](double share) { return number_text(std::round(100 * share)) + " %"; };
    if (std::min(box.width, box.height) < options.min_side_px)
        remark("tiny box", join_text(number_text(box.width), "x", number_text(box.height), " px"));
    const Box page{0, 0, double(image.width), double(image.height)};
    const double outside = 1 - intersection(box, page).area() / box.area();
    if (outside > options.max_outside_image) remark("box outside the image", percent(outside) + " of it");

    Mask mask;
    try {
        mask = read_mask(image, object);
    } catch (const Error& error) {
        remark("bad mask", error.what());
    }
    facts.masked = !mask.empty();
    if (facts.masked) {
        std::size_t all = 0, beyond = 0;
        for (int y = 0; y < mask.height(); ++y)
            for (int x = 0; x < mask.width(); ++x) {
                if (mask(x, y) == 0) continue;
                ++all;
                beyond += x + 0.5 < box.x || x + 0.5 > box.x + box.width || y + 0.5 < box.y ||
                          y + 0.5 > box.y + box.height;
            }
        const double share = double(beyond) / double(all);
        if (share > options.max_outside_box) remark("mask outside its box", percent(share) + " of it");
        const double fill = iou(intersection(box, page), mask_box(mask));
        if (fill < options.min_mask_fill && share <= options.max_outside_box)
            remark("box much larger than its mask", "the mask's box covers " + percent(fill));
    }
    std::vector<float> readings;
    if (!frame.depth_m.empty()) {
        std::size_t pixels = 0;
        const Box seen = intersection(box, page);
        for (int y = int(seen.y); y < int(std::ceil(seen.y + seen.height)); ++y)
            for (int x = int(seen.x); x < int(std::ceil(seen.x + seen.width)); ++x) {
                if (!frame.depth_m.contains(x, y) || (facts.masked && mask(x, y) == 0)) continue;
                ++pixels;
                if (is_depth(double(frame.depth_m(x, y)))) readings.push_back(frame.depth_m(x, y));
            }
        facts.depth_share = pixels > 0 ? double(readings.size()) / double(pixels) : 0;
        if (facts.depth_share < options.min_depth_share)
            remark("little depth", percent(facts.depth_share) + " of the object has a reading");
        if (!readings.empty()) {
            facts.depth_m = double(nth_smallest(readings, readings.size() / 2));
            if (!(facts.depth_m >= options.min_depth_m && facts.depth_m <= options.max_depth_m))
                remark("depth scale",
                       join_text("the object would be ", number_text(facts.depth_m, 3),
                                 " m away; depth_scale is ", number_text(image.depth_scale), " m per unit"));
        }
    }
    if (object.position_m && frame.camera)
        if (std::string doubt =
                position_doubt(*object.position_m, box, *frame.camera, readings, options.position_margin);
            !doubt.empty())
            remark("position", std::move(doubt));
    return facts;
}

}  // namespace detail

/// @brief What an image and its labels are like, and what looks wrong.
/// @param frame  of the image, as read_frame() reads it
[[nodiscard]] inline ImageFacts inspect_image(const DatasetImage& image, const Frame& frame,
                                              const InspectOptions& options = {}) {
    ImageFacts facts{.fingerprint = detail::pixel_fingerprint(frame.color)};
    if (!image.depth_file.empty() && frame.depth_m.empty())
        facts.remarks.push_back({.kind = "depth without a reading", .text = "it counts as without depth"});
    if (frame.camera)
        if (std::string doubt = camera_doubt(*frame.camera, image.width, image.height); !doubt.empty())
            facts.remarks.push_back({.kind = "camera", .text = std::move(doubt)});
    for (std::size_t i = 0; i < image.objects.size(); ++i) {
        const DatasetAnnotation& object = image.objects[i];
        if (object.crowd) continue;
        facts.objects.push_back(detail::inspect_object(image, i, frame, options, facts.remarks));
        for (std::size_t j = 0; j < i; ++j) {
            const DatasetAnnotation& other = image.objects[j];
            if (other.crowd || iou(other.box, object.box) < options.same_object_iou) continue;
            if (other.class_index == object.class_index)
                facts.remarks.push_back({"labelled twice", i, "another label has almost the same box"});
            else
                facts.remarks.push_back(
                    {"two classes in one box", i, "a label of another class has almost the same box"});
        }
    }
    if (!frame.depth_m.empty()) {
        std::size_t readings = 0;
        for (const float depth_m : frame.depth_m.pixels()) readings += is_depth(double(depth_m));
        facts.depth_share = double(readings) / double(frame.depth_m.pixels().size());
    }
    return facts;
}

}  // namespace ism
