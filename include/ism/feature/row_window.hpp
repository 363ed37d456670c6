// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "ism/core/aligned.hpp"
#include "ism/core/image.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism::detail {

/// Images of one size ("planes") of which only some rows, from first() on, are held; a row has its number in
/// the whole image.
class RowWindow {
public:
    /// Holds all rows.
    void hold_all(int planes, int width, int height) {
        set_size(planes, width, height);
        capacity_ = height;
        pixels_.make_room(plane() * std::size_t(planes));
    }

    /// Holds some rows, for which slide() makes room; fitting memory is reused. Views are offset by the rows
    /// dropped, so that a row keeps its number.
    void hold_some(int planes, int width, int height) {
        const bool fits = planes == planes_ && whole_lines(width) == stride_ && height == height_;
        set_size(planes, width, height);
        if (!fits) capacity_ = 0;
    }

    /// Makes room for the rows up to end − 1. Where there is none, rows before `needed` are dropped;
    /// those from there to made − 1 are kept.
    void slide(int needed, int made, int end, ThreadPool& pool) {
        if (end - first_ <= capacity_) return;
        const int first = std::clamp(needed, first_, std::max(first_, made)), rows = end - first;
        const int capacity = rows <= capacity_ ? capacity_ : std::min(height_, rows + rows / 2);
        const bool grows = capacity > capacity_;
        AlignedVector<float> larger(
            grows ? std::size_t(stride_) * std::size_t(capacity) * std::size_t(planes_) : 0);
        float* const to = grows ? larger.data() : pixels_.data();
        const std::size_t count = std::size_t(stride_) * std::size_t(std::max(0, made - first));
        pool.for_each(count > 0 ? std::size_t(planes_) : 0, [&](std::size_t i, unsigned) {
            std::memmove(to + std::size_t(stride_) * std::size_t(capacity) * i,
                         pixels_.data() + plane() * i + stride_ * (first - first_), count * sizeof(float));
        });
        if (grows) std::swap(pixels_, larger);
        first_ = first, capacity_ = capacity;
    }

    /// Back to the first row.
    void rewind() { first_ = 0; }

    /// Plane i, of which only the rows that are held may be looked at.
    [[nodiscard]] ImageView<const float> view(int i) const {
        return {pixels_.data() + offset(i), width_, height_, stride_};
    }
    [[nodiscard]] ImageView<float> view(int i) {
        return {pixels_.data() + offset(i), width_, height_, stride_};
    }

private:
    void set_size(int planes, int width, int height) {
        planes_ = planes, width_ = width, height_ = height, first_ = 0, stride_ = whole_lines(width);
    }
    [[nodiscard]] std::size_t plane() const { return std::size_t(stride_) * std::size_t(capacity_); }
    [[nodiscard]] std::ptrdiff_t offset(int i) const {
        return std::ptrdiff_t(plane()) * i - stride_ * first_;
    }

    int planes_ = 0, width_ = 0, height_ = 0, first_ = 0, capacity_ = 0;
    std::ptrdiff_t stride_ = 0;
    AlignedVector<float> pixels_;
};

}  // namespace ism::detail
