// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/codebook/byte_filter.hpp"
#include "ism/codebook/codebook.hpp"
#include "ism/codebook/exact_dot.hpp"
#include "ism/codebook/float_filter.hpp"
#include "ism/core/error.hpp"
#include "ism/core/order.hpp"

namespace ism {

/// @brief The words of a codebook made ready for match(): for a codebook that is asked many times. It keeps
/// what it needs of the codebook, which may go. May be asked from several threads at once.
class WordIndex {
public:
    /// @param isa  for tests and measurements: matches are the same bits for each, only the time differs
    /// @throws Error for words or lengths that are not finite, a threshold that is negative or NaN, or an
    /// instruction set that the processor lacks.
    explicit WordIndex(const Codebook& codebook, InstructionSet isa = best_instruction_set())
        : words_(codebook.means().values().begin(), codebook.means().values().end()),
          mean_sq_lengths_(codebook.mean_sq_lengths()),
          groups_(codebook.groups()),
          dimension_(codebook.dimension()),
          max_sq_distance_(codebook.max_sq_distance()) {
        expect(has_instruction_set(isa), "matching: instruction set", "one that the processor has", int(isa));
        dot_ = detail::exact_dot<float>(isa);
        expect(max_sq_distance_ >= 0, "matching: largest squared distance", "0 or more", max_sq_distance_);
        for (const std::span<const float> values :
             {std::span<const float>(words_), std::span<const float>(mean_sq_lengths_)})
            for (const float value : values)
                expect(std::isfinite(value), "matching: words", "finite numbers", value);
        number_groups();
        // Bytes are faster where their rounding is small beside the threshold, or, where there is none,
        // beside how far apart words are.
        byte_filter_ = detail::ByteFilter(words_, mean_sq_lengths_, dimension_, isa);
        const double reach = std::isfinite(max_sq_distance_) ? max_sq_distance_ : byte_filter_.spread();
        uses_bytes_ = byte_filter_.slack() < reach / 4;
        if (!uses_bytes_) {
            byte_filter_ = {};
            float_filter_ = detail::FloatFilter(words_, mean_sq_lengths_, dimension_, isa);
        }
    }

    /// @brief Number of words.
    [[nodiscard]] std::size_t size() const { return mean_sq_lengths_.size(); }
    /// @brief Numbers of a descriptor.
    [[nodiscard]] std::size_t dimension() const { return dimension_; }
    [[nodiscard]] double max_sq_distance() const { return max_sq_distance_; }
    /// @brief Number of groups that have words.
    [[nodiscard]] std::size_t group_count() const { return group_count_; }
    /// @brief Number of the group of a word among those that have words.
    [[nodiscard]] std::uint32_t group(std::size_t word) const { return groups_[word]; }

    /// @brief Squared length of a descriptor, in double.
    [[nodiscard]] double sq_length(const float* descriptor) const {
        return dot_(descriptor, descriptor, dimension_);
    }
    /// @brief The distance of a descriptor to a word: see Codebook. The same bits on every processor.
    /// @param sq_length  that of the descriptor
    [[nodiscard]] double sq_distance(const float* descriptor, double sq_length, std::size_t word) const {
        return sq_length + double(mean_sq_lengths_[word]) -
               2 * dot_(descriptor, words_.data() + word * dimension_, dimension_);
    }

    /// @brief Has a word at hand that sq_distance() is asked of soon.
    void prefetch([[maybe_unused]] std::size_t word) const {
#if defined(__GNUC__)
        const float* row = words_.data() + word * dimension_;
        constexpr std::size_t line = 64 / sizeof(float);
        for (std::size_t k = 0; k < dimension_; k += line) __builtin_prefetch(row + k);
#endif
    }

    /// @brief Which of the two filters tells candidates; the other is empty.
    [[nodiscard]] bool uses_bytes() const {
        return uses_bytes_;
    }
    [[nodiscard]] const detail::ByteFilter& byte_filter() const {
        return byte_filter_;
    }
    [[nodiscard]] const detail::FloatFilter& float_filter() const {
        return float_filter_;
    }

private:
    /// Groups by number of those that have words.
    void number_groups() {
        std::vector<detail::Ranked> order(size());
        for (std::uint32_t word = 0; word < size(); ++word) order[word] = {groups_[word], word};
        detail::sort_ranked(order.data(), order.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            group_count_ += i == 0 || order[i].key != order[i - 1].key;
            groups_[order[i].index] = static_cast<std::uint32_t>(group_count_ - 1);
        }
    }

    std::vector<float> words_, mean_sq_lengths_;
    std::vector<std::uint32_t> groups_;
    std::size_t dimension_ = 0, group_count_ = 0;
    double max_sq_distance_ = 0;
    detail::Dot<float>* dot_ = nullptr;
    bool uses_bytes_ = false;
    detail::ByteFilter byte_filter_;
    detail::FloatFilter float_filter_;
};

}  // namespace ism
