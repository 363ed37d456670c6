// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

#include "ism/core/callable.hpp"
#include "ism/core/error.hpp"

namespace ism {

/// @brief The largest number of threads that can be asked for.
inline constexpr unsigned max_threads = 1024;

/// @brief Resolves a thread count: 0 means all hardware threads.
/// @throws Error for more than max_threads.
[[nodiscard]] inline unsigned thread_count(unsigned threads) {
    expect(threads <= max_threads, "number of threads", lazy_text("at most ", max_threads), threads);
    return threads > 0 ? threads : std::clamp(std::thread::hardware_concurrency(), 1u, max_threads);
}

/// @brief Threads that wait for the next loop: for many short loops in a row, as those of a frame. One loop
/// runs at a time.
class ThreadPool {
public:
    /// @brief A pool of `threads` threads, the calling one included (0 = all hardware threads). They start
    /// with the first loop that has work for them.
    /// @throws Error for more than max_threads.
    explicit ThreadPool(unsigned threads = 1)
        : size_(thread_count(threads)), failures_(size_), others_(size_ - 1) {}
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;
    ~ThreadPool() {
        if (others_.empty()) return;
        call_ = nullptr;
        round_.fetch_add(1);
        round_.notify_all();
        for (std::thread& other : others_)
            if (other.joinable()) other.join();
    }

    [[nodiscard]] unsigned size() const { return size_; }

    /// @brief Calls `body(i, worker)` for each i in [0, count), where worker < size() numbers the thread that
    /// makes the call. Threads take indices as they come, so a body may write only what belongs to its i, or
    /// to its worker for the duration of the call; then the result is the same for any number of threads.
    /// @throws whatever `body` throws for the smallest i that throws; calls not yet begun are dropped. Error
    /// where a loop of this pool is running already, or the system has no more threads.
    template <Callable<std::size_t, unsigned> Body>
    void for_each(std::size_t count, const Body& body) {
        run(
            count,
            [](const void* what, std::size_t i, unsigned worker) {
                (*static_cast<const Body*>(what))(i, worker);
            },
            &body);
    }

private:
    using Call = void(const void* body, std::size_t i, unsigned worker);
    struct Failure {
        std::size_t at = 0;
        std::exception_ptr error = nullptr;
    };

    /// Marks the pool as running, for as long as it lives.
    class Running {
    public:
        explicit Running(std::atomic<bool>& running) : running_(running) {
            expect(!running_.exchange(true), "thread pool", "one loop at a time",
                   "another, within a loop or of another thread");
        }
        Running(const Running&) = delete;
        Running& operator=(const Running&) = delete;
        ~Running() { running_ = false; }

    private:
        std::atomic<bool>& running_;
    };

    void run(std::size_t count, Call* call, const void* body) {
        const Running running(running_);
        if (size_ == 1 || count <= 1) {
            for (std::size_t i = 0; i < count; ++i) call(body, i, 0);
            return;
        }
        call_ = call;
        body_ = body;
        count_ = count;
        next_ = 0;
        for (unsigned worker = 1; worker < size_; ++worker)
            if (!others_[worker - 1].joinable()) start(worker);
        working_ = size_ - 1;
        round_.fetch_add(1);
        round_.notify_all();
        work(0);
        for (unsigned left = working_; left != 0; left = working_) wait_while(working_, left);
        rethrow_first();
    }

    void start(unsigned worker) {
        try {
            others_[worker - 1] =
                std::thread([this, worker, round = round_.load()] { serve(worker, round); });
        } catch (const std::system_error& error) {
            throw Error(join_text("threads: expected the system to give ", size_, ", got ", worker, " (",
                                  error.what(), ")"));
        }
    }

    /// Loops follow each other closely: spins for some microseconds before it sleeps.
    static void wait_while(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
        for (int spin = 0; spin < 50000; ++spin)
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
                failures_[worker] = {i, std::current_exception()};
                next_ = count_;
            }
        }
    }

    /// Throws what was thrown for the smallest index, if anything was.
    void rethrow_first() {
        const Failure* first = nullptr;
        for (const Failure& failure : failures_)
            if (failure.error && (first == nullptr || failure.at < first->at)) first = &failure;
        if (first == nullptr) return;
        const std::exception_ptr error = first->error;
        for (Failure& failure : failures_) failure.error = nullptr;
        std::rethrow_exception(error);
    }

    unsigned size_;
    Call* call_ = nullptr;
    const void* body_ = nullptr;
    std::size_t count_ = 0;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<std::uint32_t> round_ = 0, working_ = 0;
    std::atomic<bool> running_ = false;
    std::vector<Failure> failures_;  // what each worker threw; it takes no more of that loop
    std::vector<std::thread> others_;
};

/// @brief Calls `body(i)` for each i in [0, count) on up to `threads` threads (0 = all hardware threads), as
/// ThreadPool::for_each() does.
/// @throws as ThreadPool::for_each() does.
template <Callable<std::size_t> Body>
void parallel_for(std::size_t count, unsigned threads, const Body& body) {
    ThreadPool pool(unsigned(std::min<std::size_t>(thread_count(threads), std::max<std::size_t>(1, count))));
    pool.for_each(count, [&](std::size_t i, unsigned) { body(i); });
}

}  // namespace ism
