// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Labels of YOLO: a text file an image, with a line an object. By stb_image: see ism/io/images.hpp
/// for what a program needs.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "ism/core/box_check.hpp"
#include "ism/dataset/image_files.hpp"
#include "ism/dataset/yolo_places.hpp"

namespace ism {

namespace detail {

/// @brief The labels of an image: in the folder labels for images, else beside it.
[[nodiscard]] inline std::filesystem::path yolo_labels(const std::filesystem::path& image) {
    std::filesystem::path labels, parent = image.parent_path();
    std::vector<std::filesystem::path> parts(parent.begin(), parent.end());
    for (std::size_t i = parts.size(); i-- > 0;)
        if (parts[i] == "images") {
            parts[i] = "labels";
            break;
        }
    for (const auto& part : parts) labels /= part;
    const auto name = image.stem().concat(".txt");
    return std::filesystem::exists(labels / name) ? labels / name : parent / name;
}

/// @brief Whether there are labels of this image, and not of another one of its name.
[[nodiscard]] inline bool has_own_labels(const std::filesystem::path& image) {
    return std::filesystem::exists(yolo_labels(image)) &&
           image_of_stem(image.parent_path(), image.stem().string()) == image;
}

/// @brief A line: the class, then middle and sides of a box, or the corners of an outline, in parts of the
/// image's sides.
[[nodiscard]] inline DatasetAnnotation yolo_object(std::string_view line, std::size_t classes,
                                                   const DatasetImage& image) {
    std::vector<double> numbers;
    for (std::string_view rest = line; !rest.empty(); rest = trimmed(rest)) {
        double number = 0;
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
        const bool whole = error == std::errc() && std::isfinite(number) && std::abs(number) <= 1e6 &&
                           (end == rest.data() + rest.size() || *end == ' ' || *end == '\t');
        expect(whole, "label", "numbers", lazy_text("'", one_line(line.substr(0, 60)), "'"));
        numbers.push_back(number);
        rest.remove_prefix(std::size_t(end - rest.data()));
    }
    const bool outline = numbers.size() >= 7 && numbers.size() % 2 == 1;
    expect(numbers.size() == 5 || outline, "label", "5 numbers of a box, or 7, 9, … of an outline",
           lazy_text(numbers.size(), " numbers"));
    expect(numbers[0] >= 0 && numbers[0] < double(classes) && numbers[0] == std::floor(numbers[0]), "class",
           lazy_text("a whole number below ", classes), numbers[0]);
    DatasetAnnotation object{.class_index = std::uint32_t(numbers[0]), .box = {}};
    const double w = image.width, h = image.height;
    if (outline) {
        Polygon polygon;
        for (std::size_t i = 1; i < numbers.size(); i += 2)
            polygon.push_back({numbers[i] * w, numbers[i + 1] * h});
        object.box = box_around(polygon);
        object.segmentation = std::vector<Polygon>{std::move(polygon)};
    } else {
        object.box = {(numbers[1] - numbers[3] / 2) * w, (numbers[2] - numbers[4] / 2) * h, numbers[3] * w,
                      numbers[4] * h};
    }
    check_labelled_box(object.box, image.width, image.height);
    return object;
}

[[nodiscard]] inline DatasetImage yolo_image(std::int64_t id, const std::filesystem::path& file,
                                             std::size_t classes, const DatasetReadOptions& options) {
    DatasetImage image = labelled_image(id, file, options);
    const auto labels = yolo_labels(file);
    if (!std::filesystem::exists(labels)) return image;
    image.label_file = labels;
    for_lines(read_text(labels, 1 << 30), [&](std::string_view line, std::size_t number) {
        const bool read = read_or_tell(options.faults, [&] {
            image.objects.push_back(at_place(join_text(file_text(labels), ", line ", number),
                                             [&] { return yolo_object(line, classes, image); }));
        });
        if (!read) image.incomplete = true;
    });
    return image;
}

/// @brief The images of a folder, or those that a text file lists.
[[nodiscard]] inline std::vector<std::filesystem::path> yolo_files(const std::filesystem::path& place,
                                                                   DatasetPart part) {
    if (place.extension() != ".txt" || std::filesystem::is_directory(place))
        return image_files(yolo_images(place, part));
    std::vector<std::filesystem::path> files;
    for (const std::string& line : lines_of(place))
        files.push_back(place.parent_path() / path_from_utf8(line));
    return files;
}

}  // namespace detail

/// @brief Reads labels of YOLO, boxes and outlines. A YAML file names the classes (`names`) and folders or
/// lists of images (`train`, `val`, `test`, below `path`): the part that is asked for is read, `val` where
/// there is no `test`. In a folder, images are there or in images/, and the classes in data.yaml or
/// classes.txt, up to two folders above. Labels are in labels/ in place of images/, or beside the images; an
/// image without is background. Depth among the images of a folder or list is left out where it has no labels
/// of its own (see depth_among()). Images are numbered from 1 in the order of their names, classes too as
/// they are listed.
/// @throws FileError, naming the file and the line, where one cannot be read or makes no sense and there is
/// no list of faults.
[[nodiscard]] inline Dataset read_yolo(const std::filesystem::path& path,
                                       const DatasetReadOptions& options = {}) {
    const detail::YoloPlaces places = detail::yolo_places(path, options);
    Dataset dataset = detail::folder_dataset(places.root);
    dataset.class_names = places.names, dataset.part = places.part;
    std::int64_t id = 0;
    for (const auto& place : places.images) {
        const auto files = detail::yolo_files(place, options.part);
        const auto depth = detail::depth_among(files);
        for (const auto& file : files) {
            if (depth.contains(file) && !detail::has_own_labels(file)) {
                ++dataset.depth_left_out;
                continue;
            }
            ++id;
            read_or_tell(options.faults, [&] {
                dataset.images.push_back(detail::yolo_image(id, file, places.names.size(), options));
            });
        }
    }
    detail::number(dataset);
    return dataset;
}

}  // namespace ism
