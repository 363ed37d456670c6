// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "ism/train/harvest.hpp"
#include "ism/train/select_words.hpp"

namespace ism {

/// @brief Whether classes share words.
enum class CodebookKind {
    joint,      ///< one codebook of all classes (the paper's)
    per_class,  ///< each class has words of its own, as separate models have
};

/// @brief How a model is trained.
struct TrainOptions {
    double min_similarity = 0.82;      ///< clustering and matching cut-off; 1 = equal, 0 = unrelated
    std::size_t min_cluster_size = 2;  ///< smaller clusters make no word (T_Q + 1)
    double min_information_gain = 0;   ///< words that tell less about the class are dropped (T_IG)
    std::size_t max_words = 0;         ///< of more words the best by `measure` stay; 0 = all
    WordMeasure measure = WordMeasure::vote_agreement;
    CodebookKind codebook = CodebookKind::joint;
    std::size_t max_features = 40000;  ///< see HarvestOptions
    std::size_t max_cluster_features =
        30000;               ///< of more features a random part is clustered; all are matched
    std::uint64_t seed = 1;  ///< chooses that part
    bool memory = false;     ///< also keep the descriptors, so that the model can grow well: see Model
    bool appearance = true;  ///< also learn what boxes of each class hold, to judge hypotheses
    unsigned threads = 0;    ///< 0 = all the machine has
    Progress progress = {};
};

}  // namespace ism
