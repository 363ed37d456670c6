// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#if __has_include(<stb/stb_image_write.h>)
#include <stb/stb_image_write.h>
#else
#include <stb_image_write.h>
#endif

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/core/random.hpp"
#include "ism/io/images.hpp"

using ism::FileError;
using ism::Image;
using ism::Rgb;
using ism::RgbImage;
using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

using Bytes = std::vector<std::uint8_t>;

template <class T>
Image<T> random_image(int width, int height, std::uint64_t seed) {
    ism::Random random(seed);
    Image<T> image(width, height);
    for (T& pixel : image.pixels()) {
        if constexpr (std::is_same_v<T, Rgb>)
            pixel = {std::uint8_t(random.bits()), std::uint8_t(random.bits()), std::uint8_t(random.bits())};
        else
            pixel = T(random.bits());
    }
    return image;
}

RgbImage smooth_image(int width, int height) {
    RgbImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image(x, y) = {std::uint8_t(x * 3), std::uint8_t(y * 5), std::uint8_t((x + y) * 2)};
    return image;
}

void append(void* bytes, void* data, int size) {
    const auto* from = static_cast<const std::uint8_t*>(data);
    static_cast<Bytes*>(bytes)->insert(static_cast<Bytes*>(bytes)->end(), from, from + size);
}

std::string read_error(const TemporaryFolder& folder, const Bytes& bytes) {
    ism::write_file(folder / "image", bytes);
    const std::string message = error_message<FileError>([&] { (void)ism::read_rgb(folder / "image"); });
    const std::string head = "file '" + (folder / "image").string() + "': ";
    return message.substr(0, head.size()) == head ? message.substr(head.size()) : message;
}

Bytes head_of(const Bytes& bytes, std::size_t count) {
    return {bytes.begin(), bytes.begin() + std::ptrdiff_t(count)};
}

}  // namespace

TEST_CASE("Images of every kind come back from PNG files as they were") {
    const TemporaryFolder folder;
    for (const auto& [width, height] :
         {std::pair(1, 1), std::pair(17, 1), std::pair(1, 9), std::pair(61, 43)}) {
        const RgbImage noise = random_image<Rgb>(width, height, 1), smooth = smooth_image(width, height);
        ism::write_png(folder / "noise.png", noise);
        ism::write_png(folder / "smooth.png", smooth);
        CHECK(ism::read_rgb(folder / "noise.png") == noise);
        CHECK(ism::read_rgb(folder / "smooth.png") == smooth);

        const Image<std::uint8_t> gray = random_image<std::uint8_t>(width, height, 2);
        ism::write_png(folder / "gray.png", gray);
        CHECK(ism::read_gray(folder / "gray.png") == ism::to_gray(gray));
        const RgbImage gray_as_rgb = ism::read_rgb(folder / "gray.png");
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                REQUIRE(gray_as_rgb(x, y) == Rgb{gray(x, y), gray(x, y), gray(x, y)});

        const ism::RawDepth depth = random_image<std::uint16_t>(width, height, 3);
        ism::write_png16(folder / "depth.png", depth);
        CHECK(ism::read_raw_depth(folder / "depth.png") == depth);
        const ism::GrayImage deep = ism::read_gray(folder / "depth.png");
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) REQUIRE(deep(x, y) == Approx(depth(x, y) / 65535.0).margin(1e-7));

        for (const char* name : {"noise.png", "gray.png", "depth.png"}) {
            const ism::Picture picture = ism::read_picture(folder / name);
            CHECK(picture.gray == ism::read_gray(folder / name));
            CHECK(picture.color == ism::read_rgb(folder / name));
        }
    }
}

TEST_CASE("A part of an image is written with its own rows alone") {
    const TemporaryFolder folder;
    const RgbImage image = random_image<Rgb>(20, 15, 4);
    ism::write_png(folder / "part.png", image.view().region(3, 2, 7, 5));
    const RgbImage part = ism::read_rgb(folder / "part.png");
    REQUIRE(part.width() == 7);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) CHECK(part(x, y) == image(x + 3, y + 2));
    CHECK(ism::encode_png(image.view().region(3, 2, 7, 5)) == ism::read_bytes(folder / "part.png"));
}

TEST_CASE("Filtering makes a smooth image's PNG smaller than its pixels") {
    const RgbImage smooth = smooth_image(64, 48);
    CHECK(ism::encode_png(smooth).size() < smooth.pixels().size_bytes() / 10);
}

TEST_CASE("The checksum of PNG chunks is the CRC-32 of ISO 3309") {
    const std::string digits = "123456789";
    CHECK(ism::detail::crc32(Bytes(digits.begin(), digits.end())) == 0xcbf43926u);
}

TEST_CASE("Depth of 8 bits is refused, not widened") {
    const TemporaryFolder folder;
    ism::write_png(folder / "flat.png", Image<std::uint8_t>(20, 20, std::uint8_t(7)));
    CHECK(error_message<FileError>([&] { (void)ism::read_raw_depth(folder / "flat.png"); }) ==
          "file '" + (folder / "flat.png").string() +
              "': expected depth as a 16-bit PNG, got an image of 8 bits");
    ism::write_file(folder / "flat.png", std::string("II*\0", 4));
    CHECK(error_message<FileError>([&] { (void)ism::read_raw_depth(folder / "flat.png"); }) ==
          "file '" + (folder / "flat.png").string() + "': expected depth as a 16-bit PNG, got a TIFF image");
}

TEST_CASE("A PNG cut at any length or changed in any byte is refused") {
    const TemporaryFolder folder;
    const Bytes png = ism::encode_png(random_image<Rgb>(5, 4, 5));
    CHECK(read_error(folder, png) == "nothing thrown");
    CHECK(read_error(folder, head_of(png, png.size() - 1)) == "expected a whole image, got a truncated PNG");
    for (std::size_t count = 0; count < png.size(); ++count)
        REQUIRE(read_error(folder, head_of(png, count)).starts_with("expected "));
    for (std::size_t i = 0; i < png.size(); ++i) {
        Bytes changed = png;
        changed[i] ^= 0x10;
        REQUIRE(read_error(folder, changed).starts_with("expected "));
    }
}

TEST_CASE("JPEG, BMP and PNM files are read, and refused when cut at any length") {
    const TemporaryFolder folder;
    const RgbImage image = smooth_image(19, 12);
    Bytes jpeg, bmp, pnm;
    stbi_write_jpg_to_func(append, &jpeg, 19, 12, 3, image.pixels().data(), 95);
    stbi_write_bmp_to_func(append, &bmp, 19, 12, 3, image.pixels().data());
    const std::string head = "P6 # a comment\n19 12\n255\n";
    pnm.assign(head.begin(), head.end());
    for (const Rgb& pixel : image.pixels()) pnm.insert(pnm.end(), {pixel.r, pixel.g, pixel.b});
    for (const Bytes& file : {jpeg, bmp, pnm}) {
        REQUIRE(read_error(folder, file) == "nothing thrown");
        const RgbImage read = ism::read_rgb(folder / "image");
        REQUIRE(ism::join_text(ism::size_text(read)) == "19x12");
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 19; ++x) {
                CHECK(std::abs(read(x, y).r - image(x, y).r) <= 12);
                CHECK(std::abs(read(x, y).g - image(x, y).g) <= 12);
            }
        for (std::size_t count = 0; count < file.size(); ++count)
            REQUIRE(read_error(folder, head_of(file, count)).starts_with("expected "));
    }
    // Two pixels by two below the short header of OS/2, from the last row to the first.
    const Bytes os2{'B', 'M', 42, 0,  0, 0, 0, 0, 0, 0, 26, 0, 0, 0, 12, 0, 0, 0, 2, 0, 2,
                    0,   1,   0,  24, 0, 9, 8, 7, 1, 1, 1,  0, 0, 3, 2,  1, 1, 1, 1, 0, 0};
    REQUIRE(read_error(folder, os2) == "nothing thrown");
    CHECK(ism::read_rgb(folder / "image")(0, 0) == ism::Rgb{1, 2, 3});
    CHECK(read_error(folder, head_of(os2, os2.size() - 1)) == "expected a whole image, got a truncated BMP");
    CHECK(read_error(folder, head_of(jpeg, jpeg.size() - 2)) ==
          "expected a whole image, got a truncated JPEG");
    CHECK(read_error(folder, head_of(bmp, bmp.size() - 1)) == "expected a whole image, got a truncated BMP");
    CHECK(read_error(folder, head_of(pnm, pnm.size() - 1)) == "expected a whole image, got a truncated PNM");
}

TEST_CASE("A JPEG with any byte changed is read or refused, one without its tables or pixels refused") {
    const TemporaryFolder folder;
    Bytes jpeg;
    stbi_write_jpg_to_func(append, &jpeg, 19, 12, 3, smooth_image(19, 12).pixels().data(), 95);
    REQUIRE(read_error(folder, jpeg) == "nothing thrown");
    for (std::size_t i = 0; i < jpeg.size(); ++i)
        for (const int change : {0x01, 0x80, 0xff}) {
            Bytes changed = jpeg;
            changed[i] = std::uint8_t(changed[i] ^ change);
            const std::string message = read_error(folder, changed);
            REQUIRE((message == "nothing thrown" || message.starts_with("expected ")));
        }
    // each part left out in turn: code tables, quantisers, frame, scan with the pixels after it
    for (const std::uint8_t marker : {0xc4, 0xdb, 0xc0, 0xda}) {
        std::size_t at = 2;
        while (jpeg[at + 1] != marker) at += 2 + (std::size_t(jpeg[at + 2]) << 8 | jpeg[at + 3]);
        const std::size_t length =
            marker == 0xda ? jpeg.size() - 2 - at : 2 + (std::size_t(jpeg[at + 2]) << 8 | jpeg[at + 3]);
        Bytes changed = jpeg;
        changed.erase(changed.begin() + std::ptrdiff_t(at), changed.begin() + std::ptrdiff_t(at + length));
        CAPTURE(int(marker));
        CHECK(read_error(folder, changed).substr(0, 9) == "expected ");
    }
    Bytes long_table = {0xc4, 0x01, 0x23, 0x00};  // 16 · 17 codes
    long_table.insert(long_table.begin(), 0xff);
    long_table.insert(long_table.end(), 16, 17);
    long_table.insert(long_table.end(), 272, 0);
    jpeg.insert(jpeg.begin() + 2, long_table.begin(), long_table.end());
    CHECK(read_error(folder, jpeg) == "expected a whole image, got a damaged JPEG");
}

TEST_CASE("Files that are no images are named with the reason") {
    const TemporaryFolder folder;
    CHECK(read_error(folder, {}) == "expected an image, got an empty file");
    CHECK(read_error(folder, {'h', 'e', 'l', 'l', 'o'}) ==
          "expected a PNG, JPEG, BMP or PNM image, got something else");
    CHECK(error_message<FileError>([&] { (void)ism::read_gray(folder / "none.png"); }) ==
          "file '" + (folder / "none.png").string() + "': expected a file to read, got none of this name");
    CHECK(error_message<FileError>([&] { (void)ism::read_raw_depth(folder.path()); }) ==
          "file '" + folder.path().string() + "': expected a file to read, got a folder");
    const std::string deep = "P5 2 2 65535\nabcdefgh";
    CHECK(read_error(folder, Bytes(deep.begin(), deep.end())) ==
          "expected 8 bits a channel in this format, got 16 bits");
}

TEST_CASE("An image that claims absurd sides is refused before its pixels are made") {
    const TemporaryFolder folder;
    const std::string huge = "P5 1000000 1000000 255\nx";
    CHECK(read_error(folder, Bytes(huge.begin(), huge.end())) ==
          "expected 1 to 134217728 pixels, sides up to 1048576, got 1000000x1000000");
    CHECK(error_message([] { (void)ism::encode_png(RgbImage()); }) ==
          "image to write: expected 1 to 134217728 pixels, sides up to 1048576, got 0x0");
}
