// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

#include "ism/config.hpp"

/// Values as text: the same in every locale, so that a file is valid wherever it was written. Plain functions
/// of few types, since every header that checks anything includes this.
namespace ism {

template <std::size_t Count>
struct LazyText;

/// @brief A part of a text that may be asked for: a string, a number (with six digits that count), or several
/// parts. Making it costs nothing beyond a copy of the number; strings and lists are referred to.
class TextPart {
public:
    TextPart(const char* text) : kind_(Kind::text), text_(text) {}
    TextPart(const std::string& text) : kind_(Kind::text), text_(text) {}
    TextPart(std::string_view text) : kind_(Kind::text), text_(text) {}
    TextPart(char one) : kind_(Kind::one), signed_(one) {}
    TextPart(bool value) : kind_(Kind::signed_number), signed_(value) {}
    TextPart(int value) : kind_(Kind::signed_number), signed_(value) {}
    TextPart(long value) : kind_(Kind::signed_number), signed_(value) {}
    TextPart(long long value) : kind_(Kind::signed_number), signed_(value) {}
    TextPart(unsigned value) : kind_(Kind::unsigned_number), unsigned_(value) {}
    TextPart(unsigned long value) : kind_(Kind::unsigned_number), unsigned_(value) {}
    TextPart(unsigned long long value) : kind_(Kind::unsigned_number), unsigned_(value) {}
    TextPart(float value) : kind_(Kind::real), real_(double(value)) {}
    TextPart(double value) : kind_(Kind::real), real_(value) {}
    template <std::size_t Count>
    TextPart(const LazyText<Count>& parts) : kind_(Kind::list), list_{parts.parts.data(), Count} {}

    void append_to(std::string& text) const {
        std::array<char, 32> digits;
        const auto append = [&](std::to_chars_result end) { text.append(digits.data(), end.ptr); };
        char* const last = digits.data() + digits.size();
        switch (kind_) {
            case Kind::text:
                text += text_;
                break;
            case Kind::one:
                text += char(signed_);
                break;
            case Kind::signed_number:
                append(std::to_chars(digits.data(), last, signed_));
                break;
            case Kind::unsigned_number:
                append(std::to_chars(digits.data(), last, unsigned_));
                break;
            case Kind::real:
                append(std::to_chars(digits.data(), last, real_, std::chars_format::general, 6));
                break;
            case Kind::list:
                for (std::size_t i = 0; i < list_.count; ++i) list_.first[i].append_to(text);
        }
    }

private:
    struct Parts {
        const TextPart* first;
        std::size_t count;
    };
    enum class Kind : unsigned char { text, one, signed_number, unsigned_number, real, list };

    Kind kind_;
    union {
        std::string_view text_;
        long long signed_;
        unsigned long long unsigned_;
        double real_;
        Parts list_;
    };
};

/// @brief Several parts that may become one text.
template <std::size_t Count>
struct LazyText {
    std::array<TextPart, Count> parts;
};

/// @brief As join_text(), but joined only where it is asked for: for the messages of expect(), which are
/// rarely needed. It refers to strings among its arguments, so it is not to be kept.
[[nodiscard]] inline LazyText<2> lazy_text(TextPart a, TextPart b) {
    return {{a, b}};
}
[[nodiscard]] inline LazyText<3> lazy_text(TextPart a, TextPart b, TextPart c) {
    return {{a, b, c}};
}
[[nodiscard]] inline LazyText<4> lazy_text(TextPart a, TextPart b, TextPart c, TextPart d) {
    return {{a, b, c, d}};
}
[[nodiscard]] inline LazyText<5> lazy_text(TextPart a, TextPart b, TextPart c, TextPart d, TextPart e) {
    return {{a, b, c, d, e}};
}
[[nodiscard]] inline LazyText<7> lazy_text(TextPart a, TextPart b, TextPart c, TextPart d, TextPart e,
                                           TextPart f, TextPart g = "") {
    return {{a, b, c, d, e, f, g}};
}
[[nodiscard]] inline LazyText<9> lazy_text(TextPart a, TextPart b, TextPart c, TextPart d, TextPart e,
                                           TextPart f, TextPart g, TextPart h, TextPart i = "") {
    return {{a, b, c, d, e, f, g, h, i}};
}

/// @brief Its arguments, up to twelve, joined into one string.
[[nodiscard]] inline std::string join_text(TextPart a, TextPart b = "", TextPart c = "", TextPart d = "",
                                           TextPart e = "", TextPart f = "", TextPart g = "", TextPart h = "",
                                           TextPart i = "", TextPart j = "", TextPart k = "",
                                           TextPart l = "") {
    std::string text;
    for (const TextPart* part : {&a, &b, &c, &d, &e, &f, &g, &h, &i, &j, &k, &l}) part->append_to(text);
    return text;
}

}  // namespace ism
