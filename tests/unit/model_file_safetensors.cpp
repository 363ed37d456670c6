// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/core/random.hpp"
#include "ism/model_file/safetensors.hpp"

using ism::FileError;
using ism::Tensor;
using ism::TensorFile;
using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

template <class T>
Tensor tensor_of(std::vector<std::size_t> shape, std::uint64_t seed) {
    ism::Random random(seed);
    std::size_t count = 1;
    for (const std::size_t side : shape) count *= side;
    std::vector<T> values(count);
    for (T& value : values) value = T(random.uniform(0, 250));
    return ism::make_tensor<T>(values, std::move(shape));
}

TensorFile some_tensors() {
    TensorFile file{.metadata = {{"format", "1"}, {"name", "\xc3\xa9 \"quoted\""}}};
    file.tensors = {
        {"bytes", tensor_of<std::uint8_t>({3}, 1)},      {"words", tensor_of<std::uint16_t>({5, 1}, 2)},
        {"counts", tensor_of<std::uint32_t>({2, 2}, 3)}, {"floats", tensor_of<float>({3, 2, 2}, 4)},
        {"doubles", tensor_of<double>({}, 5)},           {"longs", tensor_of<std::int64_t>({1}, 6)},
        {"none", tensor_of<float>({0, 128}, 7)},         {"ints", tensor_of<std::int32_t>({3}, 8)}};
    return file;
}

std::string bytes_of(const TensorFile& file) {
    const TemporaryFolder folder;
    ism::write_safetensors(folder / "t", file);
    return ism::read_text(folder / "t");
}

TensorFile parse(const std::string& bytes) {
    std::istringstream stream(bytes);
    return ism::detail::read_tensors(stream, bytes.size(), "t");
}

std::string parse_error(const std::string& bytes) {
    return error_message<FileError>([&] { (void)parse(bytes); });
}

std::string with_header(const std::string& header, std::size_t data_bytes) {
    std::string bytes(8, '\0');
    const std::uint64_t length = header.size();
    std::memcpy(bytes.data(), &length, 8);
    return bytes + header + std::string(data_bytes, '\0');
}

bool same_content(const TensorFile& a, const TensorFile& b) {
    return a.tensors == b.tensors && a.metadata == b.metadata;
}

}  // namespace

TEST_CASE("Tensors of every type and their texts come back from a file, in the same bytes every time") {
    const TemporaryFolder folder;
    const TensorFile file = some_tensors();
    ism::write_safetensors(folder / "t", file);
    const TensorFile read = ism::read_safetensors(folder / "t");
    CHECK(same_content(read, file));
    CHECK(read.has_checksum);
    CHECK(bytes_of(read) == ism::read_text(folder / "t"));

    const auto floats = ism::values<float>(read, "floats", {3, ism::any_length, 2});
    const auto first = ism::values<float>(file, "floats", {3, 2, 2});
    REQUIRE(floats.size() == 12);
    CHECK(std::vector<float>(floats.begin(), floats.end()) == std::vector<float>(first.begin(), first.end()));
    CHECK(ism::values<float>(read, "none", {ism::any_length, 128}).empty());
    CHECK(ism::values<double>(read, "doubles", {}).size() == 1);
    CHECK(ism::values<std::uint8_t>(read, "bytes", {3})[2] ==
          ism::values<std::uint8_t>(file, "bytes", {3})[2]);
    CHECK(same_content(parse(bytes_of(TensorFile{})), TensorFile{}));
}

TEST_CASE("In the file every tensor begins at a multiple of its type's size") {
    const std::string bytes = bytes_of(some_tensors());
    std::uint64_t header_bytes = 0;
    std::memcpy(&header_bytes, bytes.data(), 8);
    CHECK(header_bytes % 8 == 0);
    const auto header =
        ism::detail::read_header(bytes.substr(8, header_bytes), bytes.size() - 8 - header_bytes, "t");
    CHECK(header.places.size() == 8);
    for (const auto& place : header.places) CHECK(place.begin % ism::type_bytes(place.tensor.type) == 0);
}

TEST_CASE("Asking for a tensor of another name, type or shape is refused") {
    TensorFile file = some_tensors();
    file.source = "file 't'";
    CHECK(error_message<FileError>([&] { (void)ism::values<float>(file, "no", {3}); }) ==
          "file 't': expected a tensor 'no', got none of this name");
    CHECK(error_message<FileError>([&] {
              (void)ism::values<double>(file, "floats", {3, 2, 2});
          }) == "file 't': tensor 'floats': expected F64[3, 2, 2], got F32[3, 2, 2]");
    CHECK(error_message<FileError>([&] {
              (void)ism::values<float>(file, "floats", {ism::any_length, 3});
          }) == "file 't': tensor 'floats': expected F32[any, 3], got F32[3, 2, 2]");
    CHECK(error_message([] {
              (void)ism::make_tensor<float>(std::vector<float>(5), {2, 3});
          }) == "number of values: expected [2, 3], got 5");
    file.tensors["floats"].bytes.pop_back();
    CHECK_THROWS_AS(ism::values<float>(file, "floats", {3, 2, 2}), FileError);
}

TEST_CASE("A tensor file cut or lengthened by any amount is refused") {
    const std::string bytes = bytes_of(some_tensors());
    REQUIRE(parse_error(bytes) == "nothing thrown");
    for (std::size_t count = 0; count < bytes.size(); ++count)
        REQUIRE(parse_error(bytes.substr(0, count)) != "nothing thrown");
    CHECK(parse_error(bytes + "x") != "nothing thrown");
    CHECK(parse_error("") == "t: expected a safetensors file, got 0 bytes");
}

TEST_CASE("A tensor file with any bit changed is refused, or says the same") {
    const TensorFile file = some_tensors();
    const std::string bytes = bytes_of(file);
    std::uint64_t header_bytes = 0;
    std::memcpy(&header_bytes, bytes.data(), 8);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        for (int bit = 0; bit < 8; ++bit) {
            std::string changed = bytes;
            changed[i] = char(changed[i] ^ (1 << bit));
            try {
                const TensorFile read = parse(changed);
                // what passes is blanks, or has lost the name of its checksum
                REQUIRE(i < 8 + header_bytes);
                REQUIRE((read.has_checksum ? same_content(read, file) : read.tensors == file.tensors));
            } catch (const FileError&) {
            }
        }
}

TEST_CASE("Headers that contradict themselves or the file are refused before memory is taken") {
    const auto one = [](const std::string& dtype, const std::string& shape, const std::string& offsets) {
        return R"({"a":{"dtype":")" + dtype + R"(","shape":)" + shape + R"(,"data_offsets":)" + offsets +
               "}}";
    };
    CHECK(parse_error(with_header(one("F32", "[2]", "[0,8]"), 8)) == "nothing thrown");
    CHECK(parse_error(with_header(one("F32", "[2]", "[0,8]"), 9)) == "t: bytes of data: expected 8, got 9");
    CHECK(parse_error(with_header(one("F32", "[2]", "[0,8]"), 7)) ==
          "t, tensor 'a': data_offsets: expected 8 bytes of data, got 7: the file may be cut off");
    CHECK(parse_error(with_header(one("F32", "[2]", "[8,0]"), 8)) ==
          "t, tensor 'a': data_offsets: expected begin <= end <= 8, got 8, 0");
    CHECK(parse_error(with_header(one("F32", "[2]", "[4,12]"), 12)) ==
          "t: tensor 'a', begin: expected 0, got 4");
    CHECK(parse_error(with_header(one("F32", "[3]", "[0,8]"), 8)) ==
          "t, tensor 'a': data_offsets: expected room for F32[3], got 8 bytes");
    // 2^62 · 4 bytes = 0 where products wrap around
    CHECK(parse_error(with_header(one("F32", "[2147483648,2147483648]", "[0,0]"), 0)) ==
          "t, tensor 'a': data_offsets: expected room for F32[2147483648, 2147483648], got 0 bytes");
    CHECK(parse_error(with_header(one("F32", "[9223372036854775807,9223372036854775807,4]", "[0,8]"), 8)) !=
          "nothing thrown");
    CHECK(parse_error(with_header(one("F32", "[-2]", "[0,8]"), 8)) ==
          "t, tensor 'a': shape: expected numbers of 0 or more, got -2");
    CHECK(parse_error(with_header(one("F16", "[4]", "[0,8]"), 8)) ==
          "t, tensor 'a': dtype: expected one of F64, I64, F32, I32, U32, U16, U8, got 'F16'");
    CHECK(parse_error(with_header(R"({"a":3})", 0)) == "t, tensor 'a': expected an object, got 3");
    CHECK(parse_error(with_header(R"({"__metadata__":{"a":1}})", 0)) ==
          "t: __metadata__ 'a': expected a text, got 1");
    CHECK(parse_error(with_header("[]", 0)) ==
          "t: expected a header that begins with '{', got another character");
    CHECK(parse_error(with_header("{\"a\"", 0))
              .starts_with("t, header: expected well-formed JSON, got parse error"));
    CHECK(parse_error(std::string(7, '\xff') + "\x7f" + "{}") ==
          "t: expected a safetensors file, as models are, got something else (a header of "
          "9223372036854775807 bytes)");
    const std::string overlap = R"({"a":{"dtype":"U8","shape":[4],"data_offsets":[0,4]},)"
                                R"("b":{"dtype":"U8","shape":[4],"data_offsets":[2,6]}})";
    CHECK(parse_error(with_header(overlap, 6)) == "t: tensor 'b', begin: expected 4, got 2");
}

TEST_CASE("Tensor files that cannot be written are refused") {
    const TemporaryFolder folder;
    const auto error = [&](const TensorFile& file) {
        return error_message<FileError>([&] { ism::write_safetensors(folder / "t", file); });
    };
    const std::string at = "file '" + (folder / "t").string() + "'";
    TensorFile file = some_tensors();
    file.tensors["floats"].bytes.pop_back();
    CHECK(error(file) == at + ", tensor 'floats': bytes: expected F32[3, 2, 2], got 47");
    CHECK(error({.metadata = {{"a", "\xff"}}}) == at + ": expected names in UTF-8, got other bytes");
    CHECK(error({.metadata = {{"data_hash", "1"}}}) ==
          at + ": expected other names than '__metadata__' and 'data_hash', got one of them");
    CHECK(error({.metadata = {{"long", std::string(20'000'000, 'x')}}})
              .starts_with(at + ": bytes of header: "));
    CHECK_FALSE(std::filesystem::exists(folder / "t"));
    CHECK(error_message<FileError>([&] { (void)ism::read_safetensors(folder / "t"); }) ==
          at + ": expected a file to read, got none of this name");
    CHECK_THROWS_AS(ism::read_safetensors(folder.path()), FileError);
}
