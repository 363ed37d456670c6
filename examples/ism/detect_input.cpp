// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "detect_input.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "data.hpp"
#include "input.hpp"
#include "pictures.hpp"
#include "spaces.hpp"

#include "ism/core/nearest_name.hpp"
#include "ism/dataset/camera_doubt.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/model_file/model_file.hpp"

namespace program {

namespace {

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

/// Makes sure that an image can be searched as it is asked for.
void check_image(const ism::DatasetImage& image, std::string_view space) {
    if (needs_depth(space) && image.depth_file.empty())
        throw ism::FileError(ism::file_text(image.file) +
                             ": expected a depth image (depth_file_name), got none");
    if (space == metric_space && !image.camera)
        throw ism::FileError(ism::file_text(image.file) + ": expected its camera, got none");
}

}  // namespace

DetectInput read_detect_input(const DetectCommand& command, const ImageList& list) {
    const bool pictures = !command.images.empty();
    DetectInput input{.model = ism::load_model(command.model), .dataset = {}, .names = {}};
    const ism::ShapeModel& shapes = input.model.shapes;
    input.dataset = pictures ? as_dataset(list, command, shapes)
                             : read_data(command.data, ism::DatasetPart::test, command.skip_bad);
    add_classes(input.dataset, shapes);
    check_classes(input.dataset, shapes);
    check_depth(command, input.dataset);
    ism::expect(command.search.space != metric_space || !input.model.rgbd.empty(), "--space metric",
                "a model learnt from images with depth and camera", "one without");
    Doubts doubts;
    const auto read = [&](ism::DatasetImage& image) {
        check_image(image, command.search.space);
        ism::Frame frame = pictures ? picture_frame(image) : ism::read_frame(image, read_picture);
        if (needs_depth(command.search.space) && frame.depth_m.empty())
            throw ism::FileError(ism::file_text(image.depth_file) +
                                 ": expected depth with a reading, got none");
        if (!frame.depth_m.empty())
            doubts.add(image.depth_file, ism::depth_scale_doubt(frame.depth_m, image.depth_scale));
        if (image.camera) doubts.add(image.file, ism::camera_doubt(*image.camera, image.width, image.height));
        if (pictures && list.images().size() == 1)
            input.only = std::make_shared<const ism::Frame>(std::move(frame));
    };
    input.skipped =
        check_images(input.dataset, command.threads, command.skip_bad, [&](ism::DatasetImage& image) {
            try {
                read(image);
            } catch (const ism::Error& error) {
                throw ism::FileError(list.told(error.what()));
            }
        });
    doubts.tell();
    for (const ism::DatasetImage& image : input.dataset.images)
        input.names.push_back(pictures ? list.images()[std::size_t(image.id) - 1].name
                                       : short_name(input.dataset, image));
    return input;
}

std::shared_ptr<const ism::Frame> frame_of(const DetectInput& input, std::size_t i) {
    if (input.only) return input.only;
    return std::make_shared<const ism::Frame>(ism::read_frame(input.dataset.images[i], read_picture));
}

}  // namespace program
