// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <limits>
#include <locale>
#include <string>
#include <string_view>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/core/error.hpp"
#include "ism/core/image.hpp"
#include "ism/core/number_text.hpp"

namespace {

/// Writes 1234.5 as "1.234,5", as many countries do, whatever locales the machine has.
struct CommaNumbers : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

/// The global locale, exchanged for as long as this lives.
class GlobalLocale {
public:
    explicit GlobalLocale(const std::locale& other) : before_(std::locale::global(other)) {}
    GlobalLocale(const GlobalLocale&) = delete;
    GlobalLocale& operator=(const GlobalLocale&) = delete;
    ~GlobalLocale() { std::locale::global(before_); }

private:
    std::locale before_;
};

}  // namespace

TEST_CASE("numbers become the shortest text of so many digits") {
    CHECK(ism::number_text(0) == "0");
    CHECK(ism::number_text(1234.5678) == "1235");
    CHECK(ism::number_text(0.25, 2) == "0.25");
    CHECK(ism::number_text(1e-7, 3) == "1e-07");
    CHECK(ism::number_text(std::numeric_limits<double>::quiet_NaN()) == "\u2013");
    CHECK(ism::fixed_text(2.0 / 3, 2) == "0.67");
    CHECK(ism::fixed_text(std::numeric_limits<double>::max(), 3).size() == 313);
    CHECK(ism::hex_text(0xAB, 4) == "00ab");
    CHECK(ism::hex_text(0x12345, 2) == "45");
}

TEST_CASE("parts of a text are strings, numbers and what appends itself") {
    CHECK(ism::join_text("a", std::string("b"), std::string_view("c"), 'd', 1, -2L, 3u, std::uint8_t(65),
                         true) == "abcd1-23651");
    CHECK(ism::join_text(0.1f, " ", 1.0 / 3, " ", 1e20, " ", std::numeric_limits<double>::infinity()) ==
          "0.1 0.333333 1e+20 inf");
    CHECK(ism::join_text(ism::lazy_text("a", 1), ism::SizeText{3, 4}) == "a13x4");
}

TEST_CASE("the message of an expectation is made only where it fails") {
    struct Counted {
        int& count;
        void append_to(std::string& text) const { ++count, text += "text"; }
    };
    int count = 0;
    ism::expect(true, Counted{count}, ism::lazy_text("a", Counted{count}), 1);
    CHECK(count == 0);
    CHECK(ism::test::error_message([&] {
              ism::expect(false, Counted{count}, ism::lazy_text("a", Counted{count}), 1);
          }) == "text: expected atext, got 1");
    CHECK(count == 2);
}

TEST_CASE("numbers are written the same in every locale") {
    const GlobalLocale commas(std::locale(std::locale::classic(), new CommaNumbers));
    CHECK(ism::join_text(1234.5, " of ", 10000) == "1234.5 of 10000");
    CHECK(ism::number_text(1234.5, 5) == "1234.5");
    CHECK(ism::fixed_text(12345.678, 1) == "12345.7");
}
