// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Detection from few examples: mean AP on a set's val.json (IoU .5) and time an image on one thread, learnt
// from so many images a class of its train.json, the same for each way, as a mean of several draws. Ours with
// templates, as the program does by default; with votes and words (`ism train --no-templates`); with votes
// alone; and dlib's gradient histograms, a detector a class, where it is installed.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/data_sets.hpp"
#include "support/dlib_detector.hpp"
#include "support/program_model.hpp"
#include "support/rows.hpp"
#include "support/set_options.hpp"

#include "ism/core/random.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/evaluate/detections.hpp"

namespace {

namespace fs = std::filesystem;

/// A way to detect.
struct Way {
    std::string name;
    std::function<std::vector<ism::FoundObject>(const ism::Frame&, std::size_t image)> detect;
    double train_s = 0;
    double detect_s = 0;
    std::vector<ism::FoundObject> found = {};
};

/// The figures of a way, added up over draws.
struct Sum {
    double ap = 0, train_s = 0, detect_ms = 0;
    std::string aps = {};  ///< of each draw
};

[[nodiscard]] double seconds_of(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// So many images of each class, all where there are fewer; more of the same draw have the fewer among them.
[[nodiscard]] ism::Dataset drawn(const ism::Dataset& all, std::size_t count, std::uint64_t draw) {
    std::set<std::size_t> chosen;
    for (std::uint32_t c = 0; c < all.class_names.size(); ++c) {
        std::vector<std::size_t> with_class;
        for (std::size_t i = 0; i < all.images.size(); ++i) {
            const auto& objects = all.images[i].objects;
            if (std::any_of(objects.begin(), objects.end(),
                            [&](const auto& object) { return object.class_index == c && !object.crowd; }))
                with_class.push_back(i);
        }
        ism::Random random(draw * 100 + c + 1);
        for (std::size_t i = 0; i < std::min(count, with_class.size()); ++i) {
            std::swap(with_class[i], with_class[i + random.index(with_class.size() - i)]);
            chosen.insert(with_class[i]);
        }
    }
    ism::Dataset part{.source = all.source, .class_names = all.class_names, .category_ids = all.category_ids};
    for (const std::size_t i : chosen) part.images.push_back(all.images[i]);
    return part;
}

[[nodiscard]] double mean_ap(const ism::Dataset& set, const std::vector<ism::FoundObject>& found) {
    std::vector<ism::TruthObject> truth;
    for (std::size_t i = 0; i < set.images.size(); ++i)
        for (const ism::DatasetAnnotation& object : set.images[i].objects)
            truth.push_back({i, object.class_index, object.box, object.crowd});
    return ism::evaluate(truth, found, set.images.size(), set.class_names, ism::IouRule{}).mean.ap;
}

/// Learns each way from the same images, and lets them search the same pictures in turn.
[[nodiscard]] std::vector<Way> measured(const ism::Dataset& train, const ism::Dataset& val, unsigned threads,
                                        [[maybe_unused]] const bench::DlibOptions& dlib_options) {
    ism::Model model;
    const double train_s = seconds_of([&] { model = bench::learn_as_program(train, threads); });
    ism::ThreadPool one(1);
    program::Matcher matcher(model, one);
    const auto find_by = [&](const program::SearchOptions& search) {
        return [&matcher, search](const ism::Frame& frame, std::size_t image) {
            return ism::found_objects(matcher.find(frame, search).objects, image);
        };
    };
    std::vector<Way> ways = {{"templates", find_by(bench::all_by_templates()), train_s},
                             {"votes and words", find_by(bench::votes_in("jism"))},
                             {"votes alone", find_by(bench::votes_in("jism", "none"))}};
#if defined(ISM_HAVE_DLIB)
    std::vector<ism::TrainingImage> images;
    for (const ism::DatasetImage& image : train.images) images.push_back(ism::read_training_image(image));
    std::deque<bench::DlibDetector> detectors;
    for (const bool mirror : {false, true}) {
        bench::DlibOptions options = dlib_options;
        options.mirror = mirror;
        const double dlib_s =
            seconds_of([&] { detectors.emplace_back(images, train.class_names.size(), options); });
        ways.push_back({mirror ? "dlib, images also mirrored" : "dlib",
                        [&detector = detectors.back()](const ism::Frame& frame, std::size_t i) {
                            return detector.detect(frame, i);
                        },
                        dlib_s});
    }
#endif
    for (std::size_t i = 0; i < val.images.size(); ++i) {
        const ism::Frame frame = ism::read_frame(val.images[i]);
        for (Way& way : ways)
            way.detect_s += seconds_of([&] {
                for (const ism::FoundObject& found : way.detect(frame, i)) way.found.push_back(found);
            });
    }
    for (Way& way : ways) way.detect = {};
    return ways;
}

}  // namespace

int main(int argc, char** argv) try {
    bench::SetOptions options{.sets = {"sysu-shapes", "weizmann-horses"}};
    fs::path csv;
    std::vector<std::size_t> counts = {5, 10, 20, 50};
    std::uint64_t draws = 5;
    bench::DlibOptions dlib_options;
    bench::Options command_line(
        "Detection from few examples: templates, votes, and dlib's gradient histograms. One thread searches; "
        "--threads is of learning.");
    options.add_to(command_line);
    command_line.add("--counts", counts, "training images a class");
    command_line.add("--draws", draws, "of training images");
    command_line.add("--dlib-cost", dlib_options.cost, "C of dlib's detectors");
    command_line.add("--dlib-epsilon", dlib_options.epsilon, "where dlib's solver ends");
    command_line.add("--csv", csv, "file of the figures of each draw");
    if (const auto code = command_line.parse(argc, argv)) return *code;
    dlib_options.threads = ism::thread_count(options.threads);

    std::string lines = "set,images a class,draw,way,mean AP,training s,ms an image\n";
    std::vector<std::vector<std::string>> cells = {
        {"set", "images a class", "way", "mean AP %", "draws", "training s", "ms/image"}};
    for (const std::string& set : options.sets) {
        const ism::Dataset train = bench::read_set(options.data / set / "train.json"),
                           val = bench::held_out(options.data / set, train.class_names);
        for (const std::size_t count : counts) {
            std::vector<std::pair<std::string, Sum>> sums;
            for (std::uint64_t draw = 1; draw <= draws; ++draw) {
                const auto ways = measured(drawn(train, count, draw), val, options.threads, dlib_options);
                sums.resize(ways.size());
                for (std::size_t w = 0; w < ways.size(); ++w) {
                    const double ap = mean_ap(val, ways[w].found),
                                 ms = 1000 * ways[w].detect_s / double(val.images.size());
                    auto& [name, sum] = sums[w];
                    name = ways[w].name;
                    sum.ap += ap / double(draws), sum.train_s += ways[w].train_s / double(draws);
                    sum.detect_ms += ms / double(draws);
                    sum.aps += (sum.aps.empty() ? "" : " ") + bench::number(100 * ap, 1);
                    const std::string line = set + ism::join_text(",", count, ",", draw, ",") + name + "," +
                                             bench::number(ap, 4) + "," + bench::number(ways[w].train_s, 1) +
                                             "," + bench::number(ms, 1) + "\n";
                    std::fputs(line.c_str(), stderr);
                    lines += line;
                }
            }
            for (const auto& [name, sum] : sums)
                cells.push_back({set, std::to_string(count), name, bench::number(100 * sum.ap, 1), sum.aps,
                                 sum.train_s > 0 ? bench::number(sum.train_s, 1) : "as above",
                                 bench::number(sum.detect_ms, 0)});
        }
    }
    std::fputs(ism::align_columns(cells).c_str(), stdout);
    if (!csv.empty()) ism::write_file(csv, lines);
} catch (const std::exception& error) {
    std::fprintf(stderr, "peers_detection: %s\n", error.what());
    return 2;
}
