// expect: detector.detect(space, workspace)
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string_view>

#include "ism/feature/extract.hpp"
#include "ism/feature/sift.hpp"

struct FindsNothing {
    static constexpr std::string_view name = "finds-nothing";
};

ism::Extractor<FindsNothing, ism::Sift> extractor;
