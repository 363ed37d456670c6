// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "commands.hpp"

#include "ism/detect/detection.hpp"
#include "ism/detect/scene.hpp"

namespace program {

/// Detects the objects of a scene by the policies of these names.
[[nodiscard]] ism::Detections find_objects(ism::Scene scene, const SearchOptions& search);
/// Whether a vote space uses depth.
[[nodiscard]] bool needs_depth(std::string_view space);

}  // namespace program
