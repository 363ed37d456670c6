// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"

namespace ism {

/// @brief What the numbers of a tensor may be.
enum class TensorType { f64, i64, f32, i32, u32, u16, u8 };

/// @brief Their C++ types.
template <class T>
concept TensorScalar = std::same_as<T, double> || std::same_as<T, std::int64_t> || std::same_as<T, float> ||
    std::same_as<T, std::int32_t> || std::same_as<T, std::uint32_t> || std::same_as<T, std::uint16_t> ||
    std::same_as<T, std::uint8_t>;

/// @brief The TensorType of a C++ type.
template <TensorScalar T>
inline constexpr TensorType tensor_type = std::same_as<T, double>          ? TensorType::f64
                                          : std::same_as<T, std::int64_t>  ? TensorType::i64
                                          : std::same_as<T, float>         ? TensorType::f32
                                          : std::same_as<T, std::int32_t>  ? TensorType::i32
                                          : std::same_as<T, std::uint32_t> ? TensorType::u32
                                          : std::same_as<T, std::uint16_t> ? TensorType::u16
                                                                           : TensorType::u8;

/// @brief The name of a type in files.
[[nodiscard]] constexpr std::string_view type_name(TensorType type) {
    constexpr std::string_view names[] = {"F64", "I64", "F32", "I32", "U32", "U16", "U8"};
    return names[static_cast<int>(type)];
}

/// @brief Bytes of one number.
[[nodiscard]] constexpr std::size_t type_bytes(TensorType type) {
    constexpr std::size_t bytes[] = {8, 8, 4, 4, 4, 2, 1};
    return bytes[static_cast<int>(type)];
}

/// @brief Numbers in rows, the last side running fastest.
struct Tensor {
    TensorType type = TensorType::f32;
    std::vector<std::size_t> shape = {};  ///< sides; none = a single number
    std::vector<std::byte> bytes = {};    ///< product of the sides times type_bytes()
    [[nodiscard]] bool operator==(const Tensor&) const = default;
};

/// @brief Named tensors and a table of texts.
struct TensorFile {
    std::map<std::string, std::string> metadata = {};
    std::map<std::string, Tensor> tensors = {};
    std::string source = "tensors";  ///< where they come from, for messages
    bool has_checksum = false;       ///< read from a file with a checksum, which was right
};

/// @brief Stands for a side of any length in values().
inline constexpr std::size_t any_length = static_cast<std::size_t>(-1);

namespace detail {

[[nodiscard]] inline std::string shape_text(std::span<const std::size_t> shape) {
    std::string text = "[";
    for (std::size_t i = 0; i < shape.size(); ++i)
        text +=
            (i == 0 ? "" : ", ") + (shape[i] == any_length ? std::string("any") : std::to_string(shape[i]));
    return text + "]";
}

/// @brief Whether a tensor of these sides has exactly `bytes` bytes; no product overflows.
[[nodiscard]] inline bool shape_fills(std::span<const std::size_t> shape, TensorType type,
                                      std::size_t bytes) {
    if (std::find(shape.begin(), shape.end(), std::size_t(0)) != shape.end()) return bytes == 0;
    std::size_t product = type_bytes(type);
    for (const std::size_t side : shape) {
        if (side > bytes / product) return false;
        product *= side;
    }
    return product == bytes;
}

}  // namespace detail

/// @brief A tensor of these numbers.
/// @throws Error where their count is not the product of the sides.
template <TensorScalar T>
[[nodiscard]] Tensor make_tensor(std::span<const T> values, std::vector<std::size_t> shape) {
    expect(detail::shape_fills(shape, tensor_type<T>, values.size_bytes()), "number of values",
           detail::shape_text(shape), values.size());
    const auto bytes = std::as_bytes(values);
    return {tensor_type<T>, std::move(shape), std::vector<std::byte>(bytes.begin(), bytes.end())};
}

/// @brief The tensor of this name.
/// @throws FileError where there is none.
[[nodiscard]] inline const Tensor& tensor(const TensorFile& file, const std::string& name) {
    const auto found = file.tensors.find(name);
    if (found == file.tensors.end())
        throw FileError(join_text(file.source, ": expected a tensor '", name, "', got none of this name"));
    return found->second;
}

/// @brief The numbers of the tensor `name`, row after row; any_length in `shape` stands for any side.
/// @throws FileError where there is no such tensor or it is of another type or shape.
template <TensorScalar T>
[[nodiscard]] std::span<const T> values(const TensorFile& file, const std::string& name,
                                        std::span<const std::size_t> shape) {
    const Tensor& found = tensor(file, name);
    bool fits = found.type == tensor_type<T> && found.shape.size() == shape.size() &&
                detail::shape_fills(found.shape, found.type, found.bytes.size());
    for (std::size_t i = 0; fits && i < shape.size(); ++i)
        fits = shape[i] == any_length || shape[i] == found.shape[i];
    if (!fits)
        throw FileError(join_text(file.source, ": tensor '", name, "': expected ", type_name(tensor_type<T>),
                                  detail::shape_text(shape), ", got ", type_name(found.type),
                                  detail::shape_text(found.shape)));
    return {reinterpret_cast<const T*>(found.bytes.data()), found.bytes.size() / sizeof(T)};
}

/// @brief values() with the shape written in braces.
template <TensorScalar T>
[[nodiscard]] std::span<const T> values(const TensorFile& file, const std::string& name,
                                        std::initializer_list<std::size_t> shape) {
    return values<T>(file, name, std::span<const std::size_t>(shape.begin(), shape.size()));
}

/// The numbers live in the file's tensors: one that is about to go away cannot be asked.
template <TensorScalar T>
std::span<const T> values(const TensorFile&& file, const std::string& name,
                          std::span<const std::size_t> shape) = delete;
template <TensorScalar T>
std::span<const T> values(const TensorFile&& file, const std::string& name,
                          std::initializer_list<std::size_t> shape) = delete;

}  // namespace ism
