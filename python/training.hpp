// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "model.hpp"

namespace ism_python {

/// How a model is learnt.
struct Training {
    std::string detector, descriptor, orientation;
    bool templates = true;
    std::size_t max_words = 0, max_features = 0;
    std::optional<double> depth_scale = {};  ///< metres a unit; none = by what the numbers are
    std::string order = "rgb";
    std::uint64_t seed = 1;
    unsigned threads = 0;
    py::object progress = py::none();  ///< called with stage, done, total
};

/// Learns as the program does, and warns of what it tells. Signals, such as that of Ctrl-C, are heard at each
/// step.
/// @param coco    COCO's dict
/// @param images  arrays by image id, or in the order of coco["images"]; so depths, which may be None
[[nodiscard]] PythonModel train(const py::object& coco, const py::object& images, const py::object& depths,
                                const Training& training);

}  // namespace ism_python
