// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// A program that needs every library the recipes name, and threads.
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "ism/core/radius_search.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/io/images.hpp"
#include "ism/io/json.hpp"
#include "ism/io/stb_implementation.hpp"
#include "ism/version.hpp"

static_assert(ISM_HAS_JSON == 1 && ISM_HAS_NANOFLANN == 1 && ISM_HAS_STB == 1);

int main(int, char** argv) {
    std::vector<std::array<double, 2>> points;  // more than are searched without a tree
    for (int i = 0; i < 1000; ++i) points.push_back({double(i % 40), double(i / 40)});
    if (ism::RadiusSearch<2>(points).within({10, 10}, 1).size() != 5) return 1;

    const ism::RgbImage image(5, 4, {1, 2, 3});
    const std::string file = std::string(argv[0]) + ".png";
    ism::write_png(file, image);
    if (ism::read_rgb(file) != image) return 2;

    std::array<int, 8> squares{};
    ism::ThreadPool(2).for_each(squares.size(), [&](std::size_t i, unsigned) { squares[i] = int(i * i); });
    if (squares[7] != 49 || nlohmann::json::parse("[1, 2]").size() != 2) return 3;
    std::printf("ism %s\n", ism::version_text);
}
