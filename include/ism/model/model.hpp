// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/codebook/codebook.hpp"
#include "ism/feature/extract.hpp"
#include "ism/model/occurrence.hpp"

namespace ism {

/// @brief What training gives and detection needs, whatever the vote space: how to find and describe
/// features, the words, and where on which objects they occur.
template <Detector D, Descriptor Desc>
struct Model {
    Extractor<D, Desc> extractor;
    Codebook<Desc::dimension, typename Desc::Scalar> codebook;  ///< of bytes for descriptors of bytes
    Shapes shapes;
    /// Descriptors of the training features, by Occurrence::feature; empty = not kept. Only growing needs
    /// them: see grow_model().
    Descriptors<typename Desc::Scalar, Desc::dimension> memory = {};
};

}  // namespace ism
