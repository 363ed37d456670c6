// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <fstream>

#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/io/write_file.hpp"

namespace bench {

/// @brief A plane's map from one image to another, row after row.
struct Homography {
    std::array<double, 9> h{};

    [[nodiscard]] ism::Point2 operator()(double x, double y) const {
        const double w = h[6] * x + h[7] * y + h[8];
        return {(h[0] * x + h[1] * y + h[2]) / w, (h[3] * x + h[4] * y + h[5]) / w};
    }

    /// @brief The derivative at (x, y): du/dx, du/dy, dv/dx, dv/dy.
    [[nodiscard]] std::array<double, 4> affine(double x, double y) const {
        const double w = h[6] * x + h[7] * y + h[8];
        const auto [u, v] = (*this)(x, y);
        return {(h[0] - u * h[6]) / w, (h[1] - u * h[7]) / w, (h[3] - v * h[6]) / w, (h[4] - v * h[7]) / w};
    }

    [[nodiscard]] Homography inverse() const {
        const auto& m = h;
        return {{m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
                 m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
                 m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]}};
    }
};

[[nodiscard]] inline Homography read_homography(const std::filesystem::path& path) {
    std::ifstream in(path);
    Homography result;
    for (double& value : result.h)
        if (!(in >> value)) throw ism::FileError(path.string() + ": expected nine numbers");
    return result;
}

}  // namespace bench
