// expect: descriptor.describe(space, feature, row)
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <string_view>

#include "ism/feature/dense_grid.hpp"
#include "ism/feature/extract.hpp"

struct SaysNothing {
    using Scalar = float;
    static constexpr std::size_t dimension = 3;
    static constexpr std::string_view name = "says-nothing";
    static constexpr float support_radius = 1;
    static constexpr double sq_length = 1;
};

ism::Extractor<ism::DenseGrid, SaysNothing> extractor;
