// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// How the time to search a picture and the size of the codebook grow with the number of classes: one joint
// model beside models of their own (a codebook a class, features shared). A class here is one real object of
// the data sets, so classes are many and alike; the judge of boxes, whose cost in detection does not depend
// on the number of classes, is left out.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "support/photographs.hpp"
#include "support/pseudo_classes.hpp"
#include "support/rows.hpp"
#include <CLI/CLI.hpp>

#include "ism/detect/detect.hpp"
#include "ism/detect/train.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/io/color.hpp"
#include "ism/io/svg.hpp"
#include "ism/io/write_file.hpp"

namespace {

namespace fs = std::filesystem;
using ism::HessianLaplace;
using ism::RootSift;
using Model = ism::Model<HessianLaplace, RootSift>;

struct Point {
    std::size_t classes = 0;
    double words[2] = {}, ms[2] = {}, known = 0;  // joint, separate; share of objects found again by joint
};

/// The exponent b of y = a · x^b, fitted to logarithms.
[[nodiscard]] double exponent(const std::vector<Point>& points, std::size_t from, int kind) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const Point& p : points) {
        if (p.classes < from || !(p.ms[kind] > 0)) continue;
        const double x = std::log(double(p.classes)), y = std::log(p.ms[kind]);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

using Detector = ism::FrameDetector<HessianLaplace, RootSift>;

/// The share of some training objects that are found as what and where they are.
[[nodiscard]] double share_known(Detector& detector, const bench::PseudoClasses& classes, std::size_t count) {
    const std::size_t tried = std::min<std::size_t>(count, 32);
    std::size_t right = 0;
    for (std::size_t k = 0; k < tried; ++k) {
        const std::size_t i = k * count / tried;
        const auto found = detector.detect<ism::Jism>(classes.images[i].frame);
        right += std::any_of(found.objects.begin(), found.objects.end(), [&](const ism::Detection& object) {
            return object.class_index == i && ism::iou(object.box, classes.images[i].objects[0].box) > 0.5;
        });
    }
    return double(right) / double(tried);
}

[[nodiscard]] ism::Plot plot_of(const std::vector<Point>& points) {
    ism::Plot plot{.title = "Time to search a picture",
                   .x_label = "classes (logarithm to base 2)",
                   .y_label = "ms (logarithm to base 10)"};
    const char* names[] = {"one joint model", "a model a class"};
    double low = 1e9, high = -1e9;
    for (int kind = 0; kind < 2; ++kind) {
        ism::PlotCurve curve{.name = ism::join_text(names[kind], ": classes to the power ",
                                                    bench::number(exponent(points, 16, kind))),
                             .color = ism::class_color(std::size_t(kind))};
        for (const Point& p : points)
            if (p.ms[kind] > 0) {
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

void measure(const fs::path& data, std::size_t most, std::size_t rounds, unsigned threads,
             const std::string& json, const std::string& svg) {
    std::vector<fs::path> files;
    for (const char* set : {"four-class/train", "msrc/train", "osd/train", "sysu-shapes/train",
                            "weizmann-horses/train", "uiuc-cars/train", "sysu-shapes/val", "msrc/val"})
        files.push_back(data / (std::string(set) + ".json"));
    const ism::Extractor<HessianLaplace, RootSift> extractor;
    const bench::PseudoClasses classes = bench::pseudo_classes(files, most, extractor);
    most = classes.images.size();
    const auto harvest =
        ism::harvest(classes.names, most, [&](std::size_t i) -> const auto& { return classes.images[i]; },
                     extractor, {.max_features = 100 * most});
    std::printf("%zu real objects, each a class, %zu features\n", most, harvest.seen.size());

    const ism::Dataset scenes = ism::read_dataset(data / "osd" / "val.json");
    std::vector<ism::Frame> frames;
    for (std::size_t i = 0; i < 8; ++i) frames.push_back(ism::read_frame(scenes.images.at(i * 5)));

    std::vector<Point> points;
    std::vector<bench::Row> rows;
    for (std::size_t count = 1; count <= most; count *= 2) {
        Point point{.classes = count};
        const auto part = bench::first_classes(harvest, count);
        std::vector<Model> models;
        models.reserve(2);
        std::vector<std::unique_ptr<Detector>> detectors;
        for (const auto kind : {ism::CodebookKind::joint, ism::CodebookKind::per_class}) {
            models.push_back(ism::learn(part, {.codebook = kind, .appearance = false, .threads = threads}));
            point.words[models.size() - 1] = double(models.back().codebook.size());
            detectors.push_back(std::make_unique<Detector>(models.back(), threads));
        }
        std::vector<std::function<void()>> runs;
        for (const auto& detector : detectors)
            runs.push_back([&frames, &detector = *detector, threads] {
                for (const ism::Frame& frame : frames)
                    (void)detector.detect<ism::Jism>(frame, {.threads = threads});
            });
        const std::vector<double> ms = bench::interleaved_ms(runs, rounds);
        for (int kind = 0; kind < 2; ++kind) point.ms[kind] = ms[std::size_t(kind)] / double(frames.size());
        point.known = share_known(*detectors.front(), classes, count);
        points.push_back(point);
        rows.push_back({.name = std::to_string(count) + " classes",
                        .ours = point.ms[0],
                        .peer = point.ms[1],
                        .peer_name = "a model a class",
                        .unit = "ms a picture",
                        .correct = point.known >= 0.9,
                        .remark = bench::number(point.words[0], 0) + " words beside " +
                                  bench::number(point.words[1], 0) + "; training objects found again " +
                                  bench::number(100 * point.known, 0) + " %"});
        std::fprintf(stderr, "%zu classes: %.1f ms, %.1f ms\n", count, point.ms[0], point.ms[1]);
    }
    bench::print(rows);
    const auto at = [&](std::size_t count) {
        for (const Point& p : points)
            if (p.classes == count) return p.ms[0];
        return std::nan("");
    };
    std::printf(
        "joint: time from 4 to 128 classes x %.2f; exponent over 16 ... %zu classes %.2f "
        "(a model a class: %.2f)\n",
        at(128) / at(4), points.back().classes, exponent(points, 16, 0), exponent(points, 16, 1));
    if (!json.empty()) bench::write_json(json, rows);
    if (!svg.empty()) ism::write_file(svg, [&](std::ostream& out) { out << ism::to_svg(plot_of(points)); });
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Time to search a picture, by number of classes"};
    std::string data = bench::data_folder().string(), json, svg = "class_scaling.svg";
    std::size_t most = 1024, rounds = 5;
    unsigned threads = 1;
    app.add_option("--data", data, "folder of the data sets");
    app.add_option("--classes", most, "so many at most")->check(CLI::Range(1, 1024));
    app.add_option("--rounds", rounds, "times each is measured")->check(CLI::Range(1, 1000));
    app.add_option("--threads", threads, "of detection");
    app.add_option("--json", json, "also write the rows to this file");
    app.add_option("--plot", svg, "file of the plot (SVG)");
    CLI11_PARSE(app, argc, argv);
    try {
        measure(data, most, rounds, threads, json, svg);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "class_scaling: %s\n", error.what());
        return 2;
    }
}
