// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <sstream>

#include "commands.hpp"
#include "detect_page.hpp"
#include "extractors.hpp"
#include "input.hpp"
#include "learning.hpp"
#include "output.hpp"
#include "pictures.hpp"
#include "progress.hpp"
#include "spaces.hpp"
#include "toy/toy_set.hpp"
#include <unistd.h>

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/evaluate/coco.hpp"
#include "ism/evaluate/plot.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/show/report_detections.hpp"

namespace program {

namespace fs = std::filesystem;

namespace {

/// Marks folders that a demo may write over.
constexpr const char* marker = "made-by-ism-demo";

/// What one vote space gives on the test scenes.
struct SpaceOutcome {
    std::vector<ism::Result> results;
    ism::Evaluation evaluation;
    ism::PrecisionRecall curve;     ///< of all classes together
    double position_error_m = NAN;  ///< mean over what was found rightly
    double milliseconds = 0;        ///< an image, on one thread
};

/// What the spaces find in one scene, by space.
struct SceneOutcome {
    std::array<std::vector<ism::Result>, space_names.size()> results;
    std::array<double, space_names.size()> seconds{};
};

/// What was found in all scenes.
struct DemoSearch {
    std::vector<SceneOutcome> scenes;
    std::vector<std::vector<ism::Result>> shown;  ///< by one space, as much as the program tells by default
};

constexpr const char* what_is_shown = "synthetic: toys and tables were rendered, nothing was photographed";

/// The space of which pictures are shown.
constexpr std::string_view shown_space = "jism";

/// Threads, and a matcher for each.
struct Searchers {
    Searchers(const ism::Model& model, unsigned threads) : pool(threads) {
        for (unsigned worker = 0; worker < pool.size(); ++worker)
            matchers.emplace_back(model, single.emplace_back(1u));
    }

    ism::ThreadPool pool;
    std::deque<ism::ThreadPool> single;  // one a matcher
    std::deque<Matcher> matchers;
};

/// An own or empty folder, or one of an earlier demo.
void prepare(const fs::path& folder) {
    make_folder(folder);
    const bool used = fs::directory_iterator(folder) != fs::directory_iterator();
    ism::expect<ism::FileError>(!used || fs::exists(folder / marker),
                                ism::lazy_text("folder '", folder.string(), "'"),
                                "an empty one or one of an earlier demo", "other files in it");
    ism::write_file(folder / marker, std::string_view());
    make_folder(folder / "overlays");
}

toy::ToySetOptions toy_options(const DemoCommand& command) {
    toy::ToySetOptions options;
    options.seed = command.seed, options.threads = command.threads;
    if (command.small) {
        options.train_cars = options.train_others = 3;
        options.test_scenes = 2;
        options.picture.width = 320, options.picture.height = 240, options.picture.focal_px = 262.5;
    }
    return options;
}

SpaceOutcome measure(const toy::ToySet& set, std::vector<ism::Result> results) {
    SpaceOutcome outcome{.results = std::move(results), .evaluation = {}, .curve = {}};
    const std::span<const ism::Result> found = outcome.results;
    outcome.evaluation = ism::evaluate(set.test, found);
    std::vector<const toy::ToyObject*> truth;
    for (const auto& objects : set.test_truth)
        for (const toy::ToyObject& object : objects) truth.push_back(&object);
    std::vector<ism::ScoredVerdict> verdicts;
    double sum = 0;
    std::size_t placed = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const ism::Judgement& judgement = outcome.evaluation.judgements[i];
        const bool right = judgement.verdict == ism::Verdict::true_positive;
        verdicts.push_back({found[i].score, right});
        if (!right || !found[i].position_m) continue;
        const ism::Point3 a = *found[i].position_m, b = truth[judgement.truth]->position_m;
        sum += std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
        ++placed;
    }
    if (placed > 0) outcome.position_error_m = sum / double(placed);
    outcome.curve = ism::precision_recall(verdicts, truth.size());
    return outcome;
}

std::vector<std::vector<std::string>> table_of(std::span<const SpaceOutcome> outcomes) {
    std::vector<std::vector<std::string>> rows = {
        {"space", "AP %", "EER %", "F1 %", "mask IoU %", "position error m", "ms/image"}};
    for (std::size_t s = 0; s < outcomes.size(); ++s) {
        const ism::Figures& mean = outcomes[s].evaluation.mean;
        rows.push_back({std::string(space_names[s])});
        for (const double share : {mean.ap, mean.eer, mean.best_f1, mean.mask_iou})
            rows.back().push_back(ism::percent_text(share));
        char text[32] = "-";
        if (!std::isnan(outcomes[s].position_error_m))
            std::snprintf(text, sizeof text, "%.3f", outcomes[s].position_error_m);
        rows.back().emplace_back(text);
        std::snprintf(text, sizeof text, "%.0f", outcomes[s].milliseconds);
        rows.back().emplace_back(text);
    }
    return rows;
}

ism::Plot plot_of(std::span<const SpaceOutcome> outcomes) {
    ism::Plot plot{.title = "Toy scenes (synthetic), all classes",
                   .x_label = "recall",
                   .y_label = "precision",
                   .width_px = 380,
                   .height_px = 320};
    for (std::size_t s = 0; s < outcomes.size(); ++s) {
        ism::PlotCurve curve{.name = std::string(space_names[s]), .color = ism::class_color(s)};
        for (const ism::PrecisionRecallPoint& point : outcomes[s].curve.points) {
            if (curve.x.empty()) curve.x.push_back(0), curve.y.push_back(point.precision);
            curve.x.push_back(point.recall), curve.y.push_back(point.precision);
        }
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

/// One training picture of each class.
ism::ReportSection lesson_section(const ism::Dataset& train) {
    ism::ReportGallery gallery;
    for (std::size_t c = 0; c < train.class_names.size(); ++c) {
        const auto image =
            std::find_if(train.images.begin(), train.images.end(), [&](const ism::DatasetImage& i) {
                return !i.objects.empty() && i.objects.front().class_index == c;
            });
        if (image == train.images.end()) continue;
        gallery.figures.push_back(ism::picture_figure(
            ism::report_picture(ism::read_rgb(image->file), {.side_px = 320, .most_bytes = 16000}),
            train.class_names[c]));
        gallery.figures.back().width_px = 165;
    }
    ism::ReportSection section{.title = "Learnt from pictures like these"};
    section.parts.push_back(std::move(gallery));
    return section;
}

/// The command that opens a page, or its address where no such command is there.
std::string opening_text(const fs::path& page) {
    const std::string path = std::getenv("PATH") != nullptr ? std::getenv("PATH") : "";
    std::istringstream folders(path);
    for (std::string folder; std::getline(folders, folder, ':');)
        for (const char* opener : {"xdg-open", "open"})
            if (access((fs::path(folder) / opener).c_str(), X_OK) == 0)
                return std::string(opener) + " " + shell_word(page.string());
    return "file://" + fs::absolute(page).string();
}

ism::Model learn_toys(const toy::ToySet& set, unsigned threads, ProgressLine& progress) {
    ism::TrainOptions options{.threads = threads};
    options.progress = [&](std::string_view stage, std::size_t done, std::size_t total) {
        progress.tell(stage, done, total);
    };
    return learn(extract_training_features(set.train.class_names, ism::training_set(set.train, read_picture),
                                           {make_extractor(default_detector, default_descriptor)}, options),
                 options);
}

/// Searches each test scene in all spaces, and draws what the one that is shown tells.
DemoSearch search_scenes(const toy::ToySet& set, const ism::ShapeModel& shapes,
                         const fs::path& overlay_folder, Searchers& searchers, ProgressLine& progress) {
    const OverlayFiles overlays(overlay_folder, set.test);
    const ism::Font font = overlay_font(shapes.class_names);
    const std::size_t count = set.test.images.size();
    DemoSearch search{std::vector<SceneOutcome>(count), std::vector<std::vector<ism::Result>>(count)};
    searchers.pool.for_each(count, [&](std::size_t i, unsigned worker) {
        const ism::DatasetImage& image = set.test.images[i];
        const ism::Frame frame = ism::read_frame(image, read_picture);
        const Stopwatch look_watch;
        const ism::Scene scene = searchers.matchers[worker].scene(frame, shown_space);
        const double look_seconds = look_watch.seconds();
        SceneOutcome& outcome = search.scenes[i];
        for (std::size_t s = 0; s < space_names.size(); ++s) {
            SearchOptions all;
            all.space = space_names[s], all.min_score = 0, all.keep = 0;  // AP asks for all
            const Stopwatch search_watch;
            const ism::Detections found = find_objects(scene, all);
            outcome.seconds[s] = look_seconds + search_watch.seconds();
            outcome.results[s] = ism::to_results(found, image, shapes);
        }
        const ism::Detections shown = find_objects(scene, {.space = std::string(shown_space)});
        overlays.write(i, ism::read_rgb(image.file), shown, shapes.class_names, font);
        search.shown[i] = ism::to_results(shown, image, shapes);
        progress.step("detecting in five vote spaces", count);
    });
    return search;
}

std::vector<SpaceOutcome> outcomes_of(const toy::ToySet& set, std::span<const SceneOutcome> scenes) {
    std::vector<SpaceOutcome> outcomes;
    for (std::size_t s = 0; s < space_names.size(); ++s) {
        std::vector<ism::Result> results;
        double seconds = 0;
        for (const SceneOutcome& scene : scenes) {
            results.insert(results.end(), scene.results[s].begin(), scene.results[s].end());
            seconds += scene.seconds[s];
        }
        outcomes.push_back(measure(set, std::move(results)));
        outcomes.back().milliseconds = 1000 * seconds / double(scenes.size());
    }
    return outcomes;
}

/// The page of what was found.
/// @param shown  has to stay as long as the page
DetectPage page_of(const toy::ToySet& set, const ism::ShapeModel& shapes,
                   const std::vector<std::vector<ism::Result>>& shown, Searchers& searchers) {
    constexpr std::size_t report_scenes = 6, report_rows = 2;
    DetectPage page(set.test, shown, shapes.class_names, short_names(set.test), report_scenes);
    searchers.pool.for_each(page.images().size(), [&](std::size_t k, unsigned worker) {
        const ism::DatasetImage& image = set.test.images[page.images()[k]];
        const ism::Frame frame = ism::read_frame(image, read_picture);
        SearchOptions search;
        search.space = shown_space, search.explain = true;
        page.add(k, ism::read_rgb(image.file), searchers.matchers[worker].find(frame, search), report_rows,
                 {});
    });
    return page;
}

/// The page, with what was learnt from and how well each space does.
ism::Report report_of(const toy::ToySet& set, const ism::Model& model, const DetectPage& page,
                      const std::vector<std::vector<std::string>>& rows, const std::string& plot) {
    const ism::ShapeModel& shapes = model.shapes;
    ism::Report report = page.report(
        "ism demo on synthetic toy scenes",
        {{"pictures", what_is_shown},
         {"learnt from", ism::join_text(set.train.images.size(), " pictures of single toys, ",
                                        shapes.objects.size(), " toys")},
         {"tested on",
          ism::join_text(set.test.images.size(), " cluttered tables with other toys of the same kinds")},
         {"classes", list_text(shapes.class_names)},
         {"features", ism::join_text(default_detector, ", ", default_descriptor)},
         {"model",
          ism::join_text(model.words(), " words, ", shapes.occurrences.values().size(), " occurrences")}});
    ism::ReportSection figures{.title = "Five vote spaces"};
    figures.parts.push_back(ism::ReportTable{
        .caption = "Means over the classes; a box is right from an IoU of 0.5. Position: from the middle of "
                   "the toy. Time: one thread.",
        .header = rows.front(),
        .rows = {rows.begin() + 1, rows.end()}});
    figures.parts.push_back(ism::ReportPlot{plot});
    report.sections.insert(report.sections.begin(), {std::move(figures), lesson_section(set.train)});
    return report;
}

}  // namespace

void run_demo(const DemoCommand& command) {
    const Stopwatch watch;
    const fs::path& folder = command.folder;
    prepare(folder);
    ProgressLine progress;
    progress.tell("rendering toys", 0, 1);
    const toy::ToySet set = toy::write_toy_set(folder, toy_options(command));
    const double render_seconds = watch.seconds();

    const Stopwatch train_watch;
    const ism::Model model = learn_toys(set, command.threads, progress);
    ism::save_model(folder / "model.safetensors", model);
    const double train_seconds = train_watch.seconds();

    Searchers searchers(model, command.threads);
    const DemoSearch search = search_scenes(set, model.shapes, folder / "overlays", searchers, progress);
    const std::vector<SpaceOutcome> outcomes = outcomes_of(set, search.scenes);
    for (std::size_t s = 0; s < space_names.size(); ++s)
        ism::write_results(folder / ism::join_text("detections-", space_names[s], ".json"),
                           outcomes[s].results);
    const auto rows = table_of(outcomes);
    const std::string plot = ism::to_svg(plot_of(outcomes));
    ism::write_file(folder / "pr.svg", plot);
    write_page(folder / "report.html",
               report_of(set, model, page_of(set, model.shapes, search.shown, searchers), rows, plot), {});

    progress.clear();
    std::printf("Toy scenes (%s).\n", what_is_shown);
    std::printf("%zu classes (%s), %zu training pictures, %zu test scenes.\n",
                model.shapes.class_names.size(), list_text(model.shapes.class_names).c_str(),
                set.train.images.size(), search.scenes.size());
    std::printf("Rendered in %.0f s, learnt in %.1f s.\n\n", render_seconds, train_seconds);
    std::fputs(ism::align_columns(rows).c_str(), stdout);
    std::printf("\nMeans over the classes; a box is right from an IoU of 0.5; one thread an image.\n");
    std::printf("All in %.0f s. To see it:\n  %s\n", watch.seconds(),
                opening_text(folder / "report.html").c_str());
    const char* const program = command.program.c_str();
    std::printf("Next, with labels of COCO, VOC, YOLO, labelme, or a folder a class:\n");
    std::printf("  %s train --data train.json -o model.safetensors\n", program);
    std::printf("  %s detect --model model.safetensors --show photo.jpg\n", program);
    std::printf("  %s detect --model model.safetensors --data test.json --report found.html\n", program);
}

}  // namespace program
