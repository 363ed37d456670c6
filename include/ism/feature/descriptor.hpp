// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>

#include "ism/feature/feature.hpp"
#include "ism/feature/scale_space.hpp"

namespace ism {

/// @brief Describes a feature by a row of numbers. To model it, write a small struct with `using Scalar`
/// (float or std::uint8_t), `static constexpr std::size_t dimension`, `static constexpr std::string_view
/// name`, `static constexpr float support_radius` (half a side of the square it looks at, in units of
/// Feature::scale), `static constexpr double sq_length` (the squared length of a typical descriptor, so that
/// similarity = 1 − squared distance / (2 sq_length)) and
/// `void describe(const ScaleSpace&, const Feature&, std::span<Scalar, dimension> row) const`, which fills
/// the row and is called from many threads at once.
template <class D>
concept Descriptor = std::copyable<D> && DescriptorScalar<typename D::Scalar> &&
    requires(const D& descriptor, const ScaleSpace& space, const Feature& feature,
             std::span<typename D::Scalar, D::dimension> row) {
    { D::dimension } -> std::convertible_to<std::size_t>;
    { D::name } -> std::convertible_to<std::string_view>;
    { D::support_radius } -> std::convertible_to<float>;
    { D::sq_length } -> std::convertible_to<double>;
    { descriptor.describe(space, feature, row) } -> std::same_as<void>;
};

/// @brief A descriptor that declares which pixels it reads, so that the scale space of a large image is never
/// held as a whole: describe() looks at space.sampling(s) or the level space.nearest_level(s), s =
/// level_scale(f), alone, at most `reach` · f.scale (and four of its pixels) from the feature. Other
/// descriptors work too.
template <class D>
concept LocalDescriptor = Descriptor<D> && requires(const Feature& feature) {
    { D::reach } -> std::convertible_to<float>;
    { D::level_scale(feature) } -> std::same_as<float>;
};

}  // namespace ism
