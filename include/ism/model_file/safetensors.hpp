// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <ostream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "ism/io/json.hpp"
#include "ism/io/write_file.hpp"
#include "ism/model_file/safetensors_header.hpp"
#include "ism/model_file/tensor.hpp"
#include "ism/model_file/tensor_checksum.hpp"

namespace ism {

namespace detail {

/// @brief The longest header that is read or written.
inline constexpr std::size_t max_header_bytes = std::size_t(1) << 24;

/// @brief Where each tensor lies in the file's data, in the order of the data. Types of more bytes come
/// first, so every tensor begins at a multiple of its type's bytes.
[[nodiscard]] inline std::vector<std::pair<std::string, const Tensor*>> storage_order(
    const TensorFile& file) {
    std::vector<std::pair<std::string, const Tensor*>> order;
    for (const auto& [name, tensor] : file.tensors) order.emplace_back(name, &tensor);
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
        return type_bytes(a.second->type) > type_bytes(b.second->type);
    });
    return order;
}

/// @brief Reads from a stream of `file_bytes` bytes.
[[nodiscard]] inline TensorFile read_tensors(std::istream& stream, std::size_t file_bytes,
                                             std::string source) {
    TensorFile file;
    file.source = std::move(source);
    const auto read = [&](void* to, std::size_t count) {
        stream.read(static_cast<char*>(to), std::streamsize(count));
        expect<FileError>(std::size_t(stream.gcount()) == count, file.source, lazy_text(count, " more bytes"),
                          stream.gcount());
    };
    std::uint64_t header_bytes = 0;
    expect<FileError>(file_bytes >= 8, file.source, "a safetensors file", lazy_text(file_bytes, " bytes"));
    read(&header_bytes, 8);
    expect<FileError>(header_bytes >= 2 && header_bytes <= std::min(max_header_bytes, file_bytes - 8),
                      file.source, "a safetensors file, as models are",
                      lazy_text("something else (a header of ", header_bytes, " bytes)"));
    std::string text(std::size_t(header_bytes), ' ');
    read(text.data(), text.size());
    expect<FileError>(text[0] == '{', file.source, "a header that begins with '{'", "another character");
    const std::size_t data_bytes = file_bytes - 8 - text.size();
    TensorHeader header = read_header(text, data_bytes, file.source);
    file.metadata = std::move(header.metadata);
    for (TensorPlace& place : header.places) {
        place.tensor.bytes.resize(place.end - place.begin);
        read(place.tensor.bytes.data(), place.tensor.bytes.size());
        file.tensors.emplace(std::move(place.name), std::move(place.tensor));
    }
    if (const auto stated = file.metadata.find(checksum_key); stated != file.metadata.end()) {
        expect<FileError>(stated->second == checksum(file), file.source, "unchanged content (checksum)",
                          "altered content");
        file.metadata.erase(stated);
        file.has_checksum = true;
    }
    return file;
}

}  // namespace detail

/// @brief Reads a safetensors file (Hugging Face; 8 bytes length of the header, header in JSON, data). All
/// the header says is checked against the file's size before memory is taken for the data, and where the
/// metadata has "data_hash" (which is then taken out of it) the content is checked too.
/// @throws FileError where the file cannot be read, is cut off or longer than it says, holds types other than
/// TensorType, contradicts itself, or was altered.
[[nodiscard]] inline TensorFile read_safetensors(const std::filesystem::path& path) {
    const std::string text = file_text(path);
    std::error_code failure;
    if (!std::filesystem::exists(path, failure))
        throw FileError(text + ": expected a file to read, got none of this name");
    if (!std::filesystem::is_regular_file(path, failure))
        throw FileError(text + ": expected a file to read, got a folder or device");
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    const auto bytes = std::filesystem::file_size(path, failure);
    if (!stream || failure)
        throw FileError(text + ": expected a readable file, got " + detail::system_reason());
    return detail::read_tensors(stream, bytes, text);
}

namespace detail {

/// @brief What a safetensors file begins with: the length of the header, and the header.
/// @param text  the file, for messages
[[nodiscard]] inline std::string file_head(const TensorFile& file, const std::string& text) {
    if (file.tensors.contains("__metadata__") || file.metadata.contains(checksum_key))
        throw FileError(text + ": expected other names than '__metadata__' and 'data_hash', got one of them");
    Json header = {{"__metadata__", file.metadata}};
    header["__metadata__"][checksum_key] = checksum(file);
    std::size_t end = 0;
    for (const auto& [name, tensor] : storage_order(file)) {
        expect<FileError>(shape_fills(tensor->shape, tensor->type, tensor->bytes.size()),
                          lazy_text(text, ", tensor '", name, "': bytes"),
                          lazy_text(type_name(tensor->type), shape_text(tensor->shape)),
                          tensor->bytes.size());
        header[name] = {{"dtype", std::string(type_name(tensor->type))},
                        {"shape", tensor->shape},
                        {"data_offsets", {end, end + tensor->bytes.size()}}};
        end += tensor->bytes.size();
    }
    std::string head = dump_json(header, text);
    head.append((8 - head.size() % 8) % 8, ' ');  // the data begin at a multiple of 8
    expect<FileError>(head.size() <= max_header_bytes, lazy_text(text, ": bytes of header"),
                      lazy_text("up to ", max_header_bytes), head.size());
    const std::uint64_t length = head.size();
    return std::string(reinterpret_cast<const char*>(&length), 8) + head;
}

/// @brief Writes to a stream what follows after its head.
inline void write_data(std::ostream& stream, const TensorFile& file) {
    for (const auto& [name, tensor] : storage_order(file))
        stream.write(reinterpret_cast<const char*>(tensor->bytes.data()),
                     std::streamsize(tensor->bytes.size()));
}

}  // namespace detail

/// @brief Writes a safetensors file atomically, with a checksum in the metadata as "data_hash". The same
/// content gives the same bytes.
/// @throws FileError where the file cannot be written, a name or text is not UTF-8, a name is "__metadata__",
/// the metadata has "data_hash", a tensor's bytes do not fit its shape, or the header becomes too long.
inline void write_safetensors(const std::filesystem::path& path, const TensorFile& file) {
    const std::string head = detail::file_head(file, file_text(path));
    write_file(path, [&](std::ostream& stream) {
        stream.write(head.data(), std::streamsize(head.size()));
        detail::write_data(stream, file);
    });
}

}  // namespace ism
