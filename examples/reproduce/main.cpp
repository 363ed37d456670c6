// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// reproduce DATA [-o FOLDER] [--threads N] [--quick] [--depth]: the experiments of the paper (Zhang and
// Kjellström, "Multi-Class Detection and Segmentation of Objects in Depth") on the public sets in the folder
// DATA, and a page FOLDER/report.html that shows them beside the paper's figures; --depth: those on depth
// alone.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "depth.hpp"
#include "experiment.hpp"
#include "input.hpp"
#include "learning.hpp"

#include "ism/evaluate/confusion_plot.hpp"
#include "ism/evaluate/plot.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/io/write_file.hpp"
#include "ism/show/report.hpp"
#include "ism/train/select_words.hpp"

namespace reproduce {

namespace {

/// Of the paper, for T_Q = 0, 1, 2.
struct PaperFigures {
    double accuracy = 0;
    std::size_t words = 0;
};
constexpr std::array<PaperFigures, 3> paper_separate = {{{.85, 7825}, {.81, 4777}, {.83, 2748}}};
constexpr std::array<PaperFigures, 3> paper_joint = {{{.81, 6949}, {.88, 4578}, {.83, 2680}}};

std::string share_text(double share) {
    return ism::percent_text(share) + " %";
}

/// Accuracy against words where the words that tell least about the class leave.
ism::Plot word_plot(const ism::Model& model, const ism::Dataset& test, unsigned threads,
                    ism::ReportTable& table) {
    const std::vector<double> gain = ism::word_information_gain(model.shapes);
    ism::Plot plot{
        .title = "Fewer words, T_Q = 2", .x_label = "words", .y_label = "accuracy", .y_range = {0.4, 1}};
    ism::PlotCurve curve{.name = "joint codebook, words of the most information gain",
                         .color = ism::class_color(0)};
    const std::array ways{votes_alone()};
    for (const double share : {1.0, 0.85, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2}) {
        const auto words = ism::best_words(gain, std::size_t(share * double(gain.size())));
        const auto found = search(ism::keep_words(model, words), test, ways, {}, threads);
        const double accuracy = found[0].evaluation.confusion->accuracy();
        double least = gain[words[0]];
        for (const std::uint32_t word : words) least = std::min(least, gain[word]);
        curve.x.push_back(double(words.size())), curve.y.push_back(accuracy);
        table.rows.push_back(
            {std::to_string(words.size()), ism::number_text(least, 2), share_text(accuracy)});
    }
    const double all = double(paper_joint[2].words);
    plot.x_range = {0, 1.05 * std::max(all, double(gain.size()))};
    plot.curves = {std::move(curve),
                   {.name = "paper: half of the words cost less than 5 %",
                    .x = {all / 2, all},
                    .y = {paper_joint[2].accuracy - .05, paper_joint[2].accuracy},
                    .color = ism::class_color(1)}};
    return plot;
}

/// Four classes, with words of their own and with joint words.
ism::ReportSection multi_class(const Settings& settings, Times& times) {
    const Images images = read_images(settings, "four-class", "test");
    const auto features = extract(images.train, "harris-laplace", "sift", false, settings.threads);
    times.add("four-class: features of training images");
    ism::ReportSection section{.title = "Several classes, one codebook"};
    section.parts.push_back(
        ism::ReportText{"Harris-Laplace features and SIFT, votes in the space jism through the nearest word, "
                        "minimum description "
                        "length; the class of an image is that of its strongest hypothesis. The paper's "
                        "images are not to be had "
                        "as a set: here horses stand for its car rears, and cars, cows and motorbikes are of "
                        "other sets, from more "
                        "directions. One image is " +
                        share_text(1 / double(images.test.images.size())) + "."});
    ism::ReportTable table{
        .caption = "Accuracy and words, ours and the paper's",
        .header = {"codebooks", "T_Q", "accuracy", "words", "paper: accuracy", "paper: words"}};
    std::string matrices;  // side by side
    ism::Model smallest;
    for (std::size_t t_q = 0; t_q < 3; ++t_q)
        for (const bool joint : {false, true}) {
            ism::TrainOptions options{.box_classifier = {}, .calibrate = false, .threads = settings.threads};
            options.codebook.kind = joint ? ism::CodebookKind::joint : ism::CodebookKind::per_class;
            options.codebook.min_cluster_size = t_q + 1;
            // the best of .70, .73 … .82 on halves of the training images, each tested on the other
            options.codebook.min_similarity = 0.76;
            ism::Model model = program::learn(features, options);
            const std::array ways{votes_alone()};
            const auto found = search(model, images.test, ways, {}, settings.threads);
            const auto& confusion = found[0].evaluation.confusion;
            const double accuracy = confusion.value().accuracy();
            const PaperFigures paper = (joint ? paper_joint : paper_separate)[t_q];
            const std::string name = joint ? "joint" : "separate";
            table.rows.push_back({name, std::to_string(t_q), share_text(accuracy),
                                  std::to_string(model.words()), share_text(paper.accuracy),
                                  std::to_string(paper.words)});
            matrices += ism::to_svg(*confusion, images.train.class_names,
                                    ism::join_text(name, ", T_Q = ", t_q, ": ", share_text(accuracy)));
            smallest = std::move(model);
        }
    times.add("four-class: six codebooks learnt and tested");
    add_table(section, std::move(table));
    section.parts.push_back(ism::ReportPlot{std::move(matrices)});
    ism::ReportTable fewer{.caption = "Fewer words, joint codebook, T_Q = 2",
                           .header = {"words", "T_IG", "accuracy"}};
    const ism::Plot plot = word_plot(smallest, images.test, settings.threads, fewer);
    times.add("four-class: fewer words");
    add_table(section, std::move(fewer));
    section.parts.push_back(ism::ReportPlot{ism::to_svg(plot)});
    return section;
}

/// Precision and recall of one class, by votes alone and with templates.
ism::ReportSection precision_recall(const Settings& settings, Times& times, const std::string& name,
                                    const std::string& test, const ism::EvaluateOptions& rule,
                                    const std::string& published) {
    const Images images = read_images(settings, name, test);
    const auto features =
        extract(images.train, program::default_detector, program::default_descriptor, true, settings.threads);
    const ism::TrainOptions options{.threads = settings.threads};
    const ism::Model model = program::learn_templates(program::learn(features, options), features, options);
    times.add(name + ": learning");
    const std::array ways{votes_alone(), program::SearchOptions{.space = "jism", .min_score = 0}};
    const auto found = search(model, images.test, ways, rule, settings.threads);
    times.add(name + ": searching");
    ism::Plot plot{.title = name, .x_label = "recall", .y_label = "precision"};
    ism::ReportTable table{.caption = ism::join_text(name, ", ", images.test.images.size(), " images"),
                           .header = {"way", "AP", "EER", "mask IoU", "ms/image, one thread"}};
    const std::array names{std::string("votes alone (the paper's way)"),
                           std::string("votes and templates (default)")};
    for (std::size_t w = 0; w < ways.size(); ++w) {
        const ism::Figures& mean = found[w].evaluation.mean;
        table.rows.push_back({names[w], share_text(mean.ap), share_text(mean.eer),
                              ism::percent_text(mean.mask_iou), ism::fixed_text(found[w].ms_per_image, 0)});
        ism::PlotCurve curve = ism::precision_recall_plot(found[w].evaluation).curves.at(0);
        curve.name = names[w], curve.color = ism::class_color(w);
        plot.curves.push_back(std::move(curve));
    }
    ism::ReportSection section{.title = name};
    section.parts.push_back(ism::ReportText{published});
    add_table(section, std::move(table));
    section.parts.push_back(ism::ReportPlot{ism::to_svg(plot)});
    return section;
}

/// Classes told apart, and objects of one class found, by colour.
void add_colour_experiments(ism::Report& report, const Settings& settings, Times& times) {
    report.sections.push_back(multi_class(settings, times));
    report.sections.push_back(
        precision_recall(settings, times, "uiuc-cars", "test", {.rule = ism::EvaluateOptions::Rule::uiuc},
                         "Cars of one size, by the rule of the set. Published: EER 97.5 % by votes and "
                         "minimum description length "
                         "(Leibe et al. 2008), 98.5 % by a Hough forest (Gall and Lempitsky 2009)."));
    report.sections.push_back(
        precision_recall(settings, times, "weizmann-horses", "val", {},
                         "Horses, one an image, IoU of boxes at least .5. Published on other "
                         "parts of the set: EER 91.4 to 93.9 % by Hough forests."));
}

/// What would otherwise be told after minutes: data that are missing, and a folder that cannot be written to.
void check(const Settings& settings) {
    std::vector<const char*> files = {"osd/train.json", "osd/val.json"};
    if (!settings.depth_alone)
        files.insert(files.end(),
                     {"four-class/train.json", "four-class/test.json", "uiuc-cars/train.json",
                      "uiuc-cars/test.json", "weizmann-horses/train.json", "weizmann-horses/val.json"});
    for (const char* file : files)
        ism::expect(std::filesystem::exists(settings.data / file), (settings.data / file).string(),
                    "a file of the data", "none");
    program::make_folder(settings.folder);
    program::check_output(settings.folder / "report.html", {});
}

void run(const Settings& settings) {
    check(settings);
    Times times;
    ism::Report report{.title = "The experiments of the paper"};
    if (!settings.depth_alone) add_colour_experiments(report, settings, times);
    for (ism::ReportSection& section : depth_experiments(settings, times))
        report.sections.push_back(std::move(section));
    ism::ReportTable seconds{.caption = "Seconds", .header = {"part", "s"}};
    double all = 0;
    for (const auto& [part, took] : times.seconds())
        seconds.rows.push_back({part, ism::fixed_text(took, 1)}), all += took;
    seconds.rows.push_back({"all", ism::fixed_text(all, 1)});
    report.summary = {{"data", settings.quick ? "a few images of each set" : "the sets whole"},
                      {"seconds", ism::fixed_text(all, 0)}};
    report.sections.push_back({.title = "Time", .parts = {std::move(seconds)}});
    ism::write_file(settings.folder / "report.html", ism::to_html(report));
    std::printf("report: %s, all in %.0f s\n", (settings.folder / "report.html").string().c_str(), all);
}

Settings settings_from(std::vector<std::string> words) {
    Settings settings;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const auto value = [&]() -> const std::string& {
            ism::expect(i + 1 < words.size(), word, "a value behind it", "none");
            return words[++i];
        };
        if (word == "--quick") {
            settings.quick = true;
        } else if (word == "--depth") {
            settings.depth_alone = true;
        } else if (word == "-o") {
            settings.folder = value();
        } else if (word == "--threads") {
            const std::string& text = value();
            const auto read = std::from_chars(text.data(), text.data() + text.size(), settings.threads);
            ism::expect(read.ec == std::errc() && read.ptr == text.data() + text.size(), "--threads",
                        "a whole number", text);
        } else {
            ism::expect(settings.data.empty() && !word.starts_with("-"), "option",
                        "DATA [-o FOLDER] [--threads N] [--quick] [--depth]", word);
            settings.data = word;
        }
    }
    ism::expect(std::filesystem::is_directory(settings.data), "DATA", "a folder of data sets",
                ism::lazy_text("'", settings.data.string(), "'"));
    return settings;
}

}  // namespace

}  // namespace reproduce

int main(int argc, char** argv) try {
    reproduce::run(reproduce::settings_from({argv + 1, argv + argc}));
} catch (const std::exception& error) {
    std::fprintf(stderr, "reproduce: %s\n", error.what());
    return 2;
}
