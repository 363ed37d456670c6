// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "ism/config.hpp"
#include "ism/core/error.hpp"

#if ISM_HAS_NANOFLANN
#include <nanoflann.hpp>
#endif

namespace ism {

/// @brief Exact Euclidean radius search among points of few dimensions, in a k-d tree (nanoflann; Bentley
/// 1975). Among few points, and without nanoflann, all are looked at for each search, with the same results.
/// May be asked from several threads at once.
template <std::size_t Dimension>
class RadiusSearch {
public:
    using Point = std::array<double, Dimension>;

    RadiusSearch() = default;

    /// @throws Error for a coordinate that is not finite, or 2³² − 1 points or more.
    explicit RadiusSearch(std::vector<Point> points) : points_(std::make_unique<Points>()) {
        expect(points.size() < 0xffffffffu, "radius search: points", "fewer than 2^32 - 1", points.size());
        for (const Point& point : points)
            for (const double value : point)
                expect(std::isfinite(value), "radius search: coordinate", "a finite number", value);
        points_->points = std::move(points);
#if ISM_HAS_NANOFLANN
        if (size() > few) tree_ = std::make_unique<Tree>(int(Dimension), *points_);
#endif
    }

    [[nodiscard]] std::size_t size() const {
        return points_ ? points_->points.size() : 0;
    }

    /// @brief The points p with Σ (p − at)² ≤ radius², by rising index. None where a number is NaN.
    [[nodiscard]] std::vector<std::uint32_t> within(const Point& at, double radius) const {
        std::vector<std::uint32_t> found;
        within(at, radius, found);
        return found;
    }

    /// @brief The same in a vector that may be used again.
    void within(const Point& at, double radius, std::vector<std::uint32_t>& found) const {
        const double sq_radius = radius * radius;
        const auto is_within = [&](std::uint32_t i) {
            double sq_distance = 0;
            for (std::size_t k = 0; k < Dimension; ++k) {
                const double difference = points_->points[i][k] - at[k];
                sq_distance += difference * difference;
            }
            return sq_distance <= sq_radius;
        };
        found.clear();
#if ISM_HAS_NANOFLANN
        if (tree_ != nullptr) {
            Candidates candidates{found, sq_radius * (1 + 1e-9) + 1e-300};  // nanoflann takes what is less
            tree_->findNeighbors(candidates, at.data(), {});
            std::erase_if(found, [&](std::uint32_t i) { return !is_within(i); });
            std::sort(found.begin(), found.end());
            return;
        }
#endif
        for (std::uint32_t i = 0; i < size(); ++i)
            if (is_within(i)) found.push_back(i);
    }

private:
    static constexpr std::size_t few = 256;  // a scan of these is as fast as a descent of the tree

    struct Points {
        std::vector<Point> points;
        [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
        [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t k) const { return points[i][k]; }
        template <class Box>
        bool kdtree_get_bbox(Box& /*box*/) const {
            return false;
        }
    };

#if ISM_HAS_NANOFLANN
    /// A result set of our own: those of nanoflann, and what they hold, differ between its versions.
    struct Candidates {
        using DistanceType = double;  // asked for by version 1.7, as sort() is
        std::vector<std::uint32_t>& found;
        double limit;
        [[nodiscard]] double worstDist() const { return limit; }
        [[nodiscard]] bool full() const { return true; }
        [[nodiscard]] bool empty() const { return found.empty(); }
        [[nodiscard]] std::size_t size() const { return found.size(); }
        void sort() {}
        bool addPoint(double /*sq_distance*/, std::uint32_t index) {
            found.push_back(index);
            return true;
        }
    };
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points,
                                                     int(Dimension), std::uint32_t>;
#endif

    std::unique_ptr<Points> points_;  // of which the tree keeps the address
#if ISM_HAS_NANOFLANN
    std::unique_ptr<Tree> tree_;
#endif
};

}  // namespace ism
