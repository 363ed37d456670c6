// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "commands.hpp"
#include "input.hpp"
#include "options.hpp"

#include "ism/core/nearest_name.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/detect_options.hpp"
#include "ism/version.hpp"

namespace {

using program::add_number;
using program::between;
using program::only;

std::vector<std::string> texts(std::span<const std::string_view> views) {
    return {views.begin(), views.end()};
}

void add_threads(CLI::App& app, unsigned& threads) {
    add_number(app, "--threads", threads, between(0, ism::max_threads),
               "threads; 0 = as many as the machine has");
}

void add_skip_bad(CLI::App& app, bool& skip_bad) {
    app.add_flag("--skip-bad", skip_bad,
                 "name images and labels that cannot be used, and go on without them");
}

constexpr const char* data_text =
    "labelled images: JSON of COCO or labelme, a folder or file of Pascal VOC or YOLO, or a folder with one "
    "folder of "
    "images a class";

void add_report_images(CLI::App& app, CLI::Option* report, program::PageOptions& page) {
    only(app.add_option_function<std::string>(
             "--report-images", [&page](const std::string& kind) { page.link = kind == "link"; },
             "embed: the pictures are in the page, which needs no other file; link: they are files in a "
             "folder "
             "beside it, sharper"),
         {"embed", "link"})
        ->default_str("embed")
        ->needs(report);
}

void add_train(CLI::App& parent, program::TrainCommand& command) {
    CLI::App& app = *parent.add_subcommand("train", "learn a model from labelled images");
    app.add_option("--data", command.data, data_text)->required();
    app.add_option("-o,--output", command.model, "model file to write")->required();
    app.add_option("--class", command.classes, "learn this class only; may be given several times")
        ->take_all()
        ->expected(1);
    only(app.add_option("--detector", command.detector,
                        "finds features; the part of the model for depth always has dog"),
         texts(program::detector_names))
        ->capture_default_str();
    only(app.add_option("--descriptor", command.descriptor,
                        "describes features; the part for depth always has root-sift"),
         texts(program::descriptor_names))
        ->capture_default_str();
    only(app.add_option("--orientation", command.orientation,
                        "upright: objects have one side up; free: they are found however they are turned in "
                        "the image, where training objects have one side up by votes and words alone; auto: "
                        "as training objects lie"),
         {"auto", "upright", "free"})
        ->capture_default_str();
    only(app.add_option_function<std::string>(
             "--codebook",
             [&command](const std::string& kind) {
                 command.options.codebook.kind =
                     kind == "joint" ? ism::CodebookKind::joint : ism::CodebookKind::per_class;
             },
             "whether classes share words"),
         {"joint", "per-class"})
        ->default_str("joint");
    add_number(app, "--similarity", command.options.codebook.min_similarity,
               {-0.999999, 1, "above -1, at most 1"}, "least similarity in clusters and matches");
    add_number(app, "--min-cluster-size", command.options.codebook.min_cluster_size, {1, 1e9, "1 or more"},
               "features that make a word, at least");
    add_number(app, "--min-information-gain", command.options.selection.min_information_gain, {},
               "least information of a word about the class");
    add_number(app, "--max-words", command.options.selection.max_words, {},
               "keep so many of the best words, of the part for colours alone; 0 = all");
    only(app.add_option(
             "--best-words", command.best_words,
             "what --max-words goes by: how often a word is seen, its information gain, or how well its "
             "votes agree"),
         {"occurrences", "gain", "agreement"})
        ->capture_default_str();
    add_number(app, "--max-features", command.options.features.max_features, {1, 1e9, "1 or more"},
               "features of all objects together: each gives its share, the strongest, and at least 30");
    add_number(app, "--max-cluster-features", command.options.codebook.max_features, {2, 1e9, "2 or more"},
               "of more features a random part is clustered; all are matched");
    app.add_flag_callback(
        "--no-templates", [&command] { command.templates = false; },
        "learn no template of each class, only votes and words");
    app.add_flag_callback(
        "--no-depth", [&command] { command.depth = false; },
        "learn from colours alone, also where images have depth");
    add_number(app, "--seed", command.options.codebook.seed, {0, 1e18, "0 or more"}, "of random choices");
    CLI::Option* add_to =
        app.add_option("--add-to", command.add_to,
                       "model to teach more classes, or more examples of its classes; it was "
                       "trained with --growable, and its features and similarity stay; how many "
                       "words are kept is told anew");
    for (const char* fixed : {"--detector", "--descriptor", "--orientation", "--codebook", "--similarity"})
        add_to->excludes(app.get_option(fixed));
    CLI::Option* growable =
        app.add_flag("--growable", command.growable,
                     "keep all training features, which --add-to learns from again, but not what the space "
                     "metric needs; a larger file");
    add_to->excludes(growable);
    add_threads(app, command.options.threads);
    add_skip_bad(app, command.skip_bad);
    app.callback([&command] { program::run_train(command); });
}

constexpr const char* detect_help = R"(
What was found is told on standard output, how long it took on stderr. On a terminal it is a table; else one
line an object, its fields separated by tabulators: image, class, probability, box (x, y, width, height in
pixels, within the picture), depth (along the optical axis), position (x right, y down, z ahead of the camera)
and how far its votes scatter, in metres; - where something is not known. With --data this is told where no file is
asked for.

--json: one object an image: file, width, height, detections [class, category_id, probability, score, scale,
bbox, segmentation (COCO run lengths), and where they are known depth_m, position_m, position_error_m,
angle_rad of what is turned, from x towards y]; image_id of a data set; next_best, where nothing was
found, the most probable guess, as a rule before it is cut out and its mask judges it. Lines to a pipe go out
as soon as their image is done, in the order of the images.

Category ids are those of the data that the model was trained on (1, 2, ... where it does not know them), also
with --data; image ids are those of the data, of images on the command line 1, 2, ...
)";

void add_detect(CLI::App& parent, program::DetectCommand& command) {
    CLI::App& app = *parent.add_subcommand("detect", "find objects in images");
    app.footer(detect_help);
    app.add_option("--model", command.model, "model file")->required();
    CLI::Option* data =
        app.add_option("--data", command.data, "images, also without labels: as of ism train");
    CLI::Option* images = app.add_option("images", command.images,
                                         "image files, folders, patterns ('*.jpg'), or - for an image at "
                                         "standard input")
                              ->excludes(data);
    CLI::Option* scale =
        add_number(app, "--depth-scale", command.depth_scale, {1e-9, 1e3, "above 0, at most 1000"},
                   "metres per unit of --depth; 0.001 for millimetres")
            ->default_str("");
    scale->needs(app.add_option("--depth", command.depth, "depth of the one image, 16-bit PNG")
                     ->needs(images)
                     ->needs(scale));
    app.add_option_function<std::string>(
           "--camera",
           [&command](const std::string& text) { command.camera = program::parse_camera("--camera", text); },
           "focal lengths and principal point of the images, pixels")
        ->type_name("FX,FY,CX,CY")
        ->needs(images);
    app.add_option("-o,--output", command.results, "results to write, COCO JSON; - for standard output");
    app.add_option("--json", command.json,
                   "results to write, a line of JSON an image; - for standard output");
    app.add_flag("--show", command.show, "draw what was found beside each image: photo.ism.png")
        ->needs(images);
    std::vector<std::string> spaces = texts(program::space_names);
    spaces.insert(spaces.begin(), std::string(program::auto_space));
    spaces.emplace_back(program::metric_space);
    only(app.add_option(
             "--space", command.search.space,
             "vote space; auto: metric where the model was learnt with depth and the image has depth and a "
             "camera, and no --rescore, --verify or --segment is given, else jism"),
         spaces)
        ->capture_default_str();
    app.add_option_function<std::string>(
           "--keep",
           [&command](const std::string& text) {
               command.search.keep = program::parse_number<double>("--keep", text, between(0, 1));
           },
           "drop what scores less than this part of the image's best (from 0 to 1)")
        ->type_name("NUMBER")
        ->default_str(ism::join_text(ism::DetectOptions{}.min_relative_score, ", with templates 0.01"));
    app.add_option_function<std::string>(
           "--min-score",
           [&command](const std::string& text) {
               command.search.min_score = program::parse_number<double>("--min-score", text, between(0, 1));
           },
           "tell only what is an object at least so probably; 0: all that was found, for evaluation (from 0 "
           "to 1)")
        ->type_name("NUMBER")
        ->default_str(ism::join_text(program::default_min_score,
                                     " where templates judge or in the space metric, else 0"));
    only(app.add_option(
             "--rescore", command.search.rescorer,
             "what judges hypotheses beside their votes: a template of each class, the words in their "
             "boxes, or nothing; auto: templates where the model has them, else words"),
         {"auto", "template", "boxes", "none"})
        ->capture_default_str();
    only(
        app.add_option(
            "--verify", command.search.verifier,
            "how overlapping hypotheses are sorted out: by their masks, or by their boxes; auto: boxes where "
            "templates judge, else masks"),
        {"auto", "mdl", "nms"})
        ->capture_default_str();
    only(app.add_option(
             "--segment", command.search.segmenter,
             "what cuts objects out: training objects that look alike, with the colours and edges of the "
             "picture, or the patches of votes; auto: exemplars where the model has them, else patches"),
         {"auto", "exemplars", "patches"})
        ->capture_default_str();
    add_number(app, "--turns", command.search.turns, between(1, 360),
               "look at each image turned by so many angles: finds objects that lie turned by a model that "
               "knows them upright; 24 for any angle, which takes 24 times as long");
    app.add_option("--overlay", command.overlay_folder, "folder for pictures of what was found and why");
    CLI::Option* report = app.add_option("--report", command.report, "HTML page to write");
    add_report_images(app, report, command.page);
    add_number(
        app, "--report-most", command.report_most, {1, 1e6, "1 or more"},
        "images that the page shows, and explains two detections each: where labels tell, those with the "
        "worst mistakes, else the first")
        ->needs(report);
    add_threads(app, command.threads);
    add_skip_bad(app, command.skip_bad);
    app.callback([&command, data, images] {
        ism::expect(data->count() + images->count() > 0, "detect", "--data or images",
                    "neither, as in: ism detect --model model.safetensors photo.jpg");
        program::run_detect(command);
    });
}

void add_evaluate(CLI::App& parent, program::EvaluateCommand& command) {
    CLI::App& app = *parent.add_subcommand("evaluate",
                                           "measure what was found: average precision (AP), precision where "
                                           "it equals recall (EER), best F1, IoU of masks");
    app.add_option("--data", command.data, data_text)->required();
    app.add_option("--detections", command.detections, "results, COCO JSON")->required();
    only(
        app.add_option_function<std::string>(
            "--rule",
            [&command](const std::string& rule) {
                command.options.rule =
                    rule == "uiuc" ? ism::EvaluateOptions::Rule::uiuc : ism::EvaluateOptions::Rule::iou;
                command.masks = rule == "coco-masks";
                command.coco = rule == "coco" || command.masks;
            },
            "when a box is right: enough overlap (iou), or a centre near enough (uiuc); AP and recall as the "
            "official evaluation of COCO tells them of boxes (coco) or of masks (coco-masks)"),
        {"iou", "uiuc", "coco", "coco-masks"})
        ->default_str("iou");
    const CLI::Option* iou =
        add_number(app, "--iou", command.options.iou_threshold, {1e-9, 1, "above 0, at most 1"},
                   "least overlap of a right box by the rule iou");
    app.add_option("--json", command.json, "figures to write, JSON; - for standard output");
    const CLI::Option* plot = app.add_option("--plot", command.plot, "precision-recall curves to write, SVG");
    add_skip_bad(app, command.skip_bad);
    app.callback([&command, iou, plot] {
        for (const CLI::Option* other : {iou, plot})
            ism::expect(!command.coco || other->count() == 0,
                        command.masks ? "--rule coco-masks" : "--rule coco",
                        ism::lazy_text("no ", other->get_name()), "one");
        ism::expect(command.options.rule == ism::EvaluateOptions::Rule::iou || iou->count() == 0,
                    "--rule uiuc", "no --iou", "one");
        program::run_evaluate(command);
    });
}

void add_demo(CLI::App& parent, program::DemoCommand& command) {
    CLI::App& app = *parent.add_subcommand("demo", "render toys, learn them, find them, report");
    app.add_option("-o,--output", command.folder, "folder to write to")->capture_default_str();
    add_number(app, "--seed", command.seed, {0, 1e18, "0 or more"}, "of the toys and scenes");
    app.add_flag("--small", command.small, "a few pictures only")->group("");
    add_threads(app, command.threads);
    app.callback([&command] { program::run_demo(command); });
}

void add_inspect(CLI::App& parent, program::InspectCommand& command) {
    CLI::App& app = *parent.add_subcommand(
        "inspect", "tell what is in a data set before it is learnt from, and what looks wrong");
    app.add_option("--data", command.data, data_text)->required();
    add_report_images(
        app, app.add_option("--report", command.report, "HTML page to write, with examples of each class"),
        command.page);
    add_threads(app, command.threads);
    app.callback([&command] { program::run_inspect(command); });
}

void add_info(CLI::App& parent, program::InfoCommand& command) {
    CLI::App& app = *parent.add_subcommand("info", "tell what is in a model file");
    app.add_option("model", command.model, "model file")->required();
    CLI::Option* report = app.add_option("--report", command.report,
                                         "HTML page to write: words, objects and templates of each class");
    app.add_option("--data", command.data,
                   "the labelled images it was learnt from, so that the page shows words as they "
                   "were seen")
        ->needs(report);
    add_report_images(app, report, command.page);
    app.callback([&command] { program::run_info(command); });
}

/// One line on stderr.
int fail(std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    std::fprintf(stderr, "ism: %s\n", message.c_str());
    return 2;
}

/// What to type first, by the name that the program was called by.
int tell_first_steps(const std::string& program) {
    std::fprintf(
        stderr,
        R"(ism finds objects of several classes in pictures, after learning from a few labelled ones. Type first:

  %s demo
      makes pictures of toys, learns them, finds them, and writes a report
  %s train --data train.json -o model.safetensors
      learns your own labelled pictures (COCO, VOC, YOLO, labelme, or a folder a class)
  %s detect --model model.safetensors photo.jpg
      tells what is in a picture; --show draws it
  %s evaluate --data test.json --detections found.json
      tells how good results are: found.json is of ism detect --data test.json -o found.json

%s --help tells all commands, %s COMMAND --help all options.
)",
        program.c_str(), program.c_str(), program.c_str(), program.c_str(), program.c_str(), program.c_str());
    return 2;
}

/// The memory of one image serves the next: what is returned to the system has to be cleared again, page by
/// page.
void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, std::numeric_limits<int>::max());
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    CLI::App app(
        "Implicit Shape Models: find, cut out and place objects of many classes in colour and depth "
        "images.",
        "ism");
    app.set_version_flag("--version", std::string("ism ") + ism::version_text);
    app.require_subcommand(1);
    const std::string called = program::shell_word(argc > 0 ? argv[0] : "ism");
    program::TrainCommand train;
    train.program = called;
    program::DetectCommand detect;
    program::EvaluateCommand evaluate;
    program::DemoCommand demo;
    demo.program = called;
    program::InspectCommand inspect;
    program::InfoCommand info;
    add_train(app, train);
    add_detect(app, detect);
    add_evaluate(app, evaluate);
    add_demo(app, demo);
    add_inspect(app, inspect);
    add_info(app, info);

    std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    if (arguments.empty()) return tell_first_steps(called);
    if (arguments[0] == "help") {  // of a command, or of all
        arguments.erase(arguments.begin());
        arguments.resize(std::min<std::size_t>(arguments.size(), 1));
        arguments.emplace_back("--help");
    }
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    const std::string first = arguments[0];
    const bool is_command = std::find(names.begin(), names.end(), first) != names.end();
    std::error_code ignored;
    if (!is_command && std::filesystem::exists(first, ignored))
        return fail("expected a command (" + program::list_text(names) + ") first, got the file '" + first +
                    "'; to find objects in it: ism detect --model MODEL " + program::shell_word(first));
    std::vector<std::string> known = names;
    known.insert(known.end(), {"--help", "--version"});
    if (!is_command && first != "--help" && first != "-h" && first != "--version")
        return fail("expected a command (" + program::list_text(names) + ") first, got '" + first + "'" +
                    ism::did_you_mean(first, known) + "; ism --help tells more");
    try {
        if (is_command)
            program::check_option_names(*app.get_subcommand(first), {arguments.begin() + 1, arguments.end()});
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 takes them
        app.parse(reversed);
    } catch (const CLI::Success& done) {
        return app.exit(done);  // --help, --version
    } catch (const CLI::ParseError& error) {
        return fail(program::refusal_text(error, arguments));
    } catch (const std::bad_alloc&) {
        return fail(
            "memory: expected enough, got too little; smaller or fewer images, or --threads 1, take less");
    } catch (const std::exception& error) {
        return fail(error.what());
    }
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        return fail("standard output: expected to write it whole, got a failure");
    return 0;
}
