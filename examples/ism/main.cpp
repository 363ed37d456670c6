// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "commands.hpp"
#include <CLI/CLI.hpp>

#include "ism/core/thread_pool.hpp"
#include "ism/detect/detect_options.hpp"
#include "ism/version.hpp"

namespace {

std::vector<std::string> texts(std::span<const std::string_view> views) {
    return {views.begin(), views.end()};
}

void add_threads(CLI::App& app, unsigned& threads) {
    app.add_option("--threads", threads, "threads; 0 = as many as the machine has")
        ->check(CLI::Range(0u, ism::max_threads))
        ->capture_default_str();
}

void add_skip_bad(CLI::App& app, bool& skip_bad) {
    app.add_flag("--skip-bad", skip_bad, "name images that cannot be used, and go on without them");
}

void add_train(CLI::App& parent, program::TrainCommand& command) {
    CLI::App& app = *parent.add_subcommand("train", "learn a model from labelled images");
    app.add_option("--data", command.data, "labelled images, COCO JSON")->required();
    app.add_option("-o,--output", command.model, "model file to write")->required();
    app.add_option("--class", command.classes, "learn this class only; may be given several times")
        ->take_all()
        ->expected(1);
    app.add_option("--detector", command.detector, "finds features")
        ->check(CLI::IsMember(texts(program::detector_names)))
        ->capture_default_str();
    app.add_option("--descriptor", command.descriptor, "describes features")
        ->check(CLI::IsMember(texts(program::descriptor_names)))
        ->capture_default_str();
    app.add_option_function<std::string>(
           "--codebook",
           [&command](const std::string& kind) {
               command.options.codebook.kind =
                   kind == "joint" ? ism::CodebookKind::joint : ism::CodebookKind::per_class;
           },
           "whether classes share words")
        ->check(CLI::IsMember({"joint", "per-class"}))
        ->default_str("joint");
    app.add_option("--similarity", command.options.codebook.min_similarity,
                   "least similarity in clusters and matches")
        ->check(CLI::Range(-1.0, 1.0))
        ->capture_default_str();
    app.add_option("--min-cluster-size", command.options.codebook.min_cluster_size,
                   "features that make a word, at least")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--min-information-gain", command.options.selection.min_information_gain,
                   "least information of a word about the class")
        ->capture_default_str();
    app.add_option("--max-words", command.options.selection.max_words,
                   "keep so many of the best words; 0 = all")
        ->capture_default_str();
    app.add_option(
           "--best-words", command.best_words,
           "what --max-words goes by: how often a word is seen, its information gain, or how well its "
           "votes agree")
        ->check(CLI::IsMember({"occurrences", "gain", "agreement"}))
        ->capture_default_str();
    app.add_option("--max-features", command.options.features.max_features,
                   "features on all objects together; of more each object gives its strongest, at least 30")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--max-cluster-features", command.options.codebook.max_features,
                   "of more features a random part is clustered; all are matched")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_flag_callback(
        "--no-templates", [&command] { command.templates = false; },
        "learn no template of each class, only votes and words");
    app.add_flag_callback(
        "--no-depth", [&command] { command.depth = false; },
        "learn from colours alone, also where images have depth");
    app.add_option("--seed", command.options.codebook.seed, "of random choices")->capture_default_str();
    CLI::Option* add_to =
        app.add_option("--add-to", command.add_to,
                       "model to teach more classes, or more examples of its classes; it was "
                       "trained with --growable, and its features and similarity stay");
    for (const char* fixed : {"--detector", "--descriptor", "--codebook", "--similarity",
                              "--min-information-gain", "--max-words", "--best-words"})
        add_to->excludes(app.get_option(fixed));
    CLI::Option* growable =
        app.add_flag("--growable", command.growable,
                     "keep all training features, which --add-to learns from again; a larger file");
    add_to->excludes(growable);
    add_threads(app, command.options.threads);
    add_skip_bad(app, command.skip_bad);
    app.callback([&command] { program::run_train(command); });
}

void add_detect(CLI::App& parent, program::DetectCommand& command) {
    CLI::App& app = *parent.add_subcommand("detect", "find objects in images");
    app.add_option("--model", command.model, "model file")->required();
    CLI::Option* data = app.add_option("--data", command.data, "images, COCO JSON");
    CLI::Option* image = app.add_option("image", command.image, "one image")->excludes(data);
    CLI::Option* scale = app.add_option("--depth-scale", command.depth_scale,
                                        "metres per unit of --depth; 0.001 for millimetres")
                             ->check(CLI::PositiveNumber);
    app.add_option("--depth", command.depth, "depth of the image, 16-bit PNG")->needs(image)->needs(scale);
    app.add_option_function<std::vector<double>>(
           "--camera",
           [&command](const std::vector<double>& k) {
               command.camera = ism::Camera{k[0], k[1], k[2], k[3]};
               ism::check(*command.camera);
           },
           "FX,FY,CX,CY of the image, pixels")
        ->delimiter(',')
        ->expected(4)
        ->needs(image);
    app.add_option("-o,--output", command.results, "results to write, COCO JSON")->required();
    std::vector<std::string> spaces = texts(program::space_names);
    spaces.insert(spaces.begin(), std::string(program::auto_space));
    spaces.emplace_back(program::metric_space);
    app.add_option(
           "--space", command.search.space,
           "vote space; auto: metric where the model was learnt with depth and the image has depth and a "
           "camera, and no --rescore, --verify or --segment is given, else jism")
        ->check(CLI::IsMember(spaces))
        ->capture_default_str();
    app.add_option("--keep", command.search.keep, "drop what scores less than this part of the image's best")
        ->check(CLI::Range(0.0, 1.0))
        ->default_str(ism::join_text(ism::DetectOptions{}.min_relative_score, ", with templates 0.01"));
    app.add_option("--min-score", command.search.min_score,
                   "tell only what is an object at least so probably; 0: all that was found, for evaluation")
        ->check(CLI::Range(0.0, 1.0))
        ->default_str(ism::join_text(program::default_min_score,
                                     " where templates judge or in the space metric, else 0"));
    app.add_option("--rescore", command.search.rescorer,
                   "what judges hypotheses beside their votes: a template of each class, the words in their "
                   "boxes, or nothing; auto: templates where the model has them, else words")
        ->check(CLI::IsMember({"auto", "template", "boxes", "none"}))
        ->capture_default_str();
    app.add_option(
           "--verify", command.search.verifier,
           "how overlapping hypotheses are sorted out: by their masks, or by their boxes; auto: boxes where "
           "templates judge, else masks")
        ->check(CLI::IsMember({"auto", "mdl", "nms"}))
        ->capture_default_str();
    app.add_option(
           "--segment", command.search.segmenter,
           "what cuts objects out: training objects that look alike, with the colours and edges of the "
           "picture, or the patches of votes; auto: exemplars where the model has them, else patches")
        ->check(CLI::IsMember({"auto", "exemplars", "patches"}))
        ->capture_default_str();
    app.add_option("--overlay", command.overlay_folder, "folder for pictures of what was found and why");
    app.add_option("--report", command.report, "HTML page to write");
    add_threads(app, command.threads);
    add_skip_bad(app, command.skip_bad);
    app.callback([&command, data, image] {
        if (data->count() + image->count() != 1)
            throw ism::Error("detect: expected --data or an image, got neither");
        program::run_detect(command);
    });
}

void add_evaluate(CLI::App& parent, program::EvaluateCommand& command) {
    CLI::App& app = *parent.add_subcommand("evaluate",
                                           "measure what was found: average precision (AP), precision where "
                                           "it equals recall (EER), best F1, IoU of masks");
    app.add_option("--data", command.data, "labelled images, COCO JSON")->required();
    app.add_option("--detections", command.detections, "results, COCO JSON")->required();
    app.add_option_function<std::string>(
           "--rule",
           [&command](const std::string& rule) {
               command.options.rule =
                   rule == "uiuc" ? ism::EvaluateOptions::Rule::uiuc : ism::EvaluateOptions::Rule::iou;
               command.coco = rule == "coco";
           },
           "when a box is right: enough overlap (iou), or a centre near enough (uiuc); coco: AP and recall "
           "as "
           "its official evaluation tells them of boxes")
        ->check(CLI::IsMember({"iou", "uiuc", "coco"}))
        ->default_str("iou");
    const CLI::Option* iou =
        app.add_option("--iou", command.options.iou_threshold, "least overlap of a right box by the rule iou")
            ->check(CLI::Range(0.0, 1.0))
            ->capture_default_str();
    app.add_option("--json", command.json, "figures to write, JSON");
    const CLI::Option* plot = app.add_option("--plot", command.plot, "precision-recall curves to write, SVG");
    app.callback([&command, iou, plot] {
        for (const CLI::Option* other : {iou, plot})
            ism::expect(!command.coco || other->count() == 0, "--rule coco",
                        ism::lazy_text("no ", other->get_name()), "both");
        program::run_evaluate(command);
    });
}

void add_demo(CLI::App& parent, program::DemoCommand& command) {
    CLI::App& app = *parent.add_subcommand("demo", "render toys, learn them, find them, report");
    app.add_option("-o,--output", command.folder, "folder to write to")->capture_default_str();
    app.add_option("--seed", command.seed, "of the toys and scenes")->capture_default_str();
    app.add_flag("--small", command.small, "a few pictures only")->group("");
    add_threads(app, command.threads);
    app.callback([&command] { program::run_demo(command); });
}

/// One line on stderr.
int fail(std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    std::fprintf(stderr, "ism: %s\n", message.c_str());
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Implicit Shape Models: find, cut out and place objects of many classes in colour and depth "
        "images.",
        "ism");
    app.set_version_flag("--version", std::string("ism ") + ism::version_text);
    app.require_subcommand(1);
    program::TrainCommand train;
    program::DetectCommand detect;
    program::EvaluateCommand evaluate;
    program::DemoCommand demo;
    std::filesystem::path model;
    add_train(app, train);
    add_detect(app, detect);
    add_evaluate(app, evaluate);
    add_demo(app, demo);
    CLI::App& info = *app.add_subcommand("info", "tell what is in a model file");
    info.add_option("model", model, "model file")->required();
    info.callback([&model] { program::run_info(model); });
    const std::string first = argc > 1 ? argv[1] : "none";
    const auto is_first = [&](const CLI::App* command) { return command->get_name() == first; };
    if (!first.starts_with("-") && app.get_subcommands(is_first).empty())
        return fail("expected a command (train, detect, evaluate, demo, info), got " + first +
                    "; ism --help tells more");
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& done) {
        return app.exit(done);  // --help, --version
    } catch (const CLI::ParseError& error) {
        return fail(error.what());
    } catch (const std::exception& error) {
        return fail(error.what());
    }
    if (std::fflush(stdout) != 0) return fail("standard output: expected to write it whole, got a failure");
    return 0;
}
