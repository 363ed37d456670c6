// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <deque>

#include "commands.hpp"
#include "data.hpp"
#include "detect_page.hpp"
#include "extractors.hpp"
#include "image_list.hpp"
#include "input.hpp"
#include "output.hpp"
#include "pictures.hpp"
#include "progress.hpp"
#include "spaces.hpp"
#include "tell.hpp"
#include <unistd.h>

#include "ism/core/nearest_name.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/detect/frame_matcher.hpp"
#include "ism/detect/metric.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/show/overlay.hpp"

namespace program {

namespace fs = std::filesystem;

namespace {

/// Pictures in a report: of so many images, with the four pictures of so many detections each.
constexpr std::size_t report_images = 12, report_rows = 2;

/// The pictures of the command line as a data set, numbered from 1; their sizes are read when they are
/// checked.
ism::Dataset as_dataset(const ImageList& list, const DetectCommand& command, const ism::ShapeModel& shapes) {
    ism::Dataset dataset{
        .source = {}, .class_names = shapes.class_names, .category_ids = ism::result_category_ids(shapes)};
    for (const NamedImage& image : list.images())
        dataset.images.push_back({.id = std::int64_t(dataset.images.size()) + 1,
                                  .file = image.file,
                                  .depth_file = command.depth,
                                  .depth_scale = command.depth_scale,
                                  .camera = command.camera});
    return dataset;
}

/// Where the classes of a data set are only those that its labels name, or none: adds those of the model.
void add_classes(ism::Dataset& dataset, const ism::ShapeModel& shapes) {
    if (dataset.classes_listed && !dataset.class_names.empty()) return;
    for (const std::string& name : shapes.class_names) {
        const auto& known = dataset.class_names;
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        dataset.class_names.push_back(name);
        dataset.category_ids.push_back(std::int64_t(dataset.class_names.size()));
    }
}

/// Makes sure that a labelled data set has the classes of the model, and tells where their numbers differ.
/// @throws ism::Error where it lacks one.
void check_classes(const ism::Dataset& dataset, const ism::ShapeModel& shapes) {
    const auto labelled = [](const ism::DatasetImage& image) { return !image.objects.empty(); };
    if (!dataset.classes_listed) return;
    if (std::none_of(dataset.images.begin(), dataset.images.end(), labelled)) return;
    const std::vector<std::int64_t> ids = ism::result_category_ids(shapes);
    for (std::size_t c = 0; c < ids.size(); ++c) {
        const std::string& name = shapes.class_names[c];
        const auto found = std::find(dataset.class_names.begin(), dataset.class_names.end(), name);
        if (found == dataset.class_names.end())
            throw ism::Error(ism::join_text("class '", name, "' of the model: expected a class of '",
                                            dataset.source.string(), "' (", list_text(dataset.class_names),
                                            "), got none of this name",
                                            ism::did_you_mean(name, dataset.class_names), "; the model has ",
                                            list_text(shapes.class_names)));
        const std::int64_t there = dataset.category_ids[std::size_t(found - dataset.class_names.begin())];
        if (there == ids[c]) continue;
        std::fprintf(
            stderr,
            "ism: note: class '%s' has category id %lld in '%s'; results have the model's, %lld, and "
            "the name, by which ism evaluate goes\n",
            name.c_str(), static_cast<long long>(there), dataset.source.string().c_str(),
            static_cast<long long>(ids[c]));
        return;
    }
}

/// @throws ism::Error where the space needs depth and no image has a depth file.
void check_depth(const DetectCommand& command, const ism::Dataset& dataset) {
    if (!needs_depth(command.search.space)) return;
    const bool any = std::any_of(dataset.images.begin(), dataset.images.end(),
                                 [](const ism::DatasetImage& image) { return !image.depth_file.empty(); });
    ism::expect(any, ism::lazy_text("vote space ", command.search.space),
                command.images.empty() ? "depth_file_name in '" + command.data.string() + "'" : "--depth",
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

/// Reads a picture of the command line, and tells its data set how large it is.
ism::Frame picture_frame(ism::DatasetImage& image) {
    ism::Picture picture = read_picture(image.file);
    image.width = picture.gray.width(), image.height = picture.gray.height();
    if (!image.depth_file.empty()) return ism::read_frame(image, read_picture);
    ism::Frame frame{
        .gray = std::move(picture.gray), .color = std::move(picture.color), .camera = image.camera};
    ism::at_place(ism::file_text(image.file), [&] { ism::check(frame); });
    return frame;
}

/// Whether an output is standard output.
bool is_standard_output(const fs::path& file) {
    return file == "-" || file == "/dev/stdout";
}

/// Makes sure that all outputs can be written, each to a place of its own.
void check_outputs(const DetectCommand& command, const ImageList& list) {
    std::vector<fs::path> inputs = {command.model, command.data, command.depth};
    for (const NamedImage& image : list.images()) inputs.push_back(image.file);
    const std::array<std::pair<const char*, fs::path>, 3> outputs = {
        {{"-o", command.results}, {"--json", command.json}, {"--report", command.report}}};
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const auto& [option, file] = outputs[i];
        if (file.empty()) continue;
        if (file != "-") check_output(file, inputs);
        for (std::size_t j = 0; j < i; ++j)
            ism::expect(
                outputs[j].second.empty() || outputs[j].second.lexically_normal() != file.lexically_normal(),
                option, ism::lazy_text("another file than ", outputs[j].first), "the same");
    }
    ism::expect(command.report != "-", "--report", "a file", "standard output");
}

void write_output(const fs::path& file, std::string_view text) {
    if (file == "-")
        std::fwrite(text.data(), 1, text.size(), stdout);
    else
        ism::write_file(file, text);
}

/// The most probable of what was left out, as a result without a mask.
std::optional<ism::Result> next_best(const ism::Detections& found, const ism::DatasetImage& image,
                                     const ism::ShapeModel& shapes) {
    if (!found.next_best) return {};
    std::vector<ism::Result> results = ism::to_results({.objects = {*found.next_best}}, image, shapes);
    if (results.empty()) return {};
    results[0].segmentation.reset();
    return std::move(results[0]);
}

/// The objects on standard output, and on stderr the images without.
void tell_objects(std::span<const FoundInImage> found) {
    if (isatty(STDOUT_FILENO) != 0)
        std::fputs(object_table(found).c_str(), stdout);
    else
        for (const FoundInImage& image : found) std::fputs(object_lines(image).c_str(), stdout);
    std::fflush(stdout);
}

std::string count_text(std::size_t count, const char* what) {
    return ism::join_text(count, " ", what, count == 1 ? "" : "s");
}

void tell_nothing_found(std::span<const FoundInImage> found) {
    constexpr std::size_t most_named = 5;
    std::size_t without = 0;
    for (const FoundInImage& image : found)
        if (image.results.empty() && ++without <= most_named)
            std::fprintf(stderr, "%s\n", nothing_found_text(image).c_str());
    if (without > most_named)
        std::fprintf(stderr, "... and nothing found in %s more\n",
                     count_text(without - most_named, "image").c_str());
}

}  // namespace

void run_detect(const DetectCommand& command) {
    const Stopwatch watch;
    const bool pictures = !command.images.empty();
    const ImageList list(command.images);
    check_outputs(command, list);
    const std::vector<fs::path> shown = command.show ? overlay_files(list.images()) : std::vector<fs::path>();
    const ism::Model model = ism::load_model(command.model);
    const ism::ShapeModel& shapes = model.shapes;
    ism::Dataset dataset = pictures ? as_dataset(list, command, shapes)
                                    : read_data(command.data, ism::DatasetPart::test, command.skip_bad);
    add_classes(dataset, shapes);
    check_classes(dataset, shapes);
    check_depth(command, dataset);
    ism::expect(command.search.space != metric_space || !model.rgbd.empty(), "--space metric",
                "a model learnt from images with depth and camera", "one without");
    Doubts doubts;
    std::optional<ism::Frame> only;  // a single picture is read once
    const auto check_image = [&](ism::DatasetImage& image) {
        if (needs_depth(command.search.space) && image.depth_file.empty())
            throw ism::FileError(ism::file_text(image.file) + ": expected a depth image beside it, got none");
        if (command.search.space == metric_space && !image.camera)
            throw ism::FileError(ism::file_text(image.file) + ": expected its camera, got none");
        ism::Frame frame = pictures ? picture_frame(image) : ism::read_frame(image, read_picture);
        if (!frame.depth_m.empty())
            doubts.add(image.depth_file, ism::depth_scale_doubt(frame.depth_m, image.depth_scale));
        if (pictures && list.images().size() == 1) only = std::move(frame);
    };
    const std::size_t skipped =
        check_images(dataset, command.threads, command.skip_bad, [&](ism::DatasetImage& image) {
            try {
                check_image(image);
            } catch (const ism::Error& error) {
                throw ism::FileError(list.told(error.what()));
            }
        });
    doubts.tell();
    std::optional<OverlayFiles> overlays;
    if (!command.overlay_folder.empty()) {
        overlays.emplace(command.overlay_folder, dataset, shapes.class_names);
        make_folder(command.overlay_folder);
    }

    const ism::Font font = command.show ? overlay_font(shapes.class_names) : ism::Font();
    const std::size_t count = dataset.images.size();
    const auto name_of = [&](const ism::DatasetImage& image) {
        return pictures ? list.images()[std::size_t(image.id) - 1].name : short_name(dataset, image);
    };
    const bool auto_metric = metric_allowed(model, command.search);
    std::vector<std::vector<ism::Result>> results(count);
    std::vector<std::optional<ism::Result>> next(count);
    std::optional<DetectPage> page;
    double search_seconds = 0;
    std::atomic<std::size_t> in_metres = 0;
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
            const ism::Frame own = only ? ism::Frame() : ism::read_frame(image, read_picture);
            const ism::Frame& frame = only ? *only : own;
            if (space_of(frame, command.search.space, auto_metric) == metric_space) ++in_metres;
            const ism::Detections found = find(frame, worker, overlays.has_value());
            results[i] = ism::to_results(found, image, shapes);
            if (results[i].empty()) next[i] = next_best(found, image, shapes);
            if (overlays) overlays->write(i, frame.color, found, shapes.class_names);
            if (command.show)
                ism::write_png(shown[std::size_t(image.id) - 1],
                               ism::draw_detections(frame.color, found, shapes.class_names, {.font = &font}));
            progress.step("detecting", count);
        });
        search_seconds = search_watch.seconds();

        // The images that the report shows are looked at once more, to be explained.
        if (!command.report.empty()) {
            std::vector<std::string> names;
            for (const ism::DatasetImage& image : dataset.images) names.push_back(name_of(image));
            page.emplace(dataset, results, shapes.class_names, std::move(names), report_images);
            pool.for_each(page->images().size(), [&](std::size_t k, unsigned worker) {
                const ism::DatasetImage& image = dataset.images[page->images()[k]];
                const ism::Frame own = only ? ism::Frame() : ism::read_frame(image, read_picture);
                const ism::Frame& frame = only ? *only : own;
                page->add(k, frame.color, find(frame, worker, true), report_rows, command.page,
                          model.rgbd.empty() ? std::span<const ism::TrainingObject>()
                                             : model.rgbd[0].shapes.objects);
            });
        }
    }

    std::vector<ism::Result> all;
    std::vector<FoundInImage> found;
    std::string json;
    for (const auto& part : results) all.insert(all.end(), part.begin(), part.end());
    const std::string space = command.search.space == auto_space ? spaces_text(in_metres, count, auto_metric)
                                                                 : command.search.space;
    if (page)
        write_page(command.report,
                   page->report("Detections", {{"model", command.model.filename().string()},
                                               {"vote space", space},
                                               {"images", std::to_string(count)},
                                               {"detections", std::to_string(all.size())}}),
                   command.page);
    for (std::size_t i = 0; i < count; ++i) {
        const ism::DatasetImage& image = dataset.images[i];
        found.push_back({.name = name_of(image),
                         .width = image.width,
                         .height = image.height,
                         .results = std::move(results[i]),
                         .next_best = std::move(next[i])});
        if (!pictures) found.back().image_id = image.id;
        if (!command.json.empty()) json += json_line(found.back());
    }
    if (!command.results.empty())
        write_output(command.results, ism::results_text(all, ism::file_text(command.results)));
    if (!command.json.empty()) write_output(command.json, json);
    const bool taken = is_standard_output(command.results) || is_standard_output(command.json);
    const bool asked =
        pictures || (command.results.empty() && command.json.empty() && command.report.empty() && !overlays);
    if (asked && !taken) tell_objects(found);
    if (asked) tell_nothing_found(found);
    const double ms = 1000 * search_seconds / double(count);
    const unsigned threads = ism::thread_count(command.threads);
    if (pictures) {
        std::fprintf(stderr, "%s in %s%s, %.1f s, %.0f ms an image (%u threads); space %s\n",
                     count_text(all.size(), "object").c_str(), count_text(count, "image").c_str(),
                     skipped > 0 ? ism::join_text(", ", skipped, " skipped").c_str() : "", watch.seconds(),
                     ms, threads, space.c_str());
        if (command.show)
            std::fprintf(stderr, "shown in %s%s\n",
                         shown[std::size_t(dataset.images[0].id) - 1].string().c_str(),
                         count > 1 ? ism::join_text(" and ", count - 1, " more").c_str() : "");
        return;
    }
    // What was found is on standard output alone.
    std::FILE* const summary = asked || taken ? stderr : stdout;
    std::fprintf(summary, "images      %zu\n", count);
    if (skipped > 0) std::fprintf(summary, "skipped     %zu\n", skipped);
    if (command.search.space == auto_space) std::fprintf(summary, "space       %s\n", space.c_str());
    std::fprintf(summary, "detections  %zu\n", all.size());
    std::fflush(summary);
    std::fprintf(stderr, "seconds     %.1f\n", watch.seconds());
    std::fprintf(stderr, "ms/image    %.0f (%u threads)\n", ms, threads);
}

}  // namespace program
