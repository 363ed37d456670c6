// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// A second source of one program that detects, too: what it defines once more has to be the same.
#include "ism/ism.hpp"

bool found_elsewhere(const ism::TypedModel<ism::HessianLaplace, ism::RootSift>& model,
                     const ism::Frame& frame);
bool found_elsewhere(const ism::TypedModel<ism::HessianLaplace, ism::RootSift>& model,
                     const ism::Frame& frame) {
    return !ism::detect<ism::Jism>(model, frame).objects.empty();
}
