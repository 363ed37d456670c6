// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#if __has_include(<stb/stb_image_write.h>)
#include <stb/stb_image_write.h>
#else
#include <stb_image_write.h>
#endif

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/core/random.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/io/images.hpp"

using ism::FileError;
using ism::Rgb;
using ism::RgbImage;
using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

using JpegBytes = std::vector<std::uint8_t>;

// Four flat quarters of 16 × 24 px: red, green / blue, white.
RgbImage four_quarters() {
    RgbImage image(32, 48);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 32; ++x)
            image(x, y) = y < 24 ? (x < 16 ? Rgb{220, 0, 0} : Rgb{0, 220, 0})
                                 : (x < 16 ? Rgb{0, 0, 220} : Rgb{220, 220, 220});
    return image;
}

char color_of(const Rgb& pixel) {
    if (pixel.r > 110) return pixel.g > 110 ? 'w' : 'r';
    return pixel.g > 110 ? 'g' : 'b';
}

// The colours of the quarters: top left, top right, bottom left, bottom right.
std::string quarters(const RgbImage& image) {
    const int w = image.width(), h = image.height();
    return {color_of(image(w / 4, h / 4)), color_of(image(3 * w / 4, h / 4)),
            color_of(image(w / 4, 3 * h / 4)), color_of(image(3 * w / 4, 3 * h / 4))};
}

JpegBytes exif(int orientation, bool little) {
    JpegBytes app = {0xff, 0xe1, 0, 0, 'E', 'x', 'i', 'f', 0, 0};
    const auto put = [&](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i)
            app.push_back(std::uint8_t(value >> 8 * (little ? i : bytes - 1 - i)));
    };
    app.insert(app.end(), 2, little ? 'I' : 'M');
    put(42, 2), put(8, 4);                                       // the first directory is at 8
    put(2, 2), put(0x010f, 2), put(2, 2), put(1, 4), put(0, 4);  // maker, a text
    put(0x0112, 2), put(3, 2), put(1, 4), put(std::uint32_t(orientation), 2), put(0, 2);
    put(0, 4);  // no second directory
    app[3] = std::uint8_t(app.size() - 2);
    return app;
}

JpegBytes jpeg_with(const JpegBytes& segment) {
    JpegBytes jpeg;
    const RgbImage image = four_quarters();
    const auto append = [](void* to, void* data, int size) {
        const auto* bytes = static_cast<const std::uint8_t*>(data);
        static_cast<JpegBytes*>(to)->insert(static_cast<JpegBytes*>(to)->end(), bytes, bytes + size);
    };
    stbi_write_jpg_to_func(append, &jpeg, image.width(), image.height(), 3, image.pixels().data(), 90);
    jpeg.insert(jpeg.begin() + 2, segment.begin(), segment.end());
    return jpeg;
}

}  // namespace

TEST_CASE("A JPEG is turned as EXIF says, in either byte order") {
    // What is seen of red, green / blue, white where the first row and column are … (EXIF 2.3, tag 274)
    const std::array<std::string, 8> seen = {"rgbw", "grwb", "wbgr", "bwrg", "rbgw", "brwg", "wgbr", "gwrb"};
    const TemporaryFolder folder;
    for (int orientation = 1; orientation <= 8; ++orientation)
        for (const bool little : {true, false}) {
            CAPTURE(orientation, little);
            const JpegBytes jpeg = jpeg_with(exif(orientation, little));
            REQUIRE(ism::exif_orientation(jpeg) == orientation);
            ism::write_file(folder / "a.jpg", jpeg);
            const RgbImage color = ism::read_rgb(folder / "a.jpg");
            CHECK(quarters(color) == seen[std::size_t(orientation - 1)]);
            CHECK(color.width() == (orientation >= 5 ? 48 : 32));
            CHECK(ism::read_gray(folder / "a.jpg") == ism::to_gray(color));
            const ism::Picture picture = ism::read_picture(folder / "a.jpg");
            CHECK(picture.color == color);
            CHECK(picture.orientation == orientation);
            const ism::ImageFileSize size = ism::read_image_size(folder / "a.jpg");
            CHECK(size.shown == ism::ImageSize{color.width(), color.height()});
            CHECK(size.stored == ism::ImageSize{32, 48});
        }
}

TEST_CASE("Pixels stay as stored where labels tell that size, and depth beside turned ones is refused") {
    const TemporaryFolder folder;
    ism::write_file(folder / "a.jpg", jpeg_with(exif(6, true)));
    ism::DatasetImage image{.id = 1, .file = folder / "a.jpg", .width = 48, .height = 32};
    CHECK(quarters(ism::read_frame(image).color) == "brwg");
    image.width = 32, image.height = 48;
    CHECK(quarters(ism::read_frame(image).color) == "rgbw");
    image.width = 33;
    CHECK(error_message<FileError>([&] {
              (void)ism::read_frame(image);
          }).ends_with("expected 33x48 pixels as its data set says, got 48x32"));

    ism::write_png16(folder / "d.png", ism::RawDepth(32, 48, std::uint16_t(900)));
    image.width = 32, image.depth_file = folder / "d.png", image.depth_scale = 0.001;
    CHECK(ism::read_frame(image).depth_m(0, 0) == Approx(0.9));
    for (const int orientation : {2, 3, 6}) {  // of half a turn sizes cannot tell
        ism::write_file(folder / "a.jpg", jpeg_with(exif(orientation, false)));
        if (orientation == 6) image.width = 48, image.height = 32;
        CHECK(error_message<FileError>([&] { (void)ism::read_frame(image); })
                  .ends_with(ism::join_text("a.jpg': expected a picture stored upright beside depth, got one "
                                            "that EXIF turns (orientation ",
                                            orientation, ")")));
    }
}

TEST_CASE("EXIF that is damaged, cut or hostile turns nothing and reads nothing beyond its end") {
    const JpegBytes whole = jpeg_with(exif(6, true));
    for (const int value : {0, 9, 65535}) CHECK(ism::exif_orientation(jpeg_with(exif(value, false))) == 1);
    CHECK(ism::exif_orientation(jpeg_with({})) == 1);
    const std::size_t end = 2 + exif(6, true).size();
    for (std::size_t count = 0; count < end; ++count)  // a copy of just these bytes: sanitizers see beyond it
        CHECK(ism::exif_orientation(JpegBytes(whole.begin(), whole.begin() + std::ptrdiff_t(count))) == 1);
    ism::Random random(7);
    for (int round = 0; round < 20000; ++round) {
        JpegBytes changed(whole.begin(), whole.begin() + std::ptrdiff_t(end + random.index(40)));
        for (std::uint64_t edits = 1 + random.index(4); edits-- > 0;)
            changed[std::size_t(random.index(changed.size()))] =
                std::uint8_t(random.index(2) == 0 ? 0xff * random.index(2) : random.bits());
        const int orientation = ism::exif_orientation(changed);
        REQUIRE((orientation >= 1 && orientation <= 8));
        REQUIRE((ism::detail::tiff_orientation(changed) == 1));  // it begins as no TIFF does
        changed.erase(changed.begin(), changed.begin() + 12);    // from the TIFF structure on
        const int direct = ism::detail::tiff_orientation(changed);
        REQUIRE((direct >= 1 && direct <= 8));
    }
    CHECK(error_message([] { (void)ism::turned(ism::Mask(2, 2), 9); }) ==
          "EXIF orientation: expected 1 to 8, got 9");
}

TEST_CASE("Images of known kinds that are not read are called by their names") {
    const TemporaryFolder folder;
    const auto told = [&](std::string bytes) {
        ism::write_file(folder / "a", bytes);
        return error_message<FileError>([&] { (void)ism::read_rgb(folder / "a"); });
    };
    const std::string nul(1, '\0');
    CHECK(told("RIFF1234WEBPVP8 ").ends_with("expected a PNG, JPEG, BMP or PNM image, got a WebP image"));
    CHECK(told("II*" + nul + "12345678").ends_with("got a TIFF image"));
    CHECK(told("MM" + nul + "*12345678").ends_with("got a TIFF image"));
    CHECK(told("GIF89a123456").ends_with("got a GIF image"));
    CHECK(told(nul + nul + nul +
               "\x18"
               "ftypheic1234")
              .ends_with("got a HEIC image"));
    CHECK(told(nul + nul + nul +
               "\x18"
               "ftypavif1234")
              .ends_with("got an AVIF image"));
    CHECK(told(nul + nul + nul +
               "\x18"
               "ftypisom1234")
              .ends_with("got something else"));
}
