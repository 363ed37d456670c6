// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/error.hpp"
#include "ism/core/image.hpp"
#include "ism/core/order.hpp"

/// Whether depth can be metres: units taken for metres make no error by themselves, only nonsense.
namespace ism {

/// @brief The median of a sample of the readings, metres; NaN where there are none.
[[nodiscard]] inline double median_depth_m(const DepthMap& depth_m) {
    std::vector<float> readings;
    const int step = depth_m.width() >= 64 && depth_m.height() >= 64 ? 4 : 1;
    for (int y = 0; y < depth_m.height(); y += step)
        for (int x = 0; x < depth_m.width(); x += step)
            if (is_depth(depth_m(x, y))) readings.push_back(depth_m(x, y));
    if (readings.empty()) return std::numeric_limits<double>::quiet_NaN();
    return double(detail::nth_smallest(readings, readings.size() / 2));
}

/// @brief The metres per unit that a camera with this median reading most likely has: the first of
/// millimetres, 1/5000 m, 0.1 mm, 10 µm and centimetres by which the median is 0.2 to 10 m; 0 where none is.
[[nodiscard]] inline double likely_depth_scale(double median_units) {
    for (const double scale : {0.001, 0.0002, 0.0001, 0.00001, 0.01})
        if (median_units * scale >= 0.2 && median_units * scale <= 10) return scale;
    return 0;
}

namespace detail {

[[nodiscard]] inline std::string depth_scale_text(double median_m, double metres_per_unit) {
    std::string text = join_text(metres_per_unit, ", by which the median of the depth is ", median_m, " m");
    if (const double likely = likely_depth_scale(median_m / metres_per_unit); likely > 0)
        text += join_text("; ", likely, " would make it ", median_m / metres_per_unit * likely, " m");
    return text;
}

}  // namespace detail

/// @brief What is doubtful about a depth scale, in a few words: the median of the depth is below 0.05 m or
/// beyond 20 m. Empty where nothing is.
[[nodiscard]] inline std::string depth_scale_doubt(const DepthMap& depth_m, double metres_per_unit) {
    const double median_m = median_depth_m(depth_m);
    if (std::isnan(median_m) || (median_m >= 0.05 && median_m <= 20)) return {};
    return "depth scale " + detail::depth_scale_text(median_m, metres_per_unit);
}

/// @brief Validates a depth scale by the depth that it gave.
/// @throws Error, naming the likely scale, where the median of the depth is below 0.01 m or beyond 200 m.
inline void check_depth_scale(const DepthMap& depth_m, double metres_per_unit) {
    const double median_m = median_depth_m(depth_m);
    if (std::isnan(median_m) || (median_m >= 0.01 && median_m <= 200)) return;
    expect(false, "depth scale (metres per unit)", "one by which the median of the depth is 0.01 to 200 m",
           detail::depth_scale_text(median_m, metres_per_unit));
}

}  // namespace ism
