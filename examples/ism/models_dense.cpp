// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "models_body.hpp"

namespace program {

template ism::Model<ism::DenseGrid, ism::Sift> learn(const Lessons&);
template ism::Model<ism::DenseGrid, ism::Sift> load(const std::filesystem::path&);
template void save(const std::filesystem::path&, const ism::Model<ism::DenseGrid, ism::Sift>&);
template Matched look_up(const ism::Model<ism::DenseGrid, ism::Sift>&, const ism::Frame&, unsigned);

template ism::Model<ism::DenseGrid, ism::RootSift> learn(const Lessons&);
template ism::Model<ism::DenseGrid, ism::RootSift> load(const std::filesystem::path&);
template void save(const std::filesystem::path&, const ism::Model<ism::DenseGrid, ism::RootSift>&);
template Matched look_up(const ism::Model<ism::DenseGrid, ism::RootSift>&, const ism::Frame&, unsigned);

}  // namespace program
