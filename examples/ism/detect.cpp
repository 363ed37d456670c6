// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <deque>

#include "commands.hpp"
#include "extractors.hpp"
#include "input.hpp"
#include "mistakes.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "spaces.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/detect/frame_matcher.hpp"
#include "ism/detect/metric.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/show/report_detections.hpp"

namespace program {

namespace {

/// Pictures in a report: of so many images, with the four pictures of so many detections each.
constexpr std::size_t report_images = 12, report_rows = 2;

/// The one image of the command line as a data set; class c of the model has the number c + 1.
ism::Dataset single_image(const DetectCommand& command, const ism::ShapeModel& shapes) {
    ism::Dataset dataset{.source = {}, .class_names = shapes.class_names};
    for (std::size_t c = 0; c < shapes.class_names.size(); ++c)
        dataset.category_ids.push_back(std::int64_t(c) + 1);
    const ism::RgbImage picture = ism::read_rgb(command.image);
    dataset.images.push_back({.id = 1,
                              .file = command.image,
                              .depth_file = command.depth,
                              .width = picture.width(),
                              .height = picture.height(),
                              .depth_scale = command.depth_scale,
                              .camera = command.camera});
    return dataset;
}

/// The data set's number of each class of the model.
std::vector<std::int64_t> category_ids(const ism::Dataset& dataset, const ism::ShapeModel& shapes) {
    std::vector<std::int64_t> ids;
    for (const std::string& name : shapes.class_names) {
        const auto found = std::find(dataset.class_names.begin(), dataset.class_names.end(), name);
        if (found == dataset.class_names.end())
            throw ism::Error(ism::join_text("class '", name, "' of the model: expected a class of '",
                                            dataset.source.string(), "' (", list_text(dataset.class_names),
                                            "), got none of this name; the model has ",
                                            list_text(shapes.class_names)));
        ids.push_back(dataset.category_ids[std::size_t(found - dataset.class_names.begin())]);
    }
    return ids;
}

/// @throws ism::Error where the space needs depth and no image has a depth file.
void check_depth(const DetectCommand& command, const ism::Dataset& dataset) {
    if (!needs_depth(command.search.space)) return;
    const bool any = std::any_of(dataset.images.begin(), dataset.images.end(),
                                 [](const ism::DatasetImage& image) { return !image.depth_file.empty(); });
    ism::expect(any, ism::lazy_text("vote space ", command.search.space),
                command.image.empty() ? "depth_file_name in '" + command.data.string() + "'" : "--depth",
                "no depth");
}

/// Whether --space auto can choose metric: the model knows it, and nothing is asked for that is not of it.
bool metric_allowed(const ism::Model& model, const SearchOptions& search) {
    return !model.rgbd.empty() && search.rescorer == "auto" && search.verifier == "auto" &&
           search.segmenter == "auto";
}

/// The space in which a frame is searched.
std::string_view space_of(const ism::Frame& frame, std::string_view space, bool may_be_metric) {
    if (space != auto_space) return space;
    return may_be_metric && !frame.depth_m.empty() && frame.camera ? metric_space : "jism";
}

/// What --space auto came to.
std::string spaces_text(std::size_t in_metres, std::size_t images, bool may_be_metric) {
    if (in_metres == images) return "metric";
    if (in_metres > 0)
        return ism::join_text("metric; jism for ", images - in_metres, " images without depth and camera");
    return may_be_metric ? "jism, for want of depth and camera: no positions, and less is found" : "jism";
}

/// Images for the report, and what is remarked beside their names.
struct ReportChoice {
    std::vector<std::size_t> images = {};
    std::vector<std::string> remarks = {};
    bool by_mistakes = false;
};

/// Of a labelled data set the images with the worst mistakes, worst first; else the first ones.
ReportChoice choose_for_report(const ism::Dataset& dataset,
                               const std::vector<std::vector<ism::Result>>& results, std::size_t count) {
    ReportChoice choice;
    for (std::size_t i = 0; i < results.size(); ++i) choice.images.push_back(i);
    choice.by_mistakes = count > 0 && std::any_of(dataset.images.begin(), dataset.images.end(),
                                                  [](const auto& image) { return !image.objects.empty(); });
    std::vector<Mistakes> mistakes(results.size());
    if (choice.by_mistakes) mistakes = find_mistakes(dataset, results);
    std::stable_sort(choice.images.begin(), choice.images.end(),
                     [&](std::size_t a, std::size_t b) { return mistakes[a].weight > mistakes[b].weight; });
    choice.images.resize(std::min(count, choice.images.size()));
    for (const std::size_t i : choice.images) {
        const std::string text = mistakes[i].text();
        choice.remarks.push_back(text.empty() ? "" : ": " + text);
    }
    return choice;
}

}  // namespace

void run_detect(const DetectCommand& command) {
    const Stopwatch watch;
    for (const auto& output : {command.results, command.report})
        if (!output.empty())
            check_output(output, std::array{command.model, command.data, command.image, command.depth});
    ism::expect(command.report.empty() || command.report != command.results, "report", "another file than -o",
                "the same");
    const ism::Model model = ism::load_model(command.model);
    const ism::ShapeModel& shapes = model.shapes;
    ism::Dataset dataset =
        command.image.empty() ? ism::read_dataset(command.data) : single_image(command, shapes);
    const std::vector<std::int64_t> ids = category_ids(dataset, shapes);
    check_depth(command, dataset);
    ism::expect(command.search.space != metric_space || !model.rgbd.empty(), "--space metric",
                "a model learnt from images with depth and camera", "one without");
    const std::size_t skipped =
        check_images(dataset, command.threads, command.skip_bad, [&](const ism::DatasetImage& image) {
            if (needs_depth(command.search.space) && image.depth_file.empty())
                throw ism::FileError(ism::file_text(image.file) +
                                     ": expected a depth image beside it, got none");
            if (command.search.space == metric_space && !image.camera)
                throw ism::FileError(ism::file_text(image.file) + ": expected its camera, got none");
            (void)ism::read_frame(image);
        });
    std::optional<OverlayFiles> overlays;
    if (!command.overlay_folder.empty()) {
        overlays.emplace(command.overlay_folder, dataset);
        make_folder(command.overlay_folder);
    }

    const std::size_t count = dataset.images.size();
    const bool auto_metric = metric_allowed(model, command.search);
    std::vector<std::vector<ism::Result>> results(count);
    std::vector<ism::ReportSection> sections;
    double search_seconds = 0;
    std::atomic<std::size_t> in_metres = 0;
    bool by_mistakes = false;
    {
        const Stopwatch search_watch;
        ProgressLine progress;
        // Several images are shared out among the threads; on a single one all threads work together.
        const unsigned inner = count > 1 ? 1 : command.threads;
        ism::ThreadPool pool(count > 1 ? command.threads : 1);
        const std::vector<ism::AnyExtractor> extractors = extractors_of(model);
        std::vector<ism::AnyExtractor> rgbd_extractors;
        for (const ism::Model& rgbd : model.rgbd) rgbd_extractors = extractors_of(rgbd);
        std::deque<ism::ThreadPool> inner_pools;  // one a worker
        std::deque<ism::FrameMatcher> matchers, rgbd_matchers;
        for (unsigned worker = 0; worker < pool.size(); ++worker) {
            ism::ThreadPool& own = inner_pools.emplace_back(inner);
            matchers.emplace_back(model, extractors, own);
            for (const ism::Model& rgbd : model.rgbd) rgbd_matchers.emplace_back(rgbd, rgbd_extractors, own);
        }
        const auto find = [&](const ism::Frame& frame, unsigned worker, bool explain) {
            SearchOptions search = command.search;
            search.explain = explain;
            search.space = space_of(frame, search.space, auto_metric);
            const bool metric = search.space == metric_space;
            return find_objects(metric ? rgbd_matchers[worker].scene(frame, ism::match_in<ism::Metric>())
                                       : matchers[worker].scene(frame),
                                search);
        };
        pool.for_each(count, [&](std::size_t i, unsigned worker) {
            const ism::DatasetImage& image = dataset.images[i];
            const ism::Frame frame = ism::read_frame(image);
            if (space_of(frame, command.search.space, auto_metric) == metric_space) ++in_metres;
            const ism::Detections found = find(frame, worker, overlays.has_value());
            results[i] = ism::to_results(found, image, ids);
            if (overlays) overlays->write(i, ism::read_rgb(image.file), found, shapes.class_names);
            progress.step("detecting", count);
        });
        search_seconds = search_watch.seconds();

        // The images that the report shows are looked at once more, to be explained.
        const ReportChoice choice =
            choose_for_report(dataset, results, command.report.empty() ? 0 : report_images);
        by_mistakes = choice.by_mistakes;
        sections.resize(choice.images.size());
        pool.for_each(sections.size(), [&](std::size_t k, unsigned worker) {
            const ism::DatasetImage& image = dataset.images[choice.images[k]];
            const ism::Frame frame = ism::read_frame(image);
            const ism::Detections found = find(frame, worker, true);
            const std::string name =
                command.image.empty() ? short_name(dataset, image) : image.file.filename().string();
            sections[k] = ism::detection_section(
                name + choice.remarks[k], ism::read_rgb(image.file), found, shapes.class_names,
                {.rows = report_rows,
                 .objects = model.rgbd.empty() ? std::span<const ism::TrainingObject>()
                                               : model.rgbd[0].shapes.objects});
        });
    }

    std::vector<ism::Result> all;
    for (auto& part : results) std::move(part.begin(), part.end(), std::back_inserter(all));
    if (!command.report.empty()) {
        ism::Report report{.title = "Detections"};
        report.summary = {
            {"model", command.model.filename().string()},
            {"classes", list_text(shapes.class_names)},
            {"vote space", command.search.space == auto_space ? spaces_text(in_metres, count, auto_metric)
                                                              : command.search.space},
            {"images", std::to_string(count)},
            {"detections", std::to_string(all.size())}};
        if (sections.size() < count)
            report.summary.emplace_back(
                "shown here", ism::join_text("the ", by_mistakes ? "" : "first ", sections.size(), " images",
                                             by_mistakes ? " with the worst mistakes" : ""));
        report.sections = std::move(sections);
        ism::write_file(command.report, ism::to_html(report));
    }
    ism::write_results(command.results, all);
    std::printf("images      %zu\n", count);
    if (skipped > 0) std::printf("skipped     %zu\n", skipped);
    if (command.search.space == auto_space)
        std::printf("space       %s\n", spaces_text(in_metres, count, auto_metric).c_str());
    std::printf("detections  %zu\n", all.size());
    std::printf("seconds     %.1f\n", watch.seconds());
    std::printf("ms/image    %.0f (%u threads)\n", 1000 * search_seconds / double(count),
                ism::thread_count(command.threads));
}

}  // namespace program
