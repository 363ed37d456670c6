// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "experiment.hpp"

#include "ism/show/report.hpp"

namespace reproduce {

/// The experiments on depth (the paper's section 3D Detection): toy cars, osd, the car between two cars, and
/// what worse pictures cost.
[[nodiscard]] std::vector<ism::ReportSection> depth_experiments(const Settings& settings, Times& times);

}  // namespace reproduce
