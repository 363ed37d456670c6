// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief Detection in the vote space Metric, or in one of your own that has its axes.

#include "ism/detect/detect.hpp"
#include "ism/detect/posed_hypothesis.hpp"
#include "ism/detect/surface_scene.hpp"
#include "ism/vote/metric.hpp"
