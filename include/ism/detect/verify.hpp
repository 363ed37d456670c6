// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/scene.hpp"

namespace ism {

/// @brief A hypothesis that stays, and the score it stays with, 0 or more.
struct Verified {
    std::size_t index = 0;
    double score = 0;
};

/// @brief Decides which of several hypotheses stay. To model it, write a small struct with its options as
/// members and `std::vector<Verified> verify(const std::vector<Detection>&, const Scene&) const`. Options are
/// validated by `void check(const V&)` where there is one. With `bool needs_masks() const`, where this is
/// false, hypotheses come without their segmentation, and only those that stay are cut out.
template <class V>
concept Verifier = std::copyable<V> &&
    requires(const V& verifier, const std::vector<Detection>& hypotheses, const Scene& scene) {
    { verifier.verify(hypotheses, scene) } -> std::same_as<std::vector<Verified>>;
};

namespace detail {

/// Strongest first.
inline void sort_by_score(std::vector<Verified>& verified) {
    sort_by(verified, [](const Verified& v) { return falling(v.score); });
}

/// The hypotheses that stay, strongest first, where each gives way to a stronger one that is of the same
/// object: are_one(stronger, weaker), by index.
template <class AreOne>
[[nodiscard]] std::vector<Verified> strongest_of_each(const std::vector<Detection>& hypotheses,
                                                      const AreOne& are_one) {
    std::vector<Verified> order, kept;
    for (std::size_t i = 0; i < hypotheses.size(); ++i) order.push_back({i, hypotheses[i].score});
    sort_by_score(order);
    for (const Verified& candidate : order)
        if (!any_of(kept, [&](const Verified& stronger) { return are_one(stronger.index, candidate.index); }))
            kept.push_back(candidate);
    return kept;
}

}  // namespace detail

/// @brief Plain non-maximum suppression: of hypotheses whose boxes overlap the strongest stays.
struct NonMaximumSuppression {
    double max_iou = 0.4;   ///< boxes that overlap more are of one object
    double max_inside = 1;  ///< … or of which a larger part lies within the stronger; 1 = none of these
    bool across_classes = true;  ///< whether classes suppress each other

    /// @brief Boxes are enough.
    [[nodiscard]] static constexpr bool needs_masks() { return false; }

    /// @brief The hypotheses that stay, strongest first, with their scores unchanged.
    [[nodiscard]] std::vector<Verified> verify(const std::vector<Detection>& hypotheses) const {
        return detail::strongest_of_each(hypotheses, [&](std::size_t stronger, std::size_t weaker) {
            const Detection &rival = hypotheses[stronger], &own = hypotheses[weaker];
            return (across_classes || rival.class_index == own.class_index) &&
                   (iou(rival.box, own.box) > max_iou ||
                    (max_inside < 1 &&
                     intersection(rival.box, own.box).area() > max_inside * own.box.area()));
        });
    }
    [[nodiscard]] std::vector<Verified> verify(const std::vector<Detection>& hypotheses, const Scene&) const {
        return verify(hypotheses);
    }
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const NonMaximumSuppression& options) {
    expect(options.max_iou >= 0 && options.max_iou <= 1, "NonMaximumSuppression::max_iou", "0 ... 1",
           options.max_iou);
    expect(options.max_inside >= 0 && options.max_inside <= 1, "NonMaximumSuppression::max_inside", "0 ... 1",
           options.max_inside);
}

/// @brief What a set of hypotheses saves: each has its own savings, and each pair pays for what both claim.
struct Savings {
    std::vector<double> own;   ///< of each hypothesis alone
    std::vector<double> cost;  ///< pair (i, j) at i · count + j, symmetric, ≥ 0

    /// @brief Σ own − Σ cost over the pairs of a set.
    [[nodiscard]] double of(std::span<const std::size_t> chosen) const {
        double sum = 0;
        for (std::size_t a = 0; a < chosen.size(); ++a) {
            sum += own[chosen[a]];
            for (std::size_t b = 0; b < a; ++b) sum -= cost[chosen[a] * own.size() + chosen[b]];
        }
        return sum;
    }
};

/// @brief Verification by minimum description length (Leibe et al. 2008, section 6): a hypothesis saves
/// S = −K1/K0 + (1 − K2/K0) · N + (K2/K0) · Σ p(figure), over the N pixels of its mask, in parts of its box;
/// pixels that two hypotheses claim are charged to the one with the lower score.
struct Mdl {
    double k1_over_k0 = 0.15;  ///< what a further hypothesis costs, in parts of its box
    double k2_over_k0 = 0.95;  ///< how much the certainty of a pixel counts

    /// @brief Savings of each hypothesis and the cost of each pair.
    [[nodiscard]] Savings savings(const std::vector<Detection>& hypotheses) const {
        const std::size_t count = hypotheses.size();
        Savings result{std::vector<double>(count), std::vector<double>(count * count, 0)};
        for (std::size_t i = 0; i < count; ++i) {
            const Segmentation& part = hypotheses[i].segmentation;
            double sum = 0;
            for (int y = 0; y < part.mask.height(); ++y)
                for (int x = 0; x < part.mask.width(); ++x)
                    if (part.mask(x, y) != 0) sum += worth(part, x, y);
            result.own[i] = sum / hypotheses[i].box.area() - k1_over_k0;
            for (std::size_t j = 0; j < i; ++j) {
                const bool i_weaker = hypotheses[i].score <= hypotheses[j].score;
                const double shared = i_weaker ? claimed_too(hypotheses[i], hypotheses[j])
                                               : claimed_too(hypotheses[j], hypotheses[i]);
                result.cost[i * count + j] = result.cost[j * count + i] = shared;
            }
        }
        return result;
    }

    /// @brief Adds the hypothesis with the largest gain, weighed by its score, as long as one gains. A
    /// hypothesis that loses pixels to others keeps its score in the part it still saves.
    [[nodiscard]] std::vector<Verified> verify(const std::vector<Detection>& hypotheses) const {
        const Savings all = savings(hypotheses);
        std::vector<double> gain = all.own;
        const auto worth_of = [&](std::size_t i) {
            return hypotheses[i].score * gain[i] / std::max(all.own[i], 1e-12);
        };
        std::vector<Verified> kept;
        while (true) {
            std::size_t best = hypotheses.size();
            for (std::size_t i = 0; i < hypotheses.size(); ++i)
                if (gain[i] > 0 && (best == hypotheses.size() || worth_of(i) > worth_of(best))) best = i;
            if (best == hypotheses.size()) return kept;
            kept.push_back({best, worth_of(best)});
            gain[best] = -std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < hypotheses.size(); ++i)
                gain[i] -= all.cost[best * hypotheses.size() + i];
        }
    }
    [[nodiscard]] std::vector<Verified> verify(const std::vector<Detection>& hypotheses, const Scene&) const {
        return verify(hypotheses);
    }

private:
    [[nodiscard]] double worth(const Segmentation& part, int x, int y) const {
        const double figure = part.figure(x, y), all = figure + double(part.ground(x, y));
        return 1 - k2_over_k0 + k2_over_k0 * (all > 0 ? figure / all : 1);  // of no maps the mask counts
    }

    /// What of `weaker` lies in the mask of `other` too, in parts of the box of `weaker`.
    [[nodiscard]] double claimed_too(const Detection& weaker, const Detection& other) const {
        const Segmentation &a = weaker.segmentation, &b = other.segmentation;
        double sum = 0;
        for (int y = std::max(a.y, b.y); y < std::min(a.y + a.mask.height(), b.y + b.mask.height()); ++y)
            for (int x = std::max(a.x, b.x); x < std::min(a.x + a.mask.width(), b.x + b.mask.width()); ++x)
                if (a.mask(x - a.x, y - a.y) != 0 && b.mask(x - b.x, y - b.y) != 0)
                    sum += worth(a, x - a.x, y - a.y);
        return sum / weaker.box.area();
    }
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const Mdl& options) {
    expect(options.k1_over_k0 >= 0 && options.k1_over_k0 <= 1e6, "Mdl::k1_over_k0", "0 ... 1e6",
           options.k1_over_k0);
    expect(options.k2_over_k0 >= 0 && options.k2_over_k0 <= 1, "Mdl::k2_over_k0", "0 ... 1",
           options.k2_over_k0);
}

}  // namespace ism
