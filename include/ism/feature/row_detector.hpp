// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <vector>

#include "ism/feature/detector.hpp"
#include "ism/feature/local_maxima.hpp"

namespace ism {

/// @brief A detector that can search rows while the scale space is built: what `search` appends for rows of
/// an octave depends on the levels up to `search_reach` rows above and below alone. `check` throws where an
/// option is out of range.
template <class D>
concept RowDetector = Detector<D> &&
    requires(const D& detector, const ScaleSpace& space, Workspace& workspace, std::vector<Feature>& found) {
    check(detector);
    { D::search_reach } -> std::convertible_to<int>;
    { detector.search(space, int(), int(), int(), workspace, unsigned(), found) } -> std::same_as<void>;
};

/// @brief What a row detector finds in a scale space that is there already.
/// @throws Error where one of its options is out of range.
template <RowDetector D>
[[nodiscard]] std::vector<Feature> search_all_rows(const D& detector, const ScaleSpace& space,
                                                   Workspace& workspace) {
    constexpr int rows_per_task = 32;
    check(detector);
    const auto tasks_of = [&](int octave) {
        return std::size_t((space.level(octave, 0).height() + rows_per_task - 1) / rows_per_task);
    };
    std::size_t tasks = 0;
    for (int octave = 0; octave < space.octaves(); ++octave) tasks += tasks_of(octave);
    const auto found = workspace.lists(workspace.pool().size());
    workspace.pool().for_each(tasks, [&](std::size_t task, unsigned worker) {
        int octave = 0;
        for (; task >= tasks_of(octave); ++octave) task -= tasks_of(octave);
        const int first = int(task) * rows_per_task, height = space.level(octave, 0).height();
        detector.search(space, octave, first, std::min(first + rows_per_task, height), workspace, worker,
                        found[worker]);
    });
    return detail::in_order(found, workspace);
}

}  // namespace ism
