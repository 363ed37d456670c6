// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// A second source of one program that trains and detects, too: what it defines once more has to be the same.
#include <string>
#include <vector>

#include "ism/ism.hpp"

bool found_elsewhere(const std::vector<std::string>& names, const std::vector<ism::TrainingImage>& images);
bool found_elsewhere(const std::vector<std::string>& names, const std::vector<ism::TrainingImage>& images) {
    const auto model = ism::train<ism::HessianLaplace, ism::RootSift>(names, images);
    return !ism::detect<ism::Jism>(model, images[0].frame).objects.empty();
}
