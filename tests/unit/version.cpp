// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/version.hpp"

#include <string>

#include "support/catch.hpp"

#include "ism/config.hpp"

TEST_CASE("the version as numbers, as text and as macros is one") {
    const std::string text = std::to_string(ism::version.major_number) + "." +
                             std::to_string(ism::version.minor_number) + "." +
                             std::to_string(ism::version.patch_number);
    CHECK(text == ism::version_text);
    CHECK(text == ISM_PROJECT_VERSION);  // what the build system read
    CHECK(ism::version >= ism::Version{0, 3, 0});
}

TEST_CASE("the development machine has the libraries of every header") {
    CHECK(ISM_HAS_JSON == 1);
    CHECK(ISM_HAS_STB == 1);
    CHECK(ISM_HAS_NANOFLANN == 1);
}
