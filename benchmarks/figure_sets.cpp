// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Sets of images that scripts/figures measures on, made from those of the data folder; --help tells of which
// kinds.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "ism/core/random.hpp"
#include "ism/core/resize_area.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/coco_write.hpp"
#include "ism/dataset/rle.hpp"
#include "ism/io/images.hpp"
#include "ism/io/png.hpp"

namespace {

namespace fs = std::filesystem;

[[nodiscard]] ism::Dataset with_background(ism::Dataset set, const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::int64_t id = 0;
    for (const ism::DatasetImage& image : set.images) id = std::max(id, image.id);
    for (const fs::path& file : files) {
        const ism::RgbImage picture = ism::read_rgb(file);
        set.images.push_back(
            {.id = ++id, .file = file, .width = picture.width(), .height = picture.height()});
    }
    return set;
}

[[nodiscard]] ism::RgbImage resized(const ism::RgbImage& before, int width, int height) {
    std::vector<float> colors;
    for (const ism::Rgb c : before.pixels())
        colors.insert(colors.end(), {float(c.r), float(c.g), float(c.b)});
    ism::RgbImage after(width, height);
    const auto numbers = ism::resize_area<3>(colors, before.width(), before.height(), width, height);
    const auto byte = [&](std::size_t i) {
        return std::uint8_t(std::lround(std::clamp(numbers[i], 0.f, 255.f)));
    };
    for (std::size_t i = 0; i < after.pixels().size(); ++i)
        after.pixels()[i] = {byte(3 * i), byte(3 * i + 1), byte(3 * i + 2)};
    return after;
}

/// Each image at .8 to 2.8 of its size, evenly in the logarithm; boxes alike.
[[nodiscard]] ism::Dataset rescaled(ism::Dataset set, const fs::path& folder) {
    fs::create_directories(folder);
    ism::Random random(1);
    for (ism::DatasetImage& image : set.images) {
        const double factor = 0.8 * std::pow(2.8 / 0.8, random.uniform());
        const ism::RgbImage before = ism::read_rgb(image.file);
        const ism::RgbImage after = resized(before, int(std::lround(factor * before.width())),
                                            int(std::lround(factor * before.height())));
        const double fx = double(after.width()) / before.width(),
                     fy = double(after.height()) / before.height();
        for (ism::DatasetAnnotation& object : image.objects) {
            const ism::Box b = object.box;
            object.box = {fx * b.x, fy * b.y, fx * b.width, fy * b.height};
            object.segmentation = {};
        }
        image.file = folder / (image.file.stem().string() + ".png");
        image.width = after.width(), image.height = after.height();
        ism::write_png(image.file, after);
    }
    return set;
}

/// Scenes of many objects: nine images at a time in three rows, each as large as 480 × 360 pixels hold it,
/// and what few are left over not at all.
[[nodiscard]] ism::Dataset scenes(const ism::Dataset& set, const fs::path& folder) {
    constexpr int columns = 3, rows = 3, width = 480, height = 360;
    constexpr std::size_t at_once = columns * rows;
    fs::create_directories(folder);
    ism::Random random(1);
    std::vector<std::size_t> order(set.images.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
    ism::Dataset result = set;
    result.images.clear();
    for (std::size_t first = 0; first + at_once <= order.size(); first += at_once) {
        const auto id = std::int64_t(result.images.size() + 1);
        ism::DatasetImage scene{.id = id,
                                .file = folder / (std::to_string(id) + ".png"),
                                .width = columns * width,
                                .height = rows * height};
        ism::RgbImage picture(scene.width, scene.height);
        for (ism::Rgb& pixel : picture.pixels()) pixel = {128, 128, 128};
        for (std::size_t k = 0; k < at_once; ++k) {
            const ism::DatasetImage& image = set.images[order[first + k]];
            const ism::RgbImage before = ism::read_rgb(image.file);
            const double factor = std::min(double(width) / before.width(), double(height) / before.height());
            const ism::RgbImage part = resized(before, int(std::lround(factor * before.width())),
                                               int(std::lround(factor * before.height())));
            const int left = int(k) % columns * width + (width - part.width()) / 2,
                      top = int(k) / columns * height + (height - part.height()) / 2;
            for (int y = 0; y < part.height(); ++y)
                for (int x = 0; x < part.width(); ++x) picture(left + x, top + y) = part(x, y);
            for (ism::DatasetAnnotation object : image.objects) {
                const ism::Box b = object.box;
                object.box = {left + factor * b.x, top + factor * b.y, factor * b.width, factor * b.height};
                object.segmentation = {};
                scene.objects.push_back(std::move(object));
            }
        }
        ism::write_png(scene.file, picture);
        result.images.push_back(std::move(scene));
    }
    return result;
}

/// An image turned about its middle, on a square.
struct Turn {
    double cosine, sine;
    int width, height;  ///< of the image before
    int side;           ///< of the square

    /// Where a pixel of the square comes from.
    [[nodiscard]] ism::Point2 before(int x, int y) const {
        const double u = x - 0.5 * (side - 1), v = y - 0.5 * (side - 1);
        return {cosine * u + sine * v + 0.5 * (width - 1), cosine * v - sine * u + 0.5 * (height - 1)};
    }
};

/// Between pixels interpolated, beyond the edges as they are.
[[nodiscard]] ism::Rgb color_at(const ism::RgbImage& image, ism::Point2 at) {
    const auto inside = [](double place, int end) { return std::clamp(int(std::lround(place)), 0, end - 1); };
    const double left = std::floor(at.x), top = std::floor(at.y);
    std::array<double, 3> color{};
    for (const double dy : {0.0, 1.0})
        for (const double dx : {0.0, 1.0}) {
            const ism::Rgb c = image(inside(left + dx, image.width()), inside(top + dy, image.height()));
            const double weight = (1 - std::abs(at.x - left - dx)) * (1 - std::abs(at.y - top - dy));
            color[0] += weight * c.r, color[1] += weight * c.g, color[2] += weight * c.b;
        }
    const auto byte = [](double value) { return std::uint8_t(std::lround(value)); };
    return {byte(color[0]), byte(color[1]), byte(color[2])};
}

/// An object with its mask turned, and the box around that, which is empty where nothing is left of it.
[[nodiscard]] ism::DatasetAnnotation turned_object(ism::DatasetAnnotation object, const ism::Mask& mask,
                                                   const Turn& turn) {
    ism::Mask after(turn.side, turn.side);
    for (int y = 0; y < turn.side; ++y)
        for (int x = 0; x < turn.side; ++x) {
            const ism::Point2 at = turn.before(x, y);
            const int u = int(std::lround(at.x)), v = int(std::lround(at.y));
            if (mask.contains(u, v) && mask(u, v) != 0) after(x, y) = 1;
        }
    object.box = ism::mask_box(after);
    object.segmentation = ism::compress_mask(after.view());
    return object;
}

/// Each image turned by a random angle, on a square larger than it by a quarter.
[[nodiscard]] ism::Dataset turned(ism::Dataset set, const fs::path& folder) {
    fs::create_directories(folder);
    ism::Random random(1);
    for (ism::DatasetImage& image : set.images) {
        const ism::RgbImage before = ism::read_rgb(image.file);
        const double angle = random.uniform(0, 2 * std::numbers::pi);
        const Turn turn{std::cos(angle), std::sin(angle), before.width(), before.height(),
                        std::max(before.width(), before.height()) * 5 / 4};
        ism::RgbImage after(turn.side, turn.side);
        for (int y = 0; y < turn.side; ++y)
            for (int x = 0; x < turn.side; ++x) after(x, y) = color_at(before, turn.before(x, y));
        for (ism::DatasetAnnotation& object : image.objects)
            object = turned_object(object, ism::read_mask(image, object), turn);
        std::erase_if(image.objects, [](const auto& object) { return object.box.width <= 0; });
        image.file = folder / (image.file.stem().string() + ".png");
        image.depth_file.clear(), image.camera.reset();
        image.width = image.height = turn.side;
        ism::write_png(image.file, after);
    }
    return set;
}

/// What an image shows: its instance, or car7 of car7-090-000.png; the length comes first, so that car10
/// follows car9.
[[nodiscard]] std::pair<std::size_t, std::string> object_of(const ism::DatasetImage& image) {
    const std::string& instance = image.objects.at(0).instance;
    if (!instance.empty()) return {instance.size(), instance};
    const std::string name = image.file.stem().string();
    const std::size_t end = name.find('-');
    ism::expect(end != name.npos, ism::lazy_text("name of ", name), "an object and a dash", "no dash");
    return {end, name.substr(0, end)};
}

/// A number of the command line.
[[nodiscard]] std::uint64_t whole_number(const char* what, const std::string& text, std::uint64_t least) {
    std::uint64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    ism::expect(read.ec == std::errc() && read.ptr == end && number >= least, what,
                ism::lazy_text("a whole number, ", least, " or more"), ism::lazy_text("'", text, "'"));
    return number;
}

/// The images of the K-th object of each class that has so many, counted from 1; or all others.
[[nodiscard]] ism::Dataset of_object(ism::Dataset set, std::uint64_t k, bool this_one) {
    std::map<std::uint32_t, std::set<std::pair<std::size_t, std::string>>> objects;
    for (const ism::DatasetImage& image : set.images)
        objects[image.objects.at(0).class_index].insert(object_of(image));
    std::set<std::pair<std::size_t, std::string>> chosen;
    for (const auto& [class_index, names] : objects) {
        if (k <= names.size()) chosen.insert(*std::next(names.begin(), std::ptrdiff_t(k - 1)));
    }
    ism::expect(!chosen.empty(), "K", "the number of an object that a class has", k);
    std::erase_if(set.images, [&](const ism::DatasetImage& image) {
        return chosen.contains(object_of(image)) != this_one;
    });
    return set;
}

[[nodiscard]] ism::Dataset random_part(ism::Dataset set, std::uint64_t seed) {
    ism::Random random(seed);
    std::vector<ism::DatasetImage>& images = set.images;
    const std::size_t less = images.size() / 5;
    for (std::size_t i = 0; i < less; ++i)
        images.erase(images.begin() + std::ptrdiff_t(random.index(images.size())));
    return set;
}

/// The images of both, whose classes of one name are one. Depth and instances are forgotten.
[[nodiscard]] ism::Dataset joint(ism::Dataset set, const ism::Dataset& other) {
    std::vector<std::uint32_t> class_of;
    for (const std::string& name : other.class_names) {
        const auto known = std::find(set.class_names.begin(), set.class_names.end(), name);
        class_of.push_back(std::uint32_t(known - set.class_names.begin()));
        if (known == set.class_names.end()) set.class_names.push_back(name);
    }
    set.category_ids.resize(set.class_names.size());
    std::iota(set.category_ids.begin(), set.category_ids.end(), std::int64_t(1));
    for (ism::DatasetImage image : other.images) {
        for (ism::DatasetAnnotation& object : image.objects)
            object.class_index = class_of[object.class_index];
        set.images.push_back(std::move(image));
    }
    std::int64_t id = 0;
    for (ism::DatasetImage& image : set.images) {
        image.id = ++id, image.depth_file.clear(), image.camera.reset();
        for (ism::DatasetAnnotation& object : image.objects) object.id = ++id, object.instance.clear();
    }
    return set;
}

struct Kind {
    std::string_view name, arguments, what;
};
constexpr std::array<Kind, 9> kinds = {{
    {"with-background", "SET.json FOLDER OUT.json", "and the photographs of a folder, without objects"},
    {"only-background", "SET.json FOLDER OUT.json", "these alone, with the classes of the set"},
    {"rescaled", "SET.json FOLDER", "each image at a random size, in FOLDER with set.json"},
    {"scenes", "SET.json FOLDER", "nine images at a time, by chance, side by side in one of 1440 × 1080"},
    {"turned", "SET.json FOLDER", "each image turned at random about its middle, in FOLDER with set.json"},
    {"without-object", "SET.json K TRAIN.json TEST.json",
     "object K of each class (instance, or car7-…) apart from the others"},
    {"random-part", "SET.json SEED OUT.json", "four of five images, by chance"},
    {"joint", "SET.json OTHER.json OUT.json", "the images of both, classes of one name as one; by colour"},
    {"without-masks", "SET.json OUT.json", "with the boxes of the labels alone"},
}};

[[nodiscard]] const Kind& kind_of(const std::vector<std::string>& words) {
    std::string names;
    for (const Kind& kind : kinds) names += (names.empty() ? "" : ", ") + std::string(kind.name);
    const std::string what = words.empty() ? "" : words[0];
    const auto* const kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.name == what; });
    ism::expect(kind != kinds.end(), "kind of set", ism::lazy_text("one of ", names),
                ism::lazy_text("'", what, "'"));
    const auto count = std::size_t(std::count(kind->arguments.begin(), kind->arguments.end(), ' ') + 1);
    ism::expect(words.size() == count + 1, what,
                ism::lazy_text(count, " arguments, ", std::string(kind->arguments)), words.size() - 1);
    return *kind;
}

int help() {
    std::puts("figure_sets KIND ARGUMENTS: a set of images made from another\n");
    for (const Kind& kind : kinds)
        std::printf("  %s %s\n      %s\n", kind.name.data(), kind.arguments.data(), kind.what.data());
    return 0;
}

}  // namespace

int main(int argc, char** argv) try {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (!words.empty() && (words[0] == "--help" || words[0] == "-h")) return help();
    const std::string_view what = kind_of(words).name;
    const std::uint64_t number = what == "without-object" ? whole_number("K", words[2], 1)
                                 : what == "random-part"  ? whole_number("SEED", words[2], 0)
                                                          : 0;
    ism::Dataset set = ism::read_dataset(words[1]);
    if (what == "without-object") {
        ism::write_dataset(words[3], of_object(set, number, false));
        ism::write_dataset(words[4], of_object(std::move(set), number, true));
    } else if (what == "random-part") {
        ism::write_dataset(words[3], random_part(std::move(set), number));
    } else if (what == "joint") {
        ism::write_dataset(words[3], joint(std::move(set), ism::read_dataset(words[2])));
    } else if (what == "without-masks") {
        for (ism::DatasetImage& image : set.images)
            for (ism::DatasetAnnotation& object : image.objects) object.segmentation = {};
        ism::write_dataset(words[2], set);
    } else if (what == "rescaled" || what == "scenes" || what == "turned") {
        const fs::path folder = words[2];
        ism::write_dataset(folder / "set.json", what == "turned"   ? turned(std::move(set), folder)
                                                : what == "scenes" ? scenes(set, folder)
                                                                   : rescaled(std::move(set), folder));
    } else {
        if (what == "only-background") set.images.clear();
        ism::write_dataset(words[3], with_background(std::move(set), words[2]));
    }
} catch (const std::exception& error) {
    std::fprintf(stderr, "figure_sets: %s\n", error.what());
    return 2;
}
