// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"
#include "support/painted.hpp"
#include "support/skipped.hpp"

#include "ism/show/font.hpp"

using ism::Rgb;
using ism::RgbImage;
using ism::test::painted;

namespace {

// the system's font; a test that asks for one without is skipped, by name
const ism::Font& some_font() {
    static const ism::Font font = ism::system_font({});
    if (font.empty()) {
        ++ism::test::skipped_tests();
        WARN("skipped: no font (scripts/install_dependencies pages)");
    }
    return font;
}

}  // namespace

TEST_CASE("Text is taken apart into characters, and what is none replaced") {
    CHECK(ism::detail::characters_of("aé鸭😀") == std::vector<int>{0x61, 0xE9, 0x9E2D, 0x1F600});
    CHECK(ism::detail::characters_of("\xff"
                                     "a\xC3") == std::vector<int>{0xFFFD, 0x61, 0xFFFD});
    CHECK(ism::detail::characters_of("").empty());
}

TEST_CASE("A font without files writes nothing") {
    const ism::Font font;
    CHECK(font.empty());
    CHECK_FALSE(font.covers("a"));
    CHECK(font.covers(""));
    CHECK(font.width("cup", 20) == 0);
    RgbImage image(30, 20);
    font.draw(image, 2, 2, "cup", ism::white, 16);
    CHECK(painted(image) == 0);
}

TEST_CASE("Files that are no fonts are refused") {
    const ism::test::TemporaryFolder folder;
    ism::write_file(folder / "a.ttf", std::string(500, 'x'));
    ism::Font font;
    CHECK_THROWS_WITH(font.add(folder / "a.ttf"),
                      Catch::Contains("a.ttf': expected a font, got something else"));
    CHECK_THROWS_AS(font.add(folder / "none.ttf"), ism::FileError);
    CHECK(font.empty());
}

TEST_CASE("Letters of a font have ink, differ, and stay where they should") {
    const ism::Font& font = some_font();
    if (font.empty()) return;
    std::set<std::vector<std::uint8_t>> shapes;
    for (char letter = '!'; letter <= '~'; ++letter) {
        RgbImage image(30, 30);
        font.draw(image, 4, 4, std::string(1, letter), ism::white, 20);
        CHECK(painted(image) > 0);
        std::vector<std::uint8_t> shape;
        for (const Rgb& pixel : image.pixels()) shape.push_back(pixel.r);
        CHECK(shapes.insert(shape).second);
    }
    CHECK(font.covers("Größe, ключ, πηγή"));
    CHECK(font.width("cupcup", 20) == Approx(2 * font.width("cup", 20)));
    CHECK(font.width("cup", 40) == Approx(2 * font.width("cup", 20)));

    RgbImage whole(60, 50);
    const ism::ImageView<Rgb> part = whole.view().region(20, 15, 17, 13);
    for (const double x : {-30.0, -3.5, 4.0, 15.0, 1e9, std::nan("")})
        for (const double y : {-9.0, 3.0, 11.0, -1e300, std::nan("")})
            font.draw(part, x, y, "gj@\xC3\xA9", ism::white, 14);
    CHECK(painted(whole) > 0);
    for (int y = 0; y < whole.height(); ++y)
        for (int x = 0; x < whole.width(); ++x)
            if (x < 20 || y < 15 || x >= 37 || y >= 28) REQUIRE(whole(x, y) == Rgb{});
}
