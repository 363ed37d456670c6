// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "pictures.hpp"

#include <algorithm>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#ifdef ISM_WITH_WEBP
#include <webp/decode.h>
#endif
#ifdef ISM_WITH_TIFF
#include <tiffio.h>
#endif

namespace program {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& path, std::string_view expected, std::string_view actual) {
    throw ism::FileError(ism::join_text(ism::file_text(path), ": expected ", expected, ", got ", actual));
}

/// What a file is that stb does not read.
std::string_view kind_of(const fs::path& path) {
    std::vector<std::uint8_t> head(16);
    std::ifstream stream(path, std::ios::binary);
    stream.read(reinterpret_cast<char*>(head.data()), std::streamsize(head.size()));
    head.resize(std::size_t(std::max<std::streamsize>(stream.gcount(), 0)));
    return ism::detail::other_image_format(head);
}

[[maybe_unused]] void check_sides(const fs::path& path, std::int64_t width, std::int64_t height) {
    if (!ism::is_image_size(width, height))
        refuse(path, ism::image_size_limits, ism::join_text(width, "x", height));
}

#ifdef ISM_WITH_WEBP
ism::RgbImage read_webp(const fs::path& path) {
    const std::vector<std::uint8_t> bytes = ism::read_bytes(path, 1 << 30);
    int width = 0, height = 0;
    if (WebPGetInfo(bytes.data(), bytes.size(), &width, &height) == 0)
        refuse(path, "a whole image", "a damaged WebP");
    check_sides(path, width, height);
    ism::RgbImage image(width, height);
    if (WebPDecodeRGBInto(bytes.data(), bytes.size(), &image.pixels().data()->r, image.pixels().size_bytes(),
                          3 * width) == nullptr)
        refuse(path, "a whole image", "a damaged or truncated WebP");
    return image;
}
#else
ism::RgbImage read_webp(const fs::path& path) {
    refuse(path, "a program built with libwebp (libwebp-dev) to read WebP", "one without");
}
#endif

#ifdef ISM_WITH_TIFF
/// The pixels of the first page of a TIFF file.
ism::RgbImage read_tiff(const fs::path& path) {
    TIFFSetErrorHandler(nullptr);  // messages are ours
    TIFFSetWarningHandler(nullptr);
    const std::unique_ptr<TIFF, decltype(&TIFFClose)> file(TIFFOpen(path.string().c_str(), "r"), &TIFFClose);
    std::uint32_t width = 0, height = 0;
    if (!file || TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width) == 0 ||
        TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height) == 0)
        refuse(path, "a whole image", "a damaged TIFF");
    check_sides(path, width, height);
    ism::RgbImage image(static_cast<int>(width), static_cast<int>(height));
    std::vector<std::uint32_t> samples(image.pixels().size());
    if (TIFFReadRGBAImageOriented(file.get(), width, height, samples.data(), ORIENTATION_TOPLEFT, 1) == 0)
        refuse(path, "a whole image of a known kind", "a damaged TIFF, or one of a rare kind");
    std::transform(samples.begin(), samples.end(), image.pixels().begin(), [](std::uint32_t sample) {
        return ism::Rgb{std::uint8_t(TIFFGetR(sample)), std::uint8_t(TIFFGetG(sample)),
                        std::uint8_t(TIFFGetB(sample))};
    });
    return image;
}
#else
ism::RgbImage read_tiff(const fs::path& path) {
    refuse(path, "a program built with libtiff (libtiff-dev) to read TIFF", "one without");
}
#endif

}  // namespace

ism::Picture read_picture(const fs::path& path, std::optional<ism::ImageSize> labelled) {
    const std::string_view kind = kind_of(path);
    const bool webp = kind == "a WebP image";
    if (!webp && kind != "a TIFF image") return ism::read_picture(path, labelled);
    ism::Picture picture{.gray = {}, .color = webp ? read_webp(path) : read_tiff(path)};
    picture.gray = to_gray(picture.color);
    return picture;
}

ism::ImageFileSize read_image_size(const fs::path& path) {
    const std::string_view kind = kind_of(path);
    if (kind != "a WebP image" && kind != "a TIFF image") return ism::read_image_size(path);
    const ism::Picture picture = read_picture(path);
    const ism::ImageSize size{picture.color.width(), picture.color.height()};
    return {size, size};
}

}  // namespace program
