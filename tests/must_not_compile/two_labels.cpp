// expect: a vote space has at most one discrete axis
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/vote/vote_space.hpp"

static_assert(ism::VoteSpace<ism::X, ism::Class, ism::Class>::dimension == 1);
