// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <pybind11/numpy.h>

#include "ism/model/model.hpp"

namespace ism_python {

namespace py = pybind11;

/// The image that is searched, and how.
struct Search {
    py::object image, depth, camera;
    std::string space = "auto";
    std::optional<double> min_score = {};    ///< none = the program's
    int turns = 1;                           ///< angles by which the image is turned
    std::optional<double> depth_scale = {};  ///< metres a unit; none = by what the numbers are
    std::string order = "rgb";
    unsigned threads = 0;
};

/// What Python knows as Model.
class PythonModel {
public:
    ism::Model model;

    [[nodiscard]] static PythonModel load(const std::filesystem::path& path);
    void save(const std::filesystem::path& path) const;
    /// The bytes of the file, and back: for pickle.
    [[nodiscard]] py::bytes to_bytes() const;
    [[nodiscard]] static PythonModel from_bytes(const py::bytes& bytes);
    [[nodiscard]] std::string text() const;

    [[nodiscard]] py::list categories() const;
    void set_categories(const py::object& dicts);
    [[nodiscard]] py::dict info() const;

    [[nodiscard]] py::object detect(const Search& search, std::int64_t image_id) const;
    /// The picture of what is found, and that of why one of it was; as arrays.
    [[nodiscard]] py::array draw(const Search& search) const;
    [[nodiscard]] py::array explain(const Search& search, std::int64_t which) const;
};

/// @throws ism::Error for another order than rgb and bgr.
[[nodiscard]] bool is_bgr(const std::string& order);

}  // namespace ism_python
