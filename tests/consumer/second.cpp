// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// The same headers in a second source of one program.
#include "ism/core/image.hpp"
#include "ism/version.hpp"

float brightness_elsewhere(const ism::RgbImage& image);
float brightness_elsewhere(const ism::RgbImage& image) {
    return ism::to_gray(image)(0, 0);
}
