// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// The features of a picture, drawn over it as features.png and written as features.txt in the format of the
// Oxford benchmark (Mikolajczyk et al. 2005): dimension, count, then a line a feature: x y a b c and the
// descriptor, where a (u - x)² + 2 b (u - x)(v - y) + c (v - y)² = 1 is its region, a circle of 3 scales.
//     05_features [IMAGE]
#include <cstdio>
#include <exception>

#include "toy_lessons.hpp"

#include "ism/feature/extract.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/io/png.hpp"
#include "ism/show/draw.hpp"

int main(int argc, char** argv) try {
    constexpr double region_scales = 3;
    ism::RgbImage picture = toy::read_or_render(argc > 1 ? argv[1] : nullptr);
    // for one picture after another: it keeps threads and memory
    ism::FeatureExtractor<ism::HessianLaplace, ism::RootSift> extractor({}, 0);
    const auto& set = extractor.extract(ism::to_gray(picture).view());

    for (const ism::Feature& f : set.features)
        ism::draw_circle(picture, {f.x, f.y}, region_scales * f.scale,
                         {.color = {255, 200, 0}, .width_px = 1, .opacity = 0.7});
    ism::write_png("features.png", picture);

    ism::write_file("features.txt", [&](std::ostream& out) {
        out << set.descriptors.dimension() << '\n' << set.features.size() << '\n';
        for (std::size_t i = 0; i < set.features.size(); ++i) {
            const ism::Feature& f = set.features[i];
            const double radius = region_scales * f.scale, a = 1 / (radius * radius);
            out << f.x << ' ' << f.y << ' ' << a << " 0 " << a;
            for (const float value : set.descriptors.row(i)) out << ' ' << value;
            out << '\n';
        }
    });
    std::printf("%zu features; wrote features.png and features.txt\n", set.features.size());
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
