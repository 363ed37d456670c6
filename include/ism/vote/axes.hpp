// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>

#include "ism/vote/vote_source.hpp"

namespace ism {

/// @brief How the mean shift window along an axis changes with the scale of the object it stands on.
enum class BandwidthScaling {
    none,        ///< one bandwidth for all
    with_scale,  ///< the bandwidth is that at scale 1, times the scale (the balloon kernel of Leibe et al.
                 ///< 2008)
};

/// @brief A coordinate of a vote space, told from a feature of the image and an occurrence of the model. To
/// model it, write a small struct as X below.
template <class A>
concept ContinuousAxis = requires(const VoteSource& source) {
    { A::name } -> std::convertible_to<std::string_view>;
    { A::unit } -> std::convertible_to<std::string_view>;
    { A::bandwidth } -> std::convertible_to<double>;
    { A::bandwidth_scaling } -> std::convertible_to<BandwidthScaling>;
    { A::needs_depth } -> std::convertible_to<bool>;
    { A::vote(source) } -> std::convertible_to<double>;
};

/// @brief A label of a vote space: votes of different labels never mix.
template <class A>
concept DiscreteAxis = requires(const VoteSource& source) {
    { A::name } -> std::convertible_to<std::string_view>;
    { A::label(source) } -> std::same_as<std::uint32_t>;
};

/// @brief One coordinate of a vote space, continuous or discrete.
template <class A>
concept Axis = ContinuousAxis<A> || DiscreteAxis<A>;

/// @brief x_f − x_i · s_f / s_i: where the object's centre would be (Eq 2), see Placement.
struct X {
    static constexpr std::string_view name = "x", unit = "px";
    static constexpr double bandwidth = 40;
    static constexpr BandwidthScaling bandwidth_scaling = BandwidthScaling::with_scale;
    static constexpr bool needs_depth = false;
    [[nodiscard]] static double vote(const VoteSource& v) { return v.placement.centre.x; }
};

/// @brief y_f − y_i · s_f / s_i (Eq 2).
struct Y {
    static constexpr std::string_view name = "y", unit = "px";
    static constexpr double bandwidth = 40;
    static constexpr BandwidthScaling bandwidth_scaling = BandwidthScaling::with_scale;
    static constexpr bool needs_depth = false;
    [[nodiscard]] static double vote(const VoteSource& v) { return v.placement.centre.y; }
};

/// @brief s_f / s_i (Eq 2): the object's size relative to the reference size.
struct Scale {
    static constexpr std::string_view name = "s", unit = "";
    static constexpr double bandwidth = 0.4;
    static constexpr BandwidthScaling bandwidth_scaling = BandwidthScaling::with_scale;
    static constexpr bool needs_depth = false;
    [[nodiscard]] static double vote(const VoteSource& v) { return v.placement.scale; }
};

/// @brief d_f (Eqs 6 and 7): depth of the feature in the image, or of the object's centre where training
/// knows how they differ (centre_depth_m()), metres. Without a reading there is no vote.
struct Depth {
    static constexpr std::string_view name = "d", unit = "m";
    static constexpr double bandwidth = 0.15;
    static constexpr BandwidthScaling bandwidth_scaling = BandwidthScaling::none;
    static constexpr bool needs_depth = true;
    [[nodiscard]] static double vote(const VoteSource& v) { return centre_depth_m(v.feature, v.occurrence); }
};

/// @brief d_f · s_f / s_i (Eq 8): depth, as of Depth, times scale, the same for an object at any distance,
/// metres. Without a reading there is no vote.
struct ScaledDepth {
    static constexpr std::string_view name = "s*d", unit = "m";
    static constexpr double bandwidth = 0.2;
    static constexpr BandwidthScaling bandwidth_scaling = BandwidthScaling::none;
    static constexpr bool needs_depth = true;
    [[nodiscard]] static double vote(const VoteSource& v) {
        return centre_depth_m(v.feature, v.occurrence) * v.placement.scale;
    }
};

/// @brief c_i (Eqs 5 to 8): the class of the occurrence.
struct Class {
    static constexpr std::string_view name = "c";
    [[nodiscard]] static std::uint32_t label(const VoteSource& v) { return v.occurrence.class_index; }
};

}  // namespace ism
