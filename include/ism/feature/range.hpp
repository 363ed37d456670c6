// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/core/error.hpp"

namespace ism::detail {

/// Throws unless low ≤ value ≤ high, which NaN is not; for the check() of options.
template <class T>
void expect_range(TextPart what, const T& value, const T& low, const T& high) {
    expect(value >= low && value <= high, what, lazy_text(low, " to ", high), value);
}

inline constexpr int max_border = 65536;      // pixels: twice it is still a number
inline constexpr float max_threshold = 1e6f;  // of any response

}  // namespace ism::detail
