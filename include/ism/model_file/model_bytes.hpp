// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>
#include <utility>

#include "ism/model/model.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/model_file/safetensors.hpp"

/// Models in memory, to be sent to another process or kept in a file among others.
namespace ism {

/// @brief The bytes of the file that save_model() writes.
/// @throws FileError as save_model() does.
[[nodiscard]] inline std::string model_to_bytes(const Model& model) {
    const std::string source = "model";
    const TensorFile file = detail::model_to_tensors(model, source);
    static_cast<void>(detail::model_from_tensors(file));
    std::ostringstream stream;
    stream << detail::file_head(file, source);
    detail::write_data(stream, file);
    return std::move(stream).str();
}

/// @brief The model of these bytes.
/// @throws FileError as load_model() does.
[[nodiscard]] inline Model model_from_bytes(const std::string& bytes) {
    std::istringstream stream(bytes);
    const TensorFile file = detail::read_tensors(stream, bytes.size(), "model");
    detail::check_model(file);
    return detail::model_from_tensors(file);
}

}  // namespace ism
