// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/order.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/search_box.hpp"

namespace ism {

/// @brief Whether two boxes of a class are of one object.
[[nodiscard]] inline bool is_one_object(const Box& a, const Box& b) {
    return iou(a, b) > 0.4;
}

/// @brief Whether more than half of a box lies in another, of which it may show a part.
[[nodiscard]] inline bool lies_within(const Box& part, const Box& whole) {
    return intersection(whole, part).area() > 0.5 * part.area();
}

/// @brief A box that may show an object, of the class that its votes speak for.
struct ProposedBox {
    std::uint32_t class_index = 0;
    Box box;
};

/// @brief Boxes of a class that are searched in an image, at least: in training as in detection.
inline constexpr std::size_t searched_boxes = 12;

/// @brief Hypotheses of an image that are asked about, at most.
inline constexpr std::size_t most_proposals = 5000;

/// @brief How many boxes of a class are searched in an image: searched_boxes, or a tenth of the hypotheses
/// whose votes speak for it where that is more, since a wide picture has more places for it.
[[nodiscard]] inline std::size_t boxes_to_search(std::span<const ProposedBox> proposals,
                                                 std::uint32_t class_index) {
    const auto own = std::count_if(proposals.begin(), proposals.end(), [&](const ProposedBox& proposal) {
        return proposal.class_index == class_index;
    });
    return std::max(searched_boxes, std::size_t(own) / 10);
}

/// @brief Classes that are asked about a hypothesis, in training as in detection.
inline constexpr std::size_t asked_classes = 8;

/// @brief The best boxes, best first, of which no two overlap by an IoU above 0.7.
[[nodiscard]] inline std::vector<SearchedBox> best_apart(std::vector<SearchedBox> boxes,
                                                         std::size_t max_count) {
    detail::sort_by(boxes, [](const SearchedBox& box) { return detail::falling(box.score); });
    std::vector<SearchedBox> kept;
    for (const SearchedBox& box : boxes) {
        if (kept.size() == max_count) break;
        if (std::none_of(kept.begin(), kept.end(),
                         [&](const SearchedBox& k) { return iou(k.box, box.box) > 0.7; }))
            kept.push_back(box);
    }
    return kept;
}

namespace detail {

/// Where templates are asked: the boxes proposed, those of other classes with the aspect of this one.
[[nodiscard]] inline std::vector<Box> asked_places(std::span<const ProposedBox> proposals,
                                                   std::uint32_t class_index, double log_aspect) {
    const double root = std::exp(log_aspect / 2);
    std::vector<Box> places;
    for (const auto& [proposing_class, box] : proposals) {
        const double side = std::sqrt(box.area());
        places.push_back(proposing_class == class_index ? box
                                                        : box_around(box.centre(), side * root, side / root));
    }
    return places;
}

/// Which of some boxes are the better third.
[[nodiscard]] inline std::vector<std::uint8_t> better_third(std::span<const SearchedBox> boxes) {
    std::vector<Ranked> order;
    for (const SearchedBox& box : boxes) order.push_back({falling(box.score), std::uint32_t(order.size())});
    sort_ranked(order.data(), order.size());
    std::vector<std::uint8_t> better(boxes.size(), 0);
    for (std::size_t i = 0; i < (boxes.size() + 2) / 3; ++i) better[order[i].index] = 1;
    return better;
}

}  // namespace detail

/// @brief The boxes of a class, best first, that each of several templates finds from proposals: each is
/// asked at its own place, those of other classes with the aspect of this, and the better third in two more
/// sizes; the best that are apart are then searched. None has a part in what another finds.
/// @param scorers    of the class, whose templates have grid and aspect in common
/// @param max_count  boxes that are searched, and told
/// @return of each template
[[nodiscard]] inline std::vector<std::vector<SearchedBox>> propose_boxes(
    std::span<const TemplateScorer* const> scorers, std::uint32_t class_index, const HogPyramid& pyramid,
    std::span<const ProposedBox> proposals, std::size_t max_count, ThreadPool& pool) {
    if (scorers.empty()) return {};
    const std::vector<Box> places =
        detail::asked_places(proposals, class_index, scorers[0]->box_template().log_aspect);
    std::vector<CellScratch> scratch(pool.size());
    std::vector<std::vector<std::uint8_t>> asks(scorers.size(), std::vector<std::uint8_t>(places.size(), 1));
    // in one size, by scorer and place, for those who ask
    const auto asked = [&](double size) {
        std::vector<std::vector<SearchedBox>> boxes(scorers.size(), std::vector<SearchedBox>(places.size()));
        pool.for_each(places.size(), [&](std::size_t i, unsigned worker) {
            if (std::none_of(asks.begin(), asks.end(),
                             [&](const auto& of_scorer) { return of_scorer[i] != 0; }))
                return;
            const Box box = box_around(places[i].centre(), size * places[i].width, size * places[i].height);
            const std::span<const float> cells = scorers[0]->describe(pyramid, box, scratch[worker]);
            for (std::size_t s = 0; s < scorers.size(); ++s) {
                if (asks[s][i] == 0) continue;
                const auto score = scorers[s]->score(cells, box);
                boxes[s][i] = {box, score.value, score.mirrored};
            }
        });
        return boxes;
    };
    std::vector<std::vector<SearchedBox>> boxes = asked(1.1);
    for (std::size_t s = 0; s < scorers.size(); ++s) asks[s] = detail::better_third(boxes[s]);
    for (const double size : {0.8, 1.5}) {
        const auto more = asked(size);
        for (std::size_t s = 0; s < scorers.size(); ++s)
            for (std::size_t i = 0; i < places.size(); ++i)
                if (asks[s][i] != 0) boxes[s].push_back(more[s][i]);
    }
    for (std::size_t s = 0; s < scorers.size(); ++s) {
        std::vector<SearchedBox> starts = best_apart(std::move(boxes[s]), max_count);
        pool.for_each(starts.size(), [&](std::size_t i, unsigned worker) {
            starts[i] = search_box(*scorers[s], pyramid, starts[i], scratch[worker]);
        });
        boxes[s] = best_apart(std::move(starts), max_count);  // some have come together
    }
    return boxes;
}

/// @brief Those of one template.
[[nodiscard]] inline std::vector<SearchedBox> propose_boxes(const TemplateScorer& scorer,
                                                            std::uint32_t class_index,
                                                            const HogPyramid& pyramid,
                                                            std::span<const ProposedBox> proposals,
                                                            std::size_t max_count, ThreadPool& pool) {
    const TemplateScorer* const one[] = {&scorer};
    return std::move(propose_boxes(one, class_index, pyramid, proposals, max_count, pool)[0]);
}

/// @brief The finest level of a pyramid that templates of about `cells` cells need for these boxes.
[[nodiscard]] inline int finest_level(std::span<const ProposedBox> boxes, double cells = 100) {
    double least = 1e9;
    for (const ProposedBox& b : boxes) least = std::min(least, std::sqrt(b.box.area() / cells));
    return boxes.empty()
               ? 0
               : std::clamp(int(std::lround(2 * std::log2(std::max(0.1, least) / 8))), HogPyramid::finest, 6);
}

}  // namespace ism
