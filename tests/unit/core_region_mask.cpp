// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/core/region_mask.hpp"

namespace {

ism::Mask random_whole_mask(ism::Random& random) {
    ism::Mask mask(30, 20);
    const int left = int(random.index(20)), top = int(random.index(12));
    const double share = random.uniform(0.1, 1);
    for (int y = top; y < top + 1 + int(random.index(8)); ++y)
        for (int x = left; x < left + 1 + int(random.index(10)); ++x)
            mask(x, y) = random.uniform() < share ? 255 : 0;
    return mask;
}

}  // namespace

TEST_CASE("regions overlap as the whole masks do") {
    ism::Random random(2);
    int met = 0;
    for (int round = 0; round < 300; ++round) {
        const ism::Mask whole_a = random_whole_mask(random), whole_b = random_whole_mask(random);
        const ism::RegionMask a = ism::region_of(whole_a), b = ism::region_of(whole_b);
        CHECK(area_of(a) == mask_area(whole_a));
        CHECK(mask_iou(full_mask(a, 30, 20), whole_a) == (area_of(a) > 0 ? 1 : 0));
        if (area_of(a) > 0) CHECK(box_of(a) == mask_box(whole_a));
        CHECK(iou(a, b) == mask_iou(whole_a, whole_b));
        CHECK(intersection_area(a, b) == intersection_area(b, a));
        std::size_t common = 0;
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 30; ++x) {
                CHECK(contains(a, x, y) == (whole_a(x, y) != 0));
                common += contains(a, x, y) && contains(b, x, y);
            }
        CHECK(intersection_area(a, b) == common);
        met += common > 0;
    }
    CHECK(met > 10);
}

TEST_CASE("a region may be empty, of a part of an image, or reach outside it") {
    const ism::RegionMask none, square{4, 5, ism::Mask(2, 2, 1)};
    CHECK(ism::region_of(ism::Mask(5, 5)) == none);
    CHECK(iou(none, none) == 0);
    CHECK(intersection_area(none, square) == 0);
    CHECK(ism::region_of(ism::Mask(2, 2, 255), 4, 5) == square);
    CHECK(ism::mask_area(ism::full_mask(square, 5, 6)) == 1);
    CHECK(ism::mask_area(ism::full_mask({-1, -1, ism::Mask(2, 2, 1)}, 5, 6)) == 1);
    CHECK(ism::mask_area(ism::full_mask({-9, 9, ism::Mask(2, 2, 1)}, 5, 6)) == 0);
    CHECK(!contains(square, -1, -1));
}
