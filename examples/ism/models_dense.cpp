// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "models_body.hpp"

namespace program {

template ism::Model<ism::DenseGrid, ism::Sift> learn(const Lessons&);
template ism::Model<ism::DenseGrid, ism::Sift> load(const std::filesystem::path&);
template void save(const std::filesystem::path&, const ism::Model<ism::DenseGrid, ism::Sift>&);
template PictureMatcher make_matcher(const ism::Model<ism::DenseGrid, ism::Sift>&, unsigned);

template ism::Model<ism::DenseGrid, ism::RootSift> learn(const Lessons&);
template ism::Model<ism::DenseGrid, ism::RootSift> load(const std::filesystem::path&);
template void save(const std::filesystem::path&, const ism::Model<ism::DenseGrid, ism::RootSift>&);
template PictureMatcher make_matcher(const ism::Model<ism::DenseGrid, ism::RootSift>&, unsigned);

}  // namespace program
