// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ism/io/json.hpp"
#include "ism/model_file/tensor.hpp"

namespace ism::detail {

[[nodiscard]] inline TensorType type_from_json(const Json& record, const std::string& place) {
    const std::string& name = text_member(record, "dtype", place);
    for (const TensorType type : {TensorType::f64, TensorType::i64, TensorType::f32, TensorType::i32,
                                  TensorType::u32, TensorType::u16, TensorType::u8})
        if (name == type_name(type)) return type;
    refuse_json(place, "dtype", "one of F64, I64, F32, I32, U32, U16, U8",
                join_text("'", name.substr(0, 40), "'"));
}

/// @brief A tensor without its data, and where in the data it lies.
struct TensorPlace {
    std::string name;
    Tensor tensor;
    std::size_t begin = 0, end = 0;
};

[[nodiscard]] inline TensorPlace place_from_json(const std::string& name, const Json& record,
                                                 std::size_t data_bytes, const std::string& place) {
    TensorPlace result{name, {.type = type_from_json(record, place)}};
    const auto natural = [&](const Json& value, const char* what) {
        const std::int64_t number = to_integer(value, what, place);
        if (number < 0) refuse_json(place, what, "numbers of 0 or more", json_text(value));
        return static_cast<std::size_t>(number);
    };
    for (const Json& side : array_member(record, "shape", place))
        result.tensor.shape.push_back(natural(side, "shape"));
    const Json& offsets = array_member(record, "data_offsets", place);
    if (offsets.size() != 2) refuse_json(place, "data_offsets", "begin and end", json_text(offsets));
    result.begin = natural(offsets[0], "data_offsets"), result.end = natural(offsets[1], "data_offsets");
    if (result.begin <= result.end && result.end > data_bytes)
        refuse_json(place, "data_offsets", join_text(result.end, " bytes of data"),
                    join_text(data_bytes, ": the file may be cut off"));
    if (result.begin > result.end)
        refuse_json(place, "data_offsets", join_text("begin <= end <= ", data_bytes),
                    join_text(result.begin, ", ", result.end));
    if (!shape_fills(result.tensor.shape, result.tensor.type, result.end - result.begin))
        refuse_json(place, "data_offsets",
                    join_text("room for ", type_name(result.tensor.type), shape_text(result.tensor.shape)),
                    join_text(result.end - result.begin, " bytes"));
    return result;
}

/// @brief The content of a header.
struct TensorHeader {
    std::map<std::string, std::string> metadata;
    std::vector<TensorPlace> places;  ///< in the order of the data
};

/// @brief Reads the header of a file with `data_bytes` bytes of data.
/// @throws FileError where it is no such header, or its tensors do not fill the data without gap and overlap.
[[nodiscard]] inline TensorHeader read_header(std::string_view text, std::size_t data_bytes,
                                              const std::string& source) {
    const Json root = parse_json(text, source + ", header");
    if (!root.is_object()) throw FileError(source + ", header: expected an object, got " + json_text(root));
    TensorHeader header;
    for (const auto& [name, record] : root.items()) {
        if (name != "__metadata__") {
            header.places.push_back(
                place_from_json(name, record, data_bytes, source + ", tensor '" + name + "'"));
            continue;
        }
        if (!record.is_object()) refuse_json(source, name, "an object of texts", json_text(record));
        for (const auto& [key, value] : record.items()) {
            if (!value.is_string()) refuse_json(source, name + " '" + key + "'", "a text", json_text(value));
            header.metadata[key] = value.get<std::string>();
        }
    }
    std::sort(header.places.begin(), header.places.end(), [](const TensorPlace& a, const TensorPlace& b) {
        return std::pair(a.begin, a.end) < std::pair(b.begin, b.end);
    });
    std::size_t end = 0;
    for (const TensorPlace& place : header.places) {
        if (place.begin != end)
            refuse_json(source, "tensor '" + place.name + "', begin", join_text(end), join_text(place.begin));
        end = place.end;
    }
    if (end != data_bytes) refuse_json(source, "bytes of data", join_text(end), join_text(data_bytes));
    return header;
}

}  // namespace ism::detail
