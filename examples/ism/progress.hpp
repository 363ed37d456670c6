// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>

#include <unistd.h>

namespace program {

/// Seconds since it was made.
class Stopwatch {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }

private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// A line on stderr that tells how far a work is, how fast it goes and how long it will take; nothing where
/// stderr is no terminal. May be told from several threads; the line goes away with the object.
class ProgressLine {
public:
    ProgressLine() = default;
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// One more of `total` is done.
    void step(std::string_view stage, std::size_t total) {
        const std::lock_guard lock(mutex_);
        show(stage, ++done_, total);
    }

    /// `done` of `total` are done.
    void tell(std::string_view stage, std::size_t done, std::size_t total) {
        const std::lock_guard lock(mutex_);
        show(stage, done, total);
    }

    /// Takes the line away; print to the terminal only then.
    void clear() {
        const std::lock_guard lock(mutex_);
        if (shown_) std::fputs("\r\033[K", stderr);
        shown_ = false;
    }

private:
    void show(std::string_view stage, std::size_t done, std::size_t total) {
        if (!terminal_) return;
        if (stage != stage_ || done < shown_done_) stage_ = stage, stage_watch_ = {}, last_ = -1;
        shown_done_ = done;
        const double seconds = stage_watch_.seconds();
        if (seconds - last_ < 0.1 && done != total) return;
        last_ = seconds;
        const double rate = double(done) / (seconds + 1e-9);
        std::fprintf(stderr, "\r\033[K%s %zu/%zu", stage_.c_str(), done, total);
        if (seconds > 0.5) std::fprintf(stderr, ", %.1f/s, %.0f s left", rate, double(total - done) / rate);
        std::fflush(stderr);
        shown_ = true;
    }

    bool terminal_ = isatty(STDERR_FILENO) != 0, shown_ = false;
    std::mutex mutex_;
    std::string stage_;
    Stopwatch stage_watch_;
    double last_ = -1;
    std::size_t done_ = 0;        // by step()
    std::size_t shown_done_ = 0;  // when last told; less than that is a stage that begins anew
};

}  // namespace program
