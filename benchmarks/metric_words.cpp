// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// What features in metres vote through: the training features nearest to them, as learn_metric() has it, or
// the words of a codebook, fine or coarse, the nearest or all within its threshold; with background as a
// class of its own or without. Votes alone, learnt from two thirds of train.json and tried on the third, in
// turn, and learnt from all of it and tried on test.json or val.json.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "extractors.hpp"
#include "support/data_sets.hpp"
#include "support/program_model.hpp"
#include "support/rows.hpp"
#include "support/set_options.hpp"

#include "ism/cluster/growing_clusters.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/evaluate/detections.hpp"
#include "ism/train/learn_metric.hpp"
#include "ism/train/metric_extractor.hpp"

namespace {

/// What features vote through.
struct Words {
    std::string name = {};
    double similarity = 1;        ///< 1: each training feature is a word; less: clusters of them are
    std::size_t neighbours = 12;  ///< 0 = all words within the threshold
    bool background = true;       ///< features beside objects are words too
    std::size_t min_size = 1;     ///< smaller clusters make no word
};

const std::vector<Words> all_words = {
    {.name = "12 nearest training features"},
    {.name = "4 nearest training features", .neighbours = 4},
    {.name = "30 nearest training features", .neighbours = 30},
    {.name = "12 nearest, background no class", .background = false},
    {.name = "12 nearest words, similarity .95", .similarity = 0.95},
    {.name = "12 nearest words, similarity .9", .similarity = 0.9},
    {.name = "12 nearest words, similarity .82", .similarity = 0.82},
    {.name = "all words within similarity .9", .similarity = 0.9, .neighbours = 0, .background = false},
    {.name = "all words within similarity .82", .similarity = 0.82, .neighbours = 0, .background = false},
    {.name = "... of two features or more",
     .similarity = 0.82,
     .neighbours = 0,
     .background = false,
     .min_size = 2},
};

/// A model without what lies beside objects.
[[nodiscard]] ism::Model without_background(ism::Model model) {
    std::vector<std::uint32_t> kept;
    ism::Grouped<ism::Occurrence> occurrences;
    for (std::uint32_t word = 0; word < model.shapes.occurrences.size(); ++word)
        if (const auto seen = model.shapes.occurrences[word]; !seen.empty()) {
            kept.push_back(word);
            occurrences.push_back(seen);
        }
    model.channels[0].codebook = model.channels[0].codebook.select(kept);
    model.shapes.occurrences = occurrences;
    return model;
}

/// A model whose words are clusters of its words: a cluster votes for all that its features saw, and each
/// vote has a feature's part of it.
[[nodiscard]] ism::Model clustered(ism::Model model, const Words& words, unsigned threads) {
    ism::Codebook& codebook = model.channels[0].codebook;
    const double max_sq_distance = 2 * (1 - words.similarity) * model.channels[0].features.sq_length;
    const auto [clusters, clustering] = ism::add_points({.dimension = codebook.dimension()},
                                                        codebook.means().values(), max_sq_distance, threads);
    std::vector<std::vector<ism::Occurrence>> seen(clusters.size());
    for (std::size_t feature = 0; feature < codebook.size(); ++feature)
        for (ism::Occurrence occurrence : model.shapes.occurrences[feature]) {
            const std::uint32_t cluster = clustering.label[feature];
            occurrence.weight = 1 / float(clusters.sizes[cluster]);
            seen[cluster].push_back(occurrence);
        }
    codebook = ism::Codebook(clusters.dimension, max_sq_distance);
    model.shapes.occurrences = {};
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        if (clusters.sizes[c] < words.min_size) continue;
        codebook.push_back(
            {.mean = std::span(clusters.means).subspan(c * clusters.dimension, clusters.dimension),
             .mean_sq_length = clusters.mean_sq_lengths[c],
             .size = clusters.sizes[c]});
        model.shapes.occurrences.push_back(seen[c]);
    }
    return model;
}

[[nodiscard]] ism::Model model_of(ism::Model model, const Words& words, unsigned threads) {
    if (!words.background) model = without_background(std::move(model));
    if (words.similarity < 1) model = clustered(std::move(model), words, threads);
    model.channels[0].neighbours = words.neighbours;
    return model;
}

/// Bytes of the words and of what was seen of them.
[[nodiscard]] double bytes(const ism::Model& model) {
    const ism::Codebook& codebook = model.channels[0].codebook;
    return double(codebook.size()) * (double(codebook.dimension()) + 3) * sizeof(float) +
           double(model.shapes.occurrences.values().size()) * sizeof(ism::Occurrence) +
           double(model.shapes.frames.size()) * sizeof(ism::OccurrenceFrame);
}

/// What was found, and at what cost.
struct Found {
    double ap = 0, words = 0, bytes = 0, match_ms = 0, vote_ms = 0;
};

/// What was found by each kind of words, milliseconds a frame.
[[nodiscard]] std::vector<Found> found_by_words(const ism::Dataset& train, const ism::Dataset& test,
                                                unsigned threads) {
    const auto features = program::extract_training_features(
        train.class_names, ism::training_set(train),
        {program::make_extractor(ism::settings_of(ism::metric_extractor()))},
        {.features = {.choose_upsampling = false, .depth = true}, .threads = threads});
    const ism::Model single = ism::learn_metric(features, {}, threads);
    program::SearchOptions votes;
    votes.space = program::metric_space, votes.rescorer = "none";
    std::vector<Found> result;
    for (const Words& words : all_words) {
        const ism::Model model = model_of(single, words, threads);
        Found found{.words = double(model.channels[0].codebook.size()), .bytes = bytes(model)};
        std::vector<ism::Detections> detections(test.images.size());
        ism::ThreadPool pool(threads);
        program::Matcher matcher(model, pool);
        for (std::size_t i = 0; i < test.images.size(); ++i) {
            detections[i] = matcher.find(ism::read_frame(test.images[i]), votes);
            found.match_ms += detections[i].stats.match_ms / double(test.images.size());
            found.vote_ms += detections[i].stats.vote_ms / double(test.images.size());
        }
        found.ap = ism::evaluate(test, detections, ism::IouRule{}).mean.ap;
        std::fprintf(stderr, "%zu images, %s: %.1f\n", test.images.size(), words.name.c_str(),
                     100 * found.ap);
        result.push_back(found);
    }
    return result;
}

}  // namespace

int main(int argc, char** argv) try {
    bench::SetOptions options{.sets = {"osd"}};
    bench::Options command_line(
        "What features in metres vote through: training features or words of a codebook.");
    options.add_to(command_line);
    if (const auto code = command_line.parse(argc, argv)) return *code;

    for (const std::string& set : options.sets) {
        const ism::Dataset train = bench::read_set(options.data / set / "train.json");
        constexpr std::size_t parts = 3;
        std::vector<double> ap_of_parts(all_words.size());
        for (std::size_t part = 0; part < parts; ++part) {
            ism::Dataset known = train, unknown = train;
            known.images.clear(), unknown.images.clear();
            for (std::size_t i = 0; i < train.images.size(); ++i)
                (i % parts == part ? unknown : known).images.push_back(train.images[i]);
            const auto found = found_by_words(known, unknown, options.threads);
            for (std::size_t w = 0; w < found.size(); ++w) ap_of_parts[w] += found[w].ap / double(parts);
        }
        const auto found =
            found_by_words(train, bench::held_out(options.data / set, train.class_names), options.threads);
        std::vector<std::vector<std::string>> cells = {{set + ": votes alone", "AP %, thirds of train",
                                                        "AP %", "words", "MB", "matching ms", "voting ms"}};
        for (std::size_t w = 0; w < found.size(); ++w)
            cells.push_back({all_words[w].name, bench::number(100 * ap_of_parts[w], 1),
                             bench::number(100 * found[w].ap, 1), bench::number(found[w].words, 0),
                             bench::number(found[w].bytes / 1e6, 1), bench::number(found[w].match_ms, 1),
                             bench::number(found[w].vote_ms, 1)});
        std::fputs(ism::align_columns(cells).c_str(), stdout);
    }
} catch (const std::exception& error) {
    std::fprintf(stderr, "metric_words: %s\n", error.what());
    return 2;
}
