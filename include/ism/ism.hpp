// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief Everything from images in memory to detections: needs the standard library alone. Files are read
/// and written by the headers of ism/io (stb, nlohmann_json), figures are measured by those of ism/evaluate.

#include "ism/detect/detect.hpp"
#include "ism/feature/byte_sift.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/harris_laplace.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/train.hpp"
#include "ism/version.hpp"
