// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// How the time to search a picture and the size of the codebook grow with the number of classes, for one
// joint model, for one model with a codebook a class, and for a model a class, each searched by itself (the
// features of a picture found once). Classes are real objects, and rendered toys: many and alike.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/data_sets.hpp"
#include "support/many_classes.hpp"
#include "support/options.hpp"
#include "support/photographs.hpp"
#include "support/program_model.hpp"
#include "support/real_classes.hpp"
#include "support/rows.hpp"
#include "support/toy_classes.hpp"

#include "ism/codebook/match.hpp"
#include "ism/io/write_file.hpp"
#include "ism/show/color.hpp"
#include "ism/show/svg.hpp"

namespace {

namespace fs = std::filesystem;

struct Settings {
    fs::path data;
    std::size_t most = 1024, rounds = 5;
    unsigned threads = 1;
    bool judge = false;
};

constexpr std::array kinds = {"one joint model", "a codebook a class", "a model a class"};

struct Point {
    std::size_t classes = 0;
    std::array<std::size_t, kinds.size()> words = {};
    std::array<double, kinds.size()> ms = {};
    double learnt_s = 0;    // the joint model, without finding features
    std::size_t shown = 0;  // objects of known classes in the pictures to check
    std::array<std::size_t, kinds.size() - 1> found = {};  // of these by the models of all classes
};

/// The exponent b of y = a · x^b, fitted to logarithms, from 16 classes on.
[[nodiscard]] double exponent(const std::vector<Point>& points, std::size_t kind) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const Point& p : points) {
        if (p.classes < 16) continue;
        const double x = std::log(double(p.classes)), y = std::log(p.ms[kind]);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// A model for each class, which are searched one after another.
class ModelsApart {
public:
    ModelsApart(const ism::TrainingFeatures& features, std::size_t classes, const ism::TrainOptions& options)
        : pool_(options.threads), extract_(program::make_extractor(features.settings.front()).start(pool_)) {
        for (std::uint32_t c = 0; c < classes; ++c) {
            models_.push_back(program::learn(bench::classes_of(features, c, c + 1), options));
            words_.emplace_back(models_.back().channels.front().codebook);
        }
    }

    [[nodiscard]] std::size_t words() const {
        std::size_t sum = 0;
        for (const auto& words : words_) sum += words.size();
        return sum;
    }

    /// How many objects are found in a picture.
    std::size_t search(const ism::Frame& frame) {
        const ism::FeatureSet<float>& found = extract_(frame);
        std::size_t objects = 0;
        for (std::size_t c = 0; c < words_.size(); ++c) {
            ism::Scene scene{.frame = frame,
                             .model = models_[c],
                             .pool = pool_,
                             .features = found.features,
                             .matches = ism::match(words_[c], found.descriptors, pool_)};
            objects += program::find_objects(std::move(scene), bench::votes_in("jism")).objects.size();
        }
        return objects;
    }

private:
    ism::ThreadPool pool_;
    ism::ExtractFeatures extract_;
    std::vector<ism::Model> models_;
    std::vector<ism::WordIndex> words_;
};

/// How many objects of the first `classes` classes are in the pictures, and how many of these are found as
/// what and where they are.
[[nodiscard]] std::pair<std::size_t, std::size_t> shown_and_found(
    program::Matcher& matcher, std::size_t classes, const std::vector<ism::TrainingImage>& pictures) {
    std::size_t shown = 0, right = 0;
    for (const ism::TrainingImage& picture : pictures) {
        const auto found = matcher.find(picture.frame, bench::votes_in("jism"));
        for (const ism::LabelledObject& object : picture.objects) {
            if (object.class_index >= classes) continue;
            ++shown;
            right +=
                std::any_of(found.objects.begin(), found.objects.end(), [&](const ism::Detection& detection) {
                    return detection.class_index == object.class_index &&
                           ism::iou(detection.box, object.box) > 0.5;
                });
        }
    }
    return {shown, right};
}

[[nodiscard]] Point measure(const bench::ManyClasses& classes, const ism::TrainingFeatures& features,
                            std::size_t count, const Settings& settings) {
    Point point{.classes = count};
    const ism::TrainingFeatures part = bench::classes_of(features, 0, std::uint32_t(count));
    const ism::TrainOptions votes_alone{.codebook = {.max_features = part.feature_count() + 2},
                                        .box_classifier = std::nullopt,
                                        .calibrate = false,
                                        .threads = settings.threads};
    ism::TrainOptions options = votes_alone;
    if (settings.judge) options.box_classifier.emplace();
    const auto begin = std::chrono::steady_clock::now();
    const ism::Model joint = program::learn(part, options);
    point.learnt_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ModelsApart apart(features, count, votes_alone);
    options.codebook.kind = ism::CodebookKind::per_class;
    const ism::Model per_class = program::learn(part, options);
    point.words = {joint.words(), per_class.words(), apart.words()};

    ism::ThreadPool pool(settings.threads);
    program::Matcher joint_matcher(joint, pool), per_class_matcher(per_class, pool);
    const auto each = [&](const auto& search) {
        for (const ism::Frame& frame : classes.frames) search(frame);
    };
    const std::vector<std::function<void()>> runs = {
        [&] { each([&](const auto& frame) { (void)joint_matcher.find(frame, bench::votes_in("jism")); }); },
        [&] {
            each([&](const auto& frame) { (void)per_class_matcher.find(frame, bench::votes_in("jism")); });
        },
        [&] { each([&](const auto& frame) { (void)apart.search(frame); }); }};
    const std::vector<double> ms = bench::interleaved_ms(runs, settings.rounds);
    for (std::size_t k = 0; k < kinds.size(); ++k) point.ms[k] = ms[k] / double(classes.frames.size());
    std::tie(point.shown, point.found[0]) = shown_and_found(joint_matcher, count, classes.checks);
    std::tie(point.shown, point.found[1]) = shown_and_found(per_class_matcher, count, classes.checks);
    return point;
}

[[nodiscard]] ism::Plot plot_of(const std::vector<Point>& points, const std::string& what) {
    ism::Plot plot{.title = what,
                   .x_label = "classes (logarithm to base 2)",
                   .y_label = "ms a picture (logarithm to base 10)"};
    double low = 1e9, high = -1e9;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        ism::PlotCurve curve{.name = kinds[kind], .color = ism::class_color(kind)};
        if (points.back().classes >= 32)
            curve.name += ": classes to the power " + bench::number(exponent(points, kind));
        for (const Point& p : points) {
            curve.x.push_back(std::log2(double(p.classes)));
            curve.y.push_back(std::log10(p.ms[kind]));
            low = std::min(low, curve.y.back()), high = std::max(high, curve.y.back());
        }
        plot.curves.push_back(std::move(curve));
    }
    plot.x_range = {0, std::max(1.0, std::log2(double(points.back().classes)))};
    plot.y_range = {std::floor(low), std::ceil(high + 1e-6)};
    return plot;
}

/// Measures, prints a table, draws a plot.
void scale(const bench::ManyClasses& classes, const Settings& settings, const fs::path& svg,
           std::vector<bench::Row>& rows) {
    const std::size_t most = classes.names.size();
    const ism::TrainingFeatures features = program::extract_training_features(
        classes.names, ism::training_set(classes.images),
        {program::make_extractor(program::default_detector, program::default_descriptor)},
        {.features = {.max_features = 100 * classes.images.size(), .views = settings.judge}});
    std::printf("%s: %zu classes, %zu features\n", classes.what.c_str(), most, features.feature_count());
    std::vector<std::vector<std::string>> table = {{"classes", "joint learnt s", "ms", "words", "found",
                                                    "codebook a class ms", "words", "found",
                                                    "model a class ms", "words"}};
    std::vector<Point> points;
    for (std::size_t count = 1; count <= most; count *= 2) {
        const Point p = measure(classes, features, count, settings);
        table.push_back({std::to_string(count), bench::number(p.learnt_s, 1)});
        for (std::size_t k = 0; k < kinds.size(); ++k) {
            table.back().push_back(bench::number(p.ms[k], 1));
            table.back().push_back(std::to_string(p.words[k]));
            if (k < p.found.size()) table.back().push_back(ism::join_text(p.found[k], " of ", p.shown));
        }
        for (std::size_t k = 1; k < kinds.size(); ++k)
            rows.push_back({.name = ism::join_text(count, " classes, ", classes.what),
                            .ours = p.ms[0],
                            .peer = p.ms[k],
                            .peer_name = kinds[k],
                            .unit = "ms a picture",
                            .correct = p.found[0] > 0 || p.shown == 0,
                            .remark = ism::join_text(p.words[0], " words beside ", p.words[k], ", ",
                                                     p.found[0], " of ", p.shown, " objects found")});
        std::fprintf(stderr, "%zu classes: %.1f ms, %.1f ms, %.1f ms\n", count, p.ms[0], p.ms[1], p.ms[2]);
        points.push_back(p);
    }
    std::fputs(ism::align_columns(table).c_str(), stdout);
    const auto at = [&](std::size_t count) {
        for (const Point& p : points)
            if (p.classes == count) return p.ms[0];
        return std::nan("");
    };
    if (most >= 128)
        std::printf(
            "joint: time from 4 to 128 classes x %.2f; exponent over 16 ... %zu classes %.2f "
            "(a codebook a class %.2f, a model a class %.2f)\n\n",
            at(128) / at(4), points.back().classes, exponent(points, 0), exponent(points, 1),
            exponent(points, 2));
    ism::write_file(svg, [&](std::ostream& out) { out << ism::to_svg(plot_of(points, classes.what)); });
}

}  // namespace

int main(int argc, char** argv) {
    bench::Options command_line("Time to search a picture, by number of classes");
    Settings settings{.data = bench::data_folder()};
    std::string json, svg = ".", from = "both";
    command_line.add("--data", settings.data, "folder of the data sets");
    command_line.add("--from", from, "what classes are made from", {"real", "toys", "both"});
    command_line.add("--classes", settings.most, "so many at most", {1, 4096});
    command_line.add("--rounds", settings.rounds, "times each is measured", {1, 1000});
    command_line.add("--threads", settings.threads, "of learning and detection");
    command_line.add("--judge", settings.judge,
                     "the two models of all classes also learn their judge of boxes");
    command_line.add("--json", json, "also write the rows to this file");
    command_line.add("--plots", svg, "folder of the plots class_scaling_real.svg and class_scaling_toys.svg");
    if (const auto code = command_line.parse(argc, argv)) return *code;
    try {
        std::vector<bench::Row> rows;
        if (from != "toys")
            scale(bench::real_classes(settings.data, settings.most), settings,
                  fs::path(svg) / "class_scaling_real.svg", rows);
        if (from != "real")
            scale(bench::toy_classes(settings.most), settings, fs::path(svg) / "class_scaling_toys.svg",
                  rows);
        if (!json.empty()) bench::write_json(json, rows);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "class_scaling: %s\n", error.what());
        return 2;
    }
}
