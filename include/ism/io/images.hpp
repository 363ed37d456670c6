// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Reading image files by stb_image. A program that includes this header compiles stb once by
/// including "ism/io/stb_implementation.hpp" in one of its .cpp files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#if __has_include(<stb_image.h>)
#include <stb_image.h>
#else
#include <stb/stb_image.h>
#endif

#include "ism/core/image.hpp"
#include "ism/io/exif.hpp"
#include "ism/io/limits.hpp"
#include "ism/io/png.hpp"
#include "ism/io/stb_guard.hpp"
#include "ism/io/write_file.hpp"

namespace ism {

/// @brief The sides of an image, pixels.
struct ImageSize {
    int width = 0, height = 0;
    [[nodiscard]] bool operator==(const ImageSize&) const = default;
};

/// @brief The sides of an image file's pixels as they are shown and as they are stored: for a JPEG they
/// differ where EXIF turns it by a quarter.
struct ImageFileSize {
    ImageSize shown, stored;

    /// @brief Whether who labelled an image of this size saw its pixels as they are stored.
    [[nodiscard]] bool is_stored(const ImageSize& labelled) const {
        return labelled == stored && !(labelled == shown);
    }
};

namespace detail {

/// @brief An image file in memory, complete and within the size limits, not yet decoded.
struct ImageFile {
    std::string place;                ///< what messages call it
    std::vector<std::uint8_t> bytes;  ///< fewer than 2^31
    int width = 0, height = 0;
    int channels = 0;     ///< 1 grey, 2 grey + alpha, 3 colour, 4 colour + alpha
    bool deep = false;    ///< 16 bits a channel
    int orientation = 1;  ///< see exif_orientation()

    [[nodiscard]] ImageFileSize size() const {
        const ImageSize stored{width, height};
        return {orientation >= 5 ? ImageSize{height, width} : stored, stored};
    }
    [[noreturn]] void refuse(std::string_view expected, std::string_view actual) const {
        throw FileError(join_text(place, ": expected ", expected, ", got ", actual));
    }
};

[[nodiscard]] inline ImageFile open_image(std::string place, std::vector<std::uint8_t> bytes) {
    ImageFile file{.place = std::move(place), .bytes = std::move(bytes)};
    if (file.bytes.empty()) file.refuse("an image", "an empty file");
    const ImageFormat format = image_format(file.bytes);
    if (format == ImageFormat::unknown)
        file.refuse("a PNG, JPEG, BMP or PNM image", other_image_format(file.bytes));
    const auto refuse_damage = [&](const std::string& damage) {
        if (!damage.empty()) file.refuse("a whole image", damage);
    };
    if (format == ImageFormat::png) refuse_damage(png_damage(file.bytes));
    if (format == ImageFormat::jpeg) {
        refuse_damage(jpeg_damage(file.bytes));
        file.orientation = exif_orientation(file.bytes);
    }
    if (!stbi_info_from_memory(file.bytes.data(), int(file.bytes.size()), &file.width, &file.height,
                               &file.channels))
        file.refuse("an image", join_text("a damaged one (", stbi_failure_reason(), ")"));
    if (format == ImageFormat::bmp && file.height < 0 && file.height >= -max_image_side)
        file.height = -file.height;  // a BMP may begin with its first row
    if (!is_image_size(file.width, file.height)) file.refuse(image_size_limits, sides_text(file));
    if (format == ImageFormat::bmp) refuse_damage(bmp_damage(file.bytes, file.width, file.height));
    if (format == ImageFormat::pnm)
        refuse_damage(pnm_damage(file.bytes, std::int64_t(file.width) * file.height * file.channels));
    file.deep = stbi_is_16_bit_from_memory(file.bytes.data(), int(file.bytes.size())) != 0;
    if (file.deep && format != ImageFormat::png) file.refuse("8 bits a channel in this format", "16 bits");
    return file;
}

inline constexpr std::uintmax_t most_image_bytes = std::uintmax_t(1) << 30;

[[nodiscard]] inline ImageFile open_image(const std::filesystem::path& path) {
    return open_image(file_text(path), read_bytes(path, most_image_bytes));
}

template <class Sample>
using Decoded = std::unique_ptr<Sample[], decltype(&stbi_image_free)>;

/// @brief The samples of an image, `channels` a pixel, by one of stb's two decoders.
/// @throws FileError where it gives nothing or an image of another size than announced.
template <class Sample>
[[nodiscard]] Decoded<Sample> decode(const ImageFile& file, int channels,
                                     Sample* (*decoder)(const stbi_uc*, int, int*, int*, int*, int)) {
    int width = 0, height = 0, ignored = 0;
    Decoded<Sample> samples(
        decoder(file.bytes.data(), int(file.bytes.size()), &width, &height, &ignored, channels),
        &stbi_image_free);
    if (!samples) file.refuse("an image", join_text("a damaged one (", stbi_failure_reason(), ")"));
    if (width != file.width || height != file.height)
        file.refuse(sides_text(file), join_text(width, "x", height));
    return samples;
}

}  // namespace detail

namespace detail {

[[nodiscard]] inline RgbImage decode_rgb(const ImageFile& file) {
    const auto samples = decode(file, 3, stbi_load_from_memory);
    RgbImage image(file.width, file.height);
    const std::uint8_t* at = samples.get();
    for (Rgb& pixel : image.pixels()) pixel = {at[0], at[1], at[2]}, at += 3;
    return turned(std::move(image), file.orientation);
}

[[nodiscard]] inline GrayImage decode_gray(const ImageFile& file) {
    const bool colored = file.channels >= 3;
    GrayImage image(file.width, file.height);
    const auto fill = [&](const auto* at, float full) {
        for (float& pixel : image.pixels()) {
            pixel = colored ? (0.299f * at[0] + 0.587f * at[1] + 0.114f * at[2]) / full : float(at[0]) / full;
            at += colored ? 3 : 1;
        }
    };
    if (file.deep)
        fill(decode(file, colored ? 3 : 1, stbi_load_16_from_memory).get(), 65535.0f);
    else
        fill(decode(file, colored ? 3 : 1, stbi_load_from_memory).get(), 255.0f);
    return turned(std::move(image), file.orientation);
}

}  // namespace detail

/// @brief Reads a PNG, JPEG, BMP or binary PNM file as colour: grey becomes r = g = b, transparency is
/// dropped, 16 bits are cut to 8, and a JPEG is turned as its EXIF orientation says.
/// @throws FileError where the file is missing, a folder, no image, truncated, damaged, or too large.
[[nodiscard]] inline RgbImage read_rgb(const std::filesystem::path& path) {
    return detail::decode_rgb(detail::open_image(path));
}

/// @brief Reads an image file as brightness 0 … 1; grey files of 8 and of 16 bits keep their full precision,
/// colours are weighted as by to_gray().
/// @throws FileError as read_rgb() does.
[[nodiscard]] inline GrayImage read_gray(const std::filesystem::path& path) {
    return detail::decode_gray(detail::open_image(path));
}

/// @brief An image file by its brightness and by its colours.
struct Picture {
    GrayImage gray;
    RgbImage color;
    int orientation = 1;  ///< how they were turned: see exif_orientation()
};

/// @brief The size of an image file; its pixels are not decoded.
/// @throws FileError as read_rgb() does.
[[nodiscard]] inline ImageFileSize read_image_size(const std::filesystem::path& path) {
    return detail::open_image(path).size();
}

/// @brief What read_gray() and read_rgb() read; colours of 8 bits are decoded once.
/// @param labelled  the size that labels tell of the image: where it is that of the stored pixels and not
/// that of the shown ones, pixels stay as they are stored
/// @throws FileError as read_rgb() does.
[[nodiscard]] inline Picture read_picture(const std::filesystem::path& path,
                                          std::optional<ImageSize> labelled = {}) {
    detail::ImageFile file = detail::open_image(path);
    if (labelled && file.size().is_stored(*labelled)) file.orientation = 1;
    Picture picture{.gray = {}, .color = detail::decode_rgb(file), .orientation = file.orientation};
    picture.gray = file.channels >= 3 && !file.deep ? to_gray(picture.color) : detail::decode_gray(file);
    return picture;
}

namespace detail {

/// @brief What a file is that is no PNG, for messages.
[[nodiscard]] inline std::string_view kind_beside_png(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return "an empty file";
    const ImageFormat format = image_format(bytes);
    return format == ImageFormat::jpeg  ? "a JPEG image"
           : format == ImageFormat::bmp ? "a BMP image"
           : format == ImageFormat::pnm ? "a PNM image"
                                        : other_image_format(bytes);
}

}  // namespace detail

/// @brief Reads a depth camera's units from a 16-bit grey PNG file; 0 = no reading.
/// @throws FileError as read_rgb() does, and where the file is no PNG, has 8 bits or colours.
[[nodiscard]] inline RawDepth read_raw_depth(const std::filesystem::path& path) {
    std::vector<std::uint8_t> bytes = read_bytes(path, detail::most_image_bytes);
    if (detail::image_format(bytes) != detail::ImageFormat::png)
        throw FileError(join_text(file_text(path), ": expected depth as a 16-bit PNG, got ",
                                  detail::kind_beside_png(bytes)));
    const detail::ImageFile file = detail::open_image(file_text(path), std::move(bytes));
    if (!file.deep) file.refuse("depth as a 16-bit PNG", "an image of 8 bits");
    if (file.channels != 1) file.refuse("depth as a grey PNG", join_text(file.channels, " channels"));
    const auto samples = detail::decode(file, 1, stbi_load_16_from_memory);
    const std::size_t count = std::size_t(file.width) * std::size_t(file.height);
    return RawDepth(file.width, file.height,
                    std::vector<std::uint16_t>(samples.get(), samples.get() + count));
}

}  // namespace ism
