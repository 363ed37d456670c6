// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

namespace ism::test {

/// @brief How often this run has skipped a test. Counted by find_data(), read by main().
inline int& skipped_tests() {
    static int count = 0;
    return count;
}

}  // namespace ism::test
