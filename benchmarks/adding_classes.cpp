// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// What a model loses that learns classes one after another, against one that has all images at once: on the
// four-class set, with and without the memory of descriptors, in several orders of the classes.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/rows.hpp"
#include <CLI/CLI.hpp>

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/detect/detect.hpp"
#include "ism/evaluate/detections.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/add_classes.hpp"
#include "ism/train/train.hpp"

namespace {

using Model = ism::Model<ism::HessianLaplace, ism::RootSift>;

struct Result {
    double accuracy = 0, ap = 0, words = 0, seconds = 0;
    void add(const Result& other, double share) {
        accuracy += share * other.accuracy, ap += share * other.ap;
        words += share * other.words, seconds += share * other.seconds;
    }
};

[[nodiscard]] auto images_of(const ism::Dataset& set) {
    return [&set](std::size_t i) { return ism::read_training_image(set.images[i]); };
}

/// A data set whose classes have the names of a model, in its order.
[[nodiscard]] Result evaluated(const Model& model, const ism::Dataset& all) {
    const ism::Dataset set = ism::select_classes(all, model.shapes.class_names);
    std::vector<ism::Detections> found(set.images.size());
    ism::parallel_for(set.images.size(), 0, [&](std::size_t i) {
        found[i] = ism::detect<ism::Jism>(model, ism::read_frame(set.images[i]), {.threads = 1});
    });
    const auto figures = ism::evaluate(set, found, ism::IouRule{});
    return {.accuracy = figures.confusion ? figures.confusion->accuracy() : 0,
            .ap = figures.mean.ap,
            .words = double(model.codebook.size())};
}

/// Every second image of each class, from the first or the second on; both = all.
[[nodiscard]] ism::Dataset half_of(const ism::Dataset& set, std::size_t first) {
    ism::Dataset half = set;
    std::map<std::size_t, std::size_t> count;
    std::erase_if(half.images, [&](const ism::DatasetImage& image) {
        return !image.objects.empty() && count[image.objects.front().class_index]++ % 2 != first;
    });
    return half;
}

[[nodiscard]] Model learn_at_once(const ism::Dataset& set, const ism::TrainOptions& options) {
    return ism::train<ism::HessianLaplace, ism::RootSift>(set.class_names, set.images.size(), images_of(set),
                                                          options);
}

[[nodiscard]] Model learn_in_turn(const ism::Dataset& set, const ism::TrainOptions& options) {
    Model model;
    for (std::size_t c = 0; c < set.class_names.size(); ++c) {
        const ism::Dataset one = ism::select_classes(set, std::span(set.class_names).subspan(c, 1));
        // The same number of features an object as all classes at once have.
        const std::size_t most = options.max_features * one.images.size() / set.images.size();
        ism::TrainOptions first = options;
        first.max_features = most;
        model = c == 0 ? learn_at_once(one, first)
                       : ism::add_classes(model, one.class_names, one.images.size(), images_of(one),
                                          {.max_features = most, .appearance = options.appearance});
    }
    return model;
}

}  // namespace

int main(int argc, char** argv) try {
    std::filesystem::path data = ISM_DEFAULT_DATA, json;
    std::size_t orders = 4;
    bool halves = false;
    CLI::App app("Classes one after another against all at once, on four-class.");
    app.add_option("--data", data, "folder of the data sets");
    app.add_option("--orders", orders, "orders of the classes, each beginning with another")
        ->check(CLI::Range(1, 4));
    app.add_flag("--halves", halves, "halves of the training images, each tested on the other: for choices");
    app.add_option("--json", json, "write the rows to this file");
    CLI11_PARSE(app, argc, argv);

    const ism::Dataset train = ism::read_dataset(data / "four-class/train.json");
    std::vector<std::pair<ism::Dataset, ism::Dataset>> folds;
    if (halves)
        folds = {{half_of(train, 0), half_of(train, 1)}, {half_of(train, 1), half_of(train, 0)}};
    else
        folds = {{train, ism::read_dataset(data / "four-class/test.json")}};

    const std::vector<std::string> ways = {
        "at once",           "in turn, memory",           "in turn, no memory",
        "at once, no judge", "in turn, memory, no judge", "in turn, no memory, no judge"};
    std::vector<Result> mean(ways.size());
    for (const auto& [images, test] : folds)
        for (std::size_t order = 0; order < orders; ++order) {
            std::vector<std::string> names = images.class_names;
            std::rotate(names.begin(), names.begin() + std::ptrdiff_t(order % names.size()), names.end());
            const ism::Dataset set = ism::select_classes(images, names);
            const double share = 1 / double(orders * folds.size());
            for (std::size_t way = 0; way < 3; ++way) {
                const auto begin = std::chrono::steady_clock::now();
                Model model = way == 0 ? learn_at_once(set, {}) : learn_in_turn(set, {.memory = way == 1});
                const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
                for (const bool judge : {true, false}) {
                    if (!judge) model.shapes.appearance = {};
                    Result result = evaluated(model, test);
                    result.seconds = time.count();
                    std::printf("%s first, %s: accuracy %.3f, mean AP %.3f\n", names.front().c_str(),
                                ways[way + (judge ? 0 : 3)].c_str(), result.accuracy, result.ap);
                    std::fflush(stdout);
                    mean[way + (judge ? 0 : 3)].add(result, share);
                }
            }
        }

    std::vector<std::vector<std::string>> cells = {
        {"mean of orders", "accuracy", "mean AP", "words", "seconds"}};
    std::vector<bench::Row> rows;
    for (std::size_t way = 0; way < ways.size(); ++way) {
        const Result &ours = mean[way], &peer = mean[way < 3 ? 0 : 3];
        cells.push_back({ways[way], bench::number(ours.accuracy, 3), bench::number(ours.ap, 3),
                         bench::number(ours.words, 0), bench::number(ours.seconds, 1)});
        if (&ours == &peer) continue;
        const auto row = [&](const std::string& figure, double a, double b, const std::string& unit) {
            rows.push_back({.name = ways[way] + ": " + figure,
                            .ours = a,
                            .peer = b,
                            .peer_name = "all classes at once",
                            .unit = unit});
        };
        row("accuracy", ours.accuracy, peer.accuracy, "");
        row("mean AP", ours.ap, peer.ap, "");
        row("words", ours.words, peer.words, "");
        row("training, all steps", ours.seconds, peer.seconds, "s");
    }
    std::fputs(ism::align_columns(cells).c_str(), stdout);
    if (!json.empty()) bench::write_json(json, rows);
} catch (const std::exception& error) {
    std::fprintf(stderr, "adding_classes: %s\n", error.what());
    return 1;
}
