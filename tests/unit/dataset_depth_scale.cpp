// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/dataset/depth_scale.hpp"
#include "ism/dataset/read_images.hpp"

using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

ism::DepthMap flat_depth(float depth_m) {
    ism::DepthMap map(80, 70, depth_m);
    for (int x = 0; x < 30; ++x) map(x, 0) = 0;  // no reading
    return map;
}

}  // namespace

TEST_CASE("the median of a depth map leaves out what is no reading") {
    ism::DepthMap map(3, 3, 0);
    CHECK(std::isnan(ism::median_depth_m(map)));
    map(0, 0) = 2, map(1, 1) = ism::no_depth, map(2, 2) = 4, map(1, 2) = 9;
    CHECK(ism::median_depth_m(map) == 4);
    CHECK(ism::median_depth_m(flat_depth(1.5f)) == 1.5);
}

TEST_CASE("the likely depth scale makes the median a distance in a room") {
    CHECK(ism::likely_depth_scale(812) == 0.001);
    CHECK(ism::likely_depth_scale(20000) == 0.0002);
    CHECK(ism::likely_depth_scale(60000) == 0.0001);
    CHECK(ism::likely_depth_scale(80) == 0.01);
    CHECK(ism::likely_depth_scale(2) == 0);
}

TEST_CASE("depth scales are doubted beyond 20 m and refused beyond 200 m") {
    CHECK(ism::depth_scale_doubt(flat_depth(0.8f), 0.001).empty());
    CHECK(ism::depth_scale_doubt(flat_depth(19), 0.001).empty());
    CHECK(ism::depth_scale_doubt(flat_depth(40), 0.05) ==
          "depth scale 0.05, by which the median of the depth is 40 m; 0.001 would make it 0.8 m");
    CHECK_FALSE(ism::depth_scale_doubt(flat_depth(0.04f), 0.0001).empty());
    CHECK_NOTHROW(ism::check_depth_scale(flat_depth(40), 0.05));
    CHECK_NOTHROW(ism::check_depth_scale(ism::DepthMap(20, 20, 0), 1));
    CHECK(
        error_message([] { ism::check_depth_scale(flat_depth(800), 1); }) ==
        "depth scale (metres per unit): expected one by which the median of the depth is 0.01 to 200 m, got "
        "1, by which the median of the depth is 800 m; 0.001 would make it 0.8 m");
    CHECK_THROWS_AS(ism::check_depth_scale(flat_depth(8e-4f), 1e-6), ism::Error);
}

TEST_CASE("an image whose depth scale cannot be is refused by the name of its depth file") {
    const TemporaryFolder folder;
    ism::write_png(folder / "a.png", ism::RgbImage(20, 20));
    ism::write_png16(folder / "d.png", ism::RawDepth(20, 20, 900));
    ism::DatasetImage image{.file = folder / "a.png",
                            .depth_file = folder / "d.png",
                            .width = 20,
                            .height = 20,
                            .depth_scale = 0.001};
    CHECK(ism::read_frame(image).depth_m(3, 3) == Approx(0.9));
    image.depth_scale = 1;
    CHECK_THROWS_WITH(ism::read_frame(image), Catch::StartsWith("file '" + (folder / "d.png").string() +
                                                                "': depth scale (metres per unit)"));
}
