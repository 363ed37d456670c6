// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
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

/// By four sums, since each addition waits for the last.
[[nodiscard]] inline double dot(std::span<const SparseEntry> row, std::span<const double> weight) {
    double sums[4] = {};
    std::size_t k = 0;
    for (; k + 4 <= row.size(); k += 4)
        for (std::size_t l = 0; l < 4; ++l) sums[l] += double(row[k + l].value) * weight[row[k + l].index];
    for (; k < row.size(); ++k) sums[0] += double(row[k].value) * weight[row[k].index];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Logistic regression by AdaGrad (Duchi et al. 2011); positives and negatives weigh alike.
/// @return the weights of the columns, and the bias after them
[[nodiscard]] inline std::vector<double> fit_logistic(const DesignMatrix& matrix,
                                                      const BoxClassifierOptions& options) {
    const std::size_t columns = matrix.bins.size(), rows = matrix.rows.size();
    const auto positives = std::size_t(std::count(matrix.positive.begin(), matrix.positive.end(), true));
    const double positive_weight = 0.5 / double(std::max<std::size_t>(1, positives));
    const double negative_weight = 0.5 / double(std::max<std::size_t>(1, rows - positives));
    constexpr double rate = 0.3;
    std::vector<double> weight(columns + 1, 0), slope(columns + 1), sq_slopes(columns + 1, 1e-8);
    for (int step = 0; step < options.iterations; ++step) {
        for (std::size_t b = 0; b < columns; ++b) slope[b] = options.regularisation * weight[b];
        slope[columns] = 0;
        for (std::size_t i = 0; i < rows; ++i) {
            const double sum = weight[columns] + dot(matrix.rows[i], weight);
            const bool positive = matrix.positive[i];
            const double error = (1 / (1 + std::exp(-sum)) - double(positive)) *
                                 (positive ? positive_weight : negative_weight);
            for (const SparseEntry& entry : matrix.rows[i]) slope[entry.index] += error * double(entry.value);
            slope[columns] += error;
        }
        for (std::size_t b = 0; b <= columns; ++b) {
            sq_slopes[b] += slope[b] * slope[b];
            weight[b] -= rate * slope[b] / std::sqrt(sq_slopes[b]);
        }
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
    std::vector<std::vector<SparseEntry>> weights(classes);
    std::vector<float> bias(classes);
    parallel_for(classes, threads, [&](std::size_t c) {
        const detail::DesignMatrix matrix = detail::design_matrix(used, words, c, options.max_others);
        const std::vector<double> fitted = detail::fit_logistic(matrix, options);
        for (std::size_t b = 0; b < matrix.bins.size(); ++b)
            weights[c].push_back({matrix.bins[b], static_cast<float>(fitted[b])});
        bias[c] = static_cast<float>(fitted.back());
    });
    BoxClassifier classifier;
    for (std::size_t c = 0; c < classes; ++c) classifier.push_back(weights[c], bias[c]);
    return classifier;
}

}  // namespace ism
