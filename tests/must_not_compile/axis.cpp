// expect: Axis
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string_view>

#include "ism/vote/vote_space.hpp"

struct Nothing {
    static constexpr std::string_view name = "nothing", unit = "";
    static constexpr double bandwidth = 1;
    static constexpr ism::BandwidthScaling bandwidth_scaling = ism::BandwidthScaling::none;
    static constexpr bool needs_depth = false;
};

ism::VoteSpace<ism::X, ism::Y, Nothing> space;
