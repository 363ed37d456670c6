// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace ism {

/// @brief The number of threads meant by `threads`: itself, or as many as the machine has for 0.
[[nodiscard]] inline unsigned thread_count(unsigned threads) {
    return threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
}

/// @brief Threads that stay and wait for the next loop: for many short loops one after another, a frame's
/// say. One loop at a time, and none from within another.
class Team {
public:
    /// @brief A team of so many threads, the caller's among them (0 = all the machine has). They start with
    /// the first loop that has work for them.
    explicit Team(unsigned threads = 1) : size_(thread_count(threads)) {}
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;
    ~Team() {
        if (others_.empty()) return;
        call_ = nullptr;
        round_.fetch_add(1);
        round_.notify_all();
        others_.clear();  // joins
    }

    [[nodiscard]] unsigned size() const { return size_; }

    /// @brief Calls `body(i, worker)` for each i in [0, count), worker < size() being the number of the
    /// thread that does it. Which one that is is open, so a body may write only what belongs to its i, and
    /// what belongs to its worker for as long as it runs; the result is then the same for any team.
    /// @throws whatever `body` throws for the smallest i that throws; the calls not yet begun are dropped.
    template <std::invocable<std::size_t, unsigned> Body>
    void each(std::size_t count, const Body& body) {
        if (size_ == 1 || count <= 1) {
            for (std::size_t i = 0; i < count; ++i) body(i, 0u);
            return;
        }
        call_ = [](const void* what, std::size_t i, unsigned worker) {
            (*static_cast<const Body*>(what))(i, worker);
        };
        body_ = &body;
        count_ = count;
        next_ = 0;
        error_ = nullptr;
        error_at_ = count;
        working_ = size_ - 1;
        if (others_.empty())
            for (unsigned worker = 1; worker < size_; ++worker)
                others_.emplace_back([this, worker, round = round_.load()] { serve(worker, round); });
        round_.fetch_add(1);
        round_.notify_all();
        work(0);
        for (unsigned left = working_; left != 0; left = working_) wait_while(working_, left);
        if (error_) std::rethrow_exception(error_);
    }

private:
    /// Loops follow each other closely: looks a while before it sleeps.
    static void wait_while(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
        for (int look = 0; look < 50000; ++look)
            if (value.load() != old) return;
        value.wait(old);
    }

    void serve(unsigned worker, std::uint32_t round) {
        while (true) {
            wait_while(round_, round);
            if (round_.load() == round) continue;
            ++round;
            if (call_ == nullptr) return;
            work(worker);
            if (working_.fetch_sub(1) == 1) working_.notify_one();
        }
    }

    void work(unsigned worker) {
        for (std::size_t i = next_++; i < count_; i = next_++) {
            try {
                call_(body_, i, worker);
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (i < error_at_) error_at_ = i, error_ = std::current_exception();
                next_ = count_;
            }
        }
    }

    unsigned size_;
    void (*call_)(const void*, std::size_t, unsigned) = nullptr;
    const void* body_ = nullptr;
    std::size_t count_ = 0, error_at_ = 0;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<std::uint32_t> round_ = 0, working_ = 0;
    std::mutex mutex_;
    std::exception_ptr error_;
    std::vector<std::jthread> others_;
};

/// @brief Calls `body(i)` for each i in [0, count), on up to `threads` threads (0 = all the machine has), as
/// Team::each() does.
/// @throws whatever `body` throws for the smallest i that throws; the calls not yet begun are dropped.
template <std::invocable<std::size_t> Body>
void parallel_for(std::size_t count, unsigned threads, const Body& body) {
    Team team(unsigned(std::min<std::size_t>(thread_count(threads), std::max<std::size_t>(1, count))));
    team.each(count, [&](std::size_t i, unsigned) { body(i); });
}

}  // namespace ism
