// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "arrays.hpp"

namespace ism_python {

ism::Frame to_frame(const Arrays& arrays, const std::optional<ism::Camera>& camera) {
    const ism::RawPixels& picture = arrays.picture.pixels;
    if (!arrays.depth) return ism::to_frame(picture, camera);
    const ism::RawPixels& depth = arrays.depth->pixels;
    return ism::to_frame(picture, depth, depth.format.sample == ism::Sample::float32 ? 1 : arrays.depth_scale,
                         camera);
}

}  // namespace ism_python
