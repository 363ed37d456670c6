// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Whether headers are found, and threads are linked to: the ways in that differ in nothing else compile this
// little.
#include <array>
#include <cstdio>

#include "ism/core/image.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/version.hpp"

int main() {
    std::array<int, 8> squares{};
    ism::ThreadPool(2).for_each(squares.size(), [&](std::size_t i, unsigned) { squares[i] = int(i * i); });
    std::printf("ism %s\n", ism::version_text);
    return squares[7] == 49 && ism::GrayImage(3, 2, 0.5f)(2, 1) == 0.5f ? 0 : 1;
}
