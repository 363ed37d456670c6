// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "ism/feature/sift.hpp"

namespace ism {

/// @brief SIFT or RootSIFT in bytes, a quarter of the memory: each number times 512, rounded, at most 255.
template <class D>
requires std::same_as<D, Sift> || std::same_as<D, RootSift>
struct AsBytes {
    using Scalar = std::uint8_t;
    static constexpr std::size_t dimension = D::dimension;
    static constexpr std::string_view name = std::same_as<D, Sift> ? "byte-sift" : "byte-root-sift";
    static constexpr float support_radius = D::support_radius, reach = D::reach;
    static constexpr double sq_length = 512.0 * 512.0;

    [[nodiscard]] static float level_scale(const Feature& f) { return D::level_scale(f); }

    void describe(const ScaleSpace& space, const Feature& f, std::span<std::uint8_t, dimension> out) const {
        std::array<float, dimension> exact;
        D{}.describe(space, f, exact);
        for (std::size_t i = 0; i < dimension; ++i) {
            const float value = 512 * exact[i] + 0.5f;
            out[i] = std::uint8_t(int(value < 255.0f ? value : 255.0f));
        }
    }
};

using ByteSift = AsBytes<Sift>;          ///< SIFT in bytes
using ByteRootSift = AsBytes<RootSift>;  ///< RootSIFT in bytes

}  // namespace ism
