// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/grouped.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/train/train_options.hpp"
#include "ism/train/training_boxes.hpp"

namespace ism {

namespace detail {

/// What the classifier of one class is fitted to.
struct DesignMatrix {
    std::vector<std::uint32_t> bins;  // the columns, rising
    Grouped<SparseEntry> rows;        // index = column
    std::vector<bool> positive;       // of each row: whether it shows the class
};

/// The boxes that show the class or were predicted to, whose bins are the columns, and an evenly spaced
/// subset of those that show another class.
[[nodiscard]] inline DesignMatrix design_matrix(const std::vector<const TrainingBox*>& boxes,
                                                std::size_t words, std::size_t class_index,
                                                std::size_t max_others) {
    std::vector<const TrainingBox*> used, others;
    for (const TrainingBox* box : boxes)
        if (box->true_class == class_index || box->predicted_class == class_index)
            used.push_back(box);
        else if (box->true_class != TrainingBox::background)
            others.push_back(box);
    constexpr auto no_column = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> column(BoxClassifier::cells * words, no_column);
    for (const TrainingBox* box : used)
        for (const SparseEntry& bin : box->histogram) column[bin.index] = 0;
    DesignMatrix matrix;
    for (std::uint32_t bin = 0; bin < column.size(); ++bin)
        if (column[bin] != no_column) {
            column[bin] = static_cast<std::uint32_t>(matrix.bins.size());
            matrix.bins.push_back(bin);
        }
    const std::size_t count = std::min(others.size(), max_others);
    for (std::size_t k = 0; k < count; ++k) used.push_back(others[k * others.size() / count]);
    for (const TrainingBox* box : used) {
        std::vector<SparseEntry> row;
        for (const SparseEntry& bin : box->histogram)
            if (column[bin.index] != no_column) row.push_back({column[bin.index], bin.value});
        matrix.rows.push_back(row);
        matrix.positive.push_back(box->true_class == class_index);
    }
    return matrix;
}

/// The rows of a matrix by column: index = row.
[[nodiscard]] inline Grouped<SparseEntry> transposed(const Grouped<SparseEntry>& rows, std::size_t columns) {
    std::vector<std::uint32_t> offsets(columns + 1, 0);
    for (const SparseEntry& entry : rows.values()) ++offsets[entry.index + 1];
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
    std::vector<SparseEntry> entries(rows.values().size());
    for (std::uint32_t row = 0; row < rows.size(); ++row)
        for (const SparseEntry& entry : rows[row]) entries[next[entry.index]++] = {row, entry.value};
    return {std::move(entries), std::move(offsets)};
}

/// By four sums, since each addition waits for the last.
[[nodiscard]] inline double dot(std::span<const SparseEntry> sparse, std::span<const double> numbers) {
    double sums[4] = {};
    std::size_t k = 0;
    for (; k + 4 <= sparse.size(); k += 4)
        for (std::size_t l = 0; l < 4; ++l)
            sums[l] += double(sparse[k + l].value) * numbers[sparse[k + l].index];
    for (; k < sparse.size(); ++k) sums[0] += double(sparse[k].value) * numbers[sparse[k].index];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Logistic regression by AdaGrad (Duchi et al. 2011); positives and negatives weigh alike.
/// @return the weights of the columns, and the bias after them; the same for any number of threads
[[nodiscard]] inline std::vector<double> fit_logistic(const DesignMatrix& matrix,
                                                      const BoxClassifierOptions& options, ThreadPool& pool) {
    const std::size_t columns = matrix.bins.size(), rows = matrix.rows.size();
    const auto positives = std::size_t(std::count(matrix.positive.begin(), matrix.positive.end(), true));
    const double positive_weight = 0.5 / double(std::max<std::size_t>(1, positives));
    const double negative_weight = 0.5 / double(std::max<std::size_t>(1, rows - positives));
    const Grouped<SparseEntry> by_column = transposed(matrix.rows, columns);
    std::vector<double> weight(columns + 1, 0), sq_slopes(columns + 1, 1e-8), error(rows);
    const auto descend = [&](std::size_t b, double slope) {
        constexpr double rate = 0.3;
        sq_slopes[b] += slope * slope;
        weight[b] -= rate * slope / std::sqrt(sq_slopes[b]);
    };
    const auto each = [&](std::size_t count, const auto& body) {
        constexpr std::size_t block = 256;
        pool.for_each((count + block - 1) / block, [&](std::size_t k, unsigned) {
            for (std::size_t i = k * block; i < std::min(count, (k + 1) * block); ++i) body(i);
        });
    };
    for (int step = 0; step < options.iterations; ++step) {
        each(rows, [&](std::size_t i) {
            const bool positive = matrix.positive[i];
            const double predicted = 1 / (1 + std::exp(-weight[columns] - dot(matrix.rows[i], weight)));
            error[i] = (predicted - double(positive)) * (positive ? positive_weight : negative_weight);
        });
        each(columns, [&](std::size_t b) {
            descend(b, options.regularisation * weight[b] + dot(by_column[b], error));
        });
        descend(columns, std::accumulate(error.begin(), error.end(), 0.0));
    }
    return weight;
}

}  // namespace detail

/// @brief Fits the classifier of boxes: for each class the boxes that show it against those that show another
/// or were predicted to show it. Hypotheses whose overlap lies between the two limits of the options are left
/// out. The classifier of a class uses the bins of boxes that show it or were predicted to, so that its size
/// does not grow with the number of classes.
/// @param words  of the model
/// @throws Error for boxes with bins of other words.
[[nodiscard]] inline BoxClassifier fit_box_classifier(const std::vector<TrainingBox>& boxes,
                                                      std::size_t words, std::size_t classes,
                                                      const BoxClassifierOptions& options = {},
                                                      unsigned threads = 0) {
    std::vector<TrainingBox> far;  // copies of those that count as background
    std::vector<const TrainingBox*> used;
    far.reserve(boxes.size());
    for (const TrainingBox& box : boxes) {
        if (!box.histogram.empty())
            expect(box.histogram.back().index < BoxClassifier::cells * words, "classifier of boxes: bin",
                   lazy_text("below ", BoxClassifier::cells * words), box.histogram.back().index);
        if (box.overlap >= options.same_iou || box.true_class == TrainingBox::background) {
            used.push_back(&box);
        } else if (box.overlap < options.other_iou) {
            far.push_back(box);
            far.back().true_class = TrainingBox::background;
            used.push_back(&far.back());
        }
    }
    ThreadPool pool(threads);
    BoxClassifier classifier;
    for (std::size_t c = 0; c < classes; ++c) {
        const detail::DesignMatrix matrix = detail::design_matrix(used, words, c, options.max_others);
        const std::vector<double> fitted = detail::fit_logistic(matrix, options, pool);
        std::vector<SparseEntry> weights;
        for (std::size_t b = 0; b < matrix.bins.size(); ++b)
            weights.push_back({matrix.bins[b], static_cast<float>(fitted[b])});
        classifier.push_back(weights, static_cast<float>(fitted.back()));
    }
    return classifier;
}

}  // namespace ism
