// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// stb's functions, compiled here and nowhere else in the project.
#include "ism/io/stb_implementation.hpp"
