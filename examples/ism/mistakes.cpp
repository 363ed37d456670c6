// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "mistakes.hpp"

#include <cmath>
#include <cstddef>
#include <numeric>

#include "input.hpp"

#include "ism/core/text.hpp"
#include "ism/evaluate/coco.hpp"
#include "ism/evaluate/matching.hpp"

namespace program {

std::string Mistakes::text() const {
    std::string text;
    if (!missed.empty()) text = "missed: " + list_text(missed);
    if (!wrong.empty()) text += (text.empty() ? "wrong: " : "; wrong: ") + list_text(wrong);
    return text;
}

namespace {

ism::Judged judged_as(ism::Verdict verdict) {
    if (verdict == ism::Verdict::ignored) return ism::Judged::ignored;
    return verdict == ism::Verdict::true_positive ? ism::Judged::right : ism::Judged::wrong;
}

}  // namespace

std::vector<Mistakes> find_mistakes(const ism::Dataset& dataset,
                                    std::span<const std::vector<ism::Result>> of_image) {
    const ism::detail::DatasetTruth labels = ism::detail::truth_of(dataset);
    const std::vector<ism::TruthObject>& truth = labels.objects;
    std::vector<ism::Result> results;
    for (const auto& own : of_image) results.insert(results.end(), own.begin(), own.end());
    const std::vector<ism::FoundObject> found = ism::detail::found_in(dataset, results);
    const std::vector<ism::Judgement> judgements = ism::match(truth, found, ism::IouRule{});
    std::vector<Mistakes> mistakes(of_image.size());
    std::vector<bool> seen(truth.size(), false);
    for (std::size_t f = 0; f < found.size(); ++f) {
        if (judgements[f].verdict == ism::Verdict::true_positive) seen[judgements[f].truth] = true;
        Mistakes& here = mistakes[found[f].image];
        here.judged.push_back(judged_as(judgements[f].verdict));
        if (here.judged.back() != ism::Judged::wrong) continue;
        std::string text = dataset.class_names[found[f].class_index];
        if (!std::isnan(results[f].probability))
            text += ism::join_text(" ", std::lround(100 * results[f].probability), " %");
        here.wrong.push_back(std::move(text));
        here.weights.push_back(std::isnan(results[f].probability) ? 0.1 : results[f].probability);
    }
    for (std::size_t t = 0; t < truth.size(); ++t) {
        if (seen[t] || truth[t].ignore) continue;
        mistakes[truth[t].image].missed_objects.push_back(labels.where[t].second);
        mistakes[truth[t].image].missed.push_back(dataset.class_names[truth[t].class_index]);
    }
    for (Mistakes& here : mistakes) {
        here.weights.insert(here.weights.begin(), here.missed.size(), 1.0);
        here.weight = std::accumulate(here.weights.begin(), here.weights.end(), 0.0);
    }
    return mistakes;
}

}  // namespace program
