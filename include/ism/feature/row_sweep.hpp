// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ism/core/thread_pool.hpp"

namespace ism::detail {

inline constexpr std::size_t most_stages = 40;

/// Calls `make(stage, first, end, worker)` until it was asked for all rows 0 … height − 1 of every stage,
/// where a row of a stage needs the rows up to reach[stage] above and below it of the stage before. The
/// stages follow each other at short distance, so that rows are used while they are in the cache. Every
/// member of the pool gets a band of rows; what depends on two bands comes last.
template <std::invocable<std::size_t, int, int, unsigned> Make>
void sweep_rows(ThreadPool& pool, int height, std::span<const int> reach, const Make& make) {
    constexpr int rows_at_once = 16, rows_of_gap = 8;
    std::array<int, most_stages> lag;  // rows that a stage stays behind the edge of its band
    int total = 0;
    for (std::size_t stage = 0; stage < reach.size(); ++stage) lag[stage] = total += reach[stage];

    const int bands = std::clamp(height / (3 * total + 1), 1, int(pool.size()));
    const auto edge = [&](int band) { return int(std::int64_t(height) * band / bands); };
    pool.for_each(std::size_t(bands), [&](std::size_t band, unsigned worker) {
        const int begin = edge(int(band)), end = edge(int(band) + 1);
        std::array<int, most_stages> done;
        for (std::size_t stage = 0; stage < reach.size(); ++stage)
            done[stage] = begin > 0 ? begin + lag[stage] : 0;
        for (int row = begin + rows_at_once;; row += rows_at_once) {
            for (std::size_t stage = 0; stage < reach.size(); ++stage) {
                const int last = end < height ? end - lag[stage] : height;
                const int next = row < end ? std::min(row - lag[stage], last) : last;
                if (next <= done[stage]) continue;
                make(stage, done[stage], next, worker);
                done[stage] = next;
            }
            if (row >= end) break;
        }
    });
    for (std::size_t stage = 0; bands > 1 && stage < reach.size(); ++stage) {
        const int parts = (2 * lag[stage] + rows_of_gap - 1) / rows_of_gap;
        pool.for_each(std::size_t(parts * (bands - 1)), [&](std::size_t task, unsigned worker) {
            const int middle = edge(int(task) / parts + 1);
            const int first = middle - lag[stage] + int(task) % parts * rows_of_gap;
            make(stage, first, std::min(first + rows_of_gap, middle + lag[stage]), worker);
        });
    }
}

}  // namespace ism::detail
