// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/order.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/model/shape_model.hpp"
#include "ism/vote/vote.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief The proposals that each class is asked about: all, or of more than `max_classes` classes those at
/// whose place it is among the `max_classes` of most vote weight. The class that proposed is always asked.
/// @return by class, in the order given
[[nodiscard]] inline std::vector<std::vector<ProposedBox>> asked_proposals(
    std::span<const ProposedBox> proposals, std::span<const Vote<Jism::dimension>> votes,
    std::size_t max_classes, const ShapeModel& shapes) {
    const std::size_t classes = shapes.class_names.size();
    if (classes <= max_classes)
        return std::vector<std::vector<ProposedBox>>(classes, {proposals.begin(), proposals.end()});
    struct Voted {
        float x, y, weight;
        std::uint32_t class_index;
    };
    std::vector<Voted> voted;
    for (const auto& vote : votes)
        voted.push_back(
            {vote.at[0], vote.at[1], vote.weight, shapes.occurrence(vote.occurrence).class_index});
    detail::sort_by(voted, [](const Voted& v) { return detail::rising(v.y); });
    std::vector<std::vector<ProposedBox>> asked(classes);
    for (const ProposedBox& proposal : proposals) {
        const Point2 centre = proposal.box.centre();
        const double top = centre.y - proposal.box.height / 2, bottom = centre.y + proposal.box.height / 2;
        std::vector<double> weight(classes, 0);
        auto vote =
            std::partition_point(voted.begin(), voted.end(), [&](const Voted& v) { return v.y <= top; });
        for (; vote != voted.end() && vote->y < bottom; ++vote)
            if (std::abs(vote->x - centre.x) < proposal.box.width / 2)
                weight[vote->class_index] += vote->weight;
        std::vector<detail::Ranked> order;
        for (std::uint32_t c = 0; c < classes; ++c)
            if (c != proposal.class_index) order.push_back({detail::falling(weight[c]), c});
        detail::sort_ranked(order.data(), order.size());
        asked[proposal.class_index].push_back(proposal);
        for (std::size_t i = 0; i + 1 < max_classes; ++i) asked[order[i].index].push_back(proposal);
    }
    return asked;
}

}  // namespace ism
