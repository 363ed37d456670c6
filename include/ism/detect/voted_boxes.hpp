// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/callable.hpp"
#include "ism/core/geometry.hpp"
#include "ism/feature/feature.hpp"
#include "ism/model/shape_model.hpp"
#include "ism/vote/placement.hpp"
#include "ism/vote/vote.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

namespace detail {

/// The boxes of a few votes of a class, number after number, so that a processor takes many at once.
struct VotedBlock {
    static constexpr std::size_t most = 16;
    using Floats = std::array<float, most>;

    Floats x = {}, y = {}, width = {}, height = {};  ///< centres and sides, pixels
    Floats weight = {};                              ///< of the votes
    std::array<std::uint32_t, most> vote = {};
    std::size_t count = 0;  ///< that are there

    [[nodiscard]] Box box(std::size_t i) const { return box_around({x[i], y[i]}, width[i], height[i]); }
};

/// The IoU of each with a box, in floats: off by less than rounding_of_iou().
[[nodiscard]] inline VotedBlock::Floats rough_iou(const VotedBlock& votes, const Box& box) {
    const Point2 centre = box.centre();
    const float x = float(centre.x), y = float(centre.y), width = float(box.width),
                height = float(box.height);
    const auto shared = [](float apart, float a, float b) {
        const float touching = (a + b) / 2 - std::abs(apart), smaller = a < b ? a : b,
                    most = touching < smaller ? touching : smaller;
        return most > 0 ? most : 0;
    };
    VotedBlock::Floats result;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const float both =
            shared(votes.x[i] - x, votes.width[i], width) * shared(votes.y[i] - y, votes.height[i], height);
        result[i] = both / (votes.width[i] * votes.height[i] + width * height - both);
    }
    return result;
}
/// By how much floats may be off: coordinates by a millionth, beside the shorter side.
[[nodiscard]] inline double rounding_of_iou(const Box& box) {
    const Point2 centre = box.centre();
    const double rounding_px = 1e-6 * (std::abs(centre.x) + std::abs(centre.y) + box.width + box.height);
    return 1e-3 + 8 * rounding_px / std::min(box.width, box.height);
}

}  // namespace detail

/// @brief The boxes that the votes of an image stand for.
class VotedBoxes {
public:
    /// @brief IoU of the box that a vote stands for with one that it agrees with.
    static constexpr double least_agreement = 0.5;

    VotedBoxes() = default;
    VotedBoxes(std::span<const Vote<Jism::dimension>> votes, std::span<const Feature> features,
               const ShapeModel& shapes)
        : of_class_(shapes.class_names.size()) {
        std::vector<std::size_t> counts(of_class_.size(), 0);
        for (const auto& vote : votes) ++counts[shapes.occurrence(vote.occurrence).class_index];
        for (std::size_t c = 0; c < counts.size(); ++c)
            of_class_[c].reserve(counts[c] / detail::VotedBlock::most + 1);
        for (std::uint32_t i = 0; i < votes.size(); ++i) {
            const Occurrence& o = shapes.occurrence(votes[i].occurrence);
            const TrainingObject& object = shapes.objects[o.object];
            add(placed_box(placement(features[votes[i].feature], o), object), votes[i].weight, i,
                of_class_[o.class_index]);
        }
    }

    /// @brief Calls tell(vote, weight, IoU) for each vote of a class that agrees with a box, by index.
    template <Callable<std::uint32_t, float, double> Tell>
    void each_agreeing(std::uint32_t class_index, const Box& box, const Tell& tell) const {
        const auto rough = float(least_agreement - detail::rounding_of_iou(box));
        for (const detail::VotedBlock& votes : of_class_[class_index]) {
            const auto about = detail::rough_iou(votes, box);
            for (std::size_t i = 0; i < votes.count; ++i) {
                if (!(about[i] >= rough)) continue;
                const double agreement = iou(votes.box(i), box);
                if (agreement >= least_agreement) tell(votes.vote[i], votes.weight[i], agreement);
            }
        }
    }
    /// @brief The weight of the votes of a class that agree with a box, each as much as it does.
    [[nodiscard]] double weight(std::uint32_t class_index, const Box& box) const {
        double sum = 0;
        if (class_index < of_class_.size())
            each_agreeing(class_index, box,
                          [&](std::uint32_t, float weight, double agreement) { sum += weight * agreement; });
        return sum;
    }

    /// @brief The share that a class has in the weight of all votes that agree with a box, as if it and all
    /// others together had a tenth more each: one half where no votes agree.
    [[nodiscard]] double share(std::uint32_t class_index, const Box& box) const {
        double own = 0, all = 0;
        for (std::uint32_t c = 0; c < of_class_.size(); ++c) {
            const double of_class = weight(c, box);
            all += of_class;
            if (c == class_index) own = of_class;
        }
        return (own + 0.1) / (all + 0.2);
    }

    /// @brief Keeps one in `step` votes of a class, at `step` times its weight, for the memory that they
    /// take: enough for sums over many votes.
    void thin(std::uint32_t class_index, std::size_t step) {
        std::size_t passed = step / 2;  // since the last that was kept
        Blocks kept;
        for (const detail::VotedBlock& votes : of_class_[class_index])
            for (std::size_t i = 0; i < votes.count; ++i)
                if (passed++ % step == 0)
                    add(votes.box(i), float(step) * votes.weight[i], votes.vote[i], kept);
        of_class_[class_index] = std::move(kept);
    }

private:
    using Blocks = std::vector<detail::VotedBlock>;

    static void add(const Box& box, float weight, std::uint32_t vote, Blocks& to) {
        if (to.empty() || to.back().count == detail::VotedBlock::most) to.emplace_back();
        detail::VotedBlock& votes = to.back();
        const Point2 centre = box.centre();
        const std::size_t i = votes.count++;
        votes.x[i] = float(centre.x), votes.y[i] = float(centre.y);
        votes.width[i] = float(box.width), votes.height[i] = float(box.height);
        votes.weight[i] = weight, votes.vote[i] = vote;
    }

    std::vector<Blocks> of_class_;
};

}  // namespace ism
