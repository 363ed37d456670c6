// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ism/config.hpp"

namespace ism::detail {

/// A cluster and how far it is.
struct Neighbour {
    float sq_distance;
    std::uint32_t cluster;
};

/// The nearest neighbours of each cluster, nearest first, as many as fit, and the radius within which the
/// list is complete: all clusters that are not on it lie at that distance or further.
class NeighbourLists {
public:
    static constexpr std::size_t capacity = 8;  // a cache line; of longer lists little is ever asked for

    /// A bit more than a squared distance, so that nothing that near in double is lost by rounding.
    [[nodiscard]] static float limit_of(double sq_distance) {
        constexpr float most = std::numeric_limits<float>::max();
        if (sq_distance >= 0.5 * double(most)) return most;
        return std::nextafter(float(sq_distance * (1 + 1e-6)), most);
    }

    /// Empty lists that keep what is nearer than `limit`.
    NeighbourLists(std::size_t clusters, float limit)
        : entries_(clusters * capacity), counts_(clusters, 0), sq_radius_(clusters, limit), limit_(limit) {}

    [[nodiscard]] std::span<const Neighbour> of(std::uint32_t i) const {
        return {entries_.data() + i * capacity, counts_[i]};
    }
    [[nodiscard]] float sq_radius(std::uint32_t i) const { return sq_radius_[i]; }
    [[nodiscard]] bool complete(std::uint32_t i) const { return sq_radius_[i] >= limit_; }

    /// Whether the first of the list is known to be the nearest of all clusters.
    [[nodiscard]] bool is_exact(std::uint32_t i) const {
        return complete(i) || (counts_[i] > 0 && of(i).front().sq_distance < sq_radius_[i]);
    }

    void clear(std::uint32_t i, float sq_radius) {
        counts_[i] = 0, sq_radius_[i] = std::min(sq_radius, limit_);
    }

    /// Puts a cluster on the list of i where it is near enough; one that finds no place shortens the radius.
    void insert(std::uint32_t i, const Neighbour& other) {
        if (!(other.sq_distance <= sq_radius_[i] && other.sq_distance < limit_)) return;
        Neighbour* const first = entries_.data() + i * capacity;
        std::size_t at = counts_[i];
        if (at == capacity) {
            const bool fits = before(i, other, first[capacity - 1]);
            sq_radius_[i] = fits ? first[capacity - 1].sq_distance : other.sq_distance;
            if (!fits) return;
            --at;
        } else {
            ++counts_[i];
        }
        for (; at > 0 && before(i, other, first[at - 1]); --at) first[at] = first[at - 1];
        first[at] = other;
    }

private:
    /// An order of all pairs, so that some pair is always reciprocal; among equal distances a random one, so
    /// that many are.
    [[nodiscard]] static bool before(std::uint32_t i, const Neighbour& a, const Neighbour& b) {
        if (a.sq_distance != b.sq_distance) return a.sq_distance < b.sq_distance;
        const std::uint64_t key_a = pair_key(i, a.cluster), key_b = pair_key(i, b.cluster);
        return key_a != key_b ? key_a < key_b : a.cluster < b.cluster;
    }
    [[nodiscard]] static std::uint64_t pair_key(std::uint32_t i, std::uint32_t j) {
        std::uint64_t key = std::uint64_t(std::min(i, j)) << 32 | std::max(i, j);
        key = (key ^ (key >> 31)) * 0x9e3779b97f4a7c15u;
        key = (key ^ (key >> 29)) * 0xbf58476d1ce4e5b9u;
        return key ^ (key >> 32);
    }

    std::vector<Neighbour> entries_;
    std::vector<std::uint8_t> counts_;
    std::vector<float> sq_radius_;
    float limit_;
};

}  // namespace ism::detail
