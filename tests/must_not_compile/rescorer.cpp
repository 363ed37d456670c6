// expect: rescorer.rescore(
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/detect/detect.hpp"

struct Indifferent {};

ism::Recognition<ism::Jism, ism::FlatKernel, Indifferent> recognition;
