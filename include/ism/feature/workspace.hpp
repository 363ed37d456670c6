// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/aligned.hpp"
#include "ism/core/callable.hpp"
#include "ism/core/image.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/core/shared.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/feature.hpp"
#include "ism/feature/gaussian_kernel.hpp"

namespace ism {

/// @brief What the scratch buffers of a Workspace are for: one number per feature.
enum class Scratch : std::uint8_t {
    order,       ///< features in another order
    place,       ///< where a feature is in such an order
    dropped,     ///< whether a feature is left out
    directions,  ///< how many directions a feature has
    angles,      ///< bits of these directions, several a feature
    count        ///< how many there are of these
};

/// @brief Threads and memory for feature extraction, reused across frames: after the first frame of a size
/// nothing is allocated. For one frame at a time.
class Workspace {
public:
    /// @brief With this many threads, the caller's included (0 = all hardware threads).
    explicit Workspace(unsigned threads = 1)
        : own_(Shared<ThreadPool>::make(threads)), pool_(own_.get()), rows_(pool_->size()) {}

    /// @brief With threads that others use too, between frames.
    /// @param pool  has to stay as long as this
    explicit Workspace(ThreadPool& pool) : pool_(&pool), rows_(pool.size()) {}

    Workspace(Workspace&&) = default;
    Workspace& operator=(Workspace&&) = default;

    [[nodiscard]] ThreadPool& pool() { return *pool_; }
    /// @brief Threads of the pool, the caller's among them.
    [[nodiscard]] std::size_t threads() const { return pool_->size(); }

    /// @brief Calls body(y) for y = 0 … rows − 1, on all threads.
    template <Callable<int> Body>
    void each_row(int rows, const Body& body) {
        constexpr int rows_per_task = 32;
        pool_->for_each(std::size_t(rows + rows_per_task - 1) / rows_per_task,
                        [&](std::size_t task, unsigned) {
                            const int first = int(task) * rows_per_task;
                            for (int y = first; y < std::min(rows, first + rows_per_task); ++y) body(y);
                        });
    }

    /// @brief Scratch of `count` floats for one worker of the pool, uninitialised, aligned to a cache line;
    /// valid until that worker's next call.
    [[nodiscard]] std::span<float> rows(unsigned worker, std::size_t count) {
        AlignedVector<float>& own = rows_[worker];
        own.make_room(count);
        return {own.data(), count};
    }

    /// @brief An empty list for each worker of the pool, valid until the next call.
    [[nodiscard]] std::vector<std::vector<Feature>>& lists() {
        detail::make_room(lists_, threads());
        for (std::vector<Feature>& list : lists_) list.clear();
        return lists_;
    }

    /// @brief The scratch buffer `use` with `count` numbers, uninitialised; valid until the next call for it.
    [[nodiscard]] std::span<std::uint32_t> numbers(Scratch use, std::size_t count) {
        std::vector<std::uint32_t>& own = numbers_[std::size_t(use)];
        detail::make_room(own, count);
        return {own.data(), count};
    }

    /// @brief Scratch to sort `count` features, uninitialised; valid until the next call.
    [[nodiscard]] std::span<detail::Ranked> ranked(std::size_t count) {
        detail::make_room(ranked_, count);
        return {ranked_.data(), count};
    }

    /// @brief gaussian_kernel(sigma), cached.
    [[nodiscard]] std::span<const float> kernel(double sigma) {
        for (const auto& [known, weights] : kernels_)
            if (known == sigma) return weights;
        return kernels_.emplace_back(sigma, gaussian_kernel(sigma)).second;
    }

    /// @brief An empty list to return as a result; its memory comes from reuse().
    [[nodiscard]] std::vector<Feature> empty_list() {
        if (spare_lists_ == 0) return {};
        std::vector<Feature> list = std::move(spare_[--spare_lists_]);
        list.clear();
        return list;
    }
    /// @brief Takes back the memory of a list; a few unused ones are kept.
    void reuse(std::vector<Feature> list) {
        if (spare_lists_ < spare_.size()) spare_[spare_lists_++] = std::move(list);
    }

    /// @brief An image, from reuse() where one of this size is there; its pixels are uninitialised.
    [[nodiscard]] GrayImage image(int width, int height) {
        for (std::size_t i = 0; i < images_.size(); ++i)
            if (images_[i].width() == width && images_[i].height() == height) {
                std::swap(images_[i], images_.back());
                GrayImage found = std::move(images_.back());
                images_.pop_back();
                return found;
            }
        images_.clear();
        return GrayImage(width, height);
    }
    /// @brief Takes back the memory of an image.
    void reuse(GrayImage image) {
        if (!image.empty()) images_.push_back(std::move(image));
    }

private:
    Shared<ThreadPool> own_;
    ThreadPool* pool_;
    std::vector<AlignedVector<float>> rows_;
    std::vector<std::vector<Feature>> lists_;
    std::array<std::vector<Feature>, 4> spare_;
    std::size_t spare_lists_ = 0;
    std::array<std::vector<std::uint32_t>, std::size_t(Scratch::count)> numbers_;
    std::vector<detail::Ranked> ranked_;
    std::vector<GrayImage> images_;
    std::vector<std::pair<double, std::vector<float>>> kernels_;
};

}  // namespace ism
