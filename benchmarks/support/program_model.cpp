// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "support/program_model.hpp"

#include "extractors.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/read_images.hpp"

namespace bench {

ism::TrainingFeatures features_as_program(const ism::Dataset& set, unsigned threads,
                                          const ism::TrainingFeatureOptions& features) {
    return program::extract_training_features(
        set.class_names, ism::training_set(set),
        {program::make_extractor(program::default_detector, program::default_descriptor)},
        {.features = features, .threads = threads});
}

ism::Model learn_as_program(const ism::Dataset& set, unsigned threads) {
    const ism::TrainingFeatures features = features_as_program(set, threads);
    const ism::TrainOptions options{.threads = threads};
    return program::learn_templates(program::learn(features, options), features, options);
}

program::SearchOptions votes_in(std::string_view space, std::string_view rescorer) {
    program::SearchOptions search;
    search.space = space, search.rescorer = rescorer, search.verifier = "mdl", search.segmenter = "patches";
    return search;
}

program::SearchOptions all_by_templates() {
    program::SearchOptions search;
    search.space = "jism", search.rescorer = "template", search.min_score = 0;
    return search;
}

std::vector<ism::Detections> find_as_program(const ism::Model& model, const ism::Dataset& set,
                                             const program::SearchOptions& search, unsigned threads) {
    std::vector<ism::Detections> found(set.images.size());
    ism::parallel_for(set.images.size(), threads, [&](std::size_t i) {
        ism::ThreadPool one(1);
        found[i] = program::Matcher(model, one).find(ism::read_frame(set.images[i]), search);
    });
    return found;
}

}  // namespace bench
