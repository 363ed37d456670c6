// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "ism/core/image.hpp"
#include "ism/version.hpp"

float brightness_elsewhere(const ism::RgbImage& image);  // second.cpp

int main() {
    const ism::RgbImage white(4, 3, {255, 255, 255});
    std::printf("ism %s\n", ism::version_text);
    const float here = ism::to_gray(white)(3, 2);
    return here > 0.99f && here == brightness_elsewhere(white) ? 0 : 1;
}
