// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>

#include "support/catch.hpp"

#include "ism/core/geometry.hpp"
#include "ism/core/random.hpp"

TEST_CASE("the centre of a box is that of its pixels, and box_around() is its reverse") {
    CHECK(ism::Box{3, 4, 1, 1}.centre() == ism::Point2{3, 4});  // one pixel
    CHECK(ism::Box{0, 0, 2, 4}.centre() == ism::Point2{0.5, 1.5});
    CHECK(ism::Box{1, 2, 3, 5}.area() == 15);
    for (const ism::Box& box : {ism::Box{3, 4, 1, 1}, {-2.5, 7, 10, 3.25}, {100, 50, 0, 0}})
        CHECK(ism::box_around(box.centre(), box.width, box.height) == box);
}

TEST_CASE("intersection and IoU of boxes") {
    const ism::Box a{0, 0, 10, 10}, b{5, 2, 10, 4};
    CHECK(ism::intersection(a, b) == ism::Box{5, 2, 5, 4});
    CHECK(ism::iou(a, b) == Approx(20.0 / (100 + 40 - 20)));
    CHECK(ism::iou(a, a) == 1);
    CHECK(ism::iou(a, {2, 2, 5, 2}) == Approx(0.1));  // one within the other
    // side by side, at a corner, apart
    for (const ism::Box& other : {ism::Box{10, 0, 10, 10}, {10, 10, 5, 5}, {-30, 4, 2, 2}}) {
        CHECK(ism::intersection(a, other).area() == 0);
        CHECK(ism::iou(a, other) == 0);
    }
    CHECK(ism::iou({1, 1, 0, 0}, {1, 1, 0, 0}) == 0);
}

TEST_CASE("IoU of boxes of whole pixels is that of their masks, whichever comes first") {
    ism::Random random(8);
    const auto any = [&](int from, int to) { return double(int(random.uniform(from, to))); };
    for (int round = 0; round < 50; ++round) {
        std::array<ism::Box, 2> box;
        std::array<ism::Mask, 2> mask{ism::Mask(20, 20), ism::Mask(20, 20)};
        for (std::size_t i = 0; i < 2; ++i) {
            box[i] = {any(0, 10), any(0, 10), any(1, 10), any(1, 10)};
            for (int y = 0; y < int(box[i].height); ++y)
                for (int x = 0; x < int(box[i].width); ++x)
                    mask[i](int(box[i].x) + x, int(box[i].y) + y) = 200;
            CHECK(ism::mask_box(mask[i]) == box[i]);
            CHECK(double(ism::mask_area(mask[i])) == box[i].area());
        }
        CHECK(ism::iou(box[0], box[1]) == Approx(ism::mask_iou(mask[0], mask[1])));
        CHECK(ism::iou(box[0], box[1]) == ism::iou(box[1], box[0]));
    }
}

TEST_CASE("boxes and overlap of masks, up to the border of the image") {
    ism::Mask mask(7, 5);
    CHECK(ism::mask_box(mask).area() == 0);
    CHECK(ism::mask_area(mask) == 0);
    CHECK(ism::mask_iou(mask, mask) == 0);
    mask(6, 4) = 1;
    CHECK(ism::mask_box(mask) == ism::Box{6, 4, 1, 1});
    mask(0, 0) = 255;
    CHECK(ism::mask_box(mask) == ism::Box{0, 0, 7, 5});
    CHECK(ism::mask_area(mask) == 2);
    ism::Mask other(7, 5);
    other(6, 4) = 9, other(5, 4) = 9, other(4, 4) = 9;
    CHECK(ism::mask_iou(mask, other) == Approx(1.0 / 4));
    CHECK_THROWS_WITH(ism::mask_iou(mask, ism::Mask(5, 7)), "mask size: expected 7x5, got 5x7");
}
