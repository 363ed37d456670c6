// expect: a detector with options has a static each_parameter(self, visit)
// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string_view>
#include <vector>

#include "ism/feature/any_extractor.hpp"
#include "ism/feature/sift.hpp"

struct Forgetful {
    static constexpr std::string_view name = "forgetful";
    int option = 3;
    std::vector<ism::Feature> detect(const ism::ScaleSpace&, ism::Workspace&) const { return {}; }
};

const ism::AnyExtractor extractor{ism::Extractor<Forgetful, ism::Sift>{}};
