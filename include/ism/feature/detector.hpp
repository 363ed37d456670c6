// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <string_view>
#include <vector>

#include "ism/feature/feature.hpp"
#include "ism/feature/scale_space.hpp"
#include "ism/feature/workspace.hpp"

namespace ism {

/// @brief Finds features in a scale space. To model it, write a small struct with its options as members,
/// `static constexpr std::string_view name` and
/// `std::vector<Feature> detect(const ScaleSpace&, Workspace&) const`. Positions and scales are in pixels of
/// the scale space's input image; the order and every bit must not depend on the workspace's threads.
template <class D>
concept Detector = std::copyable<D> &&
    requires(const D& detector, const ScaleSpace& space, Workspace& workspace) {
    { D::name } -> std::convertible_to<std::string_view>;
    { detector.detect(space, workspace) } -> std::same_as<std::vector<Feature>>;
};

}  // namespace ism
