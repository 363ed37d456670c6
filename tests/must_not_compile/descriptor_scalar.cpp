// expect: DescriptorScalar
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/feature/feature.hpp"

ism::Descriptors<double> descriptors;
