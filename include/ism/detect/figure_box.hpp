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

}  // namespace detail

/// @brief The box of the figure of a segmentation: beyond each of its sides lies a share `outside` of
/// p(figure), so that a stray pixel does not count.
/// @return pixels of the image; without area where there is no figure
[[nodiscard]] inline Box figure_box(const Segmentation& part, double outside) {
    std::vector<double> columns(std::size_t(part.figure.width()), 0),
        rows(std::size_t(part.figure.height()), 0);
    for (int y = 0; y < part.figure.height(); ++y)
        for (int x = 0; x < part.figure.width(); ++x) {
            const double p = double(part.figure(x, y));
            columns[std::size_t(x)] += p, rows[std::size_t(y)] += p;
        }
    const detail::Inner x = detail::inner_part(columns, outside), y = detail::inner_part(rows, outside);
    return {part.x + x.begin, part.y + y.begin, std::max(0.0, x.end - x.begin),
            std::max(0.0, y.end - y.begin)};
}

/// @brief A box whose sides lie between those of two: 0 = at the first's, 1 = at the second's.
[[nodiscard]] inline Box box_between(const Box& a, const Box& b, double share) {
    const auto mixed = [&](double from, double to) { return from + share * (to - from); };
    return {mixed(a.x, b.x), mixed(a.y, b.y), mixed(a.width, b.width), mixed(a.height, b.height)};
}

}  // namespace ism
