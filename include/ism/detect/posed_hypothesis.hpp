// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "ism/core/order.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/detect/scene.hpp"
#include "ism/vote/pose.hpp"
#include "ism/vote/posed_object.hpp"

namespace ism {

/// @brief Votes of a hypothesis whose turned training objects say where its box lies: the heaviest.
inline constexpr std::size_t box_votes = 12;

/// @brief Where the object of a vote lies in space.
[[nodiscard]] inline Pose pose_of(const Support& vote, const Scene& scene) {
    const ShapeModel& shapes = scene.model.shapes;
    return pose(*scene.frames[vote.feature], shapes.frames[shapes.occurrence(vote.occurrence).feature]);
}

/// @brief Of the votes of each feature the heaviest; heaviest first.
[[nodiscard]] inline std::vector<Support> one_a_feature(std::vector<Support> votes) {
    detail::sort_by(votes, [](const Support& s) { return detail::falling(s.weight); });
    std::vector<bool> seen;
    std::erase_if(votes, [&](const Support& s) {
        if (s.feature >= seen.size()) seen.resize(s.feature + 1, false);
        const bool again = seen[s.feature];
        seen[s.feature] = true;
        return again;
    });
    return votes;
}

/// @brief Gives a detection the position of its votes, their weighted mean, and how far they scatter around
/// it, the root of the mean square. That is what positions are off by: votes of one object err alike, so that
/// many are no better than a few (on halves of osd's training images positions are off by 12 mm, votes
/// scatter by 10, medians, and their standard error would be 1.4).
[[nodiscard]] inline Detection with_voted_position(Detection detection, const Scene& scene) {
    double total = 0, scatter = 0;
    Point3 mean;
    for (const Support& s : detection.support) {
        const Vec3f at = pose_of(s, scene).centre_m;
        total += s.weight;
        mean.x += s.weight * at.x, mean.y += s.weight * at.y, mean.z += s.weight * at.z;
    }
    mean = {mean.x / total, mean.y / total, mean.z / total};
    for (const Support& s : detection.support) {
        const Vec3f off = pose_of(s, scene).centre_m - to_vec3f(mean);
        scatter += s.weight * dot(off, off);
    }
    detection.position_m = mean;
    detection.depth_m = mean.z;
    if (detection.support.size() > 1) detection.position_error_m = std::sqrt(scatter / total);
    detection.rotation = pose_of(detection.support.front(), scene).rotation;
    return detection;
}

/// @brief Tells from the votes of a window in a space with poses what the object would be: its class, its
/// centre in metres, and by the turned points of the training objects of its heaviest votes its box. A
/// feature counts once, by its heaviest vote; the score is the sum of these.
inline Detection describe_posed_hypothesis(double /*score*/, std::vector<Support> window,
                                           const Scene& scene) {
    const ShapeModel& shapes = scene.model.shapes;
    Detection result;
    result.class_index = detail::keep_heaviest_class(window, shapes);
    result.support = one_a_feature(std::move(window));
    if (result.support.empty()) return result;

    const Camera& camera = *scene.frame.camera;
    double total = 0, scale = 0, size = 0;
    for (const Support& s : result.support) {
        const TrainingObject& object = shapes.objects[shapes.occurrence(s.occurrence).object];
        total += s.weight;
        scale += s.weight * placement(pose_of(s, scene), object, camera).scale;
        size += s.weight * object.size_m;
    }
    result.score = total;
    result.scale = scale / total;
    result = with_voted_position(std::move(result), scene);
    result.size_m = size / total;
    std::vector<double> left, top, right, bottom, weights;
    for (std::size_t i = 0; i < std::min(box_votes, result.support.size()); ++i) {
        const Support& s = result.support[i];
        const TrainingObject& object = shapes.objects[shapes.occurrence(s.occurrence).object];
        const Box box = posed_box(pose_of(s, scene), object.points_m, camera);
        if (!(box.area() > 0)) continue;
        left.push_back(box.x), top.push_back(box.y);
        right.push_back(box.x + box.width), bottom.push_back(box.y + box.height);
        weights.push_back(s.weight);
    }
    if (left.empty()) {
        result.support.clear();  // no object
        return result;
    }
    const double x = weighted_median(left, weights), y = weighted_median(top, weights);
    result.box = {x, y, weighted_median(right, weights) - x, weighted_median(bottom, weights) - y};
    result.centre = result.box.centre();
    return result;
}

}  // namespace ism
