// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "ism/config.hpp"

/// Values as text: the same in every locale, so that a file is valid wherever it was written.
namespace ism {

/// @brief A type that appends itself to a text.
template <class T>
concept AppendsText = requires(const T& value, std::string& text) {
    { value.append_to(text) } -> std::same_as<void>;
};

/// @brief Refers to a value that may become a part of a text: a string, a number (with six digits that count)
/// or what AppendsText. It costs nothing as long as nobody asks for the text, and lives as long as the value.
class TextPart {
public:
    TextPart(const char* text) : value_(text), append_(append_chars) {}
    TextPart(const std::string& text) : value_(&text), append_(append_strings<std::string>) {}
    TextPart(const std::string_view& text) : value_(&text), append_(append_strings<std::string_view>) {}
    TextPart(const char& one) : value_(&one), append_(append_char) {}
    template <class T>
    requires std::integral<T> || std::floating_point<T> TextPart(const T& number)
        : value_(&number), append_(append_number<T>) {}
    template <AppendsText T>
    TextPart(const T& value) : value_(&value), append_(append_other<T>) {}

    void append_to(std::string& text) const { append_(text, value_); }

private:
    template <class T>
    [[nodiscard]] static const T& as(const void* value) {
        return *static_cast<const T*>(value);
    }
    static void append_chars(std::string& text, const void* value) {
        text += static_cast<const char*>(value);
    }
    static void append_char(std::string& text, const void* value) { text += as<char>(value); }
    template <class T>
    static void append_strings(std::string& text, const void* value) {
        text += as<T>(value);
    }
    template <class T>
    static void append_other(std::string& text, const void* value) {
        as<T>(value).append_to(text);
    }
    template <class T>
    static void append_number(std::string& text, const void* value) {
        if constexpr (std::floating_point<T>)
            append_real(text, double(as<T>(value)));
        else if constexpr (std::unsigned_integral<T>)
            append_integer(text, std::uint64_t(as<T>(value)));
        else
            append_integer(text, std::int64_t(as<T>(value)));
    }
    template <class T>
    static void append_integer(std::string& text, T number) {
        std::array<char, 24> digits;
        text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
    }
    static void append_real(std::string& text, double number) {
        std::array<char, 32> digits;
        text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number,
                                                 std::chars_format::general, 6)
                                       .ptr);
    }

    const void* value_;
    void (*append_)(std::string&, const void*);
};

/// @brief Its arguments joined into one string.
template <class... Parts>
requires(std::convertible_to<const Parts&, TextPart>&&...) [[nodiscard]] std::string
    join_text(const Parts&... parts) {
    std::string text;
    (TextPart(parts).append_to(text), ...);
    return text;
}

/// @brief Several values that may become one text: see lazy_text().
template <std::size_t Count>
struct LazyText {
    std::array<TextPart, Count> parts;

    void append_to(std::string& text) const {
        for (const TextPart& part : parts) part.append_to(text);
    }
};

/// @brief As join_text(), but joined only where it is asked for: for the messages of expect(), which are
/// rarely needed. It refers to its arguments, so it is not to be kept.
template <class... Parts>
requires(std::convertible_to<const Parts&, TextPart>&&...)
    [[nodiscard]] LazyText<sizeof...(Parts)> lazy_text(const Parts&... parts) {
    return {{TextPart(parts)...}};
}

}  // namespace ism
