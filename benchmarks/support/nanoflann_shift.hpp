// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <nanoflann.hpp>

#include "ism/vote/mean_shift.hpp"

namespace bench {

/// @brief Mean shift as one writes it with nanoflann: a k-d tree of the votes in units of the window, a
/// radius search a step. Starts, kernel, stopping rule and the choice among near modes are ours; the window
/// is the same everywhere.
template <std::size_t Dimension>
class NanoflannShift {
public:
    NanoflannShift(std::span<const ism::Vote<Dimension>> votes, const std::array<double, Dimension>& window)
        : window_(window), votes_(votes) {
        for (const auto& vote : votes) {
            std::array<float, Dimension> point;
            for (std::size_t k = 0; k < Dimension; ++k) point[k] = float(vote.at[k] / window[k]);
            points_.points.push_back(point);
        }
        tree_.buildIndex();
    }

    template <ism::Kernel K>
    [[nodiscard]] std::vector<ism::Mode<Dimension>> modes(std::span<const ism::Mode<Dimension>> starts,
                                                          const ism::MeanShiftOptions& options) {
        std::vector<ism::Mode<Dimension>> all, apart;
        for (const auto& start : starts) all.push_back(follow<K>(start, options));
        std::stable_sort(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return a.score > b.score; });
        for (const auto& mode : all)
            if (std::none_of(apart.begin(), apart.end(), [&](const auto& other) {
                    return ism::sq_windows(mode.at, other.at, window_) < 1;
                }))
                apart.push_back(mode);
        return apart;
    }

private:
    struct Points {
        std::vector<std::array<float, Dimension>> points;
        [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
        [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t k) const { return points[i][k]; }
        template <class Box>
        bool kdtree_get_bbox(Box& /*box*/) const {
            return false;
        }
    };
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points,
                                                     int(Dimension), std::uint32_t>;
#if NANOFLANN_VERSION >= 0x150
    using Found = nanoflann::ResultItem<std::uint32_t, float>;
    using Search = nanoflann::SearchParameters;
#else
    using Found = std::pair<std::uint32_t, float>;
    using Search = nanoflann::SearchParams;
#endif

    /// Votes within `reach` windows, with squared distances.
    void search(const std::array<float, Dimension>& at, double reach) {
        Search unsorted;
        unsorted.sorted = false;
        tree_.radiusSearch(at.data(), float(reach * reach), found_, unsorted);
    }

    template <ism::Kernel K>
    [[nodiscard]] ism::Mode<Dimension> follow(ism::Mode<Dimension> mode,
                                              const ism::MeanShiftOptions& options) {
        std::array<float, Dimension> at;
        for (std::size_t k = 0; k < Dimension; ++k) at[k] = float(mode.at[k] / window_[k]);
        for (int i = 0; i < options.max_iterations; ++i) {
            search(at, K::reach);
            std::array<float, Dimension> sum{};
            float weight = 0, scale = 0;
            for (const auto& [index, sq_u] : found_) {
                const float w = votes_[index].weight * K::shift(sq_u);
                for (std::size_t k = 0; k < Dimension; ++k) sum[k] += w * points_.points[index][k];
                scale += w * votes_[index].scale;
                weight += w;
            }
            if (!(weight > 0)) break;
            const double ratio = scale / weight / mode.scale - 1;
            double sq_step = ratio * ratio;
            for (std::size_t k = 0; k < Dimension; ++k) {
                const float next = sum[k] / weight, step = next - at[k];
                sq_step += step * step;
                at[k] = next;
            }
            mode.scale = scale / weight;
            if (sq_step < options.tolerance * options.tolerance) break;
        }
        search(at, K::reach);
        mode.score = 0;
        for (const auto& [index, sq_u] : found_) mode.score += votes_[index].weight * K::profile(sq_u);
        for (std::size_t k = 0; k < Dimension; ++k) mode.at[k] = at[k] * window_[k];
        return mode;
    }

    std::array<double, Dimension> window_;
    std::span<const ism::Vote<Dimension>> votes_;
    Points points_;
    Tree tree_{int(Dimension), points_, {10}};
    std::vector<Found> found_;
};

}  // namespace bench
