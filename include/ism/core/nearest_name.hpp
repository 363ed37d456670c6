// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ism/config.hpp"

namespace ism {

/// @brief How many letters have to be added, left out, replaced or swapped with the next one to make `b` of
/// `a` (Damerau 1964, the restricted form); bytes count as letters.
[[nodiscard]] inline std::size_t typing_errors(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> errors(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            std::size_t& here = errors[i][j];
            if (i == 0 || j == 0) {
                here = i + j;
                continue;
            }
            here = std::min({errors[i - 1][j] + 1, errors[i][j - 1] + 1,
                             errors[i - 1][j - 1] + std::size_t(a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                here = std::min(here, errors[i - 2][j - 2] + 1);
        }
    return errors[a.size()][b.size()];
}

/// @brief The name that was most likely meant: one that begins with what was typed (three letters or more),
/// else the one with the fewest typing errors, at most one in three letters; empty where there is none.
[[nodiscard]] inline std::string nearest_name(std::string_view typed, std::span<const std::string> names) {
    typed = typed.substr(0, 100);
    std::string nearest;
    std::size_t fewest = std::max<std::size_t>(1, typed.size() / 3) + 1;
    for (const std::string& name : names)
        if (typed.size() >= 3 && name.starts_with(typed) && (nearest.empty() || name.size() < nearest.size()))
            nearest = name;
    if (!nearest.empty()) return nearest;
    for (const std::string& name : names) {
        if (name.size() > 2 * typed.size() + 2) continue;
        const std::size_t errors = typing_errors(typed, name);
        if (errors < fewest && errors < name.size()) fewest = errors, nearest = name;
    }
    return nearest;
}

/// @brief ": did you mean X?" for the end of a message; empty where no name is near.
[[nodiscard]] inline std::string did_you_mean(std::string_view typed, std::span<const std::string> names) {
    const std::string nearest = nearest_name(typed, names);
    return nearest.empty() ? "" : ": did you mean " + nearest + "?";
}

}  // namespace ism
