// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "experiment.hpp"

#include <algorithm>
#include <cstdio>
#include <deque>

#include "extractors.hpp"
#include "learning.hpp"
#include "spaces.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/evaluate/table.hpp"

namespace reproduce {

namespace {

/// The first images that show a class less than `count` times before, and so many without objects.
ism::Dataset part_of(ism::Dataset all, std::size_t count) {
    std::vector<std::size_t> seen(all.class_names.size() + 1, 0);
    std::erase_if(all.images, [&](const ism::DatasetImage& image) {
        const auto classes_of = [&](const auto& visit) {
            for (const ism::DatasetAnnotation& object : image.objects) visit(seen[object.class_index]);
            if (image.objects.empty()) visit(seen.back());
        };
        bool wanted = false;
        classes_of([&](std::size_t& s) { wanted = wanted || s < count; });
        if (wanted) classes_of([](std::size_t& s) { ++s; });
        return !wanted;
    });
    return all;
}

}  // namespace

Images read_images(const Settings& settings, const std::string& name, const std::string& test) {
    const std::filesystem::path folder = settings.data / name;
    Images images{ism::read_dataset(folder / "train.json"), ism::read_dataset(folder / (test + ".json"))};
    images.test = ism::select_classes(images.test, images.train.class_names);
    if (settings.quick) images = {part_of(images.train, 8), part_of(images.test, 3)};
    return images;
}

ism::TrainingFeatures extract(const ism::Dataset& train, std::string_view detector,
                              std::string_view descriptor, bool whole, unsigned threads) {
    const ism::TrainOptions options{.features = {.views = whole, .pixels = whole}, .threads = threads};
    return program::extract_training_features(train.class_names, ism::training_set(train),
                                              {program::make_extractor(detector, descriptor)}, options);
}

std::vector<Outcome> search(const ism::Model& model, const ism::Dataset& images,
                            std::span<const program::SearchOptions> ways, const ism::EvaluateOptions& rule,
                            unsigned threads) {
    struct Found {
        std::vector<ism::Result> results;
        double ms = 0;
    };
    std::vector<std::vector<Found>> found(images.images.size(), std::vector<Found>(ways.size()));
    ism::ThreadPool pool(threads);
    std::deque<ism::ThreadPool> single;  // one a worker
    std::deque<program::Matcher> matchers;
    for (unsigned worker = 0; worker < pool.size(); ++worker)
        matchers.emplace_back(model, single.emplace_back(1u));
    pool.for_each(images.images.size(), [&](std::size_t i, unsigned worker) {
        const ism::Frame frame = ism::read_frame(images.images[i]);
        ism::Stopwatch watch;
        const ism::Scene scene = matchers[worker].scene(frame, ways.front().space);
        const double look_ms = watch.lap_ms();
        for (std::size_t w = 0; w < ways.size(); ++w) {
            watch.lap_ms();
            const ism::Detections objects = program::find_objects(scene, ways[w]);
            found[i][w].ms = look_ms + watch.lap_ms();
            found[i][w].results = ism::to_results(objects, images.images[i], images.category_ids);
        }
    });
    std::vector<Outcome> outcomes;
    for (std::size_t w = 0; w < ways.size(); ++w) {
        std::vector<ism::Result> results;
        double ms = 0;
        for (const std::vector<Found>& of_image : found) {
            results.insert(results.end(), of_image[w].results.begin(), of_image[w].results.end());
            ms += of_image[w].ms;
        }
        outcomes.push_back({ism::evaluate(images, results, rule), ms / double(images.images.size())});
    }
    return outcomes;
}

program::SearchOptions votes_alone(std::string_view space) {
    program::SearchOptions search;
    search.space = space, search.rescorer = "none", search.verifier = "mdl", search.segmenter = "patches";
    return search;
}

void add_table(ism::ReportSection& section, ism::ReportTable table) {
    std::vector<std::vector<std::string>> rows{table.header};
    rows.insert(rows.end(), table.rows.begin(), table.rows.end());
    std::printf("\n%s\n%s\n", table.caption.c_str(), ism::align_columns(rows).c_str());
    section.parts.push_back(std::move(table));
}

void Times::add(std::string what) {
    seconds_.emplace_back(std::move(what), watch_.lap_ms() / 1000);
    std::printf("%-60s %6.1f s\n", seconds_.back().first.c_str(), seconds_.back().second);
    std::fflush(stdout);
}

}  // namespace reproduce
