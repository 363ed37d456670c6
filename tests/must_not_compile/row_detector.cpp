// expect: detector.prepare(space, workspace)
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/feature/row_detector.hpp"

#include "ism/feature/dense_grid.hpp"

void search(const ism::ScaleSpace& space, ism::Workspace& workspace) {
    (void)ism::search_all_rows(ism::DenseGrid{}, space, workspace);
}
