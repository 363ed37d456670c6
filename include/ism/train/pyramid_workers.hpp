// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "ism/core/callable.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/hog_pyramid.hpp"

namespace ism {

/// @brief Threads that describe one image after another, each in the memory of its last: pyramids are large.
class PyramidWorkers {
public:
    /// @param threads  0 = all hardware threads
    /// @throws Error for more than max_threads.
    explicit PyramidWorkers(unsigned threads = 0) : pool_(threads), pyramids_(pool_.size()) {}

    [[nodiscard]] ThreadPool& pool() { return pool_; }
    /// @brief Calls `body(i, pyramid)` for each i in [0, count), where the pyramid is of another image.
    /// @throws as ThreadPool::for_each()
    template <Callable<std::size_t, HogPyramid&> Body>
    void for_each(std::size_t count, const Body& body) {
        pool_.for_each(count, [&](std::size_t i, unsigned worker) { body(i, pyramids_[worker]); });
    }

private:
    ThreadPool pool_;
    std::vector<HogPyramid> pyramids_;
};

}  // namespace ism
