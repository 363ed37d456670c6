// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "ism/config.hpp"

namespace ism {

/// @brief A value on the heap, or none; copies share it, and the last of them deletes it. T has to be
/// complete only where make() is called, and may be void. In place of std::shared_ptr, since `memory` is a
/// twentieth of what a program that detects costs to compile.
template <class T>
class Shared {
public:
    Shared() = default;
    Shared(const Shared& other) noexcept : value_(other.value_), block_(other.block_) {
        if (block_) block_->owners.fetch_add(1, std::memory_order_relaxed);
    }
    Shared(Shared&& other) noexcept
        : value_(std::exchange(other.value_, nullptr)), block_(std::exchange(other.block_, nullptr)) {}
    Shared& operator=(Shared other) noexcept {
        std::swap(value_, other.value_);
        std::swap(block_, other.block_);
        return *this;
    }
    ~Shared() {
        if (block_ && block_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) block_->destroy(block_);
    }

    /// @brief A new value, made of these arguments.
    template <class Value = std::remove_const_t<T>, class... Arguments>
    requires std::constructible_from<Value, Arguments...> && std::convertible_to<Value*, T*>
    [[nodiscard]] static Shared make(Arguments&&... arguments) {
        auto* const block = new BlockOf<Value>(std::forward<Arguments>(arguments)...);
        return Shared(&block->value, block);
    }

    /// @brief The value's address; nullptr where there is none.
    [[nodiscard]] T* get() const { return value_; }
    [[nodiscard]] T* operator->() const { return value_; }
    [[nodiscard]] std::add_lvalue_reference_t<T> operator*() const { return *value_; }
    [[nodiscard]] explicit operator bool() const { return value_ != nullptr; }
    [[nodiscard]] bool operator==(std::nullptr_t) const { return value_ == nullptr; }

private:
    struct Block {
        void (*destroy)(Block*);
        std::atomic<std::size_t> owners = 1;
    };
    template <class Value>
    struct BlockOf : Block {
        template <class... Arguments>
        explicit BlockOf(Arguments&&... arguments)
            : Block{[](Block* block) { delete static_cast<BlockOf*>(block); }},
              value(std::forward<Arguments>(arguments)...) {}
        Value value;
    };

    Shared(T* value, Block* block) : value_(value), block_(block) {}

    T* value_ = nullptr;
    Block* block_ = nullptr;
};

}  // namespace ism
