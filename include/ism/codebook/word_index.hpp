// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "ism/codebook/byte_filter.hpp"
#include "ism/codebook/codebook.hpp"
#include "ism/codebook/exact_dot.hpp"
#include "ism/codebook/float_filter.hpp"
#include "ism/core/error.hpp"

namespace ism {

/// @brief The words of a codebook made ready for match(): for a codebook that is asked many times. It keeps
/// what it needs of the codebook, which may go. May be asked from several threads at once.
template <std::size_t Dimension, DescriptorScalar Scalar = float>
class WordIndex {
public:
    /// @param isa  for tests and measurements: matches are the same bits for each, only the time differs
    /// @throws Error for words or lengths that are not finite, lists of different lengths, a threshold that
    /// is negative or NaN, or an instruction set that the processor lacks.
    explicit WordIndex(const Codebook<Dimension, Scalar>& codebook,
                       InstructionSet isa = best_instruction_set());

    /// @brief Number of words.
    [[nodiscard]] std::size_t size() const { return mean_sq_length_.size(); }
    [[nodiscard]] double max_sq_distance() const { return max_sq_distance_; }
    /// @brief Number of groups that have words.
    [[nodiscard]] std::size_t groups() const { return groups_; }
    /// @brief Number of the group of a word among those that have words.
    [[nodiscard]] std::uint32_t group(std::size_t word) const { return group_[word]; }

    /// @brief Squared length of a descriptor, in double.
    [[nodiscard]] double sq_length(std::span<const float, Dimension> descriptor) const {
        return length_(descriptor.data(), descriptor.data(), Dimension);
    }
    /// @brief The distance of a descriptor to a word: see Codebook. The same bits on every processor.
    /// @param sq_length  that of the descriptor
    [[nodiscard]] double sq_distance(std::span<const float, Dimension> descriptor, double sq_length,
                                     std::size_t word) const {
        return sq_length + double(mean_sq_length_[word]) -
               2 * dot_(descriptor.data(), words_.data() + word * Dimension, Dimension);
    }

    /// @brief What tells candidates: detail::ByteFilter or detail::FloatFilter.
    [[nodiscard]] const auto& filter() const { return filter_; }

private:
    std::vector<Scalar> words_;
    std::vector<float> mean_sq_length_;
    std::vector<std::uint32_t> group_;
    std::size_t groups_ = 0;
    double max_sq_distance_ = 0;
    detail::Dot<float>* length_;
    detail::Dot<Scalar>* dot_;
    std::variant<detail::FloatFilter, detail::ByteFilter> filter_;
};

template <std::size_t Dimension, DescriptorScalar Scalar>
WordIndex<Dimension, Scalar>::WordIndex(const Codebook<Dimension, Scalar>& codebook, InstructionSet isa)
    : words_(codebook.words.values().begin(), codebook.words.values().end()),
      mean_sq_length_(codebook.mean_sq_length),
      group_(codebook.group),
      max_sq_distance_(codebook.max_sq_distance),
      length_(detail::exact_dot<float>(isa)),
      dot_(detail::exact_dot<Scalar>(isa)) {
    expect(has_instruction_set(isa), "matching: instruction set", "one that the processor has", int(isa));
    expect(codebook.mean_sq_length.size() == codebook.size() && codebook.group.size() == codebook.size(),
           "matching: mean square lengths and groups of words", codebook.size(),
           lazy_text(codebook.mean_sq_length.size(), ", ", codebook.group.size()));
    expect(max_sq_distance_ >= 0, "matching: largest squared distance", "0 or more", max_sq_distance_);
    std::vector<float> converted;
    std::span<const float> words;
    if constexpr (std::same_as<Scalar, float>)
        words = words_;
    else
        converted.assign(words_.begin(), words_.end()), words = converted;
    for (const std::span<const float> values : {words, std::span<const float>(mean_sq_length_)}) {
        const auto bad =
            std::find_if_not(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
        expect(bad == values.end(), "matching: words", "finite numbers", bad == values.end() ? 0 : *bad);
    }
    std::vector<std::uint32_t> used = group_;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    groups_ = used.size();
    for (std::uint32_t& group : group_)
        group = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), group) - used.begin());

    // Bytes are faster where their rounding is small beside the threshold.
    detail::ByteFilter bytes(words, mean_sq_length_, Dimension, isa);
    if (bytes.slack() < max_sq_distance_ / 4)
        filter_ = std::move(bytes);
    else
        filter_ = detail::FloatFilter(words, mean_sq_length_, Dimension, isa);
}

}  // namespace ism
