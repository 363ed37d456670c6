// expect: rule.fit(found, truth)
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <vector>

#include "ism/evaluate/matching.hpp"

struct Lenient {};

const std::vector<ism::TruthObject> truth;
const std::vector<ism::FoundObject> found;
const auto judgements = ism::match(truth, found, Lenient{});
