// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Time of voting by number of classes, one thread, as many votes in all: ordering votes by class, and the
// strongest modes of all classes; synthetic votes.
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/synthetic_votes.hpp"

#include "ism/vote/cast.hpp"
#include "ism/vote/strongest_modes.hpp"

TEST_CASE("voting by number of classes", "[benchmark]") {
    constexpr std::size_t total = 16384;
    ism::ThreadPool pool(1);
    for (const std::uint32_t classes : {1u, 16u, 128u, 1024u}) {
        ism::Random random(classes);
        std::vector<ism::Vote<3>> votes;
        for (std::uint32_t label = 0; label < classes; ++label)
            for (const auto& vote : bench::synthetic_votes<3>(total / classes, label, random))
                votes.push_back(vote);
        const auto bandwidth = ism::default_bandwidth<ism::Jism>();
        const auto labels = ism::split_by_label(votes);
        const std::string size = std::to_string(total) + " votes, " + std::to_string(classes) +
                                 (classes == 1 ? " class" : " classes");

        auto mixed = votes;
        for (std::size_t i = 0; i < mixed.size(); ++i)
            std::swap(mixed[i], mixed[i + random.index(mixed.size() - i)]);
        BENCHMARK("order by class, " + size) {
            auto copy = mixed;
            ism::detail::sort_by_label(copy);
            return copy.size();
        };
        BENCHMARK("the 40 strongest modes, " + size) {
            return ism::strongest_modes<ism::EpanechnikovKernel>(labels, bandwidth, {}, 40, 0.05, pool)
                .size();
        };
        BENCHMARK("every mode, " + size) {
            return ism::strongest_modes<ism::EpanechnikovKernel>(labels, bandwidth, {}, votes.size(), 0, pool)
                .size();
        };
    }
}
