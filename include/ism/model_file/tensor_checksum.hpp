// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "ism/core/number_text.hpp"
#include "ism/model_file/tensor.hpp"

namespace ism::detail {

static_assert(std::endian::native == std::endian::little, "checksums and files are little-endian");

/// @brief The metadata that holds the checksum.
inline constexpr const char* checksum_key = "data_hash";

/// @brief A checksum after FNV-1a (Fowler, Noll, Vo), eight bytes a step. Each step is one-to-one, so a
/// change of any single word changes the result.
class Checksum {
public:
    void add(const void* data, std::size_t count) {
        const char* at = static_cast<const char*>(data);
        for (; count >= 8; count -= 8, at += 8) step(at, 8);
        if (count > 0) step(at, count);
        mix(count);
    }
    void add(const std::string& text) { add(text.data(), text.size()); }
    [[nodiscard]] std::string text() const { return hex_text(state_, 16); }

private:
    void step(const char* at, std::size_t count) {
        std::uint64_t word = 0;
        std::memcpy(&word, at, count);
        mix(word);
    }
    void mix(std::uint64_t word) {
        state_ = (state_ ^ word) * 0x100000001b3u;
        state_ ^= state_ >> 32;
    }
    std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// @brief The checksum of the whole content of a file: metadata, names, types, shapes and numbers.
[[nodiscard]] inline std::string checksum(const TensorFile& file) {
    Checksum sum;
    const auto add_number = [&](std::uint64_t number) { sum.add(&number, sizeof number); };
    for (const auto& [key, text] : file.metadata)
        if (key != checksum_key) sum.add(key), sum.add(text);
    add_number(file.tensors.size());
    for (const auto& [name, tensor] : file.tensors) {
        sum.add(name);
        sum.add(std::string(type_name(tensor.type)));
        add_number(tensor.shape.size());
        for (const std::size_t side : tensor.shape) add_number(side);
        sum.add(tensor.bytes.data(), tensor.bytes.size());
    }
    return sum.text();
}

}  // namespace ism::detail
