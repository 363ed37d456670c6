// expect: deleted
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/detect/detect.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/sift.hpp"

using Model = ism::TypedModel<ism::DenseGrid, ism::Sift>;

Model load();
ism::FrameDetector detector(load());  // it would refer to a model that is gone
