// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "support/photographs.hpp"

#include "ism/core/error.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"

namespace bench {

/// @brief `count` descriptors of upright Hessian-Laplace features, as training takes them by default, drawn
/// evenly from all photographs of the folders, in the order of file names: number after number.
/// @throws Error where the photographs have fewer.
template <ism::Descriptor Desc>
[[nodiscard]] std::vector<float> real_descriptors(const std::vector<std::filesystem::path>& folders,
                                                  std::size_t count) {
    std::vector<std::filesystem::path> files;
    for (const std::filesystem::path& folder : folders)
        for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
    std::erase_if(files,
                  [](const auto& file) { return file.extension() != ".png" && file.extension() != ".jpg"; });
    std::sort(files.begin(), files.end());
    ism::FeatureExtractor<ism::HessianLaplace, Desc> extractor(ism::Extractor<ism::HessianLaplace, Desc>{});
    std::vector<float> all;
    for (const std::filesystem::path& file : files) {
        const auto values = extractor.extract(read_bytes(file)).descriptors.values();
        all.insert(all.end(), values.begin(), values.end());
    }
    const std::size_t rows = all.size() / Desc::dimension;
    ism::expect(rows >= count, "real descriptors", count, rows);
    for (std::size_t i = 0; i < count; ++i)
        std::copy_n(all.begin() + std::ptrdiff_t(i * rows / count * Desc::dimension), Desc::dimension,
                    all.begin() + std::ptrdiff_t(i * Desc::dimension));
    all.resize(count * Desc::dimension);
    return all;
}

}  // namespace bench
