// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Compiles. The control of the tests of what must not.
#include "ism/core/image.hpp"

int main() {
    return ism::Image<float>(2, 2).empty() ? 1 : 0;
}
