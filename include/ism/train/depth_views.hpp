// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/order.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

/// @brief Training images with depth and camera in groups that show the same things: images of one group lie
/// side by side.
struct DepthViews {
    std::vector<const TrainingView*> views = {};
    std::vector<std::size_t> group_first = {}, group_end = {};  ///< of each view: of its group, among `views`
};

/// @brief The training images that keep depth. Those that show an object of the same instance
/// of a class (LabelledObject::instance) are one group, directly or by others between; without instances each
/// image is one. What is learnt of an image without itself is learnt without its group: an object that was
/// seen from the next side would be too easy.
/// @throws Error where there is no such image.
[[nodiscard]] inline DepthViews depth_views(const TrainingFeatures& features) {
    std::vector<const TrainingView*> found;
    for (const TrainingView& view : features.views)
        if (view.depth && !view.mirrored) found.push_back(&view);
    expect(!found.empty(), "training from depth: images with depth and camera", "1 or more", 0);
    std::vector<std::size_t> group(found.size());
    std::iota(group.begin(), group.end(), std::size_t(0));
    const auto root = [&](std::size_t i) {
        while (group[i] != i) i = group[i];
        return i;
    };
    std::map<std::pair<std::uint32_t, std::string>, std::size_t> first_with;  // of a class and an instance
    for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t k = 0; k < found[i]->depth->instances.size(); ++k) {
            const std::string& instance = found[i]->depth->instances[k];
            if (instance.empty()) continue;
            const auto [known, is_new] =
                first_with.emplace(std::pair(found[i]->labels[k].class_index, instance), i);
            const std::size_t a = root(known->second), b = root(i);
            group[std::max(a, b)] = std::min(a, b);
        }
    std::vector<std::size_t> order(found.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    detail::sort_by(order, [&](std::size_t i) { return root(i); });
    DepthViews result;
    for (const std::size_t i : order) result.views.push_back(found[i]);
    result.group_first.resize(order.size());
    result.group_end.resize(order.size());
    for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
        while (end < order.size() && root(order[end]) == root(order[first])) ++end;
        for (std::size_t i = first; i < end; ++i) result.group_first[i] = first, result.group_end[i] = end;
    }
    return result;
}

}  // namespace ism
