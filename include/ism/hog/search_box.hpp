// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/row_product.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/hog_pyramid.hpp"

namespace ism {

/// @brief A template ready to judge boxes, on both sides.
class TemplateScorer {
public:
    /// @brief The margin of a box, and the side that it shows.
    struct Score {
        double value = 0;  ///< above 0: rather an object of the class than none
        bool mirrored = false;
    };

    /// @param from  has to stay as long as this
    explicit TemplateScorer(const BoxTemplate& from)
        : template_(&from), mirrored_(mirrored_cells(from.weights, from.grid)) {}

    [[nodiscard]] const BoxTemplate& box_template() const { return *template_; }
    /// @brief The cells of a box, for score(): those of all templates that have the same grid.
    /// @return lies in `scratch`
    [[nodiscard]] std::span<const float> describe(const HogPyramid& pyramid, const Box& box,
                                                  CellScratch& scratch) const {
        scratch.cells.resize(template_->weights.size());
        describe_cells(pyramid, box, template_->grid, scratch.cells, scratch);
        return scratch.cells;
    }
    /// @brief Judges a box by its cells, on the side that fits better.
    [[nodiscard]] Score score(std::span<const float> cells, const Box& box) const {
        const double plain = dot(cells, template_->weights), other = dot(cells, mirrored_);
        return {std::max(plain, other) + template_->bias - template_->aspect_penalty(box), other > plain};
    }
    /// @brief Judges a box on one side.
    [[nodiscard]] double of_side(const HogPyramid& pyramid, const Box& box, bool mirrored,
                                 CellScratch& scratch) const {
        return dot(describe(pyramid, box, scratch), mirrored ? mirrored_ : template_->weights) +
               template_->bias - template_->aspect_penalty(box);
    }
    /// @brief What each cell of a box has to do with of_side().
    [[nodiscard]] CellShares explain(const HogPyramid& pyramid, const Box& box, bool mirrored,
                                     CellScratch& scratch) const {
        const std::span<const float> cells = describe(pyramid, box, scratch);
        const std::span<const float> weights = mirrored ? mirrored_ : template_->weights;
        const double rest = template_->bias - template_->aspect_penalty(box);
        CellShares result{template_->grid, box, {}};
        for (std::size_t i = 0; i < cells.size(); i += cell_numbers)
            result.shares.push_back(
                float(dot(cells.subspan(i, cell_numbers), weights.subspan(i, cell_numbers)) +
                      rest / double(template_->grid.cells())));
        return result;
    }

private:
    [[nodiscard]] static double dot(std::span<const float> a, std::span<const float> b) {
        return detail::row_product(a.data(), b.data(), a.size());
    }

    const BoxTemplate* template_;
    std::vector<float> mirrored_;
};

/// @brief A box with its score and the side that it shows.
struct SearchedBox {
    Box box;
    double score = 0;  ///< the template's margin
    bool mirrored = false;
};

/// @brief Moves a box to where the template fits best nearby: its place, its size and its sides in turn,
/// either way, by .16, then .08 and then .04 of the sides, each move taken where it gains.
[[nodiscard]] inline SearchedBox search_box(const TemplateScorer& scorer, const HogPyramid& pyramid,
                                            SearchedBox at, CellScratch& scratch) {
    struct Move {
        double x, y, width, height;
    };
    static constexpr Move moves[] = {
        {1, 0, 0, 0}, {0, 1, 0, 0}, {-.5, -.5, 1, 1}, {-.5, 0, 1, 0}, {0, -.5, 0, 1}};
    for (const double step : {0.16, 0.08, 0.04})
        for (const Move& m : moves)
            for (const double part : {step, -step}) {
                const double w = at.box.width * part, h = at.box.height * part;
                const Box box{at.box.x + m.x * w, at.box.y + m.y * h, at.box.width + m.width * w,
                              at.box.height + m.height * h};
                const double score = scorer.of_side(pyramid, box, at.mirrored, scratch);
                if (!(score > at.score)) continue;
                at.box = box, at.score = score;
                break;
            }
    return at;
}

}  // namespace ism
