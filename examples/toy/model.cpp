// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/model.hpp"

namespace toy {

Model finished(Model model) {
    bool first = true;
    for (const Part& part : model.parts)
        for (const Vertex& vertex : part.mesh.vertices) {
            const Vec p = vertex.position;
            if (first) model.low = model.high = p, first = false;
            model.low = {std::min(model.low.x, p.x), std::min(model.low.y, p.y), std::min(model.low.z, p.z)};
            model.high = {std::max(model.high.x, p.x), std::max(model.high.y, p.y),
                          std::max(model.high.z, p.z)};
        }
    return model;
}

}  // namespace toy
