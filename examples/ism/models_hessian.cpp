// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "models_body.hpp"

namespace program {

template ism::Model<ism::HessianLaplace, ism::Sift> learn(const Lessons&);
template ism::Model<ism::HessianLaplace, ism::Sift> load(const std::filesystem::path&);
template void save(const std::filesystem::path&, const ism::Model<ism::HessianLaplace, ism::Sift>&);
template PictureMatcher make_matcher(const ism::Model<ism::HessianLaplace, ism::Sift>&, unsigned);

template ism::Model<ism::HessianLaplace, ism::RootSift> learn(const Lessons&);
template ism::Model<ism::HessianLaplace, ism::RootSift> load(const std::filesystem::path&);
template void save(const std::filesystem::path&, const ism::Model<ism::HessianLaplace, ism::RootSift>&);
template PictureMatcher make_matcher(const ism::Model<ism::HessianLaplace, ism::RootSift>&, unsigned);

}  // namespace program
