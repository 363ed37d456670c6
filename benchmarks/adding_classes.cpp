// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// What a model loses that learns classes one after another, from training features kept in its file and those
// of the new class appended, against one that has all images at once: on the four-class set, in several
// orders of the classes. At once the labels of all classes choose the upsampling together, in turn those of
// the first alone. Which features are clustered, where there are many, depends on their order: a third way
// has all images at once, but class after class.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <map>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "extractors.hpp"
#include "support/data_sets.hpp"
#include "support/options.hpp"
#include "support/photographs.hpp"
#include "support/program_model.hpp"
#include "support/rows.hpp"

#include "ism/dataset/read_images.hpp"
#include "ism/evaluate/detections.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/train/append_training_features.hpp"
#include "ism/train/training_features.hpp"

namespace {

namespace fs = std::filesystem;

struct Result {
    double accuracy = 0, ap = 0, words = 0, seconds = 0;
    void add(const Result& other, double share) {
        accuracy += share * other.accuracy, ap += share * other.ap;
        words += share * other.words, seconds += share * other.seconds;
    }
};

/// A data set whose classes have the names of a model, in its order.
[[nodiscard]] Result evaluated(const ism::Model& model, const ism::Dataset& all) {
    const ism::Dataset set = ism::select_classes(all, model.shapes.class_names);
    const auto found = bench::find_as_program(model, set, bench::votes_in("jism"), 0);
    const auto figures = ism::evaluate(set, found, ism::IouRule{});
    return {.accuracy = figures.confusion ? figures.confusion->accuracy() : 0,
            .ap = figures.mean.ap,
            .words = double(model.words())};
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

[[nodiscard]] ism::Dataset class_of(const ism::Dataset& set, std::size_t c) {
    return ism::select_classes(set, std::span(set.class_names).subspan(c, 1));
}

[[nodiscard]] ism::Model learn_at_once(const ism::Dataset& set) {
    return program::learn(bench::features_as_program(set, 0, {}), {});
}

/// The images in the order in which learn_in_turn() comes by them.
[[nodiscard]] ism::Dataset by_class(ism::Dataset set) {
    std::stable_sort(set.images.begin(), set.images.end(), [](const auto& a, const auto& b) {
        const auto class_of_image = [](const ism::DatasetImage& image) {
            return image.objects.empty() ? 0 : image.objects.front().class_index;
        };
        return class_of_image(a) < class_of_image(b);
    });
    return set;
}

/// A model in a file learns a class, again and again.
/// @param file  for the model and its training features
[[nodiscard]] ism::Model learn_in_turn(const ism::Dataset& set, const fs::path& file) {
    ism::Model model;
    for (std::size_t c = 0; c < set.class_names.size(); ++c) {
        const ism::Dataset one = class_of(set, c);
        // The same number of features an object as all classes at once have.
        ism::TrainingFeatureOptions options;
        options.max_features = options.max_features * one.images.size() / set.images.size();
        options.choose_upsampling = c == 0;
        ism::TrainingFeatures features =
            c == 0 ? bench::features_as_program(one, 0, options)
                   : program::extract_training_features(one.class_names, ism::training_set(one),
                                                        program::extractors_of(model), {.features = options});
        if (c > 0) features = ism::append(ism::load_training_features(file), std::move(features));
        model = program::learn(features, {});
        ism::save_model(file, model, &features);
    }
    return model;
}

}  // namespace

int main(int argc, char** argv) try {
    fs::path data = bench::data_folder(), json;
    std::size_t orders = 4;
    bool halves = false;
    bench::Options command_line("Classes one after another against all at once, on four-class.");
    command_line.add("--data", data, "folder of the data sets");
    command_line.add("--orders", orders, "orders of the classes, each beginning with another", {1, 4});
    command_line.add("--halves", halves,
                     "halves of the training images, each tested on the other: for choices");
    command_line.add("--json", json, "write the rows to this file");
    if (const auto code = command_line.parse(argc, argv)) return *code;

    const ism::Dataset train = bench::read_set(data / "four-class/train.json");
    std::vector<std::pair<ism::Dataset, ism::Dataset>> folds;
    if (halves)
        folds = {{half_of(train, 0), half_of(train, 1)}, {half_of(train, 1), half_of(train, 0)}};
    else
        folds = {{train, bench::read_set(data / "four-class/test.json")}};

    const std::vector<std::string> names_of_ways = {"at once", "in turn, features appended",
                                                    "at once, class after class"};
    const fs::path file =
        fs::temp_directory_path() / ism::join_text("ism-adding-", std::random_device()(), ".safetensors");
    std::vector<std::string> ways = names_of_ways;
    for (const std::string& way : names_of_ways) ways.push_back(way + ", votes alone");
    std::vector<Result> mean(ways.size());
    for (const auto& [images, test] : folds)
        for (std::size_t order = 0; order < orders; ++order) {
            std::vector<std::string> names = images.class_names;
            std::rotate(names.begin(), names.begin() + std::ptrdiff_t(order % names.size()), names.end());
            const ism::Dataset set = ism::select_classes(images, names);
            const double share = 1 / double(orders * folds.size());
            for (std::size_t way = 0; way < names_of_ways.size(); ++way) {
                const auto begin = std::chrono::steady_clock::now();
                ism::Model model = way == 0   ? learn_at_once(set)
                                   : way == 1 ? learn_in_turn(set, file)
                                              : learn_at_once(by_class(set));
                const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
                for (const bool judge : {true, false}) {
                    if (!judge) model.box_classifier = {};
                    Result result = evaluated(model, test);
                    result.seconds = time.count();
                    const std::size_t row = way + (judge ? 0 : names_of_ways.size());
                    std::printf("%s first, %s: accuracy %.3f, mean AP %.3f\n", names.front().c_str(),
                                ways[row].c_str(), result.accuracy, result.ap);
                    std::fflush(stdout);
                    mean[row].add(result, share);
                }
            }
        }
    fs::remove(file);

    std::vector<std::vector<std::string>> cells = {
        {"mean of orders", "accuracy", "mean AP", "words", "seconds"}};
    std::vector<bench::Row> rows;
    for (std::size_t way = 0; way < ways.size(); ++way) {
        const Result &ours = mean[way], &peer = mean[way - way % names_of_ways.size()];
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
    return 2;
}
