// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/order.hpp"
#include "ism/detect/detection.hpp"

namespace ism {

/// @brief How detections of one frame after another are taken for the same objects.
struct TrackerOptions {
    double max_distance_m = 0.1;    ///< an object is not found farther from where it is thought to be
    double min_iou = 0.3;           ///< … or, without positions, with boxes that overlap less
    std::size_t birth_hits = 3;     ///< frames in which it has to be found before it is told
    std::size_t max_misses = 5;     ///< frames in a row in which it, or its position alone, may be missing
    double drift_m = 0.003;         ///< how far an object may move from frame to frame, standard deviation
    double least_error_m = 0.003;   ///< no position is trusted more
    double unknown_error_m = 0.03;  ///< what a position may be off by that does not tell
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const TrackerOptions& options) {
    const auto in_metres = [](double value, const char* name) {
        expect(value > 0 && value <= 1e3, lazy_text("TrackerOptions::", name), "above 0, to 1000 m", value);
    };
    in_metres(options.max_distance_m, "max_distance_m");
    in_metres(options.drift_m, "drift_m");
    in_metres(options.least_error_m, "least_error_m");
    in_metres(options.unknown_error_m, "unknown_error_m");
    expect(options.min_iou > 0 && options.min_iou < 1, "TrackerOptions::min_iou", "between 0 and 1",
           options.min_iou);
    expect(options.birth_hits >= 1, "TrackerOptions::birth_hits", "1 or more", options.birth_hits);
}

/// @brief An object that is followed from frame to frame.
struct Track {
    std::uint64_t id = 0;  ///< 1, 2, 3 …, never used again; 0 = not told yet
    std::uint32_t class_index = 0;
    double probability = 0;                     ///< the mean of its detections'
    Box box = {};                               ///< where it was found last, pixels
    std::optional<Point3> position_m = {};      ///< smoothed, in the camera frame
    double position_error_m = 0;                ///< standard error of position_m, where there is one
    std::size_t unplaced = 0;                   ///< frames in a row now without a position
    std::size_t hits = 0, misses = 0;           ///< frames: found in all, missed in a row now
    std::optional<std::size_t> detection = {};  ///< which of the last frame it is; none = missed there
};

/// @brief Keeps the identities of objects over frames and smooths their positions. An object is where it was
/// (constant position, so the camera has to move little from frame to frame): each frame the nearest pairs of
/// track and detection of one class come together, in metres, or by the overlap of their boxes where one has
/// no position (one that was not measured for more than max_misses frames is forgotten); a scalar Kalman
/// filter (1960), the same for the three axes, weighs a new position by what it may be off by. The same
/// detections give the same tracks.
class Tracker {
public:
    /// @throws Error as check(const TrackerOptions&) does.
    explicit Tracker(const TrackerOptions& options = {}) : options_(options) { check(options); }

    /// @brief Takes the detections of the next frame.
    /// @return the objects known now, by rising id; also those missed in this frame
    std::vector<Track> update(std::span<const Detection> detections) {
        for (Track& track : tracks_) {
            track.detection.reset(), ++track.misses, ++track.unplaced;
            track.position_error_m = std::hypot(track.position_error_m, options_.drift_m);
        }
        std::vector<bool> taken(detections.size(), false);
        for (const Pair& pair : nearest_first(detections)) {
            if (taken[pair.detection] || tracks_[pair.track].detection) continue;
            taken[pair.detection] = true;
            follow(tracks_[pair.track], detections[pair.detection], pair.detection);
        }
        for (Track& track : tracks_)
            if (track.unplaced > options_.max_misses) track.position_m.reset(), track.position_error_m = 0;
        std::erase_if(tracks_, [&](const Track& track) {
            return track.misses > (track.id > 0 ? options_.max_misses : track.hits - 1);
        });
        for (std::size_t d = 0; d < detections.size(); ++d)
            if (!taken[d]) follow(tracks_.emplace_back(), detections[d], d);
        std::vector<Track> told;
        for (Track& track : tracks_) {
            if (track.id == 0 && track.hits >= options_.birth_hits) track.id = ++last_id_;
            if (track.id > 0) told.push_back(track);
        }
        detail::sort_by(told, [](const Track& track) { return track.id; });
        return told;
    }

private:
    struct Pair {
        std::size_t track, detection;
        double apart;  // 0 … 1
    };

    /// Where a detection has a position that can be reckoned with.
    [[nodiscard]] static std::optional<Point3> position_of(const Detection& detection) {
        const auto& p = detection.position_m;
        return p && std::isfinite(p->x + p->y + p->z) ? p : std::nullopt;
    }

    [[nodiscard]] double apart(const Track& track, const Detection& detection) const {
        if (const auto p = position_of(detection); p && track.position_m) {
            const Point3& q = *track.position_m;
            return std::hypot(p->x - q.x, p->y - q.y, p->z - q.z) / options_.max_distance_m;
        }
        return (1 - iou(track.box, detection.box)) / (1 - options_.min_iou);
    }

    [[nodiscard]] std::vector<Pair> nearest_first(std::span<const Detection> detections) const {
        std::vector<Pair> pairs;
        for (std::size_t t = 0; t < tracks_.size(); ++t)
            for (std::size_t d = 0; d < detections.size(); ++d)
                if (tracks_[t].class_index == detections[d].class_index)
                    if (const double far = apart(tracks_[t], detections[d]); far <= 1)
                        pairs.push_back({t, d, far});
        detail::sort_by(pairs, [](const Pair& pair) { return detail::rising(pair.apart); });
        return pairs;
    }

    void follow(Track& track, const Detection& detection, std::size_t index) const {
        track.class_index = detection.class_index, track.box = detection.box;
        track.detection = index, track.misses = 0, ++track.hits;
        track.probability += (detection.probability - track.probability) / double(track.hits);
        const auto p = position_of(detection);
        if (!p) return;
        track.unplaced = 0;
        const double told = detection.position_error_m;
        const double error =
            std::isfinite(told) ? std::max(told, options_.least_error_m) : options_.unknown_error_m;
        if (!track.position_m) {
            track.position_m = p, track.position_error_m = error;
            return;
        }
        const double sq_before = track.position_error_m * track.position_error_m;
        const double gain = sq_before / (sq_before + error * error);
        Point3& q = *track.position_m;
        q.x += gain * (p->x - q.x), q.y += gain * (p->y - q.y), q.z += gain * (p->z - q.z);
        track.position_error_m = std::sqrt((1 - gain) * sq_before);
    }

    TrackerOptions options_;
    std::vector<Track> tracks_;
    std::uint64_t last_id_ = 0;
};

}  // namespace ism
