// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "ism/codebook/codebook.hpp"
#include "ism/core/error.hpp"

namespace ism {

/// @brief The same words in bytes, a quarter of the memory: for descriptors of bytes, whose means are
/// rounded. How far the descriptors of a word spread about it stays as it was.
/// @throws Error for a number outside 0 … 255.
template <std::size_t Dimension>
[[nodiscard]] Codebook<Dimension, std::uint8_t> in_bytes(const Codebook<Dimension>& codebook) {
    Codebook<Dimension, std::uint8_t> result{.words = Descriptors<std::uint8_t, Dimension>(codebook.size()),
                                             .mean_sq_length = codebook.mean_sq_length,
                                             .group = codebook.group,
                                             .max_sq_distance = codebook.max_sq_distance,
                                             .sizes = codebook.sizes};
    for (std::size_t w = 0; w < codebook.size(); ++w) {
        double longer = 0;  // the squared length of the word
        for (std::size_t k = 0; k < Dimension; ++k) {
            const float exact = codebook.words.row(w)[k];
            expect(exact >= 0 && exact <= 255, "words in bytes", "numbers from 0 to 255", exact);
            const auto byte = std::uint8_t(exact + 0.5f);
            result.words.row(w)[k] = byte;
            longer += double(byte) * byte - double(exact) * double(exact);
        }
        result.mean_sq_length[w] = float(std::max(0.0, double(codebook.mean_sq_length[w]) + longer));
    }
    return result;
}

/// @brief Words as numbers of a kind: as they are, or in_bytes().
template <DescriptorScalar Scalar, std::size_t Dimension>
[[nodiscard]] Codebook<Dimension, Scalar> words_as(Codebook<Dimension> codebook) {
    if constexpr (std::same_as<Scalar, float>)
        return codebook;
    else
        return in_bytes(codebook);
}

}  // namespace ism
