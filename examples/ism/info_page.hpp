// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/dataset/dataset.hpp"
#include "ism/model/model.hpp"
#include "ism/show/report_parts.hpp"

namespace program {

/// The page on a model: what it was learnt from, and of each class its template, training objects and most
/// telling words.
/// @param data  what it was learnt from, to show words as they were seen; nothing without
/// @throws ism::Error where it shows no object of the model.
[[nodiscard]] ism::Report model_report(const ism::Model& model, const std::string& title,
                                       const ism::Dataset* data);

}  // namespace program
