// expect: segmenter.segment(hypothesis, scene)
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/detect/detect.hpp"

struct Blunt {};

ism::Recognition<ism::Jism, ism::FlatKernel, ism::NoRescorer, Blunt> recognition;
