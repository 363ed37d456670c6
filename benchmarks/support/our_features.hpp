// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/harris_laplace.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"

namespace bench {

/// @brief Our detectors with settings like those of the peers: oriented, first octave doubled, 3 levels an
/// octave; the thresholds of DoG are OpenCV's, the others give about as many features as covdet's.
template <ism::Detector D, ism::Descriptor Desc = ism::Sift>
[[nodiscard]] ism::Extractor<D, Desc> like_peers() {
    ism::Extractor<D, Desc> extractor;
    extractor.options.oriented = true;
    // doubling by linear interpolation, as the peers do it, blurs; ours does not, so that the image wants
    // more
    extractor.options.scale_space.input_sigma = 0;
    return extractor;
}

}  // namespace bench
