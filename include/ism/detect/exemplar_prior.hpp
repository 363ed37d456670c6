// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/order.hpp"
#include "ism/detect/exemplar_likeness.hpp"
#include "ism/model/describe_exemplar.hpp"
#include "ism/model/model.hpp"

namespace ism {

/// @brief How masks are lent by exemplars.
struct ExemplarOptions {
    std::size_t max_exemplars = 100;  ///< that are most alike, of both sides, have a say
    double size_step = 0.05;   ///< the box is also compared in sizes smaller and larger by this; 0 = not
    double place_step = 0.03;  ///< … and moved aslant by this part of its sides; 0 = not
    double sharpness = 60;     ///< weight: exp(sharpness · cosine)
    double shift_cost = 0.01;  ///< of the cosine, for a part that lies a cell beside its place
    double agreement = 15;     ///< weight: exp(−agreement · mean difference of mask and picture)
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const ExemplarOptions& options) {
    expect(options.max_exemplars >= 1, "ExemplarOptions::max_exemplars", "1 or more", options.max_exemplars);
    expect(options.size_step >= 0 && options.size_step <= 0.1, "ExemplarOptions::size_step", "0 ... 0.1",
           options.size_step);
    expect(options.place_step >= 0 && options.place_step <= 0.05, "ExemplarOptions::place_step", "0 ... 0.05",
           options.place_step);
    expect(options.sharpness >= 0 && options.sharpness <= 1e4, "ExemplarOptions::sharpness", "0 ... 1e4",
           options.sharpness);
    expect(options.shift_cost >= 0 && options.shift_cost <= 2, "ExemplarOptions::shift_cost", "0 ... 2",
           options.shift_cost);
    expect(options.agreement >= 0 && options.agreement <= 1e4, "ExemplarOptions::agreement", "0 ... 1e4",
           options.agreement);
}

/// @brief The boxes in and around one that are compared with exemplars, itself first.
[[nodiscard]] inline std::vector<Box> compared_boxes(const Box& box, const ExemplarOptions& options) {
    std::vector<Box> boxes{box};
    if (const double step = options.size_step; step > 0)
        for (const double size : {1 - step, 1 + step})
            boxes.push_back({box.x + (1 - size) / 2 * box.width, box.y + (1 - size) / 2 * box.height,
                             size * box.width, size * box.height});
    if (const double step = options.place_step; step > 0)
        for (const double right : {-step, step})
            for (const double down : {-step, step})
                boxes.push_back(
                    {box.x + right * box.width, box.y + down * box.height, box.width, box.height});
    return boxes;
}

/// @brief p(figure) in a box by the masks of training objects that look like it part by part: each cell takes
/// the masks of those whose 3 × 3 cells around it are alike, there or a cell beside it.
class ExemplarPrior {
public:
    static constexpr int samples = 4;  ///< of the prior along a side of a cell
    static constexpr int margin = 2;   ///< cells around the box
    static constexpr int side = (exemplar_cells + 2 * margin) * samples;  ///< of the prior

    /// @param views  of the boxes it is compared in, see compared_boxes(); the first is the box itself
    /// @param among  indices of the model's exemplars that are asked
    /// @throws Error where there is no view or exemplar.
    ExemplarPrior(const Model& model, std::span<const std::uint32_t> among,
                  std::span<const ExemplarView> views, const ExemplarOptions& options)
        : options_(options) {
        expect(!among.empty() && !views.empty(), "masks that are lent: exemplars and views",
               "1 or more of each", lazy_text(among.size(), " and ", views.size()));
        std::vector<std::vector<std::uint8_t>> mirrored;
        std::vector<double> lengths;
        std::vector<detail::ExemplarSums> box_sq;
        const auto length = [](const std::vector<std::uint8_t>& cells) {
            return std::sqrt(detail::exemplar_product(cells, cells) + 1.0);
        };
        for (const ExemplarView& view : views) {
            mirrored.push_back(mirrored_exemplar(view.cells));
            lengths.push_back(length(view.cells));
            box_sq.push_back(detail::ExemplarSquares(view.cells).of_blocks(0, 0));
        }
        std::vector<Candidate> candidates;
        for (const std::uint32_t e : among) {
            const auto& own = model.exemplars[e].cells;
            const double own_length = length(own);
            for (std::size_t v = 0; v < views.size(); ++v)
                for (const bool is_mirrored : {false, true}) {
                    const int both =
                        detail::exemplar_product(is_mirrored ? mirrored[v] : views[v].cells, own);
                    candidates.push_back({e, v, is_mirrored, both / (own_length * lengths[v])});
                }
        }
        detail::sort_by(candidates, [](const Candidate& c) { return detail::falling(c.likeness); });
        if (candidates.size() > options.max_exemplars) candidates.resize(options.max_exemplars);
        parts_ = candidates.size() * shifts;
        likeness_.resize(inner * parts_);
        masks_.resize(candidates.size() * mask_size);
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            const auto& [e, view, is_mirrored, unused] = candidates[i];
            const MaskExemplar& exemplar = model.exemplars[e];
            compare(views[view].cells, box_sq[view],
                    is_mirrored ? mirrored_exemplar(exemplar.cells) : exemplar.cells, i);
            copy_mask(model.shapes.objects[exemplar.object].mask, is_mirrored, views.front().box,
                      views[view].box, i);
        }
    }

    /// @brief The prior on side × side samples of the box and its margin.
    [[nodiscard]] GrayImage prior() const { return lent(likeness_); }

    /// @brief The same by those whose masks agree with what is known of the picture, in the 5 × 5 cells
    /// around, without the outermost ring.
    /// @param figure  p(figure) as samples, as prior() returns them
    [[nodiscard]] GrayImage prior(const GrayImage& figure) const {
        constexpr int n = cells_side;
        const CellMeans known = cell_means([&](int x, int y) { return 255 * figure(x, y); });
        const float cost = float(options_.agreement / std::max(options_.sharpness, 1e-9)) / (255 * 25);
        std::vector<float> worth = likeness_;
        for (std::size_t part = 0; part < parts_; ++part) {
            const CellMeans& mask = means_[part / shifts];
            const int beside = shift_y(part) * n + shift_x(part);
            CellMeans difference{}, across{};
            for (int y = 1; y < n - 1; ++y)
                for (int x = 1; x < n - 1; ++x) {
                    const int at = y * n + x;
                    difference[std::size_t(at)] =
                        std::abs(mask[std::size_t(at + beside)] - known[std::size_t(at)]);
                }
            for (int y = 1; y < n - 1; ++y)
                for (int x = margin; x < n - margin; ++x) {
                    const float* d = difference.data() + y * n + x;
                    across[std::size_t(y * n + x)] = d[-2] + d[-1] + d[0] + d[1] + d[2];
                }
            for (int row = 0; row < exemplar_cells; ++row)
                for (int column = 0; column < exemplar_cells; ++column) {
                    const float* a = across.data() + (row + margin) * n + column + margin;
                    worth[std::size_t(row * exemplar_cells + column) * parts_ + part] -=
                        cost * (a[-2 * n] + a[-n] + a[0] + a[n] + a[2 * n]);
                }
        }
        return lent(worth);
    }

private:
    struct Candidate {
        std::uint32_t exemplar;
        std::size_t view;
        bool mirrored;
        double likeness;
    };
    static constexpr std::size_t inner = std::size_t(exemplar_cells) * exemplar_cells, shifts = 9;
    static constexpr int cells_side = exemplar_cells + 2 * margin;
    static constexpr int mask_side = side + 2 * samples;  ///< one more cell around, for the shifts
    static constexpr std::size_t mask_size = std::size_t(mask_side) * mask_side;
    /// A number for each cell of the box and its margin.
    using CellMeans = std::array<float, std::size_t(cells_side) * cells_side>;

    /// How many cells to the right, and below, a part looks at an exemplar.
    [[nodiscard]] static int shift_x(std::size_t part) { return int(part % shifts) % 3 - 1; }
    [[nodiscard]] static int shift_y(std::size_t part) { return int(part % shifts) / 3 - 1; }

    /// How much each cell of the box looks like those of candidate number i.
    void compare(const std::vector<std::uint8_t>& box, const detail::ExemplarSums& box_sq,
                 const std::vector<std::uint8_t>& own, std::size_t i) {
        const detail::ExemplarSquares squares(own);
        for (std::size_t part = i * shifts; part < (i + 1) * shifts; ++part) {
            const int dx = shift_x(part), dy = shift_y(part);
            const float cost = float(options_.shift_cost * std::sqrt(dx * dx + dy * dy));
            detail::each_likeness(
                box, box_sq, own, squares.of_blocks(dx, dy), dx, dy, [&](int column, int row, float cosine) {
                    likeness_[std::size_t(row * exemplar_cells + column) * parts_ + part] = cosine - cost;
                });
        }
    }

    /// @param compared  box that the exemplar looks like
    void copy_mask(const Mask& mask, bool mirrored, const Box& box, const Box& compared, std::size_t i) {
        std::uint8_t* to = masks_.data() + i * mask_size;
        // the columns or rows of the mask at the samples; outside it is none
        const auto lines = [](double offset, double zoom, int count) {
            std::array<int, std::size_t(mask_side)> result{};
            for (std::size_t at = 0; at < result.size(); ++at) {
                const double cells = (double(at) + 0.5) / samples - (margin + 1);
                result[at] = int(std::floor((offset + zoom * cells / exemplar_cells) * count));
            }
            return result;
        };
        const auto columns =
            lines((box.x - compared.x) / compared.width, box.width / compared.width, mask.width());
        const auto rows =
            lines((box.y - compared.y) / compared.height, box.height / compared.height, mask.height());
        for (const int row : rows)
            for (const int column : columns) {
                if (mask.contains(column, row))
                    *to = mask(mirrored ? mask.width() - 1 - column : column, row);
                ++to;
            }
        const std::uint8_t* first = masks_.data() + i * mask_size + samples * mask_side + samples;
        means_.push_back(cell_means([&](int x, int y) { return float(first[y * mask_side + x]); }));
    }
    /// The mask that belongs to a part, from the first sample of the prior on.
    [[nodiscard]] const std::uint8_t* shifted_mask(std::size_t part) const {
        return masks_.data() + part / shifts * mask_size +
               ((1 + shift_y(part)) * mask_side + 1 + shift_x(part)) * samples;
    }
    template <class At>
    [[nodiscard]] static CellMeans cell_means(const At& at) {
        CellMeans means{};
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                means[std::size_t(y / samples * cells_side + x / samples)] += at(x, y) / (samples * samples);
        return means;
    }

    /// Each cell's mean of the masks, by what they are worth there; between the cells' centres interpolated.
    [[nodiscard]] GrayImage lent(const std::vector<float>& worth) const {
        constexpr float least = 1e-2f;  // of the largest weight
        const float sharpness = float(options_.sharpness), least_log = std::log(least);
        GrayImage prior(side, side, 0.0f);
        std::vector<float> mean(std::size_t(side) * side);
        for (int row = 0; row < exemplar_cells; ++row)
            for (int column = 0; column < exemplar_cells; ++column) {
                const float* own = worth.data() + std::size_t(row * exemplar_cells + column) * parts_;
                const float best = *std::max_element(own, own + parts_);
                const auto [x0, x1] = reach(column);
                const auto [y0, y1] = reach(row);
                float sum = 0;
                std::fill(mean.begin(), mean.end(), 0.0f);
                for (std::size_t part = 0; part < parts_; ++part) {
                    const float log = sharpness * (own[part] - best);
                    if (log < least_log) continue;
                    const float weight = std::exp(log);
                    sum += weight;
                    const std::uint8_t* mask = shifted_mask(part);
                    for (int y = y0; y < y1; ++y)
                        for (int x = x0; x < x1; ++x)
                            mean[std::size_t(y * side + x)] += weight * float(mask[y * mask_side + x]);
                }
                for (int y = y0; y < y1; ++y)
                    for (int x = x0; x < x1; ++x)
                        prior(x, y) +=
                            mean[std::size_t(y * side + x)] * share(column, x) * share(row, y) / (255 * sum);
            }
        return prior;
    }
    /// The samples that a column (or row) of cells has a share in: up to the centres of its neighbours, at
    /// the ends all.
    [[nodiscard]] static std::pair<int, int> reach(int cell) {
        const int first = (margin + cell) * samples - samples / 2;
        return {cell == 0 ? 0 : first, cell == exemplar_cells - 1 ? side : first + 2 * samples};
    }
    [[nodiscard]] static float share(int cell, int sample) {
        const float at =
            std::clamp((float(sample) + 0.5f) / samples - margin - 0.5f, 0.0f, exemplar_cells - 1.0f);
        return std::max(0.0f, 1 - std::abs(at - float(cell)));
    }

    ExemplarOptions options_;
    std::size_t parts_ = 0;            ///< candidates · shifts
    std::vector<float> likeness_;      ///< of each cell to each part
    std::vector<std::uint8_t> masks_;  ///< of each candidate, mask_size samples
    std::vector<CellMeans> means_;     ///< of each candidate's mask
};

}  // namespace ism
