// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <vector>

#include "ism/feature/detector.hpp"
#include "ism/feature/local_maxima.hpp"

namespace ism {

/// @brief How far around the rows it searches a detector looks.
struct SearchReach {
    int rows = 0;     ///< above and below, in rows of the octave looked at
    int octaves = 0;  ///< finer and coarser, around the same place
};

/// @brief A detector that searches some rows of an octave at a time, so that the scale space of a large image
/// is never held as a whole. `prepare` validates the options, readies the workspace for `search` and says how
/// far that looks; `search` appends what lies in the rows first … end − 1 of an octave, on many threads;
/// `finish` gets all that was found, in order.
template <class D>
concept RowDetector = Detector<D> &&
    requires(const D& detector, const ScaleSpace& space, Workspace& workspace, std::vector<Feature>& found) {
    { detector.prepare(space, workspace) } -> std::same_as<SearchReach>;
    { detector.search(space, int(), int(), int(), workspace, unsigned(), found) } -> std::same_as<void>;
    { detector.finish(found, workspace) } -> std::same_as<void>;
};

namespace detail {

using RowOfOctave = std::array<int, max_scale_octaves>;

/// A row of one octave, in rows of another.
[[nodiscard]] inline int row_in_octave(int row, int octave, int other) {
    return other > octave ? row >> (other - octave) : row << (octave - other);
}

/// Rows of an octave that can be searched: everything within reach of them has been made.
[[nodiscard]] inline int searchable_rows(const ScaleSpace& space, int octave, SearchReach reach) {
    int rows = space.level_height(octave);
    const int last = std::min(space.octaves() - 1, octave + reach.octaves);
    for (int other = std::max(0, octave - reach.octaves); other <= last; ++other) {
        const int ready = space.rows_ready(other);
        if (ready == space.level_height(other)) continue;
        rows = std::min(rows, row_in_octave(std::max(0, ready - reach.rows), other, octave));
    }
    return rows;
}

/// The first row of an octave still needed by searches that continue at the rows `searched`.
[[nodiscard]] inline int row_wanted(const ScaleSpace& space, int octave, const RowOfOctave& searched,
                                    SearchReach reach) {
    int row = space.level_height(octave);
    const int last = std::min(space.octaves() - 1, octave + reach.octaves);
    for (int other = std::max(0, octave - reach.octaves); other <= last; ++other) {
        const int from = searched[std::size_t(other)];
        if (from < space.level_height(other))
            row = std::min(row, row_in_octave(from, other, octave) - reach.rows);
    }
    return row;
}

/// Searches the rows from[octave] … end[octave] − 1 of every octave.
template <RowDetector D>
void search_rows(const D& detector, const ScaleSpace& space, const RowOfOctave& from, const RowOfOctave& end,
                 Workspace& workspace, std::vector<std::vector<Feature>>& found) {
    constexpr int rows_per_task = 32;
    const auto tasks_of = [&](std::size_t octave) {
        return std::size_t(std::max(0, end[octave] - from[octave] + rows_per_task - 1) / rows_per_task);
    };
    std::size_t tasks = 0;
    for (int octave = 0; octave < space.octaves(); ++octave) tasks += tasks_of(std::size_t(octave));
    workspace.pool().for_each(tasks, [&](std::size_t task, unsigned worker) {
        std::size_t octave = 0;
        for (; task >= tasks_of(octave); ++octave) task -= tasks_of(octave);
        const int first = from[octave] + int(task) * rows_per_task;
        detector.search(space, int(octave), first, std::min(first + rows_per_task, end[octave]), workspace,
                        worker, found[worker]);
    });
}

/// Runs a row detector while advance() makes the scale space prepared by begin(). The result is bit-identical
/// to that of search_all_rows() on the whole scale space.
template <RowDetector D>
[[nodiscard]] std::vector<Feature> search_advancing(const D& detector, ScaleSpace& space,
                                                    Workspace& workspace) {
    const SearchReach reach = detector.prepare(space, workspace);
    std::vector<std::vector<Feature>>& found = workspace.lists();
    RowOfOctave searched{}, end{};
    while (space.advance(workspace)) {
        for (int octave = 0; octave < space.octaves(); ++octave)
            end[std::size_t(octave)] = searchable_rows(space, octave, reach);
        search_rows(detector, space, searched, end, workspace, found);
        searched = end;
        for (int octave = 0; octave < space.banded_octaves(); ++octave)
            space.forget(octave, row_wanted(space, octave, searched, reach));
    }
    std::vector<Feature> all = in_order(found, workspace);
    detector.finish(all, workspace);
    return all;
}

}  // namespace detail

/// @brief The features a row detector finds in a whole scale space.
/// @throws Error where one of its options is out of range.
template <RowDetector D>
[[nodiscard]] std::vector<Feature> search_all_rows(const D& detector, const ScaleSpace& space,
                                                   Workspace& workspace) {
    (void)detector.prepare(space, workspace);
    std::vector<std::vector<Feature>>& found = workspace.lists();
    detail::RowOfOctave end{};
    for (int octave = 0; octave < space.octaves(); ++octave)
        end[std::size_t(octave)] = space.level_height(octave);
    detail::search_rows(detector, space, {}, end, workspace, found);
    std::vector<Feature> all = detail::in_order(found, workspace);
    detector.finish(all, workspace);
    return all;
}

}  // namespace ism
