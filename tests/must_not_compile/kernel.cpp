// expect: K::reach
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <vector>

#include "ism/vote/mean_shift.hpp"

struct Endless {
    static double profile(double) { return 1; }
    static double shift(double) { return 1; }
};

const std::vector<ism::Vote<2>> votes;
const ism::Bandwidth<2> bandwidth{{1, 1}, {ism::BandwidthScaling::none, ism::BandwidthScaling::none}};
const auto modes = ism::find_modes<Endless>(std::span<const ism::Vote<2>>(votes), bandwidth);
