// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/core/resize_area.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/search_box.hpp"

namespace {

ism::RgbImage blobs(int width, int height, std::uint64_t seed) {
    ism::Random random(seed);
    ism::RgbImage image(width, height, {128, 128, 128});
    for (int blob = 0; blob < 60; ++blob) {
        const double x = random.uniform(0, width), y = random.uniform(0, height), r = random.uniform(2, 9);
        const ism::Rgb color{std::uint8_t(random.index(256)), std::uint8_t(random.index(256)),
                             std::uint8_t(random.index(256))};
        for (int v = 0; v < height; ++v)
            for (int u = 0; u < width; ++u)
                if (std::hypot(u - x, v - y) < r) image(u, v) = color;
    }
    return image;
}

std::vector<float> described(const ism::RgbImage& image, const ism::Box& box, const ism::BoxGrid& grid) {
    ism::ThreadPool pool(2);
    const ism::HogPyramid pyramid(image, 0, pool);
    std::vector<float> cells(grid.cells() * ism::cell_numbers);
    ism::CellScratch scratch;
    ism::describe_cells(pyramid, box, grid, cells, scratch);
    return cells;
}

/// A cell's directions and colours, pixel by pixel, in parts of its area.
std::vector<double> cell_by_pixels(const ism::RgbImage& image, int left, int top, int right, int bottom) {
    std::vector<double> sums(21, 0);
    double inside = 0;
    const auto channel = [&](int x, int y, int k) {
        const ism::Rgb c = image(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1));
        return (k == 0 ? c.r : k == 1 ? c.g : c.b) / 255.0;
    };
    for (int y = std::max(0, top); y < std::min(bottom, image.height()); ++y)
        for (int x = std::max(0, left); x < std::min(right, image.width()); ++x) {
            double gx = 0, gy = 0;
            for (int k = 0; k < 3; ++k) {
                const double dx = channel(x + 1, y, k) - channel(x - 1, y, k),
                             dy = channel(x, y + 1, k) - channel(x, y - 1, k);
                if (dx * dx + dy * dy > gx * gx + gy * gy + 1e-12) gx = dx, gy = dy;
            }
            double turn = std::atan2(gy, gx) * 9 / std::numbers::pi;
            if (turn < 0) turn += 18;
            const int low = int(turn) % 18;
            const double part = turn - std::floor(turn);
            sums[std::size_t(low)] += std::hypot(gx, gy) * (1 - part);
            sums[std::size_t((low + 1) % 18)] += std::hypot(gx, gy) * part;
            const double r = channel(x, y, 0), g = channel(x, y, 1), b = channel(x, y, 2);
            sums[18] += (r + g + b) / 3, sums[19] += r - g, sums[20] += (r + g) / 2 - b;
            inside += 1;
        }
    const double area = double(right - left) * (bottom - top);
    for (std::size_t k = 0; k < 21; ++k) sums[k] = inside > 0 ? sums[k] / (k < 18 ? area : inside) : 0;
    return sums;
}

/// Felzenszwalb's numbers of a cell from its own sums and those of its neighbours, by rows.
std::vector<double> cell_numbers_by_pixels(const std::vector<std::vector<double>>& around) {
    const auto energy = [&](std::size_t i) {
        double sum = 0;
        for (std::size_t k = 0; k < 9; ++k) sum += std::pow(around[i][k] + around[i][k + 9], 2);
        return sum;
    };
    const std::vector<std::vector<std::size_t>> blocks = {
        {0, 1, 3, 4}, {1, 2, 4, 5}, {3, 4, 6, 7}, {4, 5, 7, 8}};
    std::vector<double> numbers(ism::cell_numbers, 0);
    for (std::size_t t = 0; t < 4; ++t) {
        double norm = 1e-4;
        for (const std::size_t i : blocks[t]) norm += energy(i);
        norm = 1 / std::sqrt(norm);
        for (std::size_t k = 0; k < 18; ++k) {
            const double v = std::min(0.2, around[4][k] * norm);
            numbers[k] += v / 2;
            numbers[27 + t] += 0.2357 * v;
        }
        for (std::size_t k = 0; k < 9; ++k)
            numbers[18 + k] += std::min(0.2, (around[4][k] + around[4][k + 9]) * norm) / 2;
    }
    numbers[31] = around[4][18] - 0.5, numbers[32] = around[4][19], numbers[33] = around[4][20];
    return numbers;
}

/// How far the numbers of a box's cells, so many pixels wide and tall at the image's own resolution, are from
/// what its pixels say.
double apart_from_pixels(const ism::RgbImage& image, int x, int y, int wide, int tall,
                         const ism::BoxGrid& grid) {
    const auto cells =
        described(image, {double(x), double(y), double(grid.columns * wide), double(grid.rows * tall)}, grid);
    double worst = 0;
    for (int j = 0; j < grid.all_rows(); ++j)
        for (int i = 0; i < grid.all_columns(); ++i) {
            std::vector<std::vector<double>> around;
            for (int dj = -1; dj <= 1; ++dj)
                for (int di = -1; di <= 1; ++di) {
                    const int left = x + (i - int(grid.ring) + di) * wide,
                              top = y + (j - int(grid.ring) + dj) * tall;
                    around.push_back(cell_by_pixels(image, left, top, left + wide, top + tall));
                }
            const auto expected = cell_numbers_by_pixels(around);
            for (std::size_t k = 0; k < ism::cell_numbers; ++k)
                worst = std::max(
                    worst, std::abs(expected[k] -
                                    cells[std::size_t(j * grid.all_columns() + i) * ism::cell_numbers + k]));
        }
    return worst;
}

}  // namespace

TEST_CASE("the cells of a box are what its pixels say, outside the image too") {
    const auto image = blobs(150, 110, 1);
    // cells of 8 × 8 pixels: the level is the image itself
    const auto [x, y] = GENERATE(std::pair(40, 30), std::pair(-12, -20), std::pair(100, 70));
    const bool ring = GENERATE(true, false);
    // a gradient is known to 1 / 720, near-black cells are scaled up by 100
    CHECK(apart_from_pixels(image, x, y, 8, 8, {6, 4, ring}) < 8e-3);
}

TEST_CASE("cells of more pixels than a sum of two bytes counts are what their pixels say") {
    // an image that is too low for coarser levels
    const auto image = blobs(600, 14, 8);
    const int tall = GENERATE(7, 14);
    REQUIRE(150 * tall > ism::most_exact_pixels);
    CHECK(apart_from_pixels(image, 0, 0, 150, tall, {4, 14 / tall, true}) < 8e-3);
    // of the largest gradients and colours
    ism::RgbImage stripes(600, 14);
    for (int v = 0; v < 14; ++v)
        for (int u = 0; u < 600; ++u)
            stripes(u, v) = (u / 2 + v / 2) % 2 == 0 ? ism::Rgb{255, 255, 0} : ism::Rgb{0, 0, 255};
    CHECK(apart_from_pixels(stripes, 0, 0, 150, tall, {4, 14 / tall, true}) < 8e-3);
    CHECK(apart_from_pixels(stripes, 0, 0, 11, 11, {10, 1, false}) < 8e-3);
}

TEST_CASE("a mirror image has mirrored cells") {
    const auto image = blobs(160, 96, 2);
    const ism::BoxGrid grid{7, 5, true};
    const ism::Box box{24, 16, 56, 40}, other{160 - 24 - 56, 16, 56, 40};
    const auto cells = described(image, box, grid);
    const auto mirrored = described(ism::mirrored(image), other, grid);
    const auto expected = ism::mirrored_cells(cells, grid);
    for (std::size_t k = 0; k < cells.size(); ++k) CHECK(mirrored[k] == Approx(expected[k]).margin(8e-3));
    CHECK(ism::mirrored_cells(expected, grid) == cells);
}

TEST_CASE("what cells say adds up to the template's score, and is mirrored where the image is") {
    const auto image = blobs(160, 96, 5), other_image = ism::mirrored(image);
    const ism::Box box{24, 16, 56, 40}, other{160 - 24 - 56, 16, 56, 40};
    ism::BoxTemplate form{.grid = {7, 5, true}, .bias = -0.7f, .log_aspect = 1, .log_aspect_spread = 0.5f};
    ism::Random random(6);
    for (std::size_t k = 0; k < form.grid.cells() * ism::cell_numbers; ++k)
        form.weights.push_back(float(random.normal()));
    ism::ThreadPool pool(1);
    ism::CellScratch scratch;
    const ism::HogPyramid pyramid(image, 0, pool), mirrored(other_image, 0, pool);
    const ism::TemplateScorer scorer(form);
    for (const bool side : {false, true}) {
        const auto cells = scorer.explain(pyramid, box, side, scratch);
        REQUIRE(cells.shares.size() == 9 * 7);
        double sum = 0;
        for (const float share : cells.shares) sum += double(share);
        CHECK(sum == Approx(scorer.of_side(pyramid, box, side, scratch)).margin(1e-3));
        const auto seen = scorer.explain(mirrored, other, !side, scratch);
        for (std::size_t j = 0; j < 7; ++j)
            for (std::size_t i = 0; i < 9; ++i)
                CHECK(seen.shares[j * 9 + 8 - i] == Approx(cells.shares[j * 9 + i]).margin(0.03));
    }
    CHECK(form.grid.cell(box, 0) == ism::Box{16, 8, 8, 8});  // of the ring
    CHECK(form.grid.cell(box, 10) == ism::Box{24, 16, 8, 8});
    CHECK(form.grid.cell(box, 9 * 7 - 1) == ism::Box{80, 56, 8, 8});
}

TEST_CASE("a box twice as large in an image twice as large has about the same cells") {
    const auto small = blobs(120, 100, 3);
    ism::RgbImage large(240, 200);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 240; ++x) large(x, y) = small(x / 2, y / 2);
    const ism::BoxGrid grid{6, 5, true};
    const auto a = described(small, {20, 20, 48, 40}, grid), b = described(large, {40, 40, 96, 80}, grid);
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(b[k] == Approx(a[k]).margin(1e-3));
}

TEST_CASE("waves in an image of any size have about the same cells in a box as much larger") {
    const auto cells = [](double size, int first) {
        ism::RgbImage image(int(std::lround(160 * size)), int(std::lround(120 * size)));
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) {
                const double u = (x + 0.5) / size, v = (y + 0.5) / size;
                const auto wave = [&](double length, double phase) {
                    return std::uint8_t(std::lround(128 + 100 * std::sin((u + v / 2) / length + phase) *
                                                              std::cos(v / length - u / 9)));
                };
                image(x, y) = {wave(4, 0), wave(5, 1), wave(6, 2)};
            }
        ism::ThreadPool pool(1);
        const ism::HogPyramid pyramid(image, first, pool);
        const ism::BoxGrid grid{8, 6, true};
        std::vector<float> result(grid.cells() * ism::cell_numbers);
        ism::CellScratch scratch;
        ism::describe_cells(pyramid, {40 * size, 30 * size, 64 * size, 48 * size}, grid, result, scratch);
        return result;
    };
    const auto expected = cells(1, 0);
    const double size = GENERATE(0.7071, 1.4142, 2.8284, 5.6569);
    const auto seen = cells(size, size < 1 ? -1 : 0);
    double sq_apart = 0, sq_length = 0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        sq_apart += std::pow(double(seen[k]) - double(expected[k]), 2);
        sq_length += std::pow(double(expected[k]), 2);
    }
    CAPTURE(size);
    CHECK(std::sqrt(sq_apart / sq_length) < 0.08);  // lines of cells are rounded to pixels
}

TEST_CASE("the levels of a large image stay small, those of a small one go as fine as asked") {
    ism::ThreadPool pool(2);
    const ism::HogPyramid large(ism::RgbImage(4000, 3000), ism::HogPyramid::finest, pool);
    const auto& finest = large.level_for(0.1);
    CHECK(double(finest.width) * finest.height <= ism::HogPyramid::max_pixels);
    CHECK(double(finest.width) * finest.height > ism::HogPyramid::max_pixels / 4);
    const ism::HogPyramid small(ism::RgbImage(40, 30), ism::HogPyramid::finest, pool);
    CHECK(small.level_for(0.1).width == 57);  // half an octave finer than the image
    CHECK(small.level_for(8).width == 40);
    CHECK(small.level_for(1e6).width >= 2);
}

TEST_CASE("a pyramid describes an image the same, whatever it described before") {
    ism::ThreadPool pool(2);
    const auto small = blobs(61, 47, 8), large = blobs(150, 110, 9);
    const ism::BoxGrid grid{6, 4, true};
    const auto cells_of = [&](const ism::HogPyramid& pyramid) {
        std::vector<float> cells(grid.cells() * ism::cell_numbers);
        ism::CellScratch scratch;
        ism::describe_cells(pyramid, {5, 3, 48, 32}, grid, cells, scratch);
        return cells;
    };
    ism::HogPyramid used(large, ism::HogPyramid::finest, pool);
    used.assign(small, 0, pool);
    CHECK(cells_of(used) == cells_of(ism::HogPyramid(small, 0, pool)));
    CHECK(used.width() == 61);
    CHECK(used.level_for(0.1).width == 61);  // finer levels are gone
    used.assign(large, -1, pool);
    CHECK(cells_of(used) == cells_of(ism::HogPyramid(large, -1, pool)));
    const ism::HogPyramid taken = std::move(used);
    CHECK(cells_of(taken) == cells_of(ism::HogPyramid(large, -1, pool)));
    used.assign(small, 0, pool);  // NOLINT(bugprone-use-after-move)
    CHECK(cells_of(used) == cells_of(ism::HogPyramid(small, 0, pool)));
}

TEST_CASE("an image that shrinks keeps its mean, one of a single colour its colour") {
    ism::Random random(4);
    std::vector<float> image(37 * 23 * 3);
    for (float& v : image) v = float(random.uniform());
    const auto mean = [](const std::vector<float>& v) {
        double sum = 0;
        for (const float x : v) sum += x;
        return sum / double(v.size());
    };
    CHECK(mean(ism::resize_area<3>(image, 37, 23, 10, 7)) == Approx(mean(image)).epsilon(1e-6));
    CHECK(ism::resize_area<3>(image, 37, 23, 37, 23) == image);
    for (const float v : ism::resize_area<3>(std::vector<float>(37 * 23 * 3, 0.25f), 37, 23, 80, 11))
        CHECK(v == Approx(0.25));
}
