// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "toy/model.hpp"

namespace toy {

/// @brief A lamp far away, the light of the room and how bright the picture is taken.
struct Light {
    Vec to_lamp = normalised(Vec{-0.45f, -0.5f, 0.85f});
    Vec lamp = {1.42f, 1.35f, 1.22f}, sky = {0.42f, 0.46f, 0.52f}, bounce = {0.22f, 0.19f, 0.155f};
    float exposure = 1;
};

/// @brief A model in the world; `object` is the number that shall stand in the label image.
struct Placed {
    Model model;
    Pose pose;
    int object = -1;
};

/// @brief Which part of the table shadows are computed for, metres.
struct ShadowArea {
    Vec centre = {0, 0, 0.05f};
    float radius = 0.5f;
};

}  // namespace toy
