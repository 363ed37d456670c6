// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/codebook/match.hpp"
#include "ism/model/model.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/train/set_occurrences.hpp"

namespace ism::detail {

/// The occurrences of before in a grown codebook: by matching where their descriptors are kept, at the words
/// that theirs became where not.
template <Detector D, Descriptor Desc>
[[nodiscard]] std::vector<WordOccurrence> moved_occurrences(
    const Model<D, Desc>& model, std::span<const std::uint32_t> word_now,
    const Codebook<Desc::dimension, typename Desc::Scalar>& grown, unsigned threads) {
    std::vector<WordOccurrence> moved;
    std::vector<const Occurrence*> of_feature(model.memory.size(), nullptr);
    for (std::uint32_t w = 0; w < model.codebook.size(); ++w)
        for (const Occurrence& o : model.shapes.of_word(w))
            if (model.memory.empty())
                moved.push_back({word_now[w], o});
            else
                of_feature[o.feature] = &o;
    if (!model.memory.empty())
        for (const Match& m : match(grown, model.memory, threads))
            if (of_feature[m.feature] != nullptr) moved.push_back({m.word, *of_feature[m.feature]});
    return moved;
}

}  // namespace ism::detail
