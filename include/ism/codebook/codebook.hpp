// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/cluster.hpp"
#include "ism/core/error.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief Visual words: the means of clusters of descriptors. The distance of a descriptor to a word is that
/// of the clustering: the mean squared distance to the descriptors the word stands for, |d|² + mean_sq_length
/// − 2 d·mean. In a joint codebook all words belong to group 0; in a codebook of one part a class, a word's
/// group is its class.
template <std::size_t Dimension>
struct Codebook {
    Descriptors<float, Dimension> words;  ///< one row a word, in the units of the descriptor
    std::vector<float> mean_sq_length;  ///< of each word: mean of |d|² over the descriptors d it stands for
    std::vector<std::uint32_t> group;   ///< of each word
    double max_sq_distance = 0;         ///< a descriptor matches every word no further away

    [[nodiscard]] std::size_t size() const { return words.size(); }
};

/// @brief A word that a feature looks like.
struct Match {
    std::uint32_t feature = 0;
    std::uint32_t word = 0;
    float weight = 0;      ///< p(word | feature) = 1 / number of words of the group that the feature matches
    bool nearest = false;  ///< no other word of the group is nearer
    [[nodiscard]] bool operator==(const Match&) const = default;
};

/// @brief Which words of a feature cast votes.
enum class MatchMode {
    all,      ///< every word within the threshold (soft matching)
    nearest,  ///< only the nearest of each group, if within the threshold
};

/// @brief Clusters descriptors into words and drops words of fewer than `min_cluster_size` descriptors
/// (T_Q + 1 in the paper).
/// @throws Error where no word is left.
template <std::size_t Dimension>
[[nodiscard]] Codebook<Dimension> build_codebook(const Descriptors<float, Dimension>& descriptors,
                                                 double max_sq_distance, std::size_t min_cluster_size,
                                                 std::uint32_t group = 0, unsigned threads = 0) {
    const Clustering clustering =
        cluster_average_link(descriptors.values(), Dimension, max_sq_distance, threads);
    std::vector<std::size_t> size(clustering.count, 0);
    std::vector<double> sq_length(clustering.count, 0);
    Descriptors<float, Dimension> means(clustering.count);
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
        const std::uint32_t label = clustering.label[i];
        ++size[label];
        for (std::size_t k = 0; k < Dimension; ++k) {
            const float value = descriptors.row(i)[k];
            means.row(label)[k] += value;
            sq_length[label] += double(value) * value;
        }
    }
    Codebook<Dimension> codebook{
        .words = {}, .mean_sq_length = {}, .group = {}, .max_sq_distance = max_sq_distance};
    std::size_t largest = 0;
    for (std::uint32_t label = 0; label < clustering.count; ++label) {
        largest = std::max(largest, size[label]);
        if (size[label] < min_cluster_size) continue;
        for (float& value : means.row(label)) value /= static_cast<float>(size[label]);
        codebook.words.push_back(means.row(label));
        codebook.mean_sq_length.push_back(static_cast<float>(sq_length[label] / double(size[label])));
        codebook.group.push_back(group);
    }
    expect(codebook.size() > 0, "codebook",
           join_text("a cluster of at least ", min_cluster_size, " features"),
           join_text("at most ", largest, " together among ", descriptors.size(), " features"));
    return codebook;
}

/// @brief The words that each descriptor looks like, by feature and within a feature by word.
template <std::size_t Dimension, DescriptorScalar Scalar>
[[nodiscard]] std::vector<Match> match(const Codebook<Dimension>& codebook,
                                       const Descriptors<Scalar, Dimension>& descriptors,
                                       unsigned threads = 0) {
    constexpr std::size_t rows = 64, columns = 512;
    constexpr auto length = static_cast<Eigen::Index>(Dimension);
    const Eigen::Map<const Eigen::MatrixXf> words(codebook.words.values().data(), length,
                                                  static_cast<Eigen::Index>(codebook.size()));
    const std::uint32_t groups =
        codebook.group.empty() ? 0 : *std::max_element(codebook.group.begin(), codebook.group.end()) + 1;
    const auto threshold = static_cast<float>(codebook.max_sq_distance);

    std::vector<std::vector<Match>> found((descriptors.size() + rows - 1) / rows);
    parallel_for(found.size(), threads, [&](std::size_t block) {
        const std::size_t first_row = block * rows, height = std::min(rows, descriptors.size() - first_row);
        Eigen::MatrixXf part(length, static_cast<Eigen::Index>(height));
        for (std::size_t i = 0; i < height; ++i)
            for (std::size_t k = 0; k < Dimension; ++k)
                part(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
                    static_cast<float>(descriptors.row(first_row + i)[k]);

        std::vector<std::vector<std::pair<std::uint32_t, float>>> near(height);  // word, squared distance
        Eigen::MatrixXf dots;
        for (std::size_t first = 0; first < codebook.size(); first += columns) {
            const std::size_t width = std::min(columns, codebook.size() - first);
            dots.noalias() =
                words.middleCols(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(width))
                    .transpose() *
                part;
            for (std::size_t i = 0; i < height; ++i) {
                const auto column = static_cast<Eigen::Index>(i);
                const float square = part.col(column).squaredNorm();
                const float* dot = dots.col(column).data();
                for (std::size_t j = 0; j < width; ++j) {
                    const float distance = square + codebook.mean_sq_length[first + j] - 2 * dot[j];
                    if (distance <= threshold) near[i].emplace_back(first + j, distance);
                }
            }
        }
        std::vector<std::uint32_t> count(groups);
        std::vector<std::pair<float, std::uint32_t>> nearest(groups);
        for (std::size_t i = 0; i < height; ++i) {
            const auto feature = static_cast<std::uint32_t>(first_row + i);
            std::fill(count.begin(), count.end(), 0u);
            std::fill(nearest.begin(), nearest.end(), std::pair(std::numeric_limits<float>::infinity(), 0u));
            for (const auto& [word, distance] : near[i]) {
                const std::uint32_t group = codebook.group[word];
                ++count[group];
                nearest[group] = std::min(nearest[group], std::pair(distance, word));
            }
            for (const auto& [word, distance] : near[i]) {
                const std::uint32_t group = codebook.group[word];
                found[block].push_back(
                    {feature, word, 1.0f / float(count[group]), nearest[group].second == word});
            }
        }
    });
    std::vector<Match> matches;
    for (const auto& part : found) matches.insert(matches.end(), part.begin(), part.end());
    return matches;
}

/// @brief Of the matches of match() the nearest word of each group, with the weight 1.
[[nodiscard]] inline std::vector<Match> nearest_only(std::span<const Match> matches) {
    std::vector<Match> nearest;
    for (const Match& match : matches)
        if (match.nearest) nearest.push_back({match.feature, match.word, 1.0f, true});
    return nearest;
}

}  // namespace ism
