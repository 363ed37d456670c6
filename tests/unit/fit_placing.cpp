// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/train/fit_placing.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "../support/catch.hpp"

#include "ism/core/geometry.hpp"
#include "ism/core/random.hpp"
#include "ism/model/placing.hpp"

namespace {

/// Objects of 100 × 50 pixels whose judged boxes are off by up to a tenth to any side. Masks end where the
/// objects do, but for the top, which is cut out anywhere, and the bottom, where they leave out a tenth.
std::vector<ism::PlacedBox> objects_with_masks(std::size_t count) {
    ism::Random random(5);
    std::vector<ism::PlacedBox> objects;
    for (std::size_t i = 0; i < count; ++i) {
        const ism::Box label{double(10 * i), 20, 100, 50};
        const auto off = [&] { return random.uniform(-0.1, 0.1); };
        const ism::Box judged{label.x + 100 * off(), label.y + 50 * off(), 100, 50};
        const double top = label.y + 50 * (0.5 + 2.5 * off());
        objects.push_back(
            {.judged = judged, .mask = {label.x, top, 100, label.y + 45 - top}, .label = label});
    }
    return objects;
}

}  // namespace

TEST_CASE("a side is placed between the judged box and the mask, and beyond") {
    const ism::Box judged{10, 20, 100, 50}, mask{20, 30, 60, 40};
    ism::Placing placing;
    placing.sides = {{{0, 0}, {1, 0}, {0.5, 0}, {1, 0.1}}};
    CHECK(placing.place(judged, mask) == ism::Box{10, 30, 85, 45});
    for (ism::Placing::Side& side : placing.sides) side = {.share = 1, .offset = 0};
    CHECK(placing.place(judged, mask) == mask);
    for (ism::Placing::Side& side : placing.sides) side.share = 0;
    CHECK(placing.place(judged, mask) == judged);
}

TEST_CASE("a box that overlaps its mask keeps an area wherever it is placed") {
    ism::Random random(3);
    std::size_t tried = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto box = [&] {
            return ism::Box{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1),
                            random.uniform(0, 1)};
        };
        const ism::Box judged = box(), mask = box();
        if (ism::iou(judged, mask) < 0.3) continue;
        ism::Placing placing;
        for (std::size_t k = 0; k < 4; ++k)
            placing.sides[k] = {.share = random.uniform() < 0.5 ? 0.0 : 1.0,
                                .offset = (k < 2 ? 1 : -1) * ism::most_placing_offset};
        const ism::Box there = placing.place(judged, mask);
        ++tried;
        CHECK(there.width > 0);
        CHECK(there.height > 0);
    }
    CHECK(tried > 100);
}

TEST_CASE("each side learns how far to follow the mask, and what masks leave out") {
    const auto objects = objects_with_masks(60);
    const ism::Placing placing = ism::fit_placing(objects);
    const auto& [left, top, right, bottom] = placing.sides;
    CHECK(left.share > 0.9);
    CHECK(right.share > 0.9);
    CHECK(std::abs(left.offset) < 0.01);
    CHECK(top.share < 0.1);  // the judged box knows better
    CHECK(bottom.share > 0.7);
    CHECK(bottom.offset > 0.05);
    double before = 0, by_mask = 0, after = 0;
    for (const auto& [judged, mask, label] : objects) {
        before += ism::iou(judged, label) / 60, by_mask += ism::iou(mask, label) / 60;
        after += ism::iou(placing.place(judged, mask), label) / 60;
    }
    CHECK(after > before + 0.05);
    CHECK(after > by_mask + 0.1);
}

TEST_CASE("a few masks that failed change little, and of few objects the usual way is kept") {
    CHECK(ism::fit_placing({}) == ism::Placing{});
    auto objects = objects_with_masks(60);
    for (std::size_t i = 0; i < objects.size(); i += 10) objects[i].mask = {objects[i].label.x, 20, 40, 50};
    CHECK(ism::fit_placing(objects).sides[2].share > 0.5);
    const auto one = objects_with_masks(1);
    for (const ism::Placing::Side& side : ism::fit_placing(one).sides) {
        CHECK(side.share == Approx(ism::Placing::Side{}.share).margin(0.4));
        CHECK(std::abs(side.offset) < 0.05);
    }
}
