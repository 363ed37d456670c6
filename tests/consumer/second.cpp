// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// A second source of one program: what it defines once more has to be the same.
#include <cstddef>

#include "ism/ism.hpp"

std::size_t pixels_elsewhere(const ism::GrayImage& image);
std::size_t pixels_elsewhere(const ism::GrayImage& image) {
    return image.pixels().size();
}
