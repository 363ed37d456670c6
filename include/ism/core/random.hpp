// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "ism/config.hpp"

namespace ism {

/// @brief A small seeded generator (SplitMix64; Steele, Lea, Flood 2014) whose numbers are the same on every
/// platform, unlike the standard library's distributions.
class Random {
public:
    explicit constexpr Random(std::uint64_t seed) : state_(seed) {}

    /// @brief The next 64 random bits.
    [[nodiscard]] constexpr std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    /// @brief Evenly in [0, 1).
    [[nodiscard]] constexpr double uniform() { return double(bits() >> 11) * 0x1.0p-53; }

    /// @brief Evenly in [low, high).
    [[nodiscard]] constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// @brief Evenly among 0 … count − 1; 0 where count is 0.
    [[nodiscard]] constexpr std::uint64_t index(std::uint64_t count) {
        return count > 0 ? static_cast<std::uint64_t>(uniform() * double(count)) : 0;
    }

    /// @brief Normally distributed around 0 with deviation 1 (Box–Muller).
    [[nodiscard]] double normal() {
        const double radius = std::sqrt(-2 * std::log(1 - uniform()));
        return radius * std::cos(2 * std::numbers::pi * uniform());
    }

private:
    std::uint64_t state_;
};

}  // namespace ism
