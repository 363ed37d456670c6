// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

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

/// @brief The boxes that the votes of an image stand for.
class VotedBoxes {
public:
    /// @brief IoU of the box that a vote stands for with one that it agrees with.
    static constexpr double default_agreement = 0.5;

    VotedBoxes() = default;
    VotedBoxes(std::span<const Vote<Jism::dimension>> votes, std::span<const Feature> features,
               const ShapeModel& shapes)
        : of_class_(shapes.class_names.size()) {
        std::vector<std::size_t> counts(of_class_.size(), 0);
        for (const auto& vote : votes) ++counts[shapes.occurrence(vote.occurrence).class_index];
        for (std::size_t c = 0; c < counts.size(); ++c) of_class_[c].reserve(counts[c]);
        for (std::uint32_t i = 0; i < votes.size(); ++i) {
            const Occurrence& o = shapes.occurrence(votes[i].occurrence);
            const TrainingObject& object = shapes.objects[o.object];
            const Box box = placed_box(placement(features[votes[i].feature], o), object);
            const Point2 centre = box.centre();
            of_class_[o.class_index].push_back(
                {float(centre.x), float(centre.y), float(box.width), float(box.height), votes[i].weight, i});
        }
    }

    /// @brief Calls tell(vote, weight, IoU) for each vote of a class that agrees with a box, by index.
    template <Callable<std::uint32_t, float, double> Tell>
    void each_agreeing(std::uint32_t class_index, const Box& box, double min_agreement,
                       const Tell& tell) const {
        const Point2 centre = box.centre();
        for (const Voted& v : of_class_[class_index]) {
            if (std::abs(double(v.x) - centre.x) > box.width / 2 ||
                std::abs(double(v.y) - centre.y) > box.height / 2)
                continue;
            const double agreement = iou(box_around({v.x, v.y}, v.width, v.height), box);
            if (agreement >= min_agreement) tell(v.vote, v.weight, agreement);
        }
    }
    /// @brief The weight of the votes of a class that agree with a box, each as much as it does.
    [[nodiscard]] double weight(std::uint32_t class_index, const Box& box) const {
        double sum = 0;
        if (class_index < of_class_.size())
            each_agreeing(class_index, box, default_agreement,
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

    /// @brief Keeps every 64th vote of a class at 64 times its weight, for the memory that they take: enough
    /// for sums over many classes.
    void thin(std::uint32_t class_index) {
        constexpr std::size_t step = 64;
        std::vector<Voted> kept;
        for (std::size_t i = step / 2; i < of_class_[class_index].size(); i += step) {
            kept.push_back(of_class_[class_index][i]);
            kept.back().weight *= float(step);
        }
        of_class_[class_index] = std::move(kept);
    }

private:
    struct Voted {
        float x, y, width, height;  ///< centre and sides, pixels
        float weight;
        std::uint32_t vote;
    };
    std::vector<std::vector<Voted>> of_class_;
};

}  // namespace ism
