// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "ism/io/json.hpp"

namespace ism_python {

namespace py = pybind11;
using ism::detail::Json;

/// The type of an object, of an array of numpy with its shape: "uint8 of shape (480, 640, 3)"; for messages.
[[nodiscard]] std::string type_text(const py::handle& object);

/// A dict as JSON, where numbers and arrays may also be of numpy, and packed masks bytes. A mask of numpy as
/// "segmentation" is packed.
/// @param place  what it is, for messages
/// @throws ism::Error, telling the way to it, for what JSON does not hold, such as NaN.
[[nodiscard]] Json to_json(const py::object& object, const std::string& place);

[[nodiscard]] py::object to_python(const Json& json);

/// Tells a warning by `warnings`.
void warn(const std::string& text);

}  // namespace ism_python
