// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <thread>  // has the clocks; <chrono> would bring calendars and streams with them, 8 MB to compile
#include <utility>

#include "ism/config.hpp"

namespace ism {

/// @brief Measures how long the parts of a piece of work take.
class Stopwatch {
public:
    /// @brief Milliseconds since the last lap, or since this was made.
    double lap_ms() {
        const auto before = std::exchange(last_, std::chrono::steady_clock::now());
        return std::chrono::duration<double, std::milli>(last_ - before).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace ism
