// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/feature/row_sweep.hpp"

using ism::test::error_message;

TEST_CASE("a pool does every call once, loop after loop") {
    for (const unsigned threads : {1u, 2u, 3u, 5u}) {
        ism::ThreadPool pool(threads);
        REQUIRE(pool.size() == threads);
        for (const std::size_t count : {0, 1, 2, 7, 1000}) {
            std::vector<std::atomic<int>> calls(count);
            std::atomic<int> strangers = 0;
            pool.for_each(count, [&](std::size_t i, unsigned worker) {
                ++calls[i];
                strangers += worker < threads ? 0 : 1;
            });
            CHECK(std::all_of(calls.begin(), calls.end(), [](const auto& n) { return n == 1; }));
            CHECK(strangers == 0);
        }
    }
    CHECK(ism::ThreadPool(0).size() >= 1);
}

TEST_CASE("of several errors in a loop the first by number arrives, and the pool goes on") {
    for (const unsigned threads : {1u, 2u, 4u}) {
        ism::ThreadPool pool(threads);
        for (int again = 0; again < 20; ++again) {
            try {
                pool.for_each(100, [](std::size_t i, unsigned) {
                    if (i >= 3) throw std::runtime_error(std::to_string(i));
                });
                FAIL("no error arrived");
            } catch (const std::runtime_error& error) {
                CHECK(std::string(error.what()) == "3");
            }
        }
        std::atomic<int> calls = 0;
        pool.for_each(10, [&](std::size_t, unsigned) { ++calls; });
        CHECK(calls == 10);
    }
}

TEST_CASE("a loop within a loop of the same pool is refused, and so are too many threads") {
    for (const unsigned threads : {1u, 2u}) {
        ism::ThreadPool pool(threads);
        CHECK(error_message([&] {
                  pool.for_each(
                      2, [&](std::size_t, unsigned) { pool.for_each(1, [](std::size_t, unsigned) {}); });
              }) ==
              "thread pool: expected one loop at a time, got another, within a loop or of another thread");
        std::atomic<int> calls = 0;
        pool.for_each(10, [&](std::size_t, unsigned) { ++calls; });
        CHECK(calls == 10);
    }
    CHECK(error_message([] { ism::ThreadPool pool(1000000); }) ==
          "number of threads: expected at most 1024, got 1000000");
}

TEST_CASE("a sweep makes every row of every stage once, after the rows it needs") {
    for (const unsigned threads : {1u, 2u, 4u})
        for (const int height : {1, 8, 37, 160, 401})
            for (const std::vector<int>& reach :
                 {std::vector{0, 5, 4, 6, 10, 6}, {0, 0, 0}, {3}, {0, 1, 30}}) {
                CAPTURE(threads, height, reach.size());
                ism::ThreadPool pool(threads);
                const std::size_t stages = reach.size();
                std::vector<std::vector<std::atomic<int>>> made(stages);
                for (auto& stage : made) stage = std::vector<std::atomic<int>>(std::size_t(height));
                std::atomic<int> early = 0;
                ism::detail::sweep_rows(
                    pool, 0, height, height, std::span(reach),
                    [&](std::size_t stage, int first, int end, unsigned) {
                        for (int y = first; y < end; ++y) {
                            for (int t = -reach[stage]; stage > 0 && t <= reach[stage]; ++t)
                                if (y + t >= 0 && y + t < height)
                                    early += made[stage - 1][std::size_t(y + t)] == 0 ? 1 : 0;
                            ++made[stage][std::size_t(y)];
                        }
                    });
                CHECK(early == 0);
                for (const auto& stage : made)
                    CHECK(std::all_of(stage.begin(), stage.end(), [](const auto& n) { return n == 1; }));
            }
}
