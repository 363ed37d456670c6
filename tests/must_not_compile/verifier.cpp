// expect: verifier.verify(hypotheses, scene)
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/detect/detect.hpp"

struct Undecided {};

ism::Recognition<ism::Jism, ism::FlatKernel, ism::NoRescorer, ism::PatchSegmenter, Undecided> recognition;
