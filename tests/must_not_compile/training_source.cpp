// expect: source(i)
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "ism/feature/dense_grid.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/train.hpp"

const std::vector<std::string> names{"a"};
const auto model = ism::train<ism::DenseGrid, ism::Sift>(names, 1, [](std::size_t) { return 7; });
