// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/io/base64.hpp"

using ism::test::error_message;

TEST_CASE("Base64 of RFC 4648's examples, there and back") {
    const std::vector<std::pair<std::string_view, std::string_view>> examples = {{"", ""},
                                                                                 {"f", "Zg=="},
                                                                                 {"fo", "Zm8="},
                                                                                 {"foo", "Zm9v"},
                                                                                 {"foob", "Zm9vYg=="},
                                                                                 {"fooba", "Zm9vYmE="},
                                                                                 {"foobar", "Zm9vYmFy"},
                                                                                 {"\xfb\xff\xbf", "+/+/"}};
    for (const auto& [plain, text] : examples) {
        CAPTURE(text);
        const std::vector<std::uint8_t> bytes(plain.begin(), plain.end());
        CHECK(ism::base64(bytes) == text);
        CHECK(ism::decode_base64(text) == bytes);
    }
}

TEST_CASE("What is no base64 is refused with the place") {
    const auto refused = [](std::string_view text) {
        return error_message([&] { (void)ism::decode_base64(text); });
    };
    CHECK(refused("Zm9") == "base64: expected a number of letters that 4 divides, got 3");
    CHECK(refused("Zm9v Zg==").starts_with("base64: expected a number of letters"));
    CHECK(refused("Zm 9") == "base64: expected letters, digits, + and /, got byte 32 at 2");
    CHECK(refused("Zg==Zm9v") == "base64: expected letters, digits, + and /, got byte 61 at 2");
    CHECK(refused("Z===") == "base64: expected letters, digits, + and /, got byte 61 at 1");
    CHECK(refused("Zm9\xff") == "base64: expected letters, digits, + and /, got byte 255 at 3");
    CHECK(refused("Zm-_").ends_with("got byte 45 at 2"));
}
