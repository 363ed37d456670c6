// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../support/catch.hpp"

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/mask_pieces.hpp"
#include "ism/core/random.hpp"

namespace {

/// The same, pixel after pixel from neighbour to neighbour.
ism::Mask without_specks_by_filling(ism::Mask mask, double share) {
    std::vector<std::vector<std::pair<int, int>>> pieces;
    ism::Mask left = mask;
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) {
            if (left(x, y) == 0) continue;
            std::vector<std::pair<int, int>> piece{{x, y}};
            left(x, y) = 0;
            for (std::size_t i = 0; i < piece.size(); ++i)
                for (const auto& [right, down] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                    const int px = piece[i].first + right, py = piece[i].second + down;
                    if (!left.contains(px, py) || left(px, py) == 0) continue;
                    left(px, py) = 0;
                    piece.push_back({px, py});
                }
            pieces.push_back(piece);
        }
    std::size_t largest = 0;
    for (const auto& piece : pieces) largest = std::max(largest, piece.size());
    for (const auto& piece : pieces)
        if (double(piece.size()) < share * double(largest))
            for (const auto& [x, y] : piece) mask(x, y) = 0;
    return mask;
}

}  // namespace

TEST_CASE("specks are left out of a mask, pieces that are large enough are not") {
    ism::Mask mask(12, 5);
    for (int x = 0; x < 10; ++x) mask(x, 1) = 1;  // ten pixels
    mask(11, 1) = 1;                              // one beside them
    mask(0, 2) = mask(0, 3) = 1;                  // two more of the first piece
    mask(10, 2) = 1;                              // touches both by a corner alone
    mask(5, 4) = mask(6, 4) = 7;                  // two below
    ism::Mask expected = mask;
    expected(11, 1) = expected(10, 2) = 0;
    CHECK(ism::without_specks(mask, 0.1) == expected);
    CHECK(ism::without_specks(mask, 1.0 / 12) == mask);
    expected(5, 4) = expected(6, 4) = 0;
    CHECK(ism::without_specks(mask, 0.2) == expected);
    CHECK(ism::without_specks(mask, 1) == expected);
    CHECK(ism::without_specks(mask, 0) == mask);
}

TEST_CASE("pieces of random masks are those that filling finds") {
    ism::Random random(11);
    for (const double density : {0.0, 0.3, 0.55, 0.65, 0.9, 1.0})
        for (const auto& [width, height] : {std::pair{1, 1}, {1, 30}, {30, 1}, {31, 23}, {64, 50}}) {
            CAPTURE(density, width, height);
            ism::Mask mask(width, height);
            for (std::uint8_t& pixel : mask.pixels()) pixel = random.uniform() < density;
            for (const double share : {0.02, 0.3, 1.0})
                CHECK(ism::without_specks(mask, share) == without_specks_by_filling(mask, share));
        }
    CHECK(ism::without_specks(ism::Mask(), 0.5).empty());
}
