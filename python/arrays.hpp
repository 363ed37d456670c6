// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <pybind11/numpy.h>

#include "ism/adapt/pixels.hpp"

namespace ism_python {

namespace py = pybind11;

/// The pixels of a numpy array where they are; of another array where they do not lie in rows. Keeps the
/// array.
struct NumpyPixels {
    py::array array;
    ism::RawPixels pixels;
};

/// "uint8 of shape (480, 640, 3)", for messages.
inline std::string array_text(const py::handle& object) {
    if (!py::isinstance<py::array>(object)) return py::str(py::type::of(object).attr("__name__"));
    return py::str("{} of shape {}").format(object.attr("dtype"), object.attr("shape"));
}

/// @param what  the image, for messages
/// @param bgr   colours are in the order blue, green, red
inline NumpyPixels numpy_pixels(const py::object& object, const std::string& what, bool bgr = false) {
    const auto refuse = [&](bool holds) {
        ism::expect(holds, what,
                    "a numpy array of uint8, uint16, float32 or float64 of shape (height, width) or (height, "
                    "width, 1, 3 or 4)",
                    array_text(object));
    };
    refuse(py::isinstance<py::array>(object));
    py::array array = py::reinterpret_borrow<py::array>(object);
    const char kind = array.dtype().kind();
    if (kind == 'f' && array.itemsize() == 8) array = array.attr("astype")("float32");
    const py::ssize_t size = array.itemsize();
    refuse((kind == 'u' && (size == 1 || size == 2)) || (kind == 'f' && size == 4));
    refuse(array.ndim() == 2 || array.ndim() == 3);
    const py::ssize_t channels = array.ndim() == 3 ? array.shape(2) : 1;
    refuse(channels == 1 || channels == 3 || channels == 4);
    refuse(array.shape(0) > 0 && array.shape(1) > 0 && array.shape(0) <= ism::max_image_side &&
           array.shape(1) <= ism::max_image_side);
    const bool in_rows =
        array.strides(1) == channels * size && (array.ndim() == 2 || array.strides(2) == size);
    if (!in_rows || std::abs(array.strides(0)) < array.shape(1) * channels * size)
        array = py::module_::import("numpy").attr("ascontiguousarray")(array);
    ism::PixelFormat format = channels == 1   ? ism::pixel_format::gray8
                              : channels == 3 ? ism::pixel_format::rgb8
                                              : ism::pixel_format::rgba8;
    if (bgr) std::swap(format.red, format.blue);
    format.sample = size == 1 ? ism::Sample::uint8 : size == 2 ? ism::Sample::uint16 : ism::Sample::float32;
    format.swapped = !py::cast<bool>(array.dtype().attr("isnative"));
    return {array, {array.data(), int(array.shape(1)), int(array.shape(0)), array.strides(0), format}};
}

/// One image's arrays.
struct Arrays {
    NumpyPixels picture;
    std::optional<NumpyPixels> depth = {};
    double depth_scale = 0;  ///< metres a unit, of whole numbers; floats are metres
};

/// The arrays as the library takes pictures; needs no Python.
ism::Frame to_frame(const Arrays& arrays, const std::optional<ism::Camera>& camera);

}  // namespace ism_python
