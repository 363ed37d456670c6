// expect: is_trivially_copyable
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string>

#include "ism/core/image.hpp"

ism::Image<std::string> image;
