// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>

namespace ism {

/// @brief A mean shift kernel by its profile over u² = Σ ((v − c) / bandwidth)², with value 1 at 0:
/// `profile` weighs a vote in the score, `shift` (−profile′ up to a factor) in the mean; both are 0 beyond
/// u = `reach` (Comaniciu and Meer 2002).
template <class K>
concept Kernel = requires(double sq_u) {
    { K::profile(sq_u) } -> std::convertible_to<double>;
    { K::shift(sq_u) } -> std::convertible_to<double>;
    { K::reach } -> std::convertible_to<double>;
};

/// @brief 1 within one bandwidth.
struct FlatKernel {
    static constexpr double reach = 1;
    [[nodiscard]] static double profile(double sq_u) { return sq_u <= 1 ? 1 : 0; }
    [[nodiscard]] static double shift(double sq_u) { return sq_u <= 1 ? 1 : 0; }
};

/// @brief 1 − u² within one bandwidth; its mean shift takes the plain mean of the window.
struct EpanechnikovKernel {
    static constexpr double reach = 1;
    [[nodiscard]] static double profile(double sq_u) { return sq_u <= 1 ? 1 - sq_u : 0; }
    [[nodiscard]] static double shift(double sq_u) { return sq_u <= 1 ? 1 : 0; }
};

/// @brief exp(−u² / 2), cut off at three bandwidths.
struct GaussianKernel {
    static constexpr double reach = 3;
    [[nodiscard]] static double profile(double sq_u) { return sq_u <= 9 ? std::exp(-sq_u / 2) : 0; }
    [[nodiscard]] static double shift(double sq_u) { return profile(sq_u); }
};

}  // namespace ism
