// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "ism/show/markup.hpp"
#include "ism/show/report_parts.hpp"

namespace ism::detail {

/// About how wide words are on a screen, pixels: letters of scripts from U+1100 on are twice as wide.
[[nodiscard]] inline double words_width_px(std::string_view text) {
    double width = 10;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = std::max<std::size_t>(1, utf8_length(text, i));
        width += length >= 3 && std::uint8_t(text[i]) != 0xE2 ? 14 : 7.3;
        i += length;
    }
    return width;
}

/// Where words stand: their left edge and their upper or lower edge, in percent of the figure.
struct LabelPlace {
    double left = 0, top = 0;
    bool above = false;  ///< `top` is where they end
};

/// Places labels so that they evade each other on a screen `shown_px` wide: above their box, inside its upper
/// or lower edge, or below it. On a wider screen they only move apart.
[[nodiscard]] inline std::vector<LabelPlace> place_labels(const Box& part,
                                                          std::span<const ReportLabel> labels,
                                                          double shown_px) {
    const double zoom = shown_px / part.width, line = 20;
    const Box page{0, 0, shown_px, zoom * part.height};
    std::vector<Box> used;
    std::vector<LabelPlace> places;
    for (const ReportLabel& label : labels) {
        const double top = zoom * (label.box.y - part.y), bottom = top + zoom * label.box.height;
        const double width = std::min(page.width, words_width_px(label.text));
        const double x = std::clamp(zoom * (label.box.x - part.x), 0.0, page.width - width);
        struct Wish {
            double y;
            bool above;
        };
        const auto box_of = [&](const Wish& wish) {
            return Box{x, wish.above ? wish.y - line : wish.y, width, line};
        };
        Wish chosen{std::clamp(top, 0.0, std::max(0.0, page.height - line)), false};
        for (const Wish& wish :
             {Wish{top, true}, Wish{top, false}, Wish{bottom, true}, Wish{bottom, false}}) {
            const Box place = box_of(wish);
            const bool free = std::none_of(used.begin(), used.end(), [&](const Box& other) {
                return intersection(other, place).area() > 0;
            });
            if (!free || intersection(place, page).area() < 0.999 * place.area()) continue;
            chosen = wish;
            break;
        }
        used.push_back(box_of(chosen));
        places.push_back({100 * x / page.width, 100 * chosen.y / page.height, chosen.above});
    }
    return places;
}

}  // namespace ism::detail
