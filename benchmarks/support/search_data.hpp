// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <span>
#include <vector>

#include "support/our_features.hpp"
#include "support/photographs.hpp"

#include "ism/codebook/codebook.hpp"
#include "ism/train/train_options.hpp"

namespace bench {

constexpr std::size_t sift_size = ism::Sift::dimension;
using Words = ism::Codebook;
using Rows = ism::Descriptors<float>;

/// @brief The squared distance that separates clusters by default, for descriptors of a squared length.
[[nodiscard]] inline double default_max_sq_distance(double sq_length) {
    return 2 * (1 - ism::CodebookOptions{}.min_similarity) * sq_length;
}

/// @brief Descriptors of the colour images of some folders, at most `count`: an even part.
template <ism::Descriptor Desc = ism::Sift>
[[nodiscard]] Rows descriptors_of(std::span<const std::filesystem::path> folders, std::size_t count) {
    Rows all(sift_size);
    for (const std::filesystem::path& folder : folders) {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            for (const char* ending : {".png", ".jpg"})
                if (entry.path().extension() == ending) files.push_back(entry.path());
        std::erase_if(files, [](const auto& file) { return file.stem().string().ends_with("-depth"); });
        std::sort(files.begin(), files.end());
        ism::FeatureExtractor<ism::DifferenceOfGaussians, Desc> extractor(
            like_peers<ism::DifferenceOfGaussians, Desc>(), 0);
        for (const std::filesystem::path& file : files) {
            if (all.size() > 2 * count) break;
            const auto& found = extractor.extract(read_bytes(file));
            for (std::size_t i = 0; i < found.descriptors.size(); ++i)
                all.push_back(found.descriptors.row(i));
        }
    }
    Rows part(sift_size);
    const std::size_t kept = std::min(count, all.size());
    for (std::size_t i = 0; i < kept; ++i) part.push_back(all.row(i * all.size() / kept));
    return part;
}

/// @brief The first words of a codebook.
[[nodiscard]] inline Words first_words(const Words& words, std::size_t count) {
    std::vector<std::uint32_t> first(count);
    std::iota(first.begin(), first.end(), 0u);
    return words.select(first);
}

/// @brief Each descriptor a word: what very large codebooks hold.
[[nodiscard]] inline Words single_words(const Rows& descriptors, double max_sq_distance) {
    Words words(sift_size, max_sq_distance);
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
        double sum = 0;
        for (const float value : descriptors.row(i)) sum += double(value) * value;
        words.push_back({.mean = descriptors.row(i), .mean_sq_length = float(sum)});
    }
    return words;
}

/// @brief SIFT as ByteSift gives it: whole numbers from 0 to 255.
[[nodiscard]] inline Rows as_bytes(Rows descriptors) {
    for (float& value : descriptors.values()) value = std::floor(std::min(512 * value + 0.5f, 255.0f));
    return descriptors;
}

/// @brief Words in the units of as_bytes().
[[nodiscard]] inline Words in_byte_units(const Words& words) {
    Words bytes(sift_size, 512 * 512 * words.max_sq_distance());
    std::array<float, sift_size> mean;
    for (std::size_t w = 0; w < words.size(); ++w) {
        ism::Word word = words[w];
        std::transform(word.mean.begin(), word.mean.end(), mean.begin(),
                       [](float v) { return std::min(512 * v, 255.0f); });
        word.mean = mean;
        word.mean_sq_length *= 512 * 512;
        bytes.push_back(word);
    }
    return bytes;
}

}  // namespace bench
