// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/number_text.hpp"

namespace ism {

/// @brief A corner of pixels: pixel (x, y) has the corners (x, y) … (x + 1, y + 1).
struct PixelCorner {
    int x = 0, y = 0;
    [[nodiscard]] bool operator==(const PixelCorner&) const = default;
};

/// @brief The outlines of a mask: closed rings along the edges of its pixels, the figure to their right, so
/// that holes run the other way round.
[[nodiscard]] inline std::vector<std::vector<PixelCorner>> mask_outlines(ImageView<const std::uint8_t> mask) {
    constexpr std::array<PixelCorner, 4> step = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const int width = mask.width() + 1, height = mask.height() + 1;
    const auto inside = [&](int x, int y) { return mask.contains(x, y) && mask(x, y) != 0; };
    std::vector<std::uint8_t> leaves(std::size_t(width) * std::size_t(height), 0);  // edges that begin there
    const auto edges = [&](PixelCorner at) -> std::uint8_t& {
        return leaves[std::size_t(at.y) * std::size_t(width) + std::size_t(at.x)];
    };
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) {
            if (!inside(x, y)) continue;
            if (!inside(x, y - 1)) edges({x, y}) |= 1;
            if (!inside(x + 1, y)) edges({x + 1, y}) |= 2;
            if (!inside(x, y + 1)) edges({x + 1, y + 1}) |= 4;
            if (!inside(x - 1, y)) edges({x, y + 1}) |= 8;
        }
    std::vector<std::vector<PixelCorner>> rings;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            while (edges({x, y}) != 0) {
                std::vector<PixelCorner> ring;
                PixelCorner at{x, y};
                unsigned heading = 0, before = 4;
                do {
                    for (const unsigned turn :
                         {1u, 0u, 3u}) {  // right first: pixels that touch at a corner part
                        const unsigned next = (heading + turn) % 4;
                        if ((edges(at) >> next & 1) == 0) continue;
                        heading = next;
                        break;
                    }
                    if ((edges(at) >> heading & 1) == 0) heading = (heading + 2) % 4;
                    edges(at) = std::uint8_t(edges(at) & ~(1u << heading));
                    if (heading != before) ring.push_back(at);
                    before = heading;
                    at = {at.x + step[heading].x, at.y + step[heading].y};
                } while (!(at == PixelCorner{x, y}));
                rings.push_back(std::move(ring));
            }
    return rings;
}

namespace detail {

/// Keeps the corners of ring[first … last] that lie further than `tolerance` from the line between those kept
/// (Douglas and Peucker 1973); the ends are kept by the caller.
inline void keep_corners(std::span<const PixelCorner> ring, std::size_t first, std::size_t last,
                         double tolerance, std::vector<bool>& kept) {
    const PixelCorner a = ring[first], b = ring[last % ring.size()];
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    double most = tolerance;
    std::size_t furthest = first;
    for (std::size_t i = first + 1; i < last; ++i) {
        const double u = ring[i].x - a.x, v = ring[i].y - a.y;
        const double distance = length > 0 ? std::abs(u * dy - v * dx) / length : std::hypot(u, v);
        if (distance > most) most = distance, furthest = i;
    }
    if (furthest == first) return;
    kept[furthest] = true;
    keep_corners(ring, first, furthest, tolerance, kept);
    keep_corners(ring, furthest, last, tolerance, kept);
}

}  // namespace detail

/// @brief The outlines of a mask as the `d` of an SVG path (fill-rule evenodd), moved by (x, y); corners less
/// than `tolerance` pixels from a straight line are left out, as are rings that this leaves without area.
[[nodiscard]] inline std::string mask_path(ImageView<const std::uint8_t> mask, int x = 0, int y = 0,
                                           double tolerance = 0.8) {
    std::string path;
    for (const std::vector<PixelCorner>& ring : mask_outlines(mask)) {
        std::vector<bool> kept(ring.size(), false);
        kept[0] = true;
        detail::keep_corners(ring, 0, ring.size(), tolerance, kept);
        std::vector<PixelCorner> corners;
        for (std::size_t i = 0; i < ring.size(); ++i)
            if (kept[i]) corners.push_back(ring[i]);
        if (corners.size() < 3) continue;
        for (std::size_t i = 0; i < corners.size();
             ++i)  // the first from the origin, others from the one before
            path += i == 0 ? join_text('M', corners[i].x + x, ' ', corners[i].y + y, 'l')
                           : join_text(i > 1 ? " " : "", corners[i].x - corners[i - 1].x, ' ',
                                       corners[i].y - corners[i - 1].y);
        path += 'z';
    }
    return path;
}

}  // namespace ism
