// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/core/box_check.hpp"

#include <limits>

#include "support/catch.hpp"
#include "support/files.hpp"

using ism::test::error_message;

namespace {

// In an image of 40×20.
std::string message(const ism::Box& box) {
    return error_message([&] { ism::check_labelled_box(box, 40, 20); });
}

const std::string no_error = "nothing thrown";

}  // namespace

TEST_CASE("Labelled boxes are taken up to their limits, and none beyond") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = 1 / 0.0;
    CHECK(message({3, 4, 10, 12}) == no_error);
    CHECK(message({nan, 4, 1, 1}) == "box: expected finite numbers, got nan, 4, 1, 1");
    CHECK(message({3, -inf, 1, 1}) == "box: expected finite numbers, got 3, -inf, 1, 1");
    CHECK(message({3, 4, inf, 1}) == "box: expected finite numbers, got 3, 4, inf, 1");
    CHECK(message({3, 4, 1, nan}) == "box: expected finite numbers, got 3, 4, 1, nan");

    CHECK(message({3, 4, 0.1, 1}) == no_error);
    CHECK(message({3, 4, 0.09, 1}) == "box: expected sides of 0.1 to 400 pixels, got 0.09x1");
    CHECK(message({3, 4, 1, 0}) == "box: expected sides of 0.1 to 400 pixels, got 1x0");
    CHECK(message({3, 4, -2, -2}) == "box: expected sides of 0.1 to 400 pixels, got -2x-2");
    CHECK(message({3, 4, 7, 400}) == no_error);
    CHECK(message({3, 4, 7, 401}) == "box: expected sides of 0.1 to 400 pixels, got 7x401");

    CHECK(message({3, 4, 250, 0.25}) == no_error);
    CHECK(message({3, 4, 0.25, 251}) == "box: expected one side at most 1000 times the other, got 0.25x251");

    CHECK(message({-9, 4, 10, 5}) == no_error);
    CHECK(message({39, 19, 10, 5}) == no_error);
    for (const ism::Box& outside : {ism::Box{-10, 4, 10, 5}, {40, 4, 10, 5}, {3, -5, 10, 5}, {3, 20, 10, 5}})
        CHECK(message(outside).starts_with("box: expected a part in the image of 40x20, got "));
}
