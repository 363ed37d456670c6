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
    CHECK(ism::join_text(ism::lazy_text("a", 1), ism::size_text(ism::Mask(3, 4))) == "a13x4");
    CHECK(ism::join_text(ism::lazy_text(1, ism::lazy_text(2, "b", 3)), 4) == "12b34");
    CHECK(ism::join_text(1, 2, 3, 4, 5, 6, 7, 8, 9, 'a', 'b', 'c') == "123456789abc");
    CHECK(ism::join_text(ism::lazy_text(1, 2, 3, 4, 5, 6), ism::lazy_text(1, 2, 3, 4, 5, 6, 7, 8)) ==
          "12345612345678");
}

TEST_CASE("an expectation that fails names what, expected and actual") {
    CHECK_NOTHROW(ism::expect(true, "what", 1, 2));
    CHECK(ism::test::error_message([] {
              ism::expect(false, ism::lazy_text("number ", 3), ism::lazy_text("below ", 2.5), 7u);
          }) == "number 3: expected below 2.5, got 7");
    CHECK(ism::test::error_message<ism::FileError>(
              [] { ism::expect<ism::FileError>(false, "a", "b", "c"); }) == "a: expected b, got c");
}

TEST_CASE("numbers are written the same in every locale") {
    const GlobalLocale commas(std::locale(std::locale::classic(), new CommaNumbers));
    CHECK(ism::join_text(1234.5, " of ", 10000) == "1234.5 of 10000");
    CHECK(ism::number_text(1234.5, 5) == "1234.5");
    CHECK(ism::fixed_text(12345.678, 1) == "12345.7");
}
