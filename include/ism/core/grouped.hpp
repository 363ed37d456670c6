// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"

namespace ism {

/// @brief Lists of values stored one after another (compressed rows): group g holds the values of number
/// offsets()[g] … offsets()[g + 1] − 1.
template <class T>
class Grouped {
public:
    Grouped() = default;

    /// @brief Takes over values and where each group begins, and last their number.
    /// @throws Error where the offsets do not rise from 0 to the number of values.
    Grouped(std::vector<T> values, std::vector<std::uint32_t> offsets)
        : values_(std::move(values)), offsets_(std::move(offsets)) {
        expect(!offsets_.empty() && offsets_.front() == 0 && offsets_.back() == values_.size(),
               "groups: offsets", lazy_text("from 0 to ", values_.size()),
               lazy_text(offsets_.size(), " numbers up to ", offsets_.empty() ? 0u : offsets_.back()));
        for (std::size_t g = 0; g + 1 < offsets_.size(); ++g)
            expect(offsets_[g] <= offsets_[g + 1], "groups: offsets", "rising numbers",
                   lazy_text(offsets_[g], " before ", offsets_[g + 1]));
    }

    /// @brief Number of groups.
    [[nodiscard]] std::size_t size() const { return offsets_.empty() ? 0 : offsets_.size() - 1; }
    [[nodiscard]] bool empty() const { return size() == 0; }

    [[nodiscard]] std::span<const T> operator[](std::size_t group) const {
        return {values_.data() + offsets_[group], offsets_[group + 1] - offsets_[group]};
    }
    [[nodiscard]] std::span<T> operator[](std::size_t group) {
        return {values_.data() + offsets_[group], offsets_[group + 1] - offsets_[group]};
    }

    /// @brief Number, among all values, of the first of a group.
    [[nodiscard]] std::uint32_t first(std::size_t group) const { return offsets_[group]; }

    /// @brief All values, group after group.
    [[nodiscard]] const std::vector<T>& values() const { return values_; }
    [[nodiscard]] std::span<T> values() { return {values_.data(), values_.size()}; }
    [[nodiscard]] const std::vector<std::uint32_t>& offsets() const { return offsets_; }

    /// @brief Adds a group, of any list of values.
    template <class Values = std::vector<T>>
    void push_back(const Values& group) {
        if (offsets_.empty()) offsets_.push_back(0);  // as it is where the content was moved away
        for (const T& value : group) values_.push_back(value);
        offsets_.push_back(static_cast<std::uint32_t>(values_.size()));
    }

    [[nodiscard]] bool operator==(const Grouped&) const = default;

private:
    std::vector<T> values_;
    std::vector<std::uint32_t> offsets_ = {0};
};

}  // namespace ism
