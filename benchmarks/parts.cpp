// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// What each part of the way on colour images brings: mean AP at IoU .5 and mean IoU of masks, learnt from
// train.json, with the defaults of the library and without one part after another.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "support/data_sets.hpp"
#include "support/program_model.hpp"
#include "support/rows.hpp"
#include "support/set_options.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/detect/exemplar_segmenter.hpp"
#include "ism/detect/template_recognition.hpp"
#include "ism/evaluate/detections.hpp"
#include "ism/train/template_examples.hpp"

namespace {

using Find = std::function<ism::Detections(const ism::Frame&)>;

/// The default way, or the way without a part.
struct Way {
    std::string name;
    Find find;
};

void take_out_colors(ism::RgbImage& image) {
    for (ism::Rgb& pixel : image.pixels()) {
        const auto gray = static_cast<std::uint8_t>((pixel.r + pixel.g + pixel.b) / 3);
        pixel = {gray, gray, gray};
    }
}

/// Detects by a recognition with a model of its own.
template <ism::Rescorer R, ism::Segmenter S, ism::Verifier V>
[[nodiscard]] Find finder(ism::Model model,
                          const ism::Recognition<ism::Jism, ism::EpanechnikovKernel, R, S, V>& recognition) {
    return [model = std::move(model), recognition](const ism::Frame& frame) {
        ism::ThreadPool one(1);
        return ism::recognise(program::Matcher(model, one).scene(frame, "jism"), recognition);
    };
}

/// The same with a search of the program.
[[nodiscard]] Find finder(ism::Model model, const program::SearchOptions& search) {
    return [model = std::move(model), search](const ism::Frame& frame) {
        ism::ThreadPool one(1);
        return program::Matcher(model, one).find(frame, search);
    };
}

[[nodiscard]] std::vector<Way> ways_of(const ism::Dataset& train, unsigned threads) {
    const ism::TrainOptions options{.threads = threads};
    ism::TrainingFeatures features = bench::features_as_program(train, threads);
    const ism::Model words = program::learn(features, options);
    const auto judged = [&](const ism::TemplateOptions& templates) {
        return program::learn_templates(words, features, options, templates);
    };
    const ism::Model model = judged({});
    const auto recognition = ism::template_recognition<ism::Jism>(ism::ExemplarSegmenter{});
    const program::SearchOptions search = bench::all_by_templates();

    std::vector<Way> ways = {{"all parts", finder(model, search)}};
    const auto add = [&](const char* name, Find find) { ways.push_back({name, std::move(find)}); };
    for (const auto& [name, weight] :
         {std::pair{"patches do not judge", &ism::CueWeights::patches},
          std::pair{"words do not judge", &ism::CueWeights::words},
          std::pair{"votes do not judge", &ism::CueWeights::votes},
          std::pair{"shares of votes do not judge", &ism::CueWeights::share},
          std::pair{"contrast of colours does not judge", &ism::CueWeights::contrast},
          std::pair{"colours of classes do not judge", &ism::CueWeights::colors},
          std::pair{"size does not judge", &ism::CueWeights::size}}) {
        ism::Model without = model;
        without.cue_weights.*weight = 0;
        add(name, finder(std::move(without), search));
    }
    add("no mining of negatives", finder(judged({.mining_rounds = 0}), search));
    add("no jittered copies", finder(judged({.jittered_copies = 0}), search));
    add("no turned copies", finder(judged({.turned_copies = 0}), search));
    add("no copies before other ground", finder(judged({.ground_copies = 0}), search));
    auto other = recognition;
    other.rescorer.max_classes = 1;
    add("asked about their own class alone", finder(model, other));
    other = recognition;
    other.rescorer.rivals.other_classes = 0;
    add("classes at one place do not yield", finder(model, other));
    other = recognition;
    other.options = {}, other.bandwidth = ism::default_bandwidth<ism::Jism>();
    add("hypotheses as votes alone find them", finder(model, other));
    other = recognition;
    other.rescorer.rivals.wholes_and_parts = false;
    add("wholes and parts do not exclude each other", finder(model, other));
    other.verifier.max_inside = 0.5;
    add("… but the weaker is left out", finder(model, other));
    program::SearchOptions of_patches = search;
    of_patches.segmenter = "patches";
    add("masks of patches", finder(model, of_patches));
    add("votes and words (no templates)", finder(model, bench::votes_in("jism")));
    add("votes alone", finder(model, bench::votes_in("jism", "none")));
    for (ism::TrainingView& view : features.views) take_out_colors(view.pixels);
    add("no colours", [find = finder(judged({}), search)](const ism::Frame& frame) {
        ism::Frame gray = frame;
        take_out_colors(gray.color);
        return find(gray);
    });
    return ways;
}

}  // namespace

int main(int argc, char** argv) try {
    bench::SetOptions options{.sets = {"four-class", "sysu-shapes", "weizmann-horses", "msrc"}};
    bench::Options command_line("What each part of the way on colour images brings.");
    options.add_to(command_line);
    if (const auto code = command_line.parse(argc, argv)) return *code;

    std::vector<std::vector<std::string>> cells = {{"mean AP %, mean mask IoU %"}};
    for (const std::string& set : options.sets) {
        const ism::Dataset train = bench::read_set(options.data / set / "train.json"),
                           test = bench::held_out(options.data / set, train.class_names);
        cells[0].push_back(set), cells[0].push_back("");
        const std::vector<Way> ways = ways_of(train, options.threads);
        for (std::size_t w = 0; w < ways.size(); ++w) {
            std::vector<ism::Detections> found(test.images.size());
            ism::parallel_for(test.images.size(), options.threads, [&](std::size_t i) {
                found[i] = ways[w].find(ism::read_frame(test.images[i]));
            });
            const auto mean = ism::evaluate(test, found, ism::IouRule{}).mean;
            if (cells.size() <= w + 1) cells.push_back({ways[w].name});
            cells[w + 1].push_back(bench::number(100 * mean.ap, 1));
            cells[w + 1].push_back(bench::number(100 * mean.mask_iou, 1));
            std::fprintf(stderr, "%s, %s: %s, %s\n", set.c_str(), ways[w].name.c_str(),
                         cells[w + 1].end()[-2].c_str(), cells[w + 1].back().c_str());
        }
    }
    std::fputs(ism::align_columns(cells).c_str(), stdout);
} catch (const std::exception& error) {
    std::fprintf(stderr, "parts: %s\n", error.what());
    return 2;
}
