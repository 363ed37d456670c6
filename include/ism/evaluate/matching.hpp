// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/geometry.hpp"

namespace ism {

/// @brief A ground-truth object.
struct TruthObject {
    std::size_t image = 0;          ///< index of the image
    std::uint32_t class_index = 0;  ///< index of the class
    Box box;                        ///< pixels
    bool ignore = false;            ///< a crowd, say: finding it neither helps nor hurts
};

/// @brief A detection.
struct FoundObject {
    std::size_t image = 0;          ///< index of the image
    std::uint32_t class_index = 0;  ///< index of the class
    Box box;                        ///< pixels
    double score = 0;               ///< larger is more confident
};

/// @brief When a detected box matches a ground-truth box: `fit` is the quality of the match (larger is
/// better) or nothing where it does not match; `ignores` says whether a detected box that matches no object
/// lies so far inside an ignored region that it is not counted.
template <class R>
concept MatchRule = requires(const R& rule, const Box& found, const Box& truth) {
    { rule.fit(found, truth) } -> std::convertible_to<std::optional<double>>;
    { rule.ignores(found, truth) } -> std::convertible_to<bool>;
};

namespace detail {

/// The part of a box's area that lies in another, 0 … 1.
[[nodiscard]] inline double share_inside(const Box& box, const Box& region) {
    return box.area() > 0 ? intersection(box, region).area() / box.area() : 0;
}

}  // namespace detail

/// @brief A match where intersection over union reaches a threshold (Everingham et al. 2010: 0.5).
struct IouRule {
    double threshold = 0.5;  ///< 0 … 1; boxes without any overlap never match

    [[nodiscard]] std::optional<double> fit(const Box& found, const Box& truth) const {
        const double overlap = iou(found, truth);
        return overlap > 0 && overlap >= threshold ? std::optional(overlap) : std::nullopt;
    }
    [[nodiscard]] bool ignores(const Box& found, const Box& region) const {
        const double share = detail::share_inside(found, region);
        return share > 0 && share >= threshold;
    }
};

/// @brief Validates a rule.
/// @throws Error for a threshold that is out of range.
inline void check(const IouRule& rule) {
    expect(rule.threshold >= 0 && rule.threshold <= 1, "IouRule::threshold", "0 ... 1", rule.threshold);
}

/// @brief The rule of the UIUC car set (Agarwal, Awan, Roth 2004) for boxes of any size: a match where the
/// detected centre lies in the ellipse around the true centre whose half axes are a quarter of the true
/// sides.
struct UiucRule {
    [[nodiscard]] std::optional<double> fit(const Box& found, const Box& truth) const {
        const double dx = found.centre().x - truth.centre().x, dy = found.centre().y - truth.centre().y;
        // (dx / (w/4))² + (dy / (h/4))² ≤ 1 without divisions: exact on the ellipse for whole numbers
        const double distance = std::pow(4 * dx * truth.height, 2) + std::pow(4 * dy * truth.width, 2);
        const double limit = std::pow(truth.width * truth.height, 2);
        return limit > 0 && distance <= limit ? std::optional(1 - distance / limit) : std::nullopt;
    }
    [[nodiscard]] bool ignores(const Box& found, const Box& region) const {
        return detail::share_inside(found, region) >= 0.5;
    }
};

/// @brief How a detection is counted.
enum class Verdict { true_positive, false_positive, ignored };

/// @brief Stands for "no object".
inline constexpr std::size_t no_object = std::numeric_limits<std::size_t>::max();

/// @brief How one detection is counted and, for a true positive, the index of the object it found.
struct Judgement {
    Verdict verdict = Verdict::false_positive;
    std::size_t truth = no_object;
    [[nodiscard]] bool operator==(const Judgement&) const = default;
};

/// @brief Validates a detection.
/// @throws Error where its score or box is not finite.
inline void check(const FoundObject& found) {
    const Box& box = found.box;
    expect(std::isfinite(found.score), "score of a found object", "a finite number", found.score);
    expect(std::isfinite(box.x + box.y + box.width + box.height), "box of a found object", "finite numbers",
           lazy_text(box.x, ", ", box.y, ", ", box.width, ", ", box.height));
}

/// @brief Indices of the detections, best score first; of equal scores the earlier one first.
/// @throws Error where a score or a box is not finite.
[[nodiscard]] inline std::vector<std::size_t> by_score(std::span<const FoundObject> found) {
    for (const FoundObject& f : found) check(f);
    std::vector<std::size_t> order(found.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return found[a].score > found[b].score; });
    return order;
}

/// @brief Greedy matching, best score first: each detection takes the best matching object of its image and
/// class that is still unmatched (of equal matches the earlier one), so that each object is found at most
/// once and further detections of it are false positives. A detection that matches no object but lies in an
/// ignored one is ignored.
/// @return one judgement for each detection, in the order given
/// @throws Error where a score or a box is not finite, or the rule's check() refuses it.
template <MatchRule Rule>
[[nodiscard]] std::vector<Judgement> match(std::span<const TruthObject> truth,
                                           std::span<const FoundObject> found, const Rule& rule) {
    if constexpr (requires { check(rule); }) check(rule);
    // objects sorted by image and class, so that those of a detection are found by binary search
    std::vector<std::size_t> sorted(truth.size());
    std::iota(sorted.begin(), sorted.end(), std::size_t{0});
    const auto place = [](const auto& object) { return std::pair(object.image, object.class_index); };
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](std::size_t a, std::size_t b) { return place(truth[a]) < place(truth[b]); });

    std::vector<Judgement> judgements(found.size());
    std::vector<char> taken(truth.size(), 0);
    for (const std::size_t f : by_score(found)) {
        const FoundObject& object = found[f];
        const auto first = std::lower_bound(sorted.begin(), sorted.end(), place(object),
                                            [&](std::size_t t, auto key) { return place(truth[t]) < key; });
        double best = -std::numeric_limits<double>::infinity();
        for (auto it = first; it != sorted.end() && place(truth[*it]) == place(object); ++it) {
            const TruthObject& t = truth[*it];
            Judgement& judgement = judgements[f];
            if (t.ignore) {
                if (judgement.verdict == Verdict::false_positive && rule.ignores(object.box, t.box))
                    judgement.verdict = Verdict::ignored;
            } else if (taken[*it] == 0) {
                const std::optional<double> fit = rule.fit(object.box, t.box);
                if (fit && *fit > best) best = *fit, judgement = {Verdict::true_positive, *it};
            }
        }
        if (judgements[f].truth != no_object) taken[judgements[f].truth] = 1;
    }
    return judgements;
}

}  // namespace ism
