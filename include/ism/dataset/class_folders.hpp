// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Images without a file of labels: the folder tells the class. By stb_image: see ism/io/images.hpp
/// for what a program needs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "ism/dataset/image_files.hpp"
#include "ism/dataset/mask_files.hpp"

namespace ism {

namespace detail {

/// @brief Folders of images without objects.
[[nodiscard]] inline bool is_background_name(const std::string& name) {
    static const std::set<std::string> names = {"background", "backgrounds", "negative", "negatives"};
    return names.contains(lower(name));
}

/// @brief The mask beside an image, or the image itself where it has transparent pixels; empty where neither.
/// Depth beside it is no mask.
[[nodiscard]] inline std::filesystem::path mask_file_of(const std::filesystem::path& image) {
    const std::string stem = image.stem().string();
    for (const char* ending : {"_mask", "_MASK"})
        if (const auto named = image_of_stem(image.parent_path(), stem + ending); !named.empty())
            return named;
    for (const char* ending : {".png", ".PNG"})
        if (const auto beside = image.parent_path() / (stem + ending);
            lower(image.extension().string()) != ".png" && std::filesystem::exists(beside) &&
            !is_depth_image(beside))
            return beside;
    return has_transparent_pixels(image) ? image : std::filesystem::path();
}

/// @brief Whether a file is named as a mask of its own: NAME_mask.
[[nodiscard]] inline bool is_mask_name(const std::filesystem::path& file) {
    return lower(file.stem().string()).ends_with("_mask");
}

/// @brief Whether a file is the mask of another one in its folder.
[[nodiscard]] inline bool is_mask_file(const std::filesystem::path& file) {
    const std::string stem = file.stem().string();
    if (is_mask_name(file)) return true;
    return lower(file.extension().string()) == ".png" && !is_depth_image(file) &&
           !image_of_stem(file.parent_path(), stem, ".png").empty();
}

/// @brief The images of a folder that are no masks of others.
[[nodiscard]] inline std::vector<std::filesystem::path> picture_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files = image_files(folder);
    std::erase_if(files, is_mask_file);
    return files;
}

/// @brief An image of a class: one object, the figure of its mask, or where there is none the whole image.
[[nodiscard]] inline DatasetImage class_image(std::int64_t id, const std::filesystem::path& file,
                                              std::uint32_t class_index, const DatasetReadOptions& options) {
    const auto mask_file = mask_file_of(file);
    if (mask_file.empty()) {
        DatasetImage image = labelled_image(id, file, options);
        image.objects.push_back(
            {.class_index = class_index, .box = {0, 0, double(image.width), double(image.height)}});
        return image;
    }
    const Mask mask = read_mask_file(mask_file);
    const ImageSize size{mask.width(), mask.height()};
    DatasetImage image =
        at_place(file_text(mask_file), [&] { return labelled_image(id, file, options, &size); });
    add_masked(image, class_index, mask);
    return image;
}

}  // namespace detail

/// @brief Reads images without labels, numbered from 1 in the order of their names; depth among them is left
/// out (see depth_among()).
/// @throws FileError, naming the file, where one cannot be read and there is no list of faults.
[[nodiscard]] inline Dataset read_image_folder(const std::filesystem::path& folder,
                                               const DatasetReadOptions& options = {}) {
    Dataset dataset = detail::folder_dataset(folder);
    std::int64_t id = 0;
    const auto files = detail::image_files(folder);
    const auto depth = detail::depth_among(files);
    dataset.depth_left_out = depth.size();
    for (const auto& file : files) {
        if (depth.contains(file)) continue;
        ++id;
        read_or_tell(options.faults,
                     [&] { dataset.images.push_back(detail::labelled_image(id, file, options)); });
    }
    return dataset;
}

/// @brief Reads a folder with one folder a class: each image shows one object. Its mask is NAME_mask.png, or
/// NAME.png beside an image of another format, or the image's own transparency; without a mask the whole
/// image is the object. Images in a folder named background or negative show no object. Depth among the
/// images of a class is left out (see depth_among()). Images are numbered from 1 in the order of their names,
/// classes too.
/// @throws FileError, naming the file, where something else stands among the folders; and where there is no
/// image of a class, an image or mask cannot be read, they differ in size, a mask is without an image or
/// figure, and there is no list of faults.
[[nodiscard]] inline Dataset read_class_folders(const std::filesystem::path& folder,
                                                const DatasetReadOptions& options = {}) {
    Dataset dataset = detail::folder_dataset(folder);
    dataset.classes_listed = false;
    std::int64_t id = 0;
    for (const auto& part : detail::folder_entries(folder)) {
        const std::string place = "folder '" + one_line(part.string()) + "'";
        if (!std::filesystem::is_directory(part)) {
            if (!detail::is_image_name(part)) continue;
            throw FileError(file_text(part) +
                            ": expected images in the folder of their class, got one beside the folders");
        }
        const std::string name = path_to_utf8(part.filename());
        const bool background = detail::is_background_name(name);
        std::size_t images = 0;
        const auto pictures = detail::picture_files(part);  // by name
        const auto depth = detail::depth_among(pictures);
        dataset.depth_left_out += depth.size();
        for (const auto& file : detail::folder_entries(part)) {
            if (std::filesystem::is_directory(file))
                throw FileError(place +
                                ": expected the images of a class, got a folder of folders; give the folder "
                                "above those of the classes");
            if (!detail::is_image_name(file) || depth.contains(file)) continue;
            ++images;
            read_or_tell(options.faults, [&] {
                const std::string stem = file.stem().string();
                if (!std::binary_search(pictures.begin(), pictures.end(), file)) {
                    --images;
                    if (detail::is_mask_name(file) &&
                        detail::image_of_stem(part, stem.substr(0, stem.size() - 5)).empty())
                        throw FileError(file_text(file) + ": expected an image beside this mask, got none");
                    return;
                }
                ++id;
                dataset.images.push_back(
                    background
                        ? detail::labelled_image(id, file, options)
                        : detail::class_image(id, file, std::uint32_t(dataset.class_names.size()), options));
            });
        }
        const bool any = read_or_tell(options.faults, [&] {
            if (images == 0) throw FileError(place + ": expected images of a class, got none");
        });
        if (any && !background) dataset.class_names.push_back(name);
    }
    detail::number(dataset);
    return dataset;
}

}  // namespace ism
