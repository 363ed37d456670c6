// expect: verifier.verify(hypotheses)
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/detect/detect.hpp"

struct Undecided {};

const auto found = ism::detect_from_matches<ism::Jism, ism::FlatKernel, Undecided>({}, {}, {}, {});
