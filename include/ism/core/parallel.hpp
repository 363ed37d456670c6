// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace ism {

/// @brief The number of threads meant by `threads`: itself, or as many as the machine has for 0.
[[nodiscard]] inline unsigned thread_count(unsigned threads) {
    return threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
}

/// @brief Calls `body(i)` for each i in [0, count), on up to `threads` threads (0 = all the machine has).
/// Which thread does which i is open, so a body may write only what belongs to its i; the result is then
/// the same for any number of threads.
/// @throws whatever `body` throws for the smallest i that throws; the calls not yet begun are dropped.
template <std::invocable<std::size_t> Body>
void parallel_for(std::size_t count, unsigned threads, Body&& body) {
    const std::size_t workers = std::min<std::size_t>(thread_count(threads), count);
    if (workers <= 1) {
        for (std::size_t i = 0; i < count; ++i) body(i);
        return;
    }
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::exception_ptr error;
    std::size_t error_at = count;
    const auto work = [&] {
        for (std::size_t i = next++; i < count; i = next++) {
            try {
                body(i);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (i < error_at) error_at = i, error = std::current_exception();
                next = count;
            }
        }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < workers; ++i) others.emplace_back(work);
        work();
    }
    if (error) std::rethrow_exception(error);
}

}  // namespace ism
