// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// What votes propose, before anything judges it: the share of a set's objects that a hypothesis overlaps by
// an IoU of .5 or more, one of any class (templates of all classes ask each) or one of the object's own
// class; and the share that is told in the end as an object of its class. Learnt from train.json, with the
// defaults of the program.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "support/data_sets.hpp"
#include "support/program_model.hpp"
#include "support/rows.hpp"
#include "support/set_options.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/detect/recognition.hpp"
#include "ism/detect/template_recognition.hpp"

namespace {

/// Templates judge, and what they are asked about is kept.
struct Listener {
    std::vector<ism::Detection>* asked = nullptr;
    ism::TemplateScore judge = {};

    [[nodiscard]] std::vector<ism::Detection> rescore(std::vector<ism::Detection> hypotheses,
                                                      const ism::Scene& scene) const {
        *asked = hypotheses;
        return judge.rescore(std::move(hypotheses), scene);
    }
};

/// Objects, and how many of them are overlapped by what.
struct Counts {
    double objects = 0, images = 0, hypotheses = 0;
    std::array<double, 3> hit = {};  ///< by one of any class, of the own; told
};

[[nodiscard]] bool overlapped(const ism::DatasetAnnotation& object, std::span<const ism::Detection> by,
                              bool any_class) {
    return std::any_of(by.begin(), by.end(), [&](const ism::Detection& d) {
        return (any_class || d.class_index == object.class_index) && ism::iou(d.box, object.box) >= 0.5;
    });
}

[[nodiscard]] Counts counts_of(const ism::DatasetImage& image, const ism::Model& model) {
    std::vector<ism::Detection> all;
    const ism::Frame frame = ism::read_frame(image);
    const auto as_program = ism::template_recognition();
    const ism::Recognition<ism::Jism, ism::EpanechnikovKernel, Listener, ism::PatchSegmenter,
                           ism::NonMaximumSuppression>
        recognition{.options = as_program.options,
                    .bandwidth = as_program.bandwidth,
                    .rescorer = {&all},
                    .verifier = as_program.verifier};
    ism::ThreadPool one(1);
    const auto told = ism::recognise(program::Matcher(model, one).scene(frame, "jism"), recognition);
    Counts counts{.images = 1, .hypotheses = double(all.size())};
    for (const ism::DatasetAnnotation& object : image.objects) {
        if (object.crowd) continue;
        counts.objects += 1;
        const std::array hit = {overlapped(object, all, true), overlapped(object, all, false),
                                overlapped(object, told.objects, false)};
        for (std::size_t i = 0; i < hit.size(); ++i) counts.hit[i] += hit[i];
    }
    return counts;
}

[[nodiscard]] Counts measured(const std::filesystem::path& folder, unsigned threads) {
    const auto model = bench::learn_as_program(bench::read_set(folder / "train.json"), threads);
    const ism::Dataset set = bench::held_out(folder, model.shapes.class_names);
    std::vector<Counts> of_image(set.images.size());
    ism::parallel_for(set.images.size(), threads,
                      [&](std::size_t i) { of_image[i] = counts_of(set.images[i], model); });
    Counts sum;
    for (const Counts& one : of_image) {
        sum.objects += one.objects, sum.images += one.images, sum.hypotheses += one.hypotheses;
        for (std::size_t i = 0; i < sum.hit.size(); ++i) sum.hit[i] += one.hit[i];
    }
    return sum;
}

}  // namespace

int main(int argc, char** argv) try {
    bench::SetOptions options{.sets = {"sysu-shapes", "weizmann-horses", "msrc", "four-class"}};
    bench::Options command_line(
        "How many objects the hypotheses of votes overlap, before and after templates judge them.");
    options.add_to(command_line);
    if (const auto code = command_line.parse(argc, argv)) return *code;

    std::vector<std::vector<std::string>> cells = {
        {"set", "objects", "hypotheses/image", "any class", "own class", "told"}};
    for (const std::string& set : options.sets) {
        const Counts counts = measured(options.data / set, options.threads);
        cells.push_back(
            {set, bench::number(counts.objects, 0), bench::number(counts.hypotheses / counts.images, 1)});
        for (const double hit : counts.hit) cells.back().push_back(bench::number(hit / counts.objects, 3));
    }
    std::fputs(ism::align_columns(cells).c_str(), stdout);
} catch (const std::exception& error) {
    std::fprintf(stderr, "candidates: %s\n", error.what());
    return 2;
}
