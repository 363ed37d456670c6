// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/toy_set.hpp"

#include <algorithm>
#include <cstdio>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "toy/noise.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/coco_write.hpp"
#include "ism/io/png.hpp"

namespace toy {

namespace {

/// Where a picture's files are and its record in the data set.
ism::DatasetImage write_picture(const std::filesystem::path& folder, const std::string& part,
                                std::size_t number, const ToyScene& scene) {
    char digits[16];
    std::snprintf(digits, sizeof digits, "%04u", unsigned(number));
    const std::string name = part + "-" + digits;
    ism::DatasetImage image{.id = std::int64_t(number) + 1,
                            .file = folder / part / (name + ".png"),
                            .depth_file = folder / part / (name + "-depth.png"),
                            .width = scene.color.width(),
                            .height = scene.color.height(),
                            .depth_scale = 0.001,
                            .camera = scene.camera};
    ism::write_png(image.file, scene.color);
    ism::write_png16(image.depth_file, scene.depth_mm);
    for (const ToyObject& object : scene.objects)
        image.objects.push_back({.class_index = std::uint32_t(object.class_index),
                                 .box = object.box,
                                 .segmentation = ism::compress_mask(object.mask),
                                 .instance = std::to_string(object.instance),
                                 .position_m = object.position_m});
    return image;
}

/// Writes the labels of these images.
ism::Dataset write_labels(const std::filesystem::path& file, std::span<const ism::DatasetImage> images) {
    ism::Dataset set{.source = file, .class_names = class_names(), .images = {images.begin(), images.end()}};
    for (std::size_t i = 0; i < set.class_names.size(); ++i) set.category_ids.push_back(std::int64_t(i) + 1);
    std::int64_t id = 0;
    for (auto& image : set.images)
        for (auto& object : image.objects) object.id = ++id;
    ism::write_dataset(file, set);
    return set;
}

}  // namespace

ToySet write_toy_set(const std::filesystem::path& folder, const ToySetOptions& options) {
    ism::expect(options.train_cars > 0 && options.train_others > 0 && options.views_per_toy > 0,
                "toy set training toys and views", "at least one of each",
                ism::lazy_text(options.train_cars, ", ", options.train_others, ", ", options.views_per_toy));
    ism::expect(options.test_scenes >= 0 && options.backgrounds >= 0, "toy set scenes", "0 or more",
                ism::lazy_text(options.test_scenes, ", ", options.backgrounds));
    struct Lesson {
        std::size_t class_index;
        int instance, view;
    };
    std::vector<Lesson> lessons;
    for (std::size_t c = 0; c < class_names().size(); ++c)
        for (int i = 0; i < (c == 0 ? options.train_cars : options.train_others); ++i)
            for (int v = 0; v < options.views_per_toy; ++v) lessons.push_back({c, i, v});
    for (const char* part : {"train", "test"}) {
        std::error_code failure;
        std::filesystem::create_directories(folder / part, failure);
        ism::expect<ism::FileError>(!failure, ism::lazy_text("folder '", (folder / part).string(), "'"),
                                    "to be made", failure.message());
    }
    ToyOptions picture = options.picture, lesson_picture = options.picture;
    picture.seed = lesson_picture.seed = options.seed;
    lesson_picture.width = options.train_width, lesson_picture.height = options.train_height;
    ClutterOptions clutter = options.clutter, empty = options.clutter;
    clutter.first_instance = std::max(options.train_cars, options.train_others);
    empty.least_toys = empty.most_toys = 0;

    const std::size_t learnt = lessons.size(), train = learnt + std::size_t(options.backgrounds);
    std::vector<ism::DatasetImage> images(train + std::size_t(options.test_scenes));
    std::vector<std::vector<ToyObject>> truth(images.size());
    ism::parallel_for(images.size(), options.threads, [&](std::size_t i) {
        ToyScene scene;
        const std::uint64_t own = derived_seed(options.seed, 1000 + i);
        if (i < learnt) {
            ism::Random random(own);
            const Lesson& lesson = lessons[i];
            // Views are spread evenly over the turns of the class, each a little off.
            const double part = (lesson.view + random.uniform(0.15, 0.85)) / options.views_per_toy * 2 - 1;
            ToyView view{.distance_m = options.train_distance_m * random.uniform(0.95, 1.05),
                         .pitch_deg = random.uniform(13, 30)};
            view.turn_deg = part * largest_turn_deg(lesson.class_index), view.seed = own;
            scene = render_isolated(lesson.class_index, lesson.instance, view, lesson_picture);
        } else {
            scene = render_cluttered(own, i < train ? empty : clutter, i < train ? lesson_picture : picture);
        }
        const bool test = i >= train;
        images[i] = write_picture(folder, test ? "test" : "train", test ? i - train : i, scene);
        truth[i] = std::move(scene.objects);
    });
    ToySet set;
    const auto cut = std::ptrdiff_t(train);
    set.train_truth.assign(truth.begin(), truth.begin() + cut),
        set.test_truth.assign(truth.begin() + cut, truth.end());
    set.train = write_labels(folder / "train.json", std::span(images).first(train));
    set.test = write_labels(folder / "test.json", std::span(images).subspan(train));
    return set;
}

}  // namespace toy
