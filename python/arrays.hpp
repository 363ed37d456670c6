// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include <pybind11/numpy.h>

#include "ism/adapt/pixels.hpp"
#include "ism/dataset/rle.hpp"

namespace ism_python {

namespace py = pybind11;

/// The pixels of a numpy array where they are; of another array where they do not lie in rows. Keeps the
/// array.
struct NumpyPixels {
    py::array array;
    ism::RawPixels pixels;
};

/// Depth, and metres a unit of it.
struct NumpyDepth {
    NumpyPixels units;
    double scale = 1;
};

/// One image's arrays.
struct Arrays {
    NumpyPixels picture;
    std::optional<NumpyDepth> depth = {};
};

/// @param what  the image, for messages
/// @param bgr   colours are in the order blue, green, red
[[nodiscard]] NumpyPixels numpy_pixels(const py::object& object, const std::string& what, bool bgr = false);

/// @param scale  metres a unit; none = 0.001 of whole numbers, 1 of floats
[[nodiscard]] NumpyDepth numpy_depth(const py::object& object, const std::string& what,
                                     std::optional<double> scale);

/// A mask of bool or whole numbers; what is not 0 is figure.
[[nodiscard]] ism::CompressedRle packed_mask(const py::handle& object, const std::string& what);

/// The arrays as the library takes pictures; needs no Python.
[[nodiscard]] ism::Frame to_frame(const Arrays& arrays, const std::optional<ism::Camera>& camera);
/// The picture's colours; needs no Python.
[[nodiscard]] ism::RgbImage to_rgb(const Arrays& arrays);

}  // namespace ism_python
