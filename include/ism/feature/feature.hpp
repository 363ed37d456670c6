// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/error.hpp"

namespace ism {

/// @brief A local feature found by a detector.
struct Feature {
    float x = 0, y = 0;        ///< sub-pixel position, pixels of the image given
    float scale = 1;           ///< s_f: standard deviation of its Gaussian scale, pixels of the image given
    float angle = 0;           ///< orientation, radians from x towards y; 0 where upright
    float strength = 0;        ///< the detector's response, ≥ 0, larger is stronger
    float depth_m = no_depth;  ///< d_f: depth at the feature, metres; NaN = no reading
    /// @brief Whether all is equal; two without a depth reading are alike in that.
    [[nodiscard]] bool operator==(const Feature& other) const {
        const bool same_depth =
            depth_m == other.depth_m || (depth_m != depth_m && other.depth_m != other.depth_m);
        return x == other.x && y == other.y && scale == other.scale && angle == other.angle &&
               strength == other.strength && same_depth;
    }
};

/// @brief Element types of descriptors.
template <class T>
concept DescriptorScalar = std::same_as<T, float> || std::same_as<T, std::uint8_t>;

/// @brief Descriptors one after another: row i holds the `dimension()` numbers of feature i.
template <DescriptorScalar T>
class Descriptors {
public:
    using Scalar = T;

    Descriptors() = default;
    /// @brief `count` rows of `dimension` zeros.
    explicit Descriptors(std::size_t dimension, std::size_t count = 0)
        : dimension_(dimension), values_(dimension * count) {}
    /// @brief Takes over the numbers of whole rows.
    /// @throws Error where they are none of `dimension`.
    Descriptors(std::size_t dimension, std::vector<T> values)
        : dimension_(dimension), values_(std::move(values)) {
        expect(dimension > 0 && values_.size() % dimension == 0, "descriptors: numbers",
               lazy_text("whole rows of ", dimension), values_.size());
    }

    /// @brief Numbers of a row.
    [[nodiscard]] std::size_t dimension() const { return dimension_; }
    [[nodiscard]] std::size_t size() const { return dimension_ > 0 ? values_.size() / dimension_ : 0; }
    [[nodiscard]] bool empty() const { return values_.empty(); }
    [[nodiscard]] std::span<T> row(std::size_t i) { return {values_.data() + i * dimension_, dimension_}; }
    [[nodiscard]] std::span<const T> row(std::size_t i) const {
        return {values_.data() + i * dimension_, dimension_};
    }
    /// @throws Error for a row of another dimension.
    void push_back(std::span<const T> row) {
        expect(row.size() == dimension_, "descriptors: numbers of a row", dimension_, row.size());
        values_.insert(values_.end(), row.begin(), row.end());
    }
    void reserve(std::size_t count) { values_.reserve(count * dimension_); }
    void resize(std::size_t count) { values_.resize(count * dimension_); }

    /// @brief All numbers, row after row.
    [[nodiscard]] std::span<T> values() { return values_; }
    [[nodiscard]] std::span<const T> values() const { return values_; }

    [[nodiscard]] bool operator==(const Descriptors&) const = default;

private:
    std::size_t dimension_ = 0;
    std::vector<T> values_;
};

/// @brief Features with their descriptors: row i describes feature i.
template <DescriptorScalar T>
struct FeatureSet {
    std::vector<Feature> features;
    Descriptors<T> descriptors;
};

}  // namespace ism
