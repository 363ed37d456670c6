// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Frame after frame of an RGB-D camera, as a robot sees them: finds objects, keeps their identities, smooths
// their positions, and tells how long that takes.
//     06_stream MODEL.safetensors FRAMES [THREADS]
// MODEL is of `ism train` with its default features. FRAMES are the images of a COCO file; or a folder with
// NAME-color.png and, where there is depth, NAME-depth.png, and camera.json {"fx", "fy", "cx", "cy",
// "depth_scale"}; or the number of rendered frames of a toy table, of which the truth is known.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "toy/cluttered.hpp"
#include "toy/toys.hpp"
#include "toy_lessons.hpp"
#include <nlohmann/json.hpp>

#include "ism/core/stopwatch.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/detect/exemplar_segmenter.hpp"
#include "ism/detect/frame_matcher.hpp"
#include "ism/detect/metric_recognition.hpp"
#include "ism/detect/template_recognition.hpp"
#include "ism/detect/track.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/model_file/model_file.hpp"

namespace {

/// Frames one after another, and where the toys are, where that is known.
struct Frames {
    std::size_t count = 0;
    std::function<ism::Frame(std::size_t)> read = {};
    std::vector<toy::ToyObject> truth = {};  // of the frame that was read last, always in the same order
};

/// The camera of a folder, and the metres per unit of its depth.
std::pair<ism::Camera, double> read_camera(const std::filesystem::path& file) try {
    ism::expect<ism::FileError>(std::filesystem::exists(file), file.string(), "a file", "none");
    const auto json = nlohmann::json::parse(std::ifstream(file));
    const auto number = [&](const char* key) { return json.at(key).get<double>(); };
    const ism::Camera camera{number("fx"), number("fy"), number("cx"), number("cy")};
    ism::at_place(ism::file_text(file), [&] { ism::check(camera); });
    const double scale = number("depth_scale");
    ism::expect<ism::FileError>(scale > 0, file.string() + ": depth_scale", "metres per unit above 0", scale);
    return {camera, scale};
} catch (const nlohmann::json::exception&) {
    throw ism::FileError(
        ism::file_text(file) +
        ": expected JSON with the numbers fx, fy, cx, cy and depth_scale, got something else");
}

void open_folder(Frames& frames, const std::filesystem::path& folder) {
    const std::string ending = "-color.png";
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (const std::string name = entry.path().filename().string(); name.ends_with(ending))
            names.push_back((folder / name.substr(0, name.size() - ending.size())).string());
    std::sort(names.begin(), names.end());
    ism::expect<ism::FileError>(!names.empty(), folder.string(), "files NAME-color.png", "none");
    const auto settings = read_camera(folder / "camera.json");
    frames.count = names.size();
    frames.read = [names, ending, settings](std::size_t i) {
        ism::DatasetImage image{.id = std::int64_t(i),
                                .file = names[i] + ending,
                                .depth_scale = settings.second,
                                .camera = settings.first};
        const ism::ImageSize size = ism::read_image_size(image.file).shown;
        image.width = size.width, image.height = size.height;
        if (const std::string depth = names[i] + "-depth.png"; std::filesystem::exists(depth))
            image.depth_file = depth;
        return ism::read_frame(image);  // without depth, where that has no reading
    };
}

/// A whole number of the command line.
std::size_t whole_number(const std::string& text, const char* what, std::size_t least, std::size_t most,
                         const char* or_else = "") {
    std::size_t number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = failure == std::errc() && end == text.data() + text.size();
    ism::expect(whole && number >= least && number <= most, what,
                ism::lazy_text(or_else, "a whole number from ", least, " to ", most),
                ism::lazy_text("'", text, "'"));
    return number;
}

void open(Frames& frames, const std::string& what) {
    if (std::filesystem::is_directory(what)) return open_folder(frames, what);
    if (std::filesystem::exists(what)) {
        const std::vector<ism::DatasetImage> images = ism::read_dataset(what).images;
        frames.count = images.size();
        frames.read = [images](std::size_t i) { return ism::read_frame(images[i]); };
        return;
    }
    frames.count = whole_number(what, "FRAMES", 1, 1000000, "a file, a folder, or ");
    frames.read = [&frames](std::size_t i) {
        toy::ToyScene scene = toy::render_cluttered(4, {.first_instance = 100, .frame = i});
        frames.truth = std::move(scene.objects);
        ism::Frame frame = toy::to_frame(scene);
        frame.color = std::move(scene.color);
        return frame;
    };
}

/// Finds objects in metres where a frame has depth, else by its colours alone.
class Eye {
public:
    Eye(const ism::Model& model, unsigned threads)
        : pool_(threads), colors_(model, {of<ism::HessianLaplace>(model)}, pool_), model_(model) {
        metric_.options.min_probability = flat_.options.min_probability = 0.2;
        if (!model.rgbd.empty())
            depth_.emplace(model.rgbd[0], std::vector{of<ism::DifferenceOfGaussians>(model.rgbd[0])}, pool_);
    }

    ism::Detections look(const ism::Frame& frame) {
        if (depth_ && !frame.depth_m.empty() && frame.camera)
            return ism::recognise(depth_->scene(frame, ism::match_in<ism::Metric>()), metric_);
        if (!model_.templates.empty()) return ism::recognise(colors_.scene(frame), flat_);
        return ism::recognise(colors_.scene(frame), ism::Recognition<ism::Jism>{});
    }

private:
    template <ism::Detector D>
    static ism::AnyExtractor of(const ism::Model& model) {
        return ism::extractor_from<D, ism::RootSift>(model.channels.at(0).features);
    }

    ism::ThreadPool pool_;
    ism::FrameMatcher colors_;
    std::optional<ism::FrameMatcher> depth_;
    const ism::Model& model_;
    decltype(ism::metric_recognition()) metric_ = ism::metric_recognition();
    decltype(ism::template_recognition(ism::ExemplarSegmenter{})) flat_ =
        ism::template_recognition(ism::ExemplarSegmenter{});
};

double distance_m(const ism::Point3& a, const ism::Point3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// How far positions are from the truth, and how much that changes from frame to frame.
class Scatter {
public:
    void add(std::uint64_t id, const ism::Point3& at, const ism::Point3& truth) {
        Sum& sum = of_track_[id];
        const double off[] = {at.x - truth.x, at.y - truth.y, at.z - truth.z};
        ++sum.count;
        for (int i = 0; i < 3; ++i) sum.first[i] += off[i], sum.second += off[i] * off[i];
    }
    [[nodiscard]] double mm() const {
        double squares = 0, count = 0;
        for (const auto& [id, sum] : of_track_) {
            squares += sum.second;
            for (const double first : sum.first) squares -= first * first / sum.count;
            count += sum.count;
        }
        return 1000 * std::sqrt(squares / std::max(1.0, count));
    }

private:
    struct Sum {
        double count = 0, first[3] = {}, second = 0;
    };
    std::map<std::uint64_t, Sum> of_track_;
};

double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[std::size_t(share * double(values.size() - 1) + 0.5)];
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 3 || argc > 4) {
        std::fprintf(stderr, "usage: %s MODEL.safetensors FRAMES.json|FOLDER|NUMBER [THREADS]\n", argv[0]);
        return 2;
    }
    const ism::Model model = ism::load_model(argv[1]);
    Frames frames;
    open(frames, argv[2]);
    Eye eye(model, argc > 3 ? unsigned(whole_number(argv[3], "THREADS", 0, ism::max_threads)) : 0);
    ism::Tracker tracker;

    std::vector<double> latency_ms;
    double read_ms = 0;
    ism::DetectionStats sum;
    Scatter raw, smoothed;
    std::map<std::uint64_t, std::size_t> toy_of;  // of the tracks
    for (std::size_t i = 0; i < frames.count; ++i) {
        ism::Stopwatch watch;
        const ism::Frame frame = frames.read(i);
        read_ms += watch.lap_ms();
        const ism::Detections found = eye.look(frame);
        const std::vector<ism::Track> tracks = tracker.update(found.objects);
        latency_ms.push_back(watch.lap_ms());

        for (const auto part : {&ism::DetectionStats::extract_ms, &ism::DetectionStats::match_ms,
                                &ism::DetectionStats::vote_ms, &ism::DetectionStats::rescore_ms,
                                &ism::DetectionStats::segment_ms, &ism::DetectionStats::verify_ms})
            sum.*part += found.stats.*part;
        std::printf("%zu:", i + 1);
        for (const ism::Track& track : tracks) {
            std::printf(" #%u %s %.2f", unsigned(track.id),
                        model.shapes.class_names[track.class_index].c_str(), track.probability);
            if (const auto& p = track.position_m) std::printf(" (%.3f %.3f %.3f)", p->x, p->y, p->z);
            std::printf(track.detection ? ";" : " missed;");
        }
        std::printf("\n");

        for (const ism::Track& track : tracks) {  // against the truth
            if (!track.position_m) continue;
            for (std::size_t t = 0; t < frames.truth.size(); ++t)
                if (frames.truth[t].class_index == track.class_index &&
                    distance_m(*track.position_m, frames.truth[t].position_m) < 0.06)
                    toy_of.emplace(track.id, t);
            if (!toy_of.contains(track.id) || !track.detection) continue;
            const ism::Point3& truth = frames.truth[toy_of[track.id]].position_m;
            raw.add(track.id, *found.objects[*track.detection].position_m, truth);
            smoothed.add(track.id, *track.position_m, truth);
        }
    }

    const double count = double(std::max<std::size_t>(1, frames.count));
    double total_ms = 0;
    for (const double ms : latency_ms) total_ms += ms;
    std::printf("frames    %zu, %.1f a second\n", frames.count, 1000 * count / total_ms);
    std::printf("latency   p50 %.1f ms, p95 %.1f ms\n", quantile(latency_ms, 0.5),
                quantile(latency_ms, 0.95));
    std::printf(
        "stations  features %.1f, matches %.1f, votes %.1f, judging %.1f, cutting out %.1f, "
        "verifying %.1f ms\n",
        sum.extract_ms / count, sum.match_ms / count, sum.vote_ms / count, sum.rescore_ms / count,
        sum.segment_ms / count, sum.verify_ms / count);
    std::printf("reading   %.1f ms a frame, no part of the latency\n", read_ms / count);
    if (frames.truth.empty()) return 0;
    std::vector<std::size_t> toys;
    for (const auto& [id, toy] : toy_of) toys.push_back(toy);
    std::sort(toys.begin(), toys.end());
    const auto followed = std::unique(toys.begin(), toys.end()) - toys.begin();
    std::printf("toys      %zu, followed %td by %zu identities\n", frames.truth.size(), followed,
                toy_of.size());
    std::printf("scatter   of positions %.1f mm, smoothed %.1f mm\n", raw.mm(), smoothed.mm());
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
