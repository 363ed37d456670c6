// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ism/core/callable.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism::detail {

inline constexpr std::size_t most_stages = 40;

/// Calls make(stage, first, end, worker) for the rows that each stage can make once the rows up to end − 1
/// are given, beyond those it could make when the rows up to begin − 1 were; of `height` rows in all. A row
/// of a stage needs the rows up to reach[stage] above and below it of the stage before: a stage lags behind
/// by the sum of the reaches so far, and has all rows where end = height. The stages follow each other at
/// short distance, so that rows are used while they are in the cache. Every thread of the pool gets a band of
/// rows; what depends on two bands comes last.
template <Callable<std::size_t, int, int, unsigned> Make>
void sweep_rows(ThreadPool& pool, int begin, int end, int height, std::span<const int> reach,
                const Make& make) {
    constexpr int rows_at_once = 16, rows_of_gap = 8;
    std::array<int, most_stages> lag;  // rows that a stage stays behind the edge of its band
    int total = 0;
    for (std::size_t stage = 0; stage < reach.size(); ++stage) lag[stage] = total += reach[stage];

    const int bands = std::clamp((end - begin) / (3 * total + 1), 1, int(pool.size()));
    const auto edge = [&](int band) { return begin + int(std::int64_t(end - begin) * band / bands); };
    pool.for_each(std::size_t(bands), [&](std::size_t band, unsigned worker) {
        const int top = edge(int(band)), bottom = edge(int(band) + 1);
        std::array<int, most_stages> done;
        for (std::size_t stage = 0; stage < reach.size(); ++stage)
            done[stage] = band > 0 ? top + lag[stage] : std::max(0, top - lag[stage]);
        for (int row = top + rows_at_once;; row += rows_at_once) {
            for (std::size_t stage = 0; stage < reach.size(); ++stage) {
                const int last = bottom < height ? bottom - lag[stage] : height;
                const int next = row < bottom ? std::min(row - lag[stage], last) : last;
                if (next <= done[stage]) continue;
                make(stage, done[stage], next, worker);
                done[stage] = next;
            }
            if (row >= bottom) break;
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
