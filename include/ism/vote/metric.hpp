// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "ism/vote/axes.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

namespace detail {

/// What the three axes in metres share: an object is as large at any distance.
struct MetricAxis {
    static constexpr std::string_view unit = "m";
    static constexpr double bandwidth = 0.03;
    static constexpr BandwidthScaling bandwidth_scaling = BandwidthScaling::none;
    static constexpr bool needs_depth = true, needs_pose = true;
};

}  // namespace detail

/// @brief X of C = p_f + R_f · o_i: the object's centre in the camera frame, see Pose. Features without a
/// local frame cast no vote.
struct MetricX : detail::MetricAxis {
    static constexpr std::string_view name = "X";
    [[nodiscard]] static double vote(const VoteSource& v) { return v.pose.centre_m.x; }
};

/// @brief Y of the object's centre.
struct MetricY : detail::MetricAxis {
    static constexpr std::string_view name = "Y";
    [[nodiscard]] static double vote(const VoteSource& v) { return v.pose.centre_m.y; }
};

/// @brief Z of the object's centre.
struct MetricZ : detail::MetricAxis {
    static constexpr std::string_view name = "Z";
    [[nodiscard]] static double vote(const VoteSource& v) { return v.pose.centre_m.z; }
};

/// @brief Votes of six degrees of freedom for the centre in metres: features vote turned as their surface is.
using Metric = VoteSpace<MetricX, MetricY, MetricZ, Class>;

}  // namespace ism
