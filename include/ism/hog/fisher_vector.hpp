// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/patch_mixture.hpp"

namespace ism {

/// @brief How boxes are cut into cells for patches: about 225 squares and a ring around, whatever the aspect.
[[nodiscard]] inline BoxGrid patch_grid(const Box& box) {
    constexpr double cells = 225;
    const int columns = std::clamp(int(std::lround(std::sqrt(cells * box.width / box.height))), 3, 75);
    return {.columns = columns, .rows = std::max(3, int(std::lround(cells / columns))), .ring = true};
}

/// @brief A patch along the axes of a mixture.
using Patch = std::array<float, patch_axes>;

/// @brief The patch of a box whose first cell is this one.
/// @param cells  of describe_cells(), `columns` a row
[[nodiscard]] inline Patch reduce_patch(const PatchMixture& mixture, std::span<const float> cells,
                                        std::size_t columns, std::size_t column, std::size_t row) {
    Patch patch{};
    const float *mean = mixture.mean.data(), *axes = mixture.axes.data();
    for (const std::size_t first : {row * columns + column, (row + 1) * columns + column}) {
        const float* pair = cells.data() + first * cell_numbers;  // two cells side by side
        for (std::size_t k = 0; k < 2 * cell_numbers; ++k, ++mean, axes += patch_axes)
            for (std::size_t d = 0; d < patch_axes; ++d) patch[d] += (pair[k] - *mean) * axes[d];
    }
    return patch;
}

/// @brief What a patch has to do with each Gaussian of a mixture.
struct PatchPlace {
    std::array<Patch, PatchMixture::gaussians> apart;  ///< from its mean, in standard deviations
    std::array<float, PatchMixture::gaussians>
        share;  ///< p(Gaussian | patch); 0 below 1/1000 of the likeliest
};

/// @brief Tells where patches lie in a mixture.
class PatchPlacer {
public:
    /// @param mixture  not empty; has to stay as long as this
    explicit PatchPlacer(const PatchMixture& mixture) : mixture_(&mixture) {
        for (std::size_t g = 0; g < PatchMixture::gaussians; ++g) {
            double log_volume = 0;
            for (std::size_t d = 0; d < patch_axes; ++d) {
                by_spread_[g][d] = 1 / mixture.spreads[g * patch_axes + d];
                log_volume += std::log(double(mixture.spreads[g * patch_axes + d]));
            }
            log_weights_[g] = float(std::log(double(mixture.weights[g])) - log_volume);
        }
    }
    [[nodiscard]] const PatchMixture& mixture() const { return *mixture_; }
    [[nodiscard]] PatchPlace operator()(const Patch& patch) const {
        PatchPlace place;
        for (std::size_t g = 0; g < PatchMixture::gaussians; ++g) {
            const float* mean = &mixture_->means[g * patch_axes];
            std::array<float, 8> sq{};
            for (std::size_t d = 0; d < patch_axes; ++d)
                place.apart[g][d] = (patch[d] - mean[d]) * by_spread_[g][d];
            for (std::size_t d = 0; d < patch_axes; d += sq.size())
                for (std::size_t l = 0; l < sq.size(); ++l)
                    sq[l] += place.apart[g][d + l] * place.apart[g][d + l];
            const float sum = ((sq[0] + sq[4]) + (sq[1] + sq[5])) + ((sq[2] + sq[6]) + (sq[3] + sq[7]));
            place.share[g] = log_weights_[g] - 0.5f * sum;
        }
        const float most = *std::max_element(place.share.begin(), place.share.end());
        float total = 0;
        for (float& s : place.share) s = s > most - 7 ? std::exp(s - most) : 0, total += s;
        for (float& s : place.share) s /= total;
        return place;
    }

private:
    const PatchMixture* mixture_;
    std::array<Patch, PatchMixture::gaussians> by_spread_{};
    std::array<float, PatchMixture::gaussians> log_weights_{};
};

/// @brief Says how the patches of a box differ from what patches look like anywhere: the Fisher vector of the
/// box and of its thirds from above (Perronnin, Sánchez and Mensink 2010). It does not mind where in a third
/// a patch lies, and hence finds alike what a template finds different, such as animals that walk.
class FisherEncoder {
public:
    /// @param mixture  not empty; has to stay as long as this
    explicit FisherEncoder(const PatchMixture& mixture) : place_(mixture) {}

    /// @brief The vector of a box that was described as patch_grid() says: PatchMixture::vector_numbers, of
    /// length 1.
    /// @param cells  of describe_cells(), or as a mirror shows them
    [[nodiscard]] std::vector<float> encode(std::span<const float> cells, const BoxGrid& grid) const {
        std::array<Sums, parts> sums{};
        const auto columns = std::size_t(grid.all_columns()), rows = std::size_t(grid.all_rows());
        for (std::size_t j = 0; j + 1 < rows; ++j)
            for (std::size_t i = 0; i + 1 < columns; ++i)
                count(place_(reduce_patch(place_.mixture(), cells, columns, i, j)),
                      sums[1 + j * (parts - 1) / (rows - 1)]);
        for (std::size_t part = 1; part < parts; ++part)
            for (std::size_t k = 0; k < part_numbers; ++k) sums[0][k] += sums[part][k];
        std::vector<float> vector;
        vector.reserve(PatchMixture::vector_numbers);
        for (const Sums& part : sums) append(part, vector);
        return vector;
    }
    /// @brief The vector of a box in an image.
    [[nodiscard]] std::vector<float> encode(const HogPyramid& pyramid, const Box& box,
                                            CellScratch& scratch) const {
        const BoxGrid grid = patch_grid(box);
        scratch.cells.resize(grid.cells() * cell_numbers);
        describe_cells(pyramid, box, grid, scratch.cells, scratch);
        return encode(scratch.cells, grid);
    }

private:
    static constexpr std::size_t parts = PatchMixture::parts, part_numbers = PatchMixture::part_numbers;
    /// Of each Gaussian, by how much patches differ from its mean and, after that, from its variance.
    using Sums = std::array<float, part_numbers>;

    static void count(const PatchPlace& place, Sums& sums) {
        for (std::size_t g = 0; g < PatchMixture::gaussians; ++g) {
            const float share = place.share[g];
            if (!(share > 0)) continue;
            float *of_mean = &sums[2 * g * patch_axes], *of_variance = of_mean + patch_axes;
            for (std::size_t d = 0; d < patch_axes; ++d) {
                const float apart = place.apart[g][d];
                of_mean[d] += share * apart;
                of_variance[d] += share * (apart * apart - 1);
            }
        }
    }
    /// Roots with their signs, so that patches that repeat count less, at half the length of the vector.
    void append(const Sums& sums, std::vector<float>& vector) const {
        const std::size_t first = vector.size();
        double sq_length = 0;
        for (std::size_t k = 0; k < part_numbers; ++k) {
            const double weight = double(place_.mixture().weights[k / (2 * patch_axes)]);
            const double expected = k / patch_axes % 2 == 0 ? weight : 2 * weight;
            const double sum = double(sums[k]) / std::sqrt(expected);
            sq_length += std::abs(sum);
            vector.push_back(float(std::copysign(std::sqrt(std::abs(sum)), sum)));
        }
        const auto factor = float(sq_length > 0 ? 1 / std::sqrt(sq_length * parts) : 0);
        for (std::size_t k = first; k < vector.size(); ++k) vector[k] *= factor;
    }

    PatchPlacer place_;
};

}  // namespace ism
