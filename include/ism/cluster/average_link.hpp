// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>

#include "ism/cluster/cluster_moments.hpp"
#include "ism/cluster/merge_trace.hpp"
#include "ism/cluster/reciprocal_merging.hpp"
#include "ism/core/error.hpp"
#include "ism/core/processor.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism {

/// @brief How far an agglomeration goes.
struct AverageLinkOptions {
    double max_sq_distance = std::numeric_limits<double>::infinity();  ///< merges beyond are left out
    std::size_t settled = 0;  ///< the first `settled` clusters are known to lie further apart than that from
                              ///< each other, as those that an earlier run left do: they are not compared
    InstructionSet isa = best_instruction_set();  ///< for tests: the merges are the same bits for each
};

/// @brief Average-link agglomerative clustering by squared Euclidean distance (the mean over all pairs of two
/// clusters' points), from clusters on: the dendrogram up to a distance. All reciprocal nearest neighbours of
/// a round are merged at once, which for average link gives the same clusters as merging the closest pair
/// again and again (Benzécri 1982; Leibe, Leonardis, Schiele 2008, appendix). At most O(N² d) time a round,
/// in practice little more than one search of all pairs; O(N d) memory. The same bits for any number
/// of threads and on every processor; among equal distances the choice is arbitrary.
/// @throws Error as check_moments() does, for a largest distance that is negative or NaN, and for more
/// settled clusters than there are, or an instruction set that the processor lacks.
[[nodiscard]] inline MergeTrace trace_average_link(const ClusterMoments& start,
                                                   const AverageLinkOptions& options, ThreadPool& pool) {
    check_moments(start);
    expect(options.max_sq_distance >= 0, "clustering: largest squared distance", "0 or more",
           options.max_sq_distance);
    expect(options.settled <= start.size(), "clustering: number of settled clusters",
           lazy_text("at most ", start.size()), options.settled);
    expect(has_instruction_set(options.isa), "clustering: instruction set", "one that the processor has",
           int(options.isa));
    return detail::ReciprocalMerging(start, options.max_sq_distance, options.settled, pool, options.isa)
        .run();
}

/// @brief The same on `threads` threads of its own; 0 = all hardware threads.
[[nodiscard]] inline MergeTrace trace_average_link(const ClusterMoments& start,
                                                   const AverageLinkOptions& options = {},
                                                   unsigned threads = 0) {
    ThreadPool pool(threads);
    return trace_average_link(start, options, pool);
}

}  // namespace ism
