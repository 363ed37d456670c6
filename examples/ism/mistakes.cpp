// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "mistakes.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>

#include "input.hpp"

#include "ism/core/text.hpp"
#include "ism/evaluate/matching.hpp"

namespace program {

std::string Mistakes::text() const {
    std::string text;
    if (!missed.empty()) text = "missed: " + list_text(missed);
    if (!wrong.empty()) text += (text.empty() ? "wrong: " : "; wrong: ") + list_text(wrong);
    return text;
}

std::vector<Mistakes> find_mistakes(const ism::Dataset& dataset,
                                    std::span<const std::vector<ism::Result>> of_image) {
    std::map<std::int64_t, std::size_t> class_of;
    for (std::size_t c = 0; c < dataset.category_ids.size(); ++c) class_of[dataset.category_ids[c]] = c;
    std::vector<ism::TruthObject> truth;
    std::vector<ism::FoundObject> found;
    std::vector<double> probability;
    for (std::size_t i = 0; i < of_image.size(); ++i) {
        for (const ism::DatasetAnnotation& object : dataset.images[i].objects)
            truth.push_back({i, object.class_index, object.box, object.crowd});
        for (const ism::Result& result : of_image[i]) {
            found.push_back({.image = i,
                             .class_index = std::uint32_t(class_of.at(result.category_id)),
                             .box = result.box,
                             .score = result.score});
            probability.push_back(result.probability);
        }
    }
    const std::vector<ism::Judgement> judgements = ism::match(truth, found, ism::IouRule{});
    std::vector<Mistakes> mistakes(of_image.size());
    std::vector<bool> seen(truth.size(), false);
    for (std::size_t f = 0; f < found.size(); ++f) {
        if (judgements[f].verdict == ism::Verdict::true_positive) seen[judgements[f].truth] = true;
        if (judgements[f].verdict != ism::Verdict::false_positive) continue;
        Mistakes& here = mistakes[found[f].image];
        std::string text = dataset.class_names[found[f].class_index];
        if (!std::isnan(probability[f])) text += ism::join_text(" ", std::lround(100 * probability[f]), " %");
        here.wrong.push_back(std::move(text));
        here.weight += std::isnan(probability[f]) ? 0.1 : probability[f];
    }
    for (std::size_t t = 0; t < truth.size(); ++t) {
        if (seen[t] || truth[t].ignore) continue;
        mistakes[truth[t].image].missed.push_back(dataset.class_names[truth[t].class_index]);
        mistakes[truth[t].image].weight += 1;
    }
    return mistakes;
}

}  // namespace program
