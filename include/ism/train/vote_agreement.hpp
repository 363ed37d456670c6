// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/radius_search.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/model/shape_model.hpp"
#include "ism/vote/axes.hpp"
#include "ism/vote/kernel.hpp"

namespace ism {

namespace detail {

/// The votes of the occurrences of a word for each other's objects. A feature f of the word votes through the
/// occurrence o for what lies u, v, w bandwidths from its own object in x, y and scale, where
/// u² + v² + w² = s_f² |p_f − p_o|² with p = (x / (s b_x), y / (s b_y), 1 / (s b_s)), so that the votes near
/// its object come from the occurrences within 1 / s_f of p_f.
class WordVotes {
public:
    /// @param of_class  number of all occurrences of each class: every class counts alike
    WordVotes(std::span<const Occurrence> word, std::span<const double> of_class)
        : word_(word), of_class_(of_class) {
        std::vector<std::array<double, 3>> points;
        for (const Occurrence& o : word) {
            const double s = o.scale;
            points.push_back(
                {o.x / (s * X::bandwidth), o.y / (s * Y::bandwidth), 1 / (s * Scale::bandwidth)});
            all_ += 1 / of_class[o.class_index];
            of_object_[o.object] += 1 / of_class[o.class_index];
        }
        points_ = points;
        search_ = RadiusSearch<3>(std::move(points));
    }

    /// The share of the votes of feature f through occurrences on other objects that names the right class
    /// and falls near the centre and scale, 0 … 1; 0 where no other object has the word.
    [[nodiscard]] double right_share(std::size_t f) {
        const Occurrence& feature = word_[f];
        double right = 0;
        search_.within(points_[f], (1 + 1e-6) / double(feature.scale), found_);
        for (const std::uint32_t i : found_) {
            const Occurrence& other = word_[i];
            if (other.object == feature.object || other.class_index != feature.class_index) continue;
            double sq_u = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double u = double(feature.scale) * (points_[f][k] - points_[i][k]);
                sq_u += u * u;
            }
            right += EpanechnikovKernel::profile(static_cast<float>(sq_u)) / of_class_[other.class_index];
        }
        return right > 0 ? right / (all_ - of_object_.at(feature.object)) : 0;
    }

private:
    std::span<const Occurrence> word_;
    std::span<const double> of_class_;
    std::vector<std::array<double, 3>> points_;
    RadiusSearch<3> search_;
    std::map<std::uint32_t, double> of_object_;
    double all_ = 0;
    std::vector<std::uint32_t> found_;
};

}  // namespace detail

/// @brief What each word is good for: the part of all training features, every class counting alike, that
/// this word leads to the right vote: of the votes through occurrences on other objects, the share that names
/// the class and falls near the centre and scale. Unlike the information gain it asks not only which class a
/// word tells, but also whether it tells where. One radius search a feature. A WordWorth.
/// @return one number a word, 0 or more
/// @throws Error for an occurrence whose position or scale is not finite, or of scale 0.
[[nodiscard]] inline std::vector<double> vote_agreement(const ShapeModel& shapes, unsigned threads = 0) {
    std::vector<double> of_class(shapes.class_names.size(), 0);
    for (const Occurrence& o : shapes.occurrences.values()) of_class[o.class_index] += 1;
    std::vector<double> agreement(shapes.occurrences.size(), 0);
    parallel_for(agreement.size(), threads, [&](std::size_t w) {
        const std::span<const Occurrence> word = shapes.occurrences[w];
        detail::WordVotes votes(word, of_class);
        for (std::size_t f = 0; f < word.size(); ++f)
            agreement[w] += votes.right_share(f) / of_class[word[f].class_index];
    });
    return agreement;
}

}  // namespace ism
