// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/core/vec3.hpp"
#include "ism/depth/fitted_planes.hpp"
#include "ism/depth/supervoxel.hpp"
#include "ism/depth/surface.hpp"

namespace ism {

/// @brief One way to merge supervoxels into segments.
struct SegmentLevel {
    int step_px = 12;           ///< of the supervoxels
    double tolerance_deg = 10;  ///< how concave an edge between two may be, or how far apart their normals
    bool common_neighbour = false;  ///< an edge counts only where both have a third with such edges to both
};

namespace detail {

/// Two supervoxels (indices) side by side without a step in depth between them.
struct SupervoxelEdge {
    std::int32_t a = 0, b = 0, border_px = 0;
};

/// All pairs with at least `min_border_px` pixels side by side, by rising a.
[[nodiscard]] inline std::vector<SupervoxelEdge> supervoxel_edges(const Surface& surface,
                                                                  const Supervoxels& supervoxels,
                                                                  int min_border_px) {
    std::vector<std::vector<SupervoxelEdge>> of(supervoxels.all.size());
    const Image<std::int32_t>& labels = supervoxels.labels;
    const auto meet = [&](int x, int y, int other_x, int other_y) {
        const std::int32_t p = labels(x, y), q = labels(other_x, other_y);
        if (p == q || p == 0 || q == 0) return;
        const float z = surface.points_m(x, y).z;
        if (!(std::fabs(surface.points_m(other_x, other_y).z - z) < depth_step_m(z))) return;
        const std::int32_t a = std::min(p, q) - 1, b = std::max(p, q) - 1;
        auto& edges = of[std::size_t(a)];
        const auto known = std::find_if(edges.begin(), edges.end(), [b](const auto& e) { return e.b == b; });
        if (known == edges.end())
            edges.push_back({a, b, 1});
        else
            ++known->border_px;
    };
    for (int y = 0; y < labels.height(); ++y)
        for (int x = 0; x < labels.width(); ++x) {
            if (x + 1 < labels.width()) meet(x, y, x + 1, y);
            if (y + 1 < labels.height()) meet(x, y, x, y + 1);
        }
    std::vector<SupervoxelEdge> all;
    for (const auto& edges : of)
        for (const SupervoxelEdge& e : edges)
            if (e.border_px >= min_border_px) all.push_back(e);
    return all;
}

/// Whether two pieces meet convexly, up to a tolerance, or are about parallel (Stein et al. 2014, LCCP).
[[nodiscard]] inline bool is_convex(const Supervoxel& a, const Supervoxel& b, float sine, float cosine) {
    const Vec3f between = a.point_m - b.point_m;
    return dot(a.normal - b.normal, between) > -sine * length(between) || dot(a.normal, b.normal) > cosine;
}

/// Which group each supervoxel belongs to, by the smallest index in it.
class MergedGroups {
public:
    explicit MergedGroups(std::size_t count) : parent_(count) {
        for (std::size_t i = 0; i < count; ++i) parent_[i] = std::int32_t(i);
    }
    [[nodiscard]] std::int32_t find(std::int32_t i) {
        while (parent_[std::size_t(i)] != i)
            i = parent_[std::size_t(i)] = parent_[std::size_t(parent_[std::size_t(i)])];
        return i;
    }
    void merge(std::int32_t a, std::int32_t b) {
        a = find(a), b = find(b);
        parent_[std::size_t(std::max(a, b))] = std::min(a, b);
    }

private:
    std::vector<std::int32_t> parent_;
};

/// Whether two short lists have a number in common.
[[nodiscard]] inline bool have_common(const std::vector<std::int32_t>& a,
                                      const std::vector<std::int32_t>& b) {
    return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

/// Merges over all convex edges; where a common neighbour is asked for, supervoxels with at most two convex
/// edges do without.
[[nodiscard]] inline MergedGroups merge_convex(const std::vector<Supervoxel>& all,
                                               const std::vector<SupervoxelEdge>& edges,
                                               const SegmentLevel& level) {
    const double tolerance = level.tolerance_deg / 180 * std::numbers::pi;
    const auto sine = float(std::sin(tolerance)), cosine = float(std::cos(tolerance));
    std::vector<std::pair<std::int32_t, std::int32_t>> convex;
    std::vector<std::vector<std::int32_t>> neighbours(all.size());
    for (const SupervoxelEdge& e : edges)
        if (is_convex(all[std::size_t(e.a)], all[std::size_t(e.b)], sine, cosine)) {
            convex.push_back({e.a, e.b});
            neighbours[std::size_t(e.a)].push_back(e.b);
            neighbours[std::size_t(e.b)].push_back(e.a);
        }
    MergedGroups groups(all.size());
    for (const auto& [a, b] : convex) {
        const auto &of_a = neighbours[std::size_t(a)], &of_b = neighbours[std::size_t(b)];
        if (!level.common_neighbour || of_a.size() <= 2 || of_b.size() <= 2 || have_common(of_a, of_b))
            groups.merge(a, b);
    }
    return groups;
}

/// The masks of the groups of min_px to max_px pixels, by their first supervoxel.
[[nodiscard]] inline std::vector<RegionMask> group_masks(const Supervoxels& supervoxels, MergedGroups groups,
                                                         double min_px, double max_px) {
    struct Group {
        double left = 1e9, top = 1e9, right = 0, bottom = 0, pixels = 0;
    };
    const std::size_t count = supervoxels.all.size();
    std::vector<Group> of_root(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Supervoxel& s = supervoxels.all[i];
        Group& g = of_root[std::size_t(groups.find(std::int32_t(i)))];
        g.left = std::min(g.left, s.box.x), g.right = std::max(g.right, s.box.x + s.box.width);
        g.top = std::min(g.top, s.box.y), g.bottom = std::max(g.bottom, s.box.y + s.box.height);
        g.pixels += s.pixels;
    }
    std::vector<RegionMask> masks;
    std::vector<std::int32_t> mask_of_root(count, -1), mask_of_label(count + 1, -1);
    for (std::size_t i = 0; i < count; ++i) {
        const Group& g = of_root[i];
        if (g.pixels > 0 && g.pixels >= min_px && g.pixels <= max_px) {
            mask_of_root[i] = std::int32_t(masks.size());
            masks.push_back({int(g.left), int(g.top), Mask(int(g.right - g.left), int(g.bottom - g.top))});
        }
        mask_of_label[i + 1] = mask_of_root[std::size_t(groups.find(std::int32_t(i)))];
    }
    const Image<std::int32_t>& labels = supervoxels.labels;
    for (int y = 0; y < labels.height(); ++y)
        for (int x = 0; x < labels.width(); ++x)
            if (const std::int32_t m = mask_of_label[std::size_t(labels(x, y))]; m >= 0) {
                RegionMask& region = masks[std::size_t(m)];
                region.mask(x - region.x, y - region.y) = 1;
            }
    return masks;
}

}  // namespace detail

}  // namespace ism
