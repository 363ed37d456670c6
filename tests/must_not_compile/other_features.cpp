// expect: ism::RootSift>
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/detect/detect.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/sift.hpp"

using Model = ism::TypedModel<ism::DenseGrid, ism::Sift>;

void use(const Model& model);
void wrong(const ism::TypedModel<ism::DenseGrid, ism::RootSift>& model) {
    use(model);
}
