// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// A program with an stb and a nanoflann of its own: ism uses these.
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include <nanoflann.hpp>

#include "ism/core/radius_search.hpp"
#include "ism/io/images.hpp"
#include "ism/io/png.hpp"
#include "ism/version.hpp"

int main(int, char** argv) {
    // More points than are searched without a tree.
    std::vector<std::array<double, 2>> points;
    for (int i = 0; i < 1000; ++i) points.push_back({double(i % 40), double(i / 40)});
    const ism::RadiusSearch<2> search(points);
    if (search.within({10, 10}, 1).size() != 5) return 1;

    ism::RgbImage image(5, 4, {1, 2, 3});
    const std::string file = std::string(argv[0]) + ".png";
    ism::write_png(file, image);
    if (ism::read_rgb(file) != image) return 2;
    std::printf("ism %s beside nanoflann %x\n", ism::version_text, unsigned(NANOFLANN_VERSION));
}

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
static_assert(OWN_STB == 1 && OWN_NANOFLANN == 1, "the program's own");
