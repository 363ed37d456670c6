// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string>

#include "support/catch.hpp"
#include "support/data.hpp"

#include "ism/core/geometry.hpp"
#include "ism/dataset/coco.hpp"

TEST_CASE("every annotated mask decodes to its box and packs to the same text") {
    for (const std::string name : {"eth80-side/all", "msrc/val", "osd/val", "sysu-shapes/val",
                                   "turntable/all", "weizmann-horses/val", "four-class/test"}) {
        const auto file = ism::test::find_data(name + ".json");
        if (!file) return;
        const ism::Dataset data = ism::read_dataset(*file);
        std::size_t masks = 0;
        for (const auto& image : data.images)
            for (const auto& object : image.objects) {
                const ism::Mask mask = ism::read_mask(image, object);
                REQUIRE_FALSE(mask.empty());
                ++masks;
                INFO(name << ", annotation " << object.id);
                CHECK(ism::mask_box(mask) == object.box);
                CHECK(ism::compress_mask(mask).counts ==
                      std::get<ism::CompressedRle>(object.segmentation).counts);
            }
        CHECK(masks > 50);
    }
}
