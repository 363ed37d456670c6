// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "support/our_features.hpp"
#include "support/photographs.hpp"

#include "ism/codebook/byte_codebook.hpp"
#include "ism/codebook/codebook.hpp"
#include "ism/feature/byte_sift.hpp"
#include "ism/train/train.hpp"

namespace bench {

constexpr std::size_t sift_size = ism::Sift::dimension;
template <ism::DescriptorScalar Scalar>
using WordsOf = ism::Codebook<sift_size, Scalar>;
using Words = WordsOf<float>;
template <ism::DescriptorScalar Scalar>
using Rows = ism::Descriptors<Scalar, sift_size>;

/// @brief The squared distance that separates clusters by default, for descriptors of a squared length.
[[nodiscard]] inline double default_max_sq_distance(double sq_length) {
    return 2 * (1 - ism::TrainOptions{}.min_similarity) * sq_length;
}

/// @brief SIFT descriptors of the images of some folders, at most `count`: an even part.
[[nodiscard]] inline Rows<float> descriptors_of(std::span<const std::filesystem::path> folders,
                                                std::size_t count) {
    Rows<float> all;
    for (const std::filesystem::path& folder : folders) {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            for (const char* ending : {".png", ".jpg"})
                if (entry.path().extension() == ending) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        ism::FeatureExtractor<ism::DifferenceOfGaussians, ism::Sift> extractor(
            like_peers<ism::DifferenceOfGaussians>(), 0);
        for (const std::filesystem::path& file : files) {
            if (all.size() > 2 * count) break;
            const auto& found = extractor.extract(read_bytes(file));
            for (std::size_t i = 0; i < found.descriptors.size(); ++i)
                all.push_back(found.descriptors.row(i));
        }
    }
    Rows<float> part;
    const std::size_t kept = std::min(count, all.size());
    for (std::size_t i = 0; i < kept; ++i) part.push_back(all.row(i * all.size() / kept));
    return part;
}

/// @brief The first words of a codebook.
[[nodiscard]] inline Words first_words(const Words& words, std::size_t count) {
    Words part = words;
    part.words.resize(count), part.mean_sq_length.resize(count), part.group.resize(count);
    return part;
}

/// @brief Each descriptor a word: what very large codebooks hold.
[[nodiscard]] inline Words single_words(const Rows<float>& descriptors, double max_sq_distance) {
    Words words{.words = descriptors, .mean_sq_length = {}, .group = {}, .max_sq_distance = max_sq_distance};
    words.group.assign(descriptors.size(), 0);
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
        double sum = 0;
        for (const float value : descriptors.row(i)) sum += double(value) * value;
        words.mean_sq_length.push_back(float(sum));
    }
    return words;
}

/// @brief SIFT in bytes as ByteSift gives it, and words of such.
[[nodiscard]] inline Rows<std::uint8_t> as_bytes(const Rows<float>& descriptors) {
    Rows<std::uint8_t> bytes(descriptors.size());
    std::transform(descriptors.values().begin(), descriptors.values().end(), bytes.values().begin(),
                   [](float v) { return std::uint8_t(std::min(512 * v + 0.5f, 255.0f)); });
    return bytes;
}
[[nodiscard]] inline WordsOf<std::uint8_t> in_bytes(Words words) {
    for (float& value : words.words.values()) value = std::min(512 * value, 255.0f);
    for (float& value : words.mean_sq_length) value *= 512 * 512;
    words.max_sq_distance *= 512 * 512;
    return ism::in_bytes(words);
}

}  // namespace bench
