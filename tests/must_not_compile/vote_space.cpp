// expect: VoteSpaceType
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/detect/detect.hpp"

ism::Recognition<ism::X> recognition;
