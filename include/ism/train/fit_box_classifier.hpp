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
#include "ism/core/logistic.hpp"
#include "ism/core/random.hpp"
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
[[nodiscard]] inline double dot(std::span<const SparseEntry> sparse, std::span<const double> numbers) {
    double sums[4] = {};
    std::size_t k = 0;
    for (; k + 4 <= sparse.size(); k += 4)
        for (std::size_t l = 0; l < 4; ++l)
            sums[l] += double(sparse[k + l].value) * numbers[sparse[k + l].index];
    for (; k < sparse.size(); ++k) sums[0] += double(sparse[k].value) * numbers[sparse[k].index];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// The log odds t at which t + curvature · logistic(t) = target: by Newton's method between two bounds.
[[nodiscard]] inline double solve_log_odds(double curvature, double target, double t) {
    double lower = target - curvature, upper = target;
    t = std::clamp(t, lower, upper);
    for (int step = 0; step < 50; ++step) {
        const double p = logistic(t), error = t + curvature * p - target;
        if (std::abs(error) < 1e-6) break;
        (error > 0 ? upper : lower) = t;
        t -= error / (1 + curvature * p * (1 - p));
        if (!(t > lower && t < upper)) t = (lower + upper) / 2;
    }
    return t;
}

/// Logistic regression by dual coordinate descent (Yu, Huang and Lin 2011); positives and negatives weigh
/// alike. The bias is the weight of a column of ones.
/// @return the weights of the columns, and the bias after them
[[nodiscard]] inline std::vector<double> fit_logistic(const DesignMatrix& matrix,
                                                      const BoxClassifierOptions& options) {
    const std::size_t columns = matrix.bins.size(), rows = matrix.rows.size();
    const auto positives = std::size_t(std::count(matrix.positive.begin(), matrix.positive.end(), true));
    // The weights are the sum of all rows, each times its sign, its cost and the probability that it is taken
    // for the other kind, which begins at 0.
    std::vector<double> weight(columns + 1, 0), cost(rows), sq_length(rows, 1), log_odds(rows, -1e9);
    for (std::size_t i = 0; i < rows; ++i) {
        cost[i] = 0.5 / (options.regularisation * double(matrix.positive[i] ? positives : rows - positives));
        for (const SparseEntry& entry : matrix.rows[i])
            sq_length[i] += double(entry.value) * double(entry.value);
    }
    std::vector<std::uint32_t> order(rows);
    std::iota(order.begin(), order.end(), 0u);
    Random random(1);
    double most_change = std::numeric_limits<double>::infinity();
    for (int round = 0; round < options.max_rounds && most_change > options.tolerance; ++round) {
        most_change = 0;
        for (std::size_t k = rows; k > 1; --k) std::swap(order[k - 1], order[random.index(k)]);
        for (const std::uint32_t i : order) {
            const double sign = matrix.positive[i] ? 1 : -1, before = logistic(log_odds[i]),
                         curvature = cost[i] * sq_length[i];
            const double margin = sign * (dot(matrix.rows[i], weight) + weight[columns]);
            log_odds[i] = solve_log_odds(curvature, curvature * before - margin, log_odds[i]);
            const double change = logistic(log_odds[i]) - before;
            most_change = std::max(most_change, std::abs(change));
            for (const SparseEntry& entry : matrix.rows[i])
                weight[entry.index] += sign * cost[i] * change * double(entry.value);
            weight[columns] += sign * cost[i] * change;
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
