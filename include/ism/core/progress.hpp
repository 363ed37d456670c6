// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <mutex>
#include <string_view>

#include "ism/core/function.hpp"

namespace ism {

/// @brief Progress callback for long-running work: what is being done, how much of it is done, how much there
/// is. May be called from any thread, one call at a time.
using Progress = Function<void(std::string_view stage, std::size_t done, std::size_t total)>;

/// @brief Counts the steps of a stage for a progress callback, from several threads.
class ProgressCounter {
public:
    /// @param stage  has to stay as long as this
    ProgressCounter(const Progress& progress, std::string_view stage, std::size_t total)
        : progress_(progress), stage_(stage), total_(total) {}

    void step() {
        if (!progress_) return;
        const std::lock_guard lock(mutex_);
        progress_(stage_, ++done_, total_);
    }

private:
    const Progress& progress_;
    std::string_view stage_;
    std::size_t done_ = 0, total_;
    std::mutex mutex_;
};

}  // namespace ism
