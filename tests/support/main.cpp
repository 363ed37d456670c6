// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// The main of all test and benchmark programs. A run that skipped something for want of data and failed
// nowhere returns 77, which ctest shows as skipped.
#define CATCH_CONFIG_RUNNER
#include "support/catch.hpp"
#include "support/skipped.hpp"

int main(int argc, char* argv[]) {
    Catch::Session session;
#if !defined(CATCH_VERSION_MAJOR) || CATCH_VERSION_MAJOR < 3
    // A name that matches no test is a mistake, as it is in version 3.
    auto& settings = session.configData();
    settings.warnings = static_cast<Catch::WarnAbout::What>(settings.warnings | Catch::WarnAbout::NoTests);
#endif
    const int failures = session.run(argc, argv);
    if (failures != 0) return failures;
    return ism::test::skipped_tests() > 0 ? 77 : 0;
}
