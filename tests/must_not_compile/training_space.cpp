// expect: ImageVoteSpace
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/train/learn.hpp"

const ism::Model model = ism::learn<ism::Ji3sm1>({});
