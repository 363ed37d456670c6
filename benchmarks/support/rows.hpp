// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "ism/evaluate/table.hpp"

namespace bench {

/// @brief What a comparison prints: one figure of ours beside one of a peer, and whether ours is right.
struct Row {
    std::string name;
    double ours = 0, peer = 0;
    std::string peer_name, unit;
    bool correct = true;
    std::string remark = {};  ///< the correctness figure in words
};

[[nodiscard]] inline std::string number(double value, int digits = 2) {
    char text[64];
    std::snprintf(text, sizeof(text), "%.*f", digits, value);
    return text;
}

inline void print(const std::vector<Row>& rows) {
    std::vector<std::vector<std::string>> cells = {
        {"case", "ours", "peer", "unit", "peer/ours", "correct", "peer is", "remark"}};
    for (const Row& row : rows)
        cells.push_back({row.name, number(row.ours), number(row.peer), row.unit, number(row.peer / row.ours),
                         row.correct ? "yes" : "NO", row.peer_name, row.remark});
    std::fputs(ism::align_columns(cells).c_str(), stdout);
}

/// @brief Rows as a JSON array of {case, ours, peer, peer_name, unit, ratio, correct, remark}.
void write_json(const std::filesystem::path& path, const std::vector<Row>& rows);

/// @brief Median milliseconds of each of some functions, called in turn so often: what slows the machine for
/// a while slows all of them. A first round is not counted.
[[nodiscard]] inline std::vector<double> interleaved_ms(const std::vector<std::function<void()>>& functions,
                                                        std::size_t rounds) {
    std::vector<std::vector<double>> times(functions.size());
    for (std::size_t round = 0; round <= rounds; ++round)
        for (std::size_t i = 0; i < functions.size(); ++i) {
            const auto begin = std::chrono::steady_clock::now();
            functions[i]();
            const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
            if (round > 0) times[i].push_back(time.count());
        }
    std::vector<double> medians;
    for (std::vector<double>& all : times) {
        const auto middle = all.begin() + std::ptrdiff_t(all.size() / 2);
        std::nth_element(all.begin(), middle, all.end());
        medians.push_back(*middle);
    }
    return medians;
}

}  // namespace bench
