// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/core/camera.hpp"
#include "ism/feature/feature.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/model/training_object.hpp"
#include "ism/vote/placement.hpp"
#include "ism/vote/pose.hpp"

namespace ism {

/// @brief All that a vote can be told from: what an axis sees.
struct VoteSource {
    const Feature& feature;        ///< of the image
    const Occurrence& occurrence;  ///< of the model
    const TrainingObject& object;  ///< on which the word was seen
    const Camera* camera;          ///< of the image; null = not known
    Placement placement;           ///< where the object would lie: placement(feature, occurrence)
    Pose pose = {};                ///< where it would lie in space; only for axes that need it
};

}  // namespace ism
