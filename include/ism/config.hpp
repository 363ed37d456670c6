// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief What the compiler at hand offers: says so in one line where it is too old, and tells which of the
/// libraries that only some headers need can be included.

#if defined(_MSVC_LANG)
#if _MSVC_LANG < 202002L
#error "ism needs C++20: compile with /std:c++20"
#include "ism_needs_C++20"  // no such file: the compilation ends here, not after thousands of errors
#endif
#elif __cplusplus < 202002L
#error "ism needs C++20: compile with -std=c++20"
#include "ism_needs_C++20"  // no such file: the compilation ends here, not after thousands of errors
#endif

/// @brief 1 where the headers that read or write JSON can be included (nlohmann_json is installed).
#if __has_include(<nlohmann/json.hpp>)
#define ISM_HAS_JSON 1
#else
#define ISM_HAS_JSON 0
#endif

/// @brief 1 where the headers that read or write image files can be included (stb is installed).
#if __has_include(<stb_image.h>) || __has_include(<stb/stb_image.h>)
#define ISM_HAS_STB 1
#else
#define ISM_HAS_STB 0
#endif

/// @brief 1 where the k-d tree can be included (nanoflann is installed).
#if __has_include(<nanoflann.hpp>)
#define ISM_HAS_NANOFLANN 1
#else
#define ISM_HAS_NANOFLANN 0
#endif
