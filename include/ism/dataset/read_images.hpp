// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief The pixels of a data set's images, by stb_image: see ism/io/images.hpp for what a program needs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>

#include "ism/core/frame.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/dataset/depth_scale.hpp"
#include "ism/dataset/labelled_image.hpp"
#include "ism/io/images.hpp"
#include "ism/io/paths.hpp"
#include "ism/train/training_image.hpp"
#include "ism/train/training_set.hpp"

namespace ism {

/// @brief Reads an image file as read_picture() does; a function of one's own reads more formats.
using PictureReader = Picture (*)(const std::filesystem::path&, std::optional<ImageSize>);

/// @brief Reads an image's brightness and colour, its depth in metres where it has a depth file with any
/// reading (of a covered lens there is none), and its camera. A JPEG is turned as its EXIF orientation says,
/// unless the data set's size is that of its stored pixels and not that of the shown ones: then they stay as
/// they are stored.
/// @throws FileError, naming the file, where one cannot be read, is of another size than the data set says,
/// is smaller than 16×16, has a depth scale that check_depth_scale() refuses, or has depth and was turned:
/// nothing tells whether the depth was turned too.
[[nodiscard]] inline Frame read_frame(const DatasetImage& image, PictureReader read = read_picture) {
    const auto check_size = [&](const std::filesystem::path& file, const auto& pixels, const char* as) {
        if (pixels.width() != image.width || pixels.height() != image.height)
            throw FileError(join_text(file_text(file), ": expected ", detail::sides_text(image),
                                      " pixels as ", as, ", got ", size_text(pixels)));
    };
    Picture picture = read(image.file, ImageSize{image.width, image.height});
    Frame frame{.gray = std::move(picture.gray), .color = std::move(picture.color)};
    check_size(image.file, frame.gray, "its data set says");
    if (!image.depth_file.empty()) {
        if (picture.orientation != 1)
            throw FileError(join_text(file_text(image.file),
                                      ": expected a picture stored upright beside depth, got one that EXIF "
                                      "turns (orientation ",
                                      picture.orientation, ")"));
        const RawDepth raw = read_raw_depth(image.depth_file);
        check_size(image.depth_file, raw, "its picture has");
        frame.depth_m = to_metres(raw, image.depth_scale);
        at_place(file_text(image.depth_file), [&] { check_depth_scale(frame.depth_m, image.depth_scale); });
        if (!has_reading(frame.depth_m)) frame.depth_m = {};
    }
    frame.camera = image.camera;
    at_place(file_text(image.file), [&] { check(frame); });
    return frame;
}

/// @brief Reads an image and decodes its objects' masks; crowds are to be ignored.
/// @throws FileError as read_frame() and read_mask() do.
[[nodiscard]] inline TrainingImage read_training_image(const DatasetImage& image,
                                                       PictureReader read = read_picture) {
    return to_training_image(image, read_frame(image, read));
}

/// @brief The images of a data set to learn from: labels without opening a file, images when they are needed.
/// @param dataset  has to stay as long as the set
[[nodiscard]] inline TrainingSet training_set(const Dataset& dataset, PictureReader read = read_picture) {
    return {.size = dataset.images.size(),
            .labels = [&dataset](std::size_t i) { return object_labels(dataset.images[i]); },
            .image = [&dataset, read](std::size_t i) { return read_training_image(dataset.images[i], read); },
            .category_ids = dataset.category_ids};
}
TrainingSet training_set(Dataset&& dataset, PictureReader read = read_picture) = delete;

}  // namespace ism
