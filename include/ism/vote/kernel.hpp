// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>

#include "ism/config.hpp"

namespace ism {

/// @brief A mean shift kernel by its profile over u² = Σ ((v − c) / bandwidth)², with value 1 at 0 and never
/// more: `profile` weighs a vote in the score, `shift` (−profile′ up to a factor) in the mean; both are 0
/// beyond u = `reach` (Comaniciu and Meer 2002). Mean shift calls them with floats, many votes at once where
/// they have neither branches nor calls: see kept_if().
template <class K>
concept Kernel = requires(float sq_u) {
    { K::profile(sq_u) } -> std::convertible_to<double>;
    { K::shift(sq_u) } -> std::convertible_to<double>;
    { K::reach } -> std::convertible_to<double>;
};

/// @brief `value`, or 0 where it is not to be kept: without a branch, at which some compilers give up taking
/// several votes at once.
[[nodiscard]] inline float kept_if(bool keep, float value) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & (0u - std::uint32_t(keep)));
}

/// @brief 1 within one bandwidth.
struct FlatKernel {
    static constexpr double reach = 1;
    [[nodiscard]] static float profile(float sq_u) { return kept_if(sq_u <= 1, 1.0f); }
    [[nodiscard]] static float shift(float sq_u) { return kept_if(sq_u <= 1, 1.0f); }
};

/// @brief 1 − u² within one bandwidth; its mean shift takes the plain mean of the window.
struct EpanechnikovKernel {
    static constexpr double reach = 1;
    [[nodiscard]] static float profile(float sq_u) { return kept_if(sq_u <= 1, 1 - sq_u); }
    [[nodiscard]] static float shift(float sq_u) { return kept_if(sq_u <= 1, 1.0f); }
};

/// @brief exp(−u² / 2), cut off at three bandwidths; right to a millionth part.
struct GaussianKernel {
    static constexpr double reach = 3;
    [[nodiscard]] static float profile(float sq_u) {
        // exp(−x) = exp(−x / 16)¹⁶, of which seven terms of the series are enough; no call, so that a
        // compiler can do it for several votes at once.
        const float x = sq_u / -32;
        float sum = 1 + x / 6;
        sum = 1 + x / 5 * sum;
        sum = 1 + x / 4 * sum;
        sum = 1 + x / 3 * sum;
        sum = 1 + x / 2 * sum;
        sum = 1 + x * sum;
        sum *= sum;
        sum *= sum;
        sum *= sum;
        sum *= sum;
        return kept_if(sq_u <= 9, sum);
    }
    [[nodiscard]] static float shift(float sq_u) { return profile(sq_u); }
};

}  // namespace ism
