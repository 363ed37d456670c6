// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Finding the images of a data set, and its masks that are images. By stb_image: see
/// ism/io/images.hpp for what a program needs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "ism/dataset/dataset.hpp"
#include "ism/dataset/faults.hpp"
#include "ism/dataset/rle.hpp"
#include "ism/io/images.hpp"
#include "ism/io/paths.hpp"

namespace ism {

/// @brief The part of a data set that is asked for, where it has several.
enum class DatasetPart { train, test };

/// @brief How data sets are read that are not COCO's.
struct DatasetReadOptions {
    Faults* faults =
        nullptr;  ///< where given, images and labels that make no sense are left out, and told there
    DatasetPart part = DatasetPart::train;
    ImageFileSize (*image_size)(const std::filesystem::path&) = read_image_size;
};

namespace detail {

[[nodiscard]] inline std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
}

/// @brief The endings of images, also of kinds that are not read: they shall be told.
inline constexpr std::string_view image_endings[] = {".jpg", ".jpeg", ".png",  ".bmp", ".pnm",
                                                     ".ppm", ".pgm",  ".webp", ".tif", ".tiff",
                                                     ".gif", ".heic", ".heif", ".avif"};

/// @brief Whether a file is named as an image, and not as one that the program drew beside it (NAME.ism.png).
[[nodiscard]] inline bool is_image_name(const std::filesystem::path& path) {
    if (path.stem().extension() == ".ism") return false;
    const std::string ending = lower(path.extension().string());
    return std::find(std::begin(image_endings), std::end(image_endings), ending) != std::end(image_endings);
}

/// @brief What is in a folder, by name; nothing hidden.
/// @throws FileError where it cannot be read.
[[nodiscard]] inline std::set<std::filesystem::path> folder_entries(const std::filesystem::path& folder) {
    std::set<std::filesystem::path> entries;
    std::error_code failure;
    std::filesystem::directory_iterator at(folder, failure);
    for (; !failure && at != std::filesystem::directory_iterator(); at.increment(failure))
        if (!at->path().filename().string().starts_with(".")) entries.insert(at->path());
    if (failure)
        throw FileError(join_text("folder '", one_line(folder.string()), "': expected a folder to read, got ",
                                  failure.message()));
    return entries;
}

[[nodiscard]] inline std::vector<std::filesystem::path> image_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : folder_entries(folder))
        if (is_image_name(entry) && !std::filesystem::is_directory(entry)) files.push_back(entry);
    return files;
}

/// @brief The image of this name without its ending, in this folder; empty where there is none.
/// @param except  an ending that it may not have
[[nodiscard]] inline std::filesystem::path image_of_stem(const std::filesystem::path& folder,
                                                         const std::string& stem,
                                                         std::string_view except = {}) {
    std::error_code ignored;
    for (const std::string_view ending : image_endings) {
        if (ending == except) continue;
        std::string upper(ending);
        for (char& c : upper)
            if (c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
        for (const std::string& name : {stem + std::string(ending), stem + upper})
            if (std::filesystem::is_regular_file(folder / name, ignored)) return folder / name;
    }
    return {};
}

/// @brief A data set of a folder, whose name ends with "/": file names are told as seen from it.
[[nodiscard]] inline Dataset folder_dataset(const std::filesystem::path& folder) {
    return {.source = folder.filename().empty() ? folder : folder / ""};
}

/// @brief Image number `id`, as large as it is shown, or as labels tell where they are of the stored pixels.
/// @throws FileError where it cannot be read, or is of neither size.
[[nodiscard]] inline DatasetImage labelled_image(std::int64_t id, const std::filesystem::path& file,
                                                 const DatasetReadOptions& options,
                                                 const ImageSize* labelled = nullptr) {
    const ImageFileSize size = options.image_size(file);
    if (labelled != nullptr && !(*labelled == size.shown) && !(*labelled == size.stored))
        throw FileError(join_text(file_text(file), ": expected ", sides_text(*labelled),
                                  " pixels as its labels say, got ", sides_text(size.shown)));
    const ImageSize& own = labelled != nullptr ? *labelled : size.shown;
    return {.id = id, .file = file, .width = own.width, .height = own.height};
}

/// @brief Numbers classes and objects from 1.
inline void number(Dataset& dataset) {
    for (std::size_t c = 0; c < dataset.class_names.size(); ++c)
        dataset.category_ids.push_back(std::int64_t(c) + 1);
    std::int64_t id = 0;
    for (DatasetImage& image : dataset.images)
        for (DatasetAnnotation& object : image.objects) object.id = ++id;
}

/// @brief A mask in a file of its own. Figure is what is not transparent; in a file without transparent
/// pixels it is what is brighter, in any channel, than half of the brightest.
/// @throws FileError where it cannot be read, or nothing in it is figure.
[[nodiscard]] inline Mask read_mask_file(const std::filesystem::path& path) {
    const ImageFile file = open_image(path);
    const auto samples = decode(file, 4, stbi_load_from_memory);
    Mask mask(file.width, file.height);
    std::uint8_t brightest = 0, least_alpha = 255;
    const auto light = [&](std::size_t i) {
        return std::max({samples[4 * i], samples[4 * i + 1], samples[4 * i + 2]});
    };
    const std::size_t count = mask.pixels().size();
    for (std::size_t i = 0; i < count; ++i) {
        brightest = std::max(brightest, light(i));
        least_alpha = std::min<std::uint8_t>(least_alpha, samples[4 * i + 3]);
    }
    const bool transparent = least_alpha < 128;
    for (std::size_t i = 0; i < count; ++i)
        mask.pixels()[i] = transparent ? samples[4 * i + 3] >= 128 : 2 * light(i) > brightest;
    if (mask_area(mask) == 0) file.refuse("a mask with figure", "one without");
    return turned(std::move(mask), file.orientation);
}

/// @brief Whether an image has transparent pixels: they are then the ground of a mask.
[[nodiscard]] inline bool has_transparent_pixels(const std::filesystem::path& path) {
    if (lower(path.extension().string()) != ".png") return false;
    const ImageFile file = open_image(path);
    if (file.channels != 2 && file.channels != 4) return false;
    const auto samples = decode(file, 4, stbi_load_from_memory);
    const std::size_t count = std::size_t(file.width) * std::size_t(file.height);
    for (std::size_t i = 0; i < count; ++i)
        if (samples[4 * i + 3] < 128) return true;
    return false;
}

/// @brief Adds an object whose mask is known; its box is that of the mask.
inline void add_masked(DatasetImage& image, std::uint32_t class_index, const Mask& mask) {
    image.objects.push_back(
        {.class_index = class_index, .box = mask_box(mask), .segmentation = compress_mask(mask)});
}

}  // namespace detail

}  // namespace ism
