// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/random.hpp"
#include "ism/vote/vote.hpp"

namespace bench {

/// @brief Votes of one label as images have them (synthetic): a third around ten objects, the others anywhere
/// in a picture of 640×480 pixels, at scales from 0.25 to 4.
template <std::size_t Dimension>
requires(Dimension >= 3)
    [[nodiscard]] std::vector<ism::Vote<Dimension>> synthetic_votes(std::size_t count, std::uint32_t label,
                                                                    ism::Random& random) {
    std::vector<ism::Vote<Dimension>> objects(10), votes(count);
    const auto place = [&](ism::Vote<Dimension>& vote) {
        vote.scale = float(std::exp2(random.uniform(-2, 2)));
        vote.at[0] = float(random.uniform(0, 640)), vote.at[1] = float(random.uniform(0, 480));
        vote.at[2] = vote.scale;
        for (std::size_t k = 3; k < Dimension; ++k) vote.at[k] = float(random.uniform(0.5, 1.5));
    };
    for (auto& object : objects) place(object);
    for (auto& vote : votes) {
        place(vote);
        vote.weight = float(random.uniform(0.001, 0.1)), vote.label = label;
        if (random.index(3) > 0) continue;
        const auto& object = objects[random.index(objects.size())];
        vote.scale = object.scale * float(std::exp(0.1 * random.normal()));
        for (std::size_t k = 0; k < 2; ++k)
            vote.at[k] = object.at[k] + float(15 * object.scale * random.normal());
        vote.at[2] = vote.scale;
        for (std::size_t k = 3; k < Dimension; ++k) vote.at[k] = object.at[k] + float(0.05 * random.normal());
    }
    return votes;
}

}  // namespace bench
