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
#include <type_traits>
#include <utility>
#include <vector>

#include "ism/core/random.hpp"
#include "ism/core/row_product.hpp"

namespace ism {

/// @brief A linear classifier: positive where weights · x + bias is above 0.
struct LinearClassifier {
    std::vector<float> weights;
    double bias = 0;
};

/// @brief Where the `dimension` numbers of each example begin that lie one after another.
template <RowNumber T>
[[nodiscard]] std::vector<const T*> row_starts(const std::vector<T>& rows, std::size_t dimension) {
    std::vector<const T*> starts;
    for (std::size_t k = 0; k < rows.size(); k += dimension) starts.push_back(rows.data() + k);
    return starts;
}

namespace detail {

/// Adds a share of some weights to others.
inline void add_share(float share, std::span<const float> weights, std::span<float> sum) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += share * weights[k];
}

}  // namespace detail

/// @brief How a linear support vector machine is fitted.
struct LinearSvmOptions {
    double cost = 0.05;        ///< C: what an example costs that lies within the margin
    double positive_cost = 1;  ///< how many times more a positive one costs
    double bias_scale = 10;    ///< the constant feature that the bias is the weight of
    double tolerance = 0.01;   ///< of the gradients' spread, for an end
    int max_rounds = 300;      ///< over all examples
    double unit = 1;           ///< what a 1 in the rows stands for
};

/// @brief Fits a linear support vector machine with squared hinge loss by dual coordinate descent (Hsieh,
/// Chang, Lin, Keerthi and Sundararajan 2008, algorithm 1 with shrinking).
/// @param rows      of each example where its `dimension` numbers begin, see row_starts()
/// @param positive  of each row
/// @tparam T        of the rows
template <RowNumber T = float>
[[nodiscard]] LinearClassifier fit_linear_svm(std::type_identity_t<std::span<const T* const>> rows,
                                              std::size_t dimension, std::span<const std::uint8_t> positive,
                                              const LinearSvmOptions& options = {}) {
    const std::size_t count = positive.size();
    const auto dot = [&](const auto* a, const T* b) {
        return detail::row_product(a, b, dimension) * options.unit;
    };
    std::vector<double> alpha(count, 0), diagonal(count), softness(count);
    for (std::size_t i = 0; i < count; ++i)
        softness[i] = 0.5 / (options.cost * (positive[i] ? options.positive_cost : 1));
    LinearClassifier fit{.weights = std::vector<float>(dimension, 0)};
    double bias_weight = 0;
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::size_t active = count;
    double upper = std::numeric_limits<double>::infinity();
    Random random(1);
    for (int round = 0; round < options.max_rounds; ++round) {
        for (std::size_t i = 0; i < active; ++i) std::swap(order[i], order[i + random.index(active - i)]);
        double most = -std::numeric_limits<double>::infinity(),
               least = std::numeric_limits<double>::infinity();
        for (std::size_t s = 0; s < active; ++s) {
            const std::uint32_t i = order[s];
            const double sign = positive[i] ? 1 : -1;
            const T* x = rows[i];
            const double gradient = sign * (dot(fit.weights.data(), x) + bias_weight * options.bias_scale) -
                                    1 + softness[i] * alpha[i];
            if (round == 0)  // which visits all
                diagonal[i] =
                    options.unit * dot(x, x) + options.bias_scale * options.bias_scale + softness[i];
            double projected = gradient;
            if (alpha[i] == 0) {
                if (gradient > upper) {
                    std::swap(order[s--], order[--active]);
                    continue;
                }
                projected = std::min(0.0, gradient);
            }
            most = std::max(most, projected), least = std::min(least, projected);
            if (std::abs(projected) < 1e-12) continue;
            const double before = alpha[i];
            alpha[i] = std::max(0.0, alpha[i] - gradient / diagonal[i]);
            const double change = (alpha[i] - before) * sign;
            detail::add_row(float(change * options.unit), x, fit.weights.data(), dimension);
            bias_weight += change * options.bias_scale;
        }
        if (most - least <= options.tolerance) {
            if (active == count) break;
            active = count, upper = std::numeric_limits<double>::infinity();
            continue;
        }
        upper = most > 0 ? most : std::numeric_limits<double>::infinity();
    }
    fit.bias = bias_weight * options.bias_scale;
    return fit;
}

}  // namespace ism
