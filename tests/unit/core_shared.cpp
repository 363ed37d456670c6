// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/function.hpp"
#include "ism/core/shared.hpp"

namespace {

struct Counted {
    explicit Counted(int& counter) : alive(counter) { ++alive; }
    Counted(const Counted&) = delete;
    ~Counted() { --alive; }
    int& alive;
};

struct Unknown;  // complete further below
struct Holder {
    ism::Shared<Unknown> value;
};

}  // namespace

TEST_CASE("copies share a value, and the last of them deletes it") {
    int alive = 0;
    ism::Shared<Counted> first = ism::Shared<Counted>::make(alive);
    CHECK(alive == 1);
    ism::Shared<Counted> second = first, moved = std::move(first);
    CHECK(!first);
    CHECK(first.get() == nullptr);
    CHECK(second.get() == moved.get());
    second = ism::Shared<Counted>();
    CHECK(alive == 1);
    const auto& same = moved;
    moved = same;
    CHECK(alive == 1);
    CHECK(&moved->alive == &alive);
    moved = ism::Shared<Counted>::make(alive);
    CHECK(alive == 1);
    moved = {};
    CHECK(alive == 0);
}

TEST_CASE("of a shared value the type may be void, constant or unknown as yet") {
    int alive = 0;
    {
        const auto any = ism::Shared<void>::make<Counted>(alive);
        const ism::Shared<void> copy = any;
        CHECK(static_cast<Counted*>(copy.get())->alive == 1);
    }
    CHECK(alive == 0);
    const auto text = ism::Shared<const std::string>::make("word");
    CHECK(*text == "word");
    const Holder none;
    CHECK(!none.value);
}

TEST_CASE("a shared value is deleted once when threads drop their copies") {
    int alive = 0;
    auto value = ism::Shared<Counted>::make(alive);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([copy = value] {
            for (int i = 0; i < 1000; ++i) const ism::Shared<Counted> again = copy;
        });
    value = {};
    for (std::thread& thread : threads) thread.join();
    threads.clear();
    CHECK(alive == 0);
}

namespace {
struct Unknown {
    int number = 3;
};
}  // namespace

TEST_CASE("who holds a shared value need not know its type") {
    const Holder holder{ism::Shared<Unknown>::make()};
    const Holder copy = holder;
    CHECK(copy.value->number == 3);
}

TEST_CASE("a function that was moved away is none, and says so when it is called") {
    ism::Function<int(int)> twice = [](int value) { return 2 * value; };
    const ism::Function<int(int)> moved = std::move(twice);
    CHECK(moved(4) == 8);
    CHECK(bool(moved));
    CHECK_FALSE(bool(twice));
    CHECK_THROWS_WITH(twice(4), "function: expected one to call, got none");
}
