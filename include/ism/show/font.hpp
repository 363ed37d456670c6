// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Words in pictures by stb_truetype, from font files that are found when a program runs. A program
/// that includes this header compiles stb once by "ism/io/stb_implementation.hpp".
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#if __has_include(<stb_truetype.h>)
#include <stb_truetype.h>
#else
#include <stb/stb_truetype.h>
#endif

#include "ism/core/image.hpp"
#include "ism/io/write_file.hpp"
#include "ism/show/color.hpp"
#include "ism/show/markup.hpp"

namespace ism {

namespace detail {

/// The characters of UTF-8 text; what is none is the replacement character.
[[nodiscard]] inline std::vector<int> characters_of(std::string_view text) {
    std::vector<int> characters;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text, i);
        unsigned code = length == 0 ? 0xFFFD : std::uint8_t(text[i]);
        if (length > 1) code &= 0x7Fu >> length;
        for (std::size_t k = 1; k < length; ++k) code = code << 6 | (std::uint8_t(text[i + k]) & 0x3Fu);
        characters.push_back(int(code));
        i += std::max<std::size_t>(1, length);
    }
    return characters;
}

}  // namespace detail

/// @brief Letters from font files, the first that has a character giving it; a Font without files writes
/// nothing. Characters stand from left to right as text has them: scripts that join letters, or run from the
/// right, are not set as their readers would (pages are: there the browser does it). Font files are trusted,
/// as those of the system are.
class Font {
public:
    Font() = default;

    /// @brief Adds a TrueType or OpenType file.
    /// @throws FileError where it cannot be read or is no font.
    void add(const std::filesystem::path& path) {
        auto bytes =
            std::make_unique<const std::vector<std::uint8_t>>(read_bytes(path, std::uintmax_t(1) << 28));
        stbtt_fontinfo info{};
        const bool begins_well = bytes->size() > 64 && stbtt_GetFontOffsetForIndex(bytes->data(), 0) >= 0;
        if (!begins_well ||
            !stbtt_InitFont(&info, bytes->data(), stbtt_GetFontOffsetForIndex(bytes->data(), 0)))
            throw FileError(file_text(path) + ": expected a font, got something else");
        faces_.push_back({std::move(bytes), info});
    }

    [[nodiscard]] bool empty() const { return faces_.empty(); }

    /// @brief Whether it has all characters of a text.
    [[nodiscard]] bool covers(std::string_view text) const {
        const auto known = [&](int character) { return glyph_of(character).second != 0; };
        const std::vector<int> characters = detail::characters_of(text);
        return std::all_of(characters.begin(), characters.end(), known);
    }

    /// @brief How wide a text is, pixels, in lines `line_px` high; 0 without files.
    [[nodiscard]] double width(std::string_view text, double line_px) const {
        return walk(text, line_px, [](const stbtt_fontinfo&, float, int, double) {});
    }

    /// @brief Writes a text whose line has its left upper corner at (x, y); what lies outside is cut off, and
    /// nothing is written where x or y is not finite.
    void draw(ImageView<Rgb> image, double x, double y, std::string_view text, Rgb color,
              double line_px) const {
        const auto is_near = [](double place) { return std::abs(place) < 1e6; };
        if (empty() || !is_near(x) || !is_near(y)) return;
        int ascent = 0, descent = 0, gap = 0;
        stbtt_GetFontVMetrics(&faces_[0].info, &ascent, &descent, &gap);
        const int base =
            int(std::lround(y + ascent * double(stbtt_ScaleForPixelHeight(&faces_[0].info, float(line_px)))));
        walk(text, line_px, [&](const stbtt_fontinfo& info, float zoom, int glyph, double at) {
            const double left = std::floor(x + at);
            const float part = float(x + at - left);
            int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
            stbtt_GetGlyphBitmapBoxSubpixel(&info, glyph, zoom, zoom, part, 0, &x0, &y0, &x1, &y1);
            if (x1 <= x0 || y1 <= y0 || !is_near(left)) return;
            Mask cover(x1 - x0, y1 - y0);
            stbtt_MakeGlyphBitmapSubpixel(&info, cover.pixels().data(), cover.width(), cover.height(),
                                          cover.width(), zoom, zoom, part, 0, glyph);
            for (int v = 0; v < cover.height(); ++v)
                for (int u = 0; u < cover.width(); ++u) {
                    const int px = int(left) + x0 + u, py = base + y0 + v;
                    if (image.contains(px, py))
                        image(px, py) = mix(image(px, py), color, cover(u, v) / 255.0);
                }
        });
    }

private:
    struct Face {
        std::unique_ptr<const std::vector<std::uint8_t>> bytes;  // what `info` points into
        stbtt_fontinfo info{};
    };

    /// The face that has a character and its number there; number 0 of the first face where none has.
    [[nodiscard]] std::pair<const Face*, int> glyph_of(int character) const {
        for (const Face& face : faces_)
            if (const int glyph = stbtt_FindGlyphIndex(&face.info, character); glyph != 0)
                return {&face, glyph};
        return {faces_.empty() ? nullptr : faces_.data(), 0};
    }

    /// Tells `put` each letter and where it begins; returns where the text ends.
    template <class Put>
    double walk(std::string_view text, double line_px, const Put& put) const {
        double at = 0;
        if (empty()) return at;
        for (const int character : detail::characters_of(text)) {
            const auto [face, glyph] = glyph_of(character);
            const float zoom = stbtt_ScaleForPixelHeight(&face->info, float(line_px));
            int advance = 0, bearing = 0;
            stbtt_GetGlyphHMetrics(&face->info, glyph, &advance, &bearing);
            put(face->info, zoom, glyph, at);
            at += advance * double(zoom);
        }
        return at;
    }

    std::vector<Face> faces_;
};

/// @brief Fonts of the system that together have the characters of all texts, as far as there are such fonts
/// in the places where Linux distributions and macOS keep them; empty where there is none at all.
[[nodiscard]] inline Font system_font(std::span<const std::string> texts) {
    constexpr std::string_view usual[] = {
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
        "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
        "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
        "/usr/share/fonts/truetype/freefont/FreeSans.ttf",
        "/System/Library/Fonts/Supplemental/Arial Unicode.ttf",
        "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/truetype/wqy/wqy-zenhei.ttc",
        "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
        "/usr/share/fonts/truetype/unifont/unifont.ttf",
    };
    Font font;
    for (const std::string_view path : usual) {
        const auto covered = [&](const std::string& text) { return font.covers(text); };
        if (!font.empty() && std::all_of(texts.begin(), texts.end(), covered)) break;
        std::error_code missing;
        if (!std::filesystem::is_regular_file(path, missing)) continue;
        try {
            font.add(path);
        } catch (const FileError&) {  // the next one may do
        }
    }
    return font;
}

}  // namespace ism
