// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/detect/detection.hpp"

namespace ism {

namespace detail {

/// The part of a row of numbers that is left where a share of their sum is cut off at either end.
struct Inner {
    double begin = 0, end = 0;
};

[[nodiscard]] inline Inner inner_part(const std::vector<double>& sums, double share) {
    double total = 0;
    for (const double sum : sums) total += sum;
    const auto cut = [&](auto from, auto to) {  // how many numbers, within the last of them evenly
        double count = 0, rest = share * total;
        for (; from != to && rest >= *from; ++from) rest -= *from, ++count;
        return from != to ? count + rest / *from : count;
    };
    return {cut(sums.begin(), sums.end()), double(sums.size()) - cut(sums.rbegin(), sums.rend())};
}

/// The box beyond each of whose sides lies a share `outside` of p(figure), in the part's own pixels.
[[nodiscard]] inline Box likely_box(const GrayImage& figure, double outside) {
    std::vector<double> columns(std::size_t(figure.width()), 0), rows(std::size_t(figure.height()), 0);
    for (int y = 0; y < figure.height(); ++y)
        for (int x = 0; x < figure.width(); ++x) {
            const double p = double(figure(x, y));
            columns[std::size_t(x)] += p, rows[std::size_t(y)] += p;
        }
    const Inner x = inner_part(columns, outside), y = inner_part(rows, outside);
    return {x.begin, y.begin, std::max(0.0, x.end - x.begin), std::max(0.0, y.end - y.begin)};
}

}  // namespace detail

/// @brief A box whose sides lie between those of two: 0 = at the first's, 1 = at the second's.
[[nodiscard]] inline Box box_between(const Box& a, const Box& b, double share) {
    const auto mixed = [&](double from, double to) { return from + share * (to - from); };
    return {mixed(a.x, b.x), mixed(a.y, b.y), mixed(a.width, b.width), mixed(a.height, b.height)};
}

/// @brief The box of the figure of a segmentation, half way between two: that of its mask, exact where the
/// mask is whole, and a wider one that also reaches what is no more than likely, beyond each of whose sides
/// lies a share `outside` of p(figure).
/// @return pixels of the image; without area where there is no figure
[[nodiscard]] inline Box figure_box(const Segmentation& part, double outside) {
    const Box likely = detail::likely_box(part.figure, outside), cut_out = mask_box(part.mask);
    Box box = cut_out.area() > 0 ? box_between(cut_out, likely, 0.5) : likely;
    box.x += part.x, box.y += part.y;
    return box;
}

}  // namespace ism
