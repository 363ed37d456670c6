// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "ism/core/box_region.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/random.hpp"
#include "ism/train/template_examples.hpp"
#include "ism/train/turned_object.hpp"

/// Objects as they would look elsewhere: cut out and put before what other training images show.
namespace ism::detail {

/// Part of an image that can stand behind an object.
struct Ground {
    ImageView<const Rgb> image;
    Box box;  ///< of the aspect of the picture that it is to fill
};

/// How much of a box objects of a class, or what is ignored, cover; more than 1 where several lie there.
[[nodiscard]] inline double covered(const TemplateImage& image, std::uint32_t class_index, const Box& box) {
    double area = 0;
    for (const ObjectLabel& label : image.labels)
        if (label.class_index == class_index) area += intersection(label.box, box).area();
    for (const Box& region : image.ignored) area += intersection(region, box).area();
    return area / box.area();
}

/// A random part of an image, of this aspect: the first of ten where no object of the class lies, or that
/// where the least of them does.
[[nodiscard]] inline Ground random_ground(const TemplateImage& image, std::uint32_t class_index, double width,
                                          double height, Random& random) {
    constexpr int tries = 10;
    constexpr double least_part = 0.4;  // of the largest that lies within the image
    const double image_width = image.color.width(), image_height = image.color.height(),
                 largest = std::min(image_width / width, image_height / height);
    Ground best{.image = image.color, .box = {}};
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < tries && least > 0; ++k) {
        const double scale = largest * random.uniform(least_part, 1);
        const Box box{random.uniform() * (image_width - scale * width),
                      random.uniform() * (image_height - scale * height), scale * width, scale * height};
        if (const double part = covered(image, class_index, box); part < least) best.box = box, least = part;
    }
    return best;
}

/// Replaces what lies around an object.
/// @param object  that is not turned
/// @param mask    the object's box in cells: share of figure, 0 … 255
inline void put_before(ObjectPicture& object, const Mask& mask, const Ground& ground) {
    RgbImage& picture = object.picture;
    const double scale = ground.box.width / picture.width();
    const ColorSampler behind(ground.image,
                              BoxRegion(ground.box, 0, ground.image.width(), ground.image.height()),
                              std::min(1.0, 1 / scale));
    GrayImage figure(mask.width() + 2, mask.height() + 2);  // with a margin of nothing
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) figure(x + 1, y + 1) = float(mask(x, y)) / 255;
    const double across = mask.width() / object.box.width, down = mask.height() / object.box.height;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const float share = sample_bilinear(figure, float((x + 0.5 - object.box.x) * across + 0.5),
                                                float((y + 0.5 - object.box.y) * down + 0.5));
            const float own = std::clamp(2 * share - 0.5f, 0.0f, 1.0f);  // edges are half as soft as cells
            const Rgb other = behind(ground.box.x + scale * (x + 0.5), ground.box.y + scale * (y + 0.5));
            Rgb& here = picture(x, y);
            const auto mixed = [&](std::uint8_t front, std::uint8_t back) {
                return std::uint8_t(own * float(front) + (1 - own) * float(back) + 0.5f);
            };
            here = {mixed(here.r, other.r), mixed(here.g, other.g), mixed(here.b, other.b)};
        }
}

/// Adds the objects of a class, as far as their masks are known, before the ground of other images (cut and
/// paste: Dwibedi, Misra and Hebert 2017): what stands behind them where they were photographed tells less of
/// them.
/// @param others   images of which parts may stand behind them
/// @param pyramid  for pictures of them
inline void add_examples_before(std::span<const TemplateImage* const> others, const TemplateImage& image,
                                std::uint32_t class_index, const BoxGrid& grid, int copies, Random& random,
                                HogPyramid& pyramid, ThreadPool& pool, TemplateExamples& examples) {
    for (std::size_t i = 0; i < image.masks.size() && !others.empty(); ++i) {
        const ObjectLabel& label = image.labels[i];
        for (int k = 0; k < copies && label.class_index == class_index && image.masks[i]; ++k) {
            ObjectPicture object = turned_object(image.color, label.box, 0, picture_margin(grid));
            const TemplateImage& other = *others[random.index(others.size())];
            put_before(
                object, *image.masks[i],
                random_ground(other, class_index, object.picture.width(), object.picture.height(), random));
            add_picture(object, class_index, grid, pyramid, pool, examples);
        }
    }
}

}  // namespace ism::detail
