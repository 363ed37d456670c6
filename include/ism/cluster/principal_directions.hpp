// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "ism/config.hpp"
#include "ism/core/random.hpp"

namespace ism::detail {

/// Makes the columns orthonormal, one after another (Gram–Schmidt, twice against rounding). A column that
/// depends on those before becomes 0, which keeps every use as a projection right.
inline void orthonormalise(Eigen::MatrixXd& columns) {
    for (Eigen::Index i = 0; i < columns.cols(); ++i) {
        const double length = columns.col(i).norm();
        for (int pass = 0; pass < 2; ++pass)
            for (Eigen::Index j = 0; j < i; ++j)
                columns.col(i) -= columns.col(j).dot(columns.col(i)) * columns.col(j);
        const double left = columns.col(i).norm();
        if (left > 1e-6 * length)
            columns.col(i) /= left;
        else
            columns.col(i).setZero();
    }
}

/// `count` orthonormal directions, one a column, near those along which the points (columns, centred) spread
/// most: orthogonal iteration from a random start. How near does not matter to bounds that hold for any
/// directions.
[[nodiscard]] inline Eigen::MatrixXf principal_directions(const Eigen::MatrixXf& points, Eigen::Index count) {
    Random random(1);
    Eigen::MatrixXd directions(points.rows(), count);
    for (Eigen::Index c = 0; c < directions.cols(); ++c)
        for (Eigen::Index r = 0; r < directions.rows(); ++r) directions(r, c) = random.normal();
    orthonormalise(directions);
    for (int round = 0; round < 3; ++round) {
        const Eigen::MatrixXf along = points.transpose() * directions.cast<float>();
        directions = (points * along).cast<double>();
        orthonormalise(directions);
    }
    return directions.cast<float>();
}

}  // namespace ism::detail
