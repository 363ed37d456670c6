// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <map>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "detect_input.hpp"
#include "detect_page.hpp"
#include "input.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "spaces.hpp"
#include "tell.hpp"
#include <unistd.h>

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/show/overlay.hpp"

namespace program {

namespace fs = std::filesystem;

namespace {

/// Detections of an image that a report explains, with four pictures each.
constexpr std::size_t report_rows = 2;

/// Whether --space auto can choose metric: the model knows it, and nothing is asked for that is not of it.
bool metric_allowed(const ism::Model& model, const SearchOptions& search) {
    return !model.rgbd.empty() && search.rescorer == "auto" && search.verifier == "auto" &&
           search.segmenter == "auto" && search.turns == 1;
}

/// The space in which a frame is searched.
std::string_view space_of(const ism::Frame& frame, std::string_view space, bool may_be_metric) {
    if (space != auto_space) return space;
    return may_be_metric && !frame.depth_m.empty() && frame.camera ? metric_space : "jism";
}

std::string count_text(std::size_t count, const char* what) {
    return ism::join_text(count, " ", what, count == 1 ? "" : "s");
}

/// What a frame lacks for the space metric; empty where nothing.
std::string lack_of(const ism::Frame& frame, const ism::DatasetImage& image) {
    const std::string depth = !frame.depth_m.empty()     ? ""
                              : image.depth_file.empty() ? "depth"
                                                         : "a reading of depth";
    if (frame.camera) return depth;
    return depth.empty() ? "a camera" : depth + " and a camera";
}

/// What --space auto came to.
/// @param lacks  how many images lack what, among them "" for nothing
std::string spaces_text(std::map<std::string, std::size_t> lacks, bool may_be_metric) {
    if (!may_be_metric) return "jism";
    const bool in_metres = lacks.erase("") > 0;
    if (lacks.empty()) return "metric";
    std::vector<std::string> wants, images;
    for (const auto& [lack, count] : lacks) {
        wants.push_back(lack);
        images.push_back(count_text(count, "image") + " without " + lack);
    }
    return in_metres ? "metric; jism for " + list_text(images)
                     : "jism, for want of " + list_text(wants) + ": no positions, and less is found";
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
    if (command.report.empty()) return;
    check_page(command.report, inputs, command.page);
    if (!command.page.link) return;
    const fs::path pictures = (pictures_folder(command.report) / "").lexically_normal();
    for (const fs::path& folder :
         {command.overlay_folder, command.results.parent_path(), command.json.parent_path()})
        ism::expect(folder.empty() || (folder / "").lexically_normal() != pictures, "--report-images link",
                    "other outputs elsewhere than with the pictures of the page", "some there");
}

void write_output(const fs::path& file, std::string_view text) {
    if (file == "-")
        std::fwrite(text.data(), 1, text.size(), stdout);
    else
        ism::write_file(file, text);
}

/// Whether what was found is told: always of pictures, of a data set where no file keeps it.
bool is_told(const DetectCommand& command) {
    return !command.images.empty() || (command.results.empty() && command.json.empty() &&
                                       command.report.empty() && command.overlay_folder.empty());
}

/// Whether standard output is that of an option.
bool is_taken(const DetectCommand& command) {
    return is_standard_output(command.results) || is_standard_output(command.json);
}

using Line = std::string (*)(const FoundInImage&);

/// What standard output says of an image as soon as it has been searched; nullptr where that waits for all.
Line line_at_once(const DetectCommand& command) {
    if (command.json == "-") return json_line;
    return is_told(command) && !is_taken(command) && isatty(STDOUT_FILENO) == 0 ? object_lines : nullptr;
}

/// Texts on standard output, each as soon as it and all before it are there. From several threads.
class InOrder {
public:
    void add(std::size_t i, std::string text) {
        const std::lock_guard lock(mutex_);
        waiting_.emplace(i, std::move(text));
        for (; !waiting_.empty() && waiting_.begin()->first == next_; ++next_) {
            const std::string first = std::move(waiting_.extract(waiting_.begin()).mapped());
            std::fwrite(first.data(), 1, first.size(), stdout);
        }
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            throw ism::FileError("standard output: expected to write it whole, got a failure");
    }

private:
    std::mutex mutex_;
    std::map<std::size_t, std::string> waiting_;
    std::size_t next_ = 0;
};

/// The most probable of what was left out, as a result without a mask.
std::optional<ism::Result> next_best(ism::Detection best, const ism::DatasetImage& image,
                                     const ism::ShapeModel& shapes) {
    best.segmentation = {};
    std::vector<ism::Result> results = ism::to_results({.objects = {best}}, image, shapes);
    if (results.empty()) return {};
    results[0].segmentation.reset();
    return std::move(results[0]);
}

/// Pictures of what was found that are written beside the images, or in a folder.
struct Overlays {
    std::vector<fs::path> beside = {};  ///< of each image of the command line
    ism::Font font = {};
    std::optional<OverlayFiles> folder = {};
};

void add_overlays(Overlays& overlays, const DetectCommand& command, const DetectInput& input) {
    if (!command.overlay_folder.empty()) {
        overlays.folder.emplace(command.overlay_folder, input.dataset);
        make_folder(command.overlay_folder);
    }
    if (command.show || overlays.folder) overlays.font = overlay_font(input.model.shapes.class_names);
}

void write_overlays(const Overlays& overlays, const DetectInput& input, std::size_t i,
                    const ism::RgbImage& color, const ism::Detections& found) {
    const auto& names = input.model.shapes.class_names;
    if (overlays.folder) overlays.folder->write(i, color, found, names, overlays.font);
    if (!overlays.beside.empty())
        ism::write_png(overlays.beside[std::size_t(input.dataset.images[i].id) - 1],
                       ism::draw_detections(color, found, names, {.font = &overlays.font}));
}

/// A model made ready to search frames. Several images are shared out among the threads; on a single one all
/// threads work together.
class Searcher {
public:
    Searcher(const ism::Model& model, const DetectCommand& command, std::size_t images)
        : pool(images > 1 ? command.threads : 1),
          search_(command.search),
          may_be_metric_(metric_allowed(model, search_)) {
        for (unsigned worker = 0; worker < pool.size(); ++worker) {
            ism::ThreadPool& own = inner_pools_.emplace_back(images > 1 ? 1 : command.threads);
            matchers_.emplace_back(model, own);
            for (const ism::Model& rgbd : model.rgbd) rgbd_matchers_.emplace_back(rgbd, own);
        }
    }

    [[nodiscard]] bool searches_in_metres(const ism::Frame& frame) const {
        return space_of(frame, search_.space, may_be_metric_) == metric_space;
    }

    [[nodiscard]] ism::Detections find(const ism::Frame& frame, unsigned worker, bool explain) {
        SearchOptions search = search_;
        search.explain = explain;
        search.space = space_of(frame, search.space, may_be_metric_);
        return (search.space == metric_space ? rgbd_matchers_ : matchers_)[worker].find(frame, search);
    }

    ism::ThreadPool pool;

private:
    const SearchOptions& search_;
    bool may_be_metric_;
    std::deque<ism::ThreadPool> inner_pools_;  // one a worker
    std::deque<Matcher> matchers_, rgbd_matchers_;
};

/// What came of a run.
struct Outcome {
    std::vector<FoundInImage> found;  ///< in each image
    std::string space;                ///< in which was searched
    double search_seconds = 0;
    std::vector<std::uint8_t> lost;  ///< of each image: it could not be read any more
    [[nodiscard]] std::size_t objects() const {
        return std::accumulate(
            found.begin(), found.end(), std::size_t(0),
            [](std::size_t sum, const FoundInImage& image) { return sum + image.results.size(); });
    }
};

/// The i-th image; none, which is told, where it is gone since it was checked and may be left out.
std::shared_ptr<const ism::Frame> frame_if_there(const DetectInput& input, std::size_t i, bool skip_bad) {
    if (!skip_bad) return frame_of(input, i);
    try {
        return frame_of(input, i);
    } catch (const ism::FileError& error) {
        std::fprintf(stderr, "ism: skipped: %s\n", error.what());
        return nullptr;
    }
}

/// Leaves out the images that were lost on the way.
void leave_out_lost(DetectInput& input, Outcome& outcome) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < outcome.lost.size(); ++i) {
        if (outcome.lost[i] != 0) continue;
        if (kept < i) {
            input.dataset.images[kept] = std::move(input.dataset.images[i]);
            input.names[kept] = std::move(input.names[i]);
            outcome.found[kept] = std::move(outcome.found[i]);
        }
        ++kept;
    }
    input.skipped += outcome.lost.size() - kept;
    input.dataset.images.resize(kept), input.names.resize(kept), outcome.found.resize(kept);
    ism::expect<ism::FileError>(kept > 0, "images", "1 or more that can be read", "none any more");
}

/// Searches all images, draws what is found, and tells of each what is told at once.
Outcome search_images(Searcher& searcher, const DetectCommand& command, const DetectInput& input,
                      const Overlays& overlays) {
    const ism::ShapeModel& shapes = input.model.shapes;
    const std::size_t count = input.dataset.images.size();
    const Line line = line_at_once(command);
    const bool lines_shown = line != nullptr && isatty(STDOUT_FILENO) != 0;  // and tell how far it is
    Outcome outcome{.found = std::vector<FoundInImage>(count),
                    .space = command.search.space,
                    .lost = std::vector<std::uint8_t>(count, 0)};
    std::mutex lacks_used;
    std::map<std::string, std::size_t> lacks;
    InOrder told;
    ProgressLine progress;
    searcher.pool.for_each(count, [&](std::size_t i, unsigned worker) {
        const ism::DatasetImage& image = input.dataset.images[i];
        const auto frame = frame_if_there(input, i, command.skip_bad);
        if (!frame) {
            outcome.lost[i] = 1;
            if (line != nullptr) told.add(i, "");
            if (!lines_shown) progress.step("detecting", count);
            return;
        }
        {
            const std::lock_guard lock(lacks_used);
            ++lacks[lack_of(*frame, image)];
        }
        ism::Detections found = searcher.find(*frame, worker, overlays.folder.has_value());
        FoundInImage& here = outcome.found[i];
        here = {.name = input.names[i],
                .width = image.width,
                .height = image.height,
                .results = ism::to_results(found, image, shapes)};
        if (command.images.empty()) here.image_id = image.id;
        if (here.results.empty() && found.next_best) {
            here.best_is_cut_out = !found.next_best->segmentation.figure.empty();
            here.next_best = next_best(std::move(*found.next_best), image, shapes);
        }
        write_overlays(overlays, input, i, frame->color, found);
        if (line != nullptr) told.add(i, line(here));
        if (!lines_shown) progress.step("detecting", count);
    });
    if (command.search.space == auto_space)
        outcome.space = spaces_text(std::move(lacks), metric_allowed(input.model, command.search));
    return outcome;
}

/// Writes the page; the images that it shows are looked at once more, to be explained.
void write_report(Searcher& searcher, const DetectCommand& command, const DetectInput& input,
                  const Outcome& outcome) {
    std::vector<std::vector<ism::Result>> results;
    for (const FoundInImage& image : outcome.found) results.push_back(image.results);
    DetectPage page(input.dataset, results, input.model.shapes.class_names, input.names, command.report_most);
    searcher.pool.for_each(page.images().size(), [&](std::size_t k, unsigned worker) {
        const std::size_t i = page.images()[k];
        const auto frame = frame_if_there(input, i, command.skip_bad);
        if (!frame) {  // it is there no more: all grey
            const FoundInImage& image = outcome.found[i];
            return page.add(k, ism::RgbImage(image.width, image.height, {128, 128, 128}), {}, report_rows,
                            command.page);
        }
        page.add(k, frame->color, searcher.find(*frame, worker, true), report_rows, command.page,
                 input.model.rgbd.empty() ? std::span<const ism::TrainingObject>()
                                          : input.model.rgbd[0].shapes.objects);
    });
    write_page(command.report,
               page.report("Detections", {{"model", command.model.filename().string()},
                                          {"vote space", outcome.space},
                                          {"images", std::to_string(outcome.found.size())},
                                          {"detections", std::to_string(outcome.objects())}}),
               command.page);
}

/// Writes what waits for all images.
void write_outcome(const DetectCommand& command, const Outcome& outcome) {
    if (!command.results.empty()) {
        std::vector<ism::Result> all;
        for (const FoundInImage& image : outcome.found)
            all.insert(all.end(), image.results.begin(), image.results.end());
        write_output(command.results, ism::results_text(all, ism::file_text(command.results)));
    }
    if (!command.json.empty() && command.json != "-") {
        std::string json;
        for (const FoundInImage& image : outcome.found) json += json_line(image);
        write_output(command.json, json);
    }
    if (is_told(command) && !is_taken(command) && line_at_once(command) == nullptr)
        std::fputs(object_table(outcome.found).c_str(), stdout);
    std::fflush(stdout);
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

/// The class of what is found where all depth is some times as far; empty where nothing probable is.
std::string class_at(double factor, Searcher& searcher, ism::Frame frame, const ism::ShapeModel& shapes) {
    for (float& depth_m : frame.depth_m.pixels()) depth_m = float(factor * double(depth_m));
    for (const ism::Detection& object : searcher.find(frame, 0, false).objects)
        if (object.probability >= 0.5) return shapes.class_names[object.class_index];
    return {};
}

/// Where nothing at all was found in metres: whether a depth scale of ten times or a tenth finds something in
/// the first images.
void tell_other_scale(Searcher& searcher, const DetectCommand& command, const DetectInput& input,
                      const Outcome& outcome) {
    if (outcome.objects() > 0) return;
    std::size_t left = 3;
    for (std::size_t i = 0; i < outcome.found.size() && left > 0; ++i) {
        const auto frame = frame_if_there(input, i, command.skip_bad);
        if (!frame || !searcher.searches_in_metres(*frame)) continue;
        --left;
        for (const double factor : {0.1, 10.0}) {
            const std::string name = class_at(factor, searcher, *frame, input.model.shapes);
            if (name.empty()) continue;
            const double scale = input.dataset.images[i].depth_scale;
            const std::string text = ism::join_text(ism::one_line(outcome.found[i].name), ": by depth scale ",
                                                    scale, " nothing is found, by ", factor * scale,
                                                    " there would be: ", ism::one_line(name));
            std::fprintf(stderr, "ism: note: %s\n", text.c_str());
            return;
        }
    }
}

/// How many, how fast, and where, of pictures.
void sum_up_pictures(const DetectCommand& command, const DetectInput& input, const Outcome& outcome,
                     const Overlays& overlays, double seconds) {
    const std::size_t count = outcome.found.size();
    std::fprintf(stderr, "%s in %s%s, %.1f s, %.0f ms an image (%u threads); space %s\n",
                 count_text(outcome.objects(), "object").c_str(), count_text(count, "image").c_str(),
                 input.skipped > 0 ? ism::join_text(", ", input.skipped, " skipped").c_str() : "", seconds,
                 1000 * outcome.search_seconds / double(count), ism::thread_count(command.threads),
                 outcome.space.c_str());
    if (command.show)
        std::fprintf(stderr, "shown in %s%s\n",
                     overlays.beside[std::size_t(input.dataset.images[0].id) - 1].string().c_str(),
                     count > 1 ? ism::join_text(" and ", count - 1, " more").c_str() : "");
}

/// The same of a data set; on standard output, where that does not hold what was found.
void sum_up_data(const DetectCommand& command, const DetectInput& input, const Outcome& outcome,
                 double seconds) {
    const std::size_t count = outcome.found.size();
    std::FILE* const summary = is_told(command) || is_taken(command) ? stderr : stdout;
    std::fprintf(summary, "images      %zu\n", count);
    if (input.skipped > 0) std::fprintf(summary, "skipped     %zu\n", input.skipped);
    if (command.search.space == auto_space) std::fprintf(summary, "space       %s\n", outcome.space.c_str());
    std::fprintf(summary, "detections  %zu\n", outcome.objects());
    std::fflush(summary);
    std::fprintf(stderr, "seconds     %.1f\n", seconds);
    std::fprintf(stderr, "ms/image    %.0f (%u threads)\n", 1000 * outcome.search_seconds / double(count),
                 ism::thread_count(command.threads));
}

}  // namespace

void run_detect(const DetectCommand& command) {
    const Stopwatch watch;
    ImageList list(command.images);
    ism::expect(command.depth.empty() || list.images().size() == 1, "--depth", "one image",
                list.images().size());
    ism::expect(command.search.turns == 1 || command.search.space != metric_space, "--turns",
                "1 in the space metric, which finds what is turned", command.search.turns);
    check_outputs(command, list);
    Overlays overlays;
    if (command.show) overlays.beside = overlay_files(list.images());
    DetectInput input = read_detect_input(command, list);
    if (input.only) list.drop_temporary();
    check_not_labels(input.dataset, std::array{command.results, command.json, command.report});
    add_overlays(overlays, command, input);

    const Stopwatch search_watch;
    Searcher searcher(input.model, command, input.dataset.images.size());
    Outcome outcome = search_images(searcher, command, input, overlays);
    outcome.search_seconds = search_watch.seconds();
    leave_out_lost(input, outcome);

    write_outcome(command, outcome);
    if (!command.report.empty()) write_report(searcher, command, input, outcome);
    if (is_told(command)) tell_nothing_found(outcome.found);
    tell_other_scale(searcher, command, input, outcome);
    if (command.images.empty())
        sum_up_data(command, input, outcome, watch.seconds());
    else
        sum_up_pictures(command, input, outcome, overlays, watch.seconds());
}

}  // namespace program
