// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/evaluate/coco.hpp"
#include "ism/train/train_options.hpp"

namespace program {

/// The vote spaces of the paper by name, in the order of its equations.
inline constexpr std::array<std::string_view, 5> space_names = {"ism", "jism", "ji3sm1", "ji3sm2", "ji3sm3"};
/// The space of a model's part for depth, and the choice between it and jism, image by image.
inline constexpr std::string_view metric_space = "metric", auto_space = "auto";
inline constexpr std::array<std::string_view, 4> detector_names = {"dog", "harris-laplace", "hessian-laplace",
                                                                   "dense"};
inline constexpr std::array<std::string_view, 2> descriptor_names = {"sift", "root-sift"};

// What is taken where nothing is said; all else comes from the library.
inline constexpr std::string_view default_detector = "hessian-laplace";
inline constexpr std::string_view default_descriptor = "root-sift";
inline constexpr std::string_view default_orientation = "auto";
inline constexpr std::string_view default_space = auto_space;
inline constexpr std::string_view default_rescorer = "auto";
inline constexpr std::string_view default_verifier = "auto";
inline constexpr std::string_view default_segmenter = "auto";

struct TrainCommand {
    std::filesystem::path data, model;
    std::vector<std::string> classes = {};  ///< none = all of the data set
    std::string detector{default_detector}, descriptor{default_descriptor};
    std::string orientation{default_orientation};
    ism::TrainOptions options = {};
    bool skip_bad = false;
    std::filesystem::path add_to = {};     ///< model that learns more; empty = a new one
    std::string best_words = "agreement";  ///< what TrainOptions::selection goes by
    bool templates = true;                 ///< also learn a template of each class
    bool depth = true;                     ///< also learn from depth, where images have it
    bool growable = false;                 ///< keep the training features, for add_to
    std::string program = "ism";           ///< as it was called, for the command to type next
};

/// How a page keeps its pictures.
struct PageOptions {
    bool link = false;  ///< pictures are files beside the page, sharper and of any size
};

/// What is less probable is not told where templates judge: a place without objects shall look empty.
constexpr double default_min_score = 0.2;

/// How objects are searched for, whatever the vote space.
struct SearchOptions {
    std::string space{default_space}, rescorer{default_rescorer}, verifier{default_verifier},
        segmenter{default_segmenter};
    std::optional<double> keep = {};       ///< none = the library's
    std::optional<double> min_score = {};  ///< least probability of what is told; none = default_min_score
                                           ///< where templates judge, else 0
    int turns = 1;                         ///< angles by which images are turned
    bool explain = false;                  ///< also tell what templates saw, to be drawn
};

struct DetectCommand {
    std::filesystem::path model;
    std::filesystem::path data = {};       ///< or
    std::vector<std::string> images = {};  ///< files, folders, patterns, "-"
    std::filesystem::path depth = {};      ///< of the one image
    double depth_scale = 0;                ///< metres per unit
    std::optional<ism::Camera> camera = {};
    SearchOptions search = {};
    std::filesystem::path results = {}, json = {};           ///< empty = none, "-" = standard output
    bool show = false;                                       ///< write an overlay beside each image
    std::size_t report_most = 12;                            ///< images that the report shows
    std::filesystem::path overlay_folder = {}, report = {};  ///< empty = none
    PageOptions page = {};
    unsigned threads = 0;
    bool skip_bad = false;
};

struct EvaluateCommand {
    std::filesystem::path data, detections;
    ism::EvaluateOptions options = {};
    bool coco = false;                           ///< COCO's rule in place of that of the options …
    bool masks = false;                          ///< … on masks
    std::filesystem::path json = {}, plot = {};  ///< empty = none
    bool skip_bad = false;
};

struct InspectCommand {
    std::filesystem::path data, report = {};  ///< no report = on the terminal alone
    PageOptions page = {};
    unsigned threads = 0;
};

struct InfoCommand {
    std::filesystem::path model, report = {};  ///< no report = on the terminal alone
    std::filesystem::path data = {};           ///< what the model was learnt from, for pictures of its words
    PageOptions page = {};
};

struct DemoCommand {
    std::filesystem::path folder = "ism-demo";
    bool small = false;  ///< a few pictures only
    std::uint64_t seed = 1;
    unsigned threads = 0;
    std::string program = "ism";  ///< as it was called, for the commands to type next
};

// Each runs a command, prints its summary on stdout, and throws ism::Error where something is wrong.
void run_train(const TrainCommand& command);
void run_detect(const DetectCommand& command);
void run_evaluate(const EvaluateCommand& command);
void run_demo(const DemoCommand& command);
void run_inspect(const InspectCommand& command);
void run_info(const InfoCommand& command);

}  // namespace program
