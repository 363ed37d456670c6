// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

// The one place of the version; the build system reads these three lines.
#define ISM_VERSION_MAJOR 0
#define ISM_VERSION_MINOR 3
#define ISM_VERSION_PATCH 0

#include <compare>

#include "ism/config.hpp"

namespace ism {

/// @brief A version of this library (semantic versioning).
struct Version {
    int major_number = 0, minor_number = 0, patch_number = 0;
    [[nodiscard]] constexpr auto operator<=>(const Version&) const = default;
};

/// @brief The version of the headers a program was compiled with.
inline constexpr Version version{ISM_VERSION_MAJOR, ISM_VERSION_MINOR, ISM_VERSION_PATCH};

#define ISM_DETAIL_TEXT(x) #x
#define ISM_DETAIL_JOIN(a, b, c) ISM_DETAIL_TEXT(a) "." ISM_DETAIL_TEXT(b) "." ISM_DETAIL_TEXT(c)
/// @brief The same as text, "0.3.0" say.
inline constexpr char version_text[] =
    ISM_DETAIL_JOIN(ISM_VERSION_MAJOR, ISM_VERSION_MINOR, ISM_VERSION_PATCH);
#undef ISM_DETAIL_JOIN
#undef ISM_DETAIL_TEXT

}  // namespace ism
