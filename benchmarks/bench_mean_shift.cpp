// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Time of each part of mean shift by number of votes and axes, one thread; synthetic votes.
#include <span>
#include <string>

#include "support/catch.hpp"
#include "support/synthetic_votes.hpp"

#include "ism/vote/mean_shift.hpp"

namespace {

template <std::size_t D>
void measure(std::size_t count) {
    ism::Random random(1);
    const auto votes = bench::synthetic_votes<D>(count, 0, random);
    const std::span<const ism::Vote<D>> all(votes);
    ism::Bandwidth<D> bandwidth{};
    bandwidth.at_scale_1.fill(0.15);
    bandwidth.scaling.fill(ism::BandwidthScaling::none);
    bandwidth.at_scale_1[0] = bandwidth.at_scale_1[1] = 40, bandwidth.at_scale_1[2] = 0.4;
    for (std::size_t k = 0; k < 3; ++k) bandwidth.scaling[k] = ism::BandwidthScaling::with_scale;
    const ism::MeanShiftOptions options;
    ism::MeanShiftMemory<D> memory;
    const auto modes = ism::find_modes<ism::EpanechnikovKernel>(all, bandwidth, options, memory);
    const std::string size = std::to_string(D) + "-D, " + std::to_string(count) + " votes";

    BENCHMARK("grid, " + size) {
        memory.search.assign(all, bandwidth);
        return memory.search.size();
    };
    BENCHMARK("starts, " + size) {
        return memory.bins.find(all, bandwidth, options.max_seeds, options.min_relative_weight).size();
    };
    BENCHMARK("one step, " + size) {
        ism::Mode<D> mode = modes.front();
        return ism::shift_once<ism::EpanechnikovKernel>(memory.search, mode);
    };
    BENCHMARK("one step, Gaussian, " + size) {
        ism::Mode<D> mode = modes.front();
        return ism::shift_once<ism::GaussianKernel>(memory.search, mode);
    };
    BENCHMARK("modes, " + size) {
        return ism::find_modes<ism::EpanechnikovKernel>(all, bandwidth, options, memory).size();
    };
}

}  // namespace

TEST_CASE("mean shift by size", "[benchmark]") {
    for (const std::size_t count : {100, 1000, 10000, 100000}) {
        measure<3>(count);
        measure<5>(count);
    }
}
