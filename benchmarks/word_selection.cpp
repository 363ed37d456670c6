// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// What is lost when only the best words of a joint codebook are kept, by each measure of their worth:
// accuracy and mean AP on the four-class set (--data FOLDER with train.json and test.json), by number of
// words.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "support/data_sets.hpp"
#include "support/options.hpp"
#include "support/photographs.hpp"
#include "support/program_model.hpp"
#include "support/rows.hpp"

#include "ism/evaluate/detections.hpp"
#include "ism/io/write_file.hpp"
#include "ism/show/color.hpp"
#include "ism/show/svg.hpp"
#include "ism/train/select_words.hpp"
#include "ism/train/vote_agreement.hpp"

namespace {

namespace fs = std::filesystem;

struct Figures {
    double accuracy = 0, ap = 0;
};

[[nodiscard]] Figures figures_of(const ism::Model& model, const ism::Dataset& set) {
    const auto found = bench::find_as_program(model, set, bench::votes_in("jism"), 0);
    const auto evaluation = ism::evaluate(set, found, ism::IouRule{0.5});
    return {evaluation.confusion ? evaluation.confusion->accuracy() : std::nan(""), evaluation.mean.ap};
}

void measure(const fs::path& data, bool judge, const std::string& svg) {
    struct Choice {
        const char* name;
        ism::WordWorth worth;
    };
    const std::array choices = {Choice{"occurrences", ism::word_occurrences},
                                Choice{"information gain", ism::word_information_gain},
                                Choice{"vote agreement", ism::vote_agreement}};
    const ism::Dataset train = bench::read_set(data / "train.json"),
                       test = bench::read_set(data / "test.json");
    const auto features = bench::features_as_program(train, 0, {.views = judge});
    ism::TrainOptions options{.box_classifier = std::nullopt, .calibrate = false};
    const std::size_t all = program::learn(features, options).words();
    if (judge) options.box_classifier.emplace();
    std::vector<std::vector<std::string>> table = {
        {"words", "occurrences", "", "information gain", "", "vote agreement", ""},
        {"", "accuracy %", "AP %", "accuracy %", "AP %", "accuracy %", "AP %"}};
    ism::Plot plot{.title = "Accuracy by number of words",
                   .x_label = "words (logarithm to base 2)",
                   .y_label = "accuracy"};
    for (std::size_t m = 0; m < choices.size(); ++m)
        plot.curves.push_back({.name = choices[m].name, .color = ism::class_color(m)});
    for (std::size_t count = all; count >= 100; count = count * 10 / 18) {
        std::vector<std::string> row = {std::to_string(count)};
        for (std::size_t m = 0; m < choices.size(); ++m) {
            options.selection = {.max_words = count, .worth = choices[m].worth};
            const Figures figures = figures_of(program::learn(features, options), test);
            row.push_back(bench::number(100 * figures.accuracy, 1));
            row.push_back(bench::number(100 * figures.ap, 1));
            plot.curves[m].x.push_back(std::log2(double(count)));
            plot.curves[m].y.push_back(figures.accuracy);
        }
        std::fprintf(stderr, "%zu words\n", count);
        table.push_back(std::move(row));
    }
    plot.x_range = {6, std::ceil(std::log2(double(all)))};
    std::fputs(ism::align_columns(table).c_str(), stdout);
    if (!svg.empty()) ism::write_file(svg, [&](std::ostream& out) { out << ism::to_svg(plot); });
}

}  // namespace

int main(int argc, char** argv) {
    bench::Options command_line("Accuracy by number of words, for three ways to choose them");
    std::string data = (bench::data_folder() / "four-class").string(), svg = "word_selection.svg";
    bool judge = false;
    command_line.add("--data", data, "folder with train.json and test.json");
    command_line.add("--plot", svg, "file of the plot (SVG)");
    command_line.add("--judge", judge, "also learn the judge of boxes each time");
    if (const auto code = command_line.parse(argc, argv)) return *code;
    try {
        measure(data, judge, svg);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "word_selection: %s\n", error.what());
        return 2;
    }
}
