// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "ism/core/camera.hpp"

namespace ism {

/// @brief A local feature found by a detector.
struct Feature {
    float x = 0, y = 0;        ///< sub-pixel position, pixels of the image given
    float scale = 1;           ///< s_f: standard deviation of its Gaussian scale, pixels of the image given
    float angle = 0;           ///< orientation, radians from x towards y; 0 where upright
    float strength = 0;        ///< the detector's response, ≥ 0, larger is stronger
    float depth_m = no_depth;  ///< d_f: depth at the feature, metres; NaN = no reading
    [[nodiscard]] bool operator==(const Feature&) const = default;
};

/// @brief Element types of descriptors.
template <class T>
concept DescriptorScalar = std::same_as<T, float> || std::same_as<T, std::uint8_t>;

/// @brief Descriptors one after another: row i holds the `Dimension` numbers of feature i.
template <DescriptorScalar T, std::size_t Dimension>
requires(Dimension > 0) class Descriptors {
public:
    using Scalar = T;
    static constexpr std::size_t dimension = Dimension;

    Descriptors() = default;
    explicit Descriptors(std::size_t count) : values_(count * Dimension) {}

    [[nodiscard]] std::size_t size() const { return values_.size() / Dimension; }
    [[nodiscard]] bool empty() const { return values_.empty(); }
    [[nodiscard]] std::span<T, Dimension> row(std::size_t i) {
        return std::span<T, Dimension>(values_.data() + i * Dimension, Dimension);
    }
    [[nodiscard]] std::span<const T, Dimension> row(std::size_t i) const {
        return std::span<const T, Dimension>(values_.data() + i * Dimension, Dimension);
    }
    void push_back(std::span<const T, Dimension> row) {
        values_.insert(values_.end(), row.begin(), row.end());
    }
    void reserve(std::size_t count) { values_.reserve(count * Dimension); }
    void resize(std::size_t count) { values_.resize(count * Dimension); }

    /// @brief All numbers, row after row.
    [[nodiscard]] std::span<T> values() { return values_; }
    [[nodiscard]] std::span<const T> values() const { return values_; }

private:
    std::vector<T> values_;
};

}  // namespace ism
