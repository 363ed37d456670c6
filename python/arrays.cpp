// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "arrays.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "values.hpp"

namespace ism_python {

namespace {

/// An array of at most max_image_side a side as pixels.
/// @param channels  numbers of a pixel
NumpyPixels in_rows(py::array array, py::ssize_t channels) {
    const py::ssize_t size = array.itemsize();
    const bool in_rows =
        array.strides(1) == channels * size && (array.ndim() == 2 || array.strides(2) == size);
    if (!in_rows || std::abs(array.strides(0)) < array.shape(1) * channels * size)
        array = py::module_::import("numpy").attr("ascontiguousarray")(array);
    ism::PixelFormat format = channels == 1   ? ism::pixel_format::gray8
                              : channels == 3 ? ism::pixel_format::rgb8
                                              : ism::pixel_format::rgba8;
    format.sample = size == 1 ? ism::Sample::uint8 : size == 2 ? ism::Sample::uint16 : ism::Sample::float32;
    format.swapped = !py::cast<bool>(array.dtype().attr("isnative"));
    return {array, {array.data(), int(array.shape(1)), int(array.shape(0)), array.strides(0), format}};
}

bool is_size(const py::array& array) {
    return array.shape(0) > 0 && array.shape(1) > 0 && array.shape(0) <= ism::max_image_side &&
           array.shape(1) <= ism::max_image_side;
}

py::ssize_t channels_of(const py::array& array) {
    return array.ndim() == 3 ? array.shape(2) : 1;
}

bool is_wide_number(const py::dtype& type) {
    const char kind = type.kind();
    const py::ssize_t size = type.itemsize();
    return ((kind == 'i' || kind == 'u') && size >= 2) || (kind == 'f' && (size == 4 || size == 8));
}

}  // namespace

NumpyPixels numpy_pixels(const py::object& object, const std::string& what, bool bgr) {
    const auto refuse = [&](bool holds) {
        ism::expect(holds, what,
                    "a numpy array of uint8, uint16, float32 or float64 of shape (height, width) or (height, "
                    "width, 1, 3 or 4)",
                    type_text(object));
    };
    refuse(py::isinstance<py::array>(object));
    py::array array = py::reinterpret_borrow<py::array>(object);
    const char kind = array.dtype().kind();
    if (kind == 'f' && array.itemsize() == 8) array = array.attr("astype")("float32");
    const py::ssize_t size = array.itemsize();
    refuse((kind == 'u' && (size == 1 || size == 2)) || (kind == 'f' && size == 4));
    refuse(array.ndim() == 2 || array.ndim() == 3);
    const py::ssize_t channels = channels_of(array);
    refuse(channels == 1 || channels == 3 || channels == 4);
    refuse(is_size(array));
    NumpyPixels numpy = in_rows(std::move(array), channels);
    if (bgr) std::swap(numpy.pixels.format.red, numpy.pixels.format.blue);
    return numpy;
}

NumpyDepth numpy_depth(const py::object& object, const std::string& what, std::optional<double> scale) {
    const auto refuse = [&](bool holds) {
        ism::expect(holds, what,
                    "a numpy array of whole numbers of 16 to 64 bits (units of depth_scale), float32 or "
                    "float64 (metres), of shape (height, width)",
                    type_text(object));
    };
    ism::expect(!scale || (std::isfinite(*scale) && *scale > 0), "depth_scale", "metres a unit, above 0",
                scale.value_or(0));
    refuse(py::isinstance<py::array>(object));
    py::array array = py::reinterpret_borrow<py::array>(object);
    refuse(is_wide_number(array.dtype()));
    refuse(array.ndim() == 2 || array.ndim() == 3);
    refuse(channels_of(array) == 1 && is_size(array));
    const char kind = array.dtype().kind();
    const double metres = scale.value_or(kind == 'f' ? 1 : 0.001);
    if (kind == 'f')
        return {in_rows(array.itemsize() == 4 ? array : array.attr("astype")("float32"), 1), metres};
    if (kind == 'u' && array.itemsize() == 2) return {in_rows(std::move(array), 1), metres};
    const py::object in_metres = array.attr("astype")("float64") * py::float_(metres);
    return {in_rows(in_metres.attr("astype")("float32"), 1), 1};
}

ism::CompressedRle packed_mask(const py::handle& object, const std::string& what) {
    const py::array array = py::array::ensure(object);
    const char kind = array ? array.dtype().kind() : ' ';
    ism::expect(array && array.ndim() == 2 && (kind == 'b' || kind == 'i' || kind == 'u'), what,
                "a mask of bool or whole numbers of shape (height, width)",
                type_text(array ? py::handle(array) : object));
    const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast> figure(
        array.attr("__ne__")(0));
    return ism::at_place(what, [&] {
        return ism::compress_mask(
            {figure.data(), int(figure.shape(1)), int(figure.shape(0)), std::ptrdiff_t(figure.shape(1))});
    });
}

ism::Frame to_frame(const Arrays& arrays, const std::optional<ism::Camera>& camera) {
    const ism::RawPixels& picture = arrays.picture.pixels;
    if (!arrays.depth) return ism::to_frame(picture, camera);
    return ism::to_frame(picture, arrays.depth->units.pixels, arrays.depth->scale, camera);
}

ism::RgbImage to_rgb(const Arrays& arrays) {
    return ism::to_rgb(arrays.picture.pixels);
}

}  // namespace ism_python
