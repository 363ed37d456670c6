// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "toy/model.hpp"

#include "ism/core/random.hpp"

namespace toy {

namespace detail {

/// A colour that is neither pale nor dark.
Vec any_colour(ism::Random& random);

/// A book lying flat, or two.
Model make_books(ism::Random& random);

/// A printed carton, standing or lying.
Model make_carton(ism::Random& random);

/// A few dice with numbers on each side, stacked.
Model make_blocks(ism::Random& random);

}  // namespace detail

}  // namespace toy
