// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <vector>

#include "support/catch.hpp"
#include "support/depth_scene.hpp"

#include "ism/depth/region_outline.hpp"

namespace {

using depth_scene::Shape;
using depth_scene::Table;

struct Outlined {
    depth_scene::Picture picture;
    ism::Surface surface;
    explicit Outlined(const std::vector<Shape>& shapes) : picture(depth_scene::render(shapes)) {
        ism::ThreadPool pool(1);
        surface = surface_of(picture.depth_m, depth_scene::camera, pool);
    }
    [[nodiscard]] ism::RegionOutline of(const ism::RegionMask& region) const {
        return region_outline(surface, region);
    }
};

/// The left half of a region.
ism::RegionMask left_half(const ism::RegionMask& region) {
    ism::Mask mask(region.mask.width() / 2, region.mask.height());
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) mask(x, y) = region.mask(x, y);
    return region_of(mask, region.x, region.y);
}

}  // namespace

TEST_CASE("a whole object on a table ends at its outline, a part of it goes on") {
    const Table table;
    const Outlined seen({table.plane(), table.block(0, 0, {0.2f, 0.2f, 0.2f})});
    const ism::RegionMask& block = seen.picture.regions[1];
    const ism::RegionOutline whole = seen.of(block);
    CHECK(whole.continued < 0.05);  // it rests on the table along a concave edge
    CHECK(whole.hidden < 0.01);
    CHECK(whole.broken == 0);
    const ism::RegionOutline half = seen.of(left_half(block));
    CHECK(half.continued > 0.2);
    CHECK(half.continued < 0.6);
    CHECK(half.hidden < 0.01);
    // A piece of the table goes on all around.
    const ism::RegionOutline piece = seen.of({20, 400, ism::Mask(40, 30, 1)});
    CHECK(piece.continued > 0.99);
    CHECK(piece.broken == 0);
}

TEST_CASE("what stands in front hides a part of the outline, and a step in depth breaks a region") {
    const Table table;
    const Outlined seen({table.plane(), table.block(0, 0.1f, {0.3f, 0.1f, 0.2f}),
                         table.block(0.05f, -0.25f, {0.1f, 0.1f, 0.25f})});
    const ism::RegionMask &behind = seen.picture.regions[1], &front = seen.picture.regions[2];
    CHECK(seen.of(behind).hidden > 0.1);
    CHECK(seen.of(behind).broken < 0.01);
    CHECK(seen.of(front).hidden < 0.01);
    ism::Mask both = full_mask(behind, depth_scene::width, depth_scene::height);
    for (int y = 0; y < depth_scene::height; ++y)
        for (int x = 0; x < depth_scene::width; ++x) both(x, y) |= contains(front, x, y);
    CHECK(seen.of(region_of(both)).broken > seen.of(behind).broken + 0.001);
}

TEST_CASE("an outline of which nothing is known has no shares") {
    const Outlined seen({depth_scene::Block{{0, 0, 1}, {0.2f, 0.2f, 0.05f}}});
    const auto is_nothing = [](const ism::RegionOutline& o) {
        return o.continued == 0 && o.hidden == 0 && o.broken == 0;
    };
    CHECK(is_nothing(seen.of({})));
    CHECK_THROWS_WITH(seen.of({630, 470, ism::Mask(20, 20, 1)}),
                      "region_outline: region: expected within 640x480, got 20x20 at 630, 470");
    CHECK_THROWS_AS(seen.of({-3, 0, ism::Mask(20, 20, 1)}), ism::Error);
    CHECK(is_nothing(seen.of({5, 5, ism::Mask(20, 20, 1)})));  // no readings
    CHECK(is_nothing(seen.of(seen.picture.regions[0])));       // none around
    // The whole image has no outside.
    const Outlined wall({depth_scene::Plane{{0, 0, -1}, -1}});
    CHECK(is_nothing(wall.of({0, 0, ism::Mask(depth_scene::width, depth_scene::height, 1)})));
}
