// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/nearest_name.hpp"
#include "ism/dataset/polygon.hpp"
#include "ism/dataset/rle.hpp"
#include "ism/io/limits.hpp"
#include "ism/io/paths.hpp"

namespace ism {

/// @brief A mask as the data set keeps it; decoded only by read_mask().
using MaskSource = std::variant<std::monostate, CompressedRle, std::vector<Polygon>>;

/// @brief One labelled object of a data set.
struct DatasetAnnotation {
    std::int64_t id = 0;            ///< its own in the data set
    std::uint32_t class_index = 0;  ///< into Dataset::class_names
    Box box;                        ///< pixels; may reach outside the image
    bool crowd = false;  ///< a group, or hard to see: ignored in training and evaluation, and so is what
                         ///< else lies in its box
    MaskSource segmentation = {};
    std::string instance =
        {};  ///< which thing of the class it is, where that is known: the same in each image
    std::optional<Point3> position_m = {};  ///< of its middle in the camera frame, where it was measured
    /// @brief Whether it is labelled with a mask, too.
    [[nodiscard]] bool masked() const { return !std::holds_alternative<std::monostate>(segmentation); }
    [[nodiscard]] bool operator==(const DatasetAnnotation&) const = default;
};

/// @brief One image of a data set with its labels; its pixels are read only by read_frame()
/// (dataset/read_images.hpp).
struct DatasetImage {
    std::int64_t id = 0;                    ///< its own in the data set
    std::filesystem::path file;             ///< colour or grey image
    std::filesystem::path depth_file = {};  ///< 16-bit PNG; empty = none
    std::filesystem::path label_file = {};  ///< of this image alone, a text; empty = none
    int width = 0, height = 0;              ///< pixels
    double depth_scale = 0;                 ///< metres per unit of the depth file
    std::optional<Camera> camera = {};
    std::vector<DatasetAnnotation> objects = {};  ///< without objects it is background
    bool incomplete = false;  ///< labels were left out: what no object covers is not known to be background
    [[nodiscard]] bool operator==(const DatasetImage&) const = default;
};

/// @brief Labelled images.
struct Dataset {
    std::filesystem::path source = {};  ///< the file it was read from, or the folder with a "/" at its end
    std::vector<std::string> class_names = {};
    std::vector<std::int64_t> category_ids = {};  ///< the file's number of each class, in the same order
    std::vector<DatasetImage> images = {};
    bool classes_listed = true;      ///< false: class_names are those that labels name; there may be more
    std::size_t depth_left_out = 0;  ///< grey PNG of 16 bits among the pictures of a folder: they are depth
    std::string part = {};  ///< that was read of a set of parts, as its file or folder names it: "train"
};

/// @brief Where an image may show objects that its labels do not tell: the boxes of crowds, and all of it
/// where it is incomplete.
[[nodiscard]] inline std::vector<Box> ignored_boxes(const DatasetImage& image) {
    std::vector<Box> boxes;
    if (image.incomplete) boxes.push_back({0, 0, double(image.width), double(image.height)});
    for (const DatasetAnnotation& object : image.objects)
        if (object.crowd) boxes.push_back(object.box);
    return boxes;
}

/// @brief The mask of an annotation, of the image's size; without pixels where there is none.
/// @throws FileError, naming the image and the annotation, where the mask is of another size, damaged, or
/// without a figure pixel.
[[nodiscard]] inline Mask read_mask(const DatasetImage& image, const DatasetAnnotation& annotation) {
    if (!annotation.masked()) return {};
    return at_place(join_text(file_text(image.file), ", annotation ", annotation.id), [&] {
        Mask mask;
        if (const auto* packed = std::get_if<CompressedRle>(&annotation.segmentation)) {
            expect(packed->width == image.width && packed->height == image.height, "mask size",
                   detail::sides_text(image), detail::sides_text(*packed));
            mask = decompress_mask(*packed);
        } else {
            mask = fill_polygons(std::get<std::vector<Polygon>>(annotation.segmentation), image.width,
                                 image.height);
        }
        expect(mask_area(mask) > 0, "mask", "at least one figure pixel", "none");
        return mask;
    });
}

/// @brief The part of a data set with these classes alone, in the order of `names`; class indices follow it.
/// An image stays where it shows one of them, or where it had no annotation at all (background); images with
/// nothing but other classes are dropped.
/// @throws Error where a name is not a class of the data set or comes twice, there is none, or the data set
/// has not one category id for each class.
[[nodiscard]] inline Dataset select_classes(const Dataset& dataset, std::span<const std::string> names) {
    std::string known;
    for (const std::string& name : dataset.class_names) known += (known.empty() ? "" : ", ") + one_line(name);
    expect(dataset.category_ids.size() == dataset.class_names.size(), "category ids of the data set",
           dataset.class_names.size(), dataset.category_ids.size());
    expect(!names.empty(), "classes to select", lazy_text("at least one of: ", known), "none");
    Dataset part{.source = dataset.source, .classes_listed = dataset.classes_listed};
    std::map<std::size_t, std::uint32_t> new_index;
    for (const std::string& name : names) {
        const auto found = std::find(dataset.class_names.begin(), dataset.class_names.end(), name);
        expect(found != dataset.class_names.end(), "class to select", lazy_text("one of: ", known),
               lazy_text("'", name, "'", did_you_mean(name, dataset.class_names)));
        const auto index = std::size_t(found - dataset.class_names.begin());
        expect(new_index.emplace(index, std::uint32_t(part.class_names.size())).second, "class to select",
               "each name once", lazy_text("'", name, "' twice"));
        part.class_names.push_back(name);
        part.category_ids.push_back(dataset.category_ids[index]);
    }
    for (const DatasetImage& image : dataset.images) {
        DatasetImage chosen = image;
        chosen.objects.clear();
        for (const DatasetAnnotation& object : image.objects)
            if (const auto found = new_index.find(object.class_index); found != new_index.end()) {
                chosen.objects.push_back(object);
                chosen.objects.back().class_index = found->second;
            }
        if (!chosen.objects.empty() || image.objects.empty()) part.images.push_back(std::move(chosen));
    }
    return part;
}

}  // namespace ism
