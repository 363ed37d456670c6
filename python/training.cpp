// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "training.hpp"

#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "extractors.hpp"
#include "input.hpp"
#include "learning.hpp"
#include "lessons.hpp"
#include "values.hpp"
#include <pybind11/stl.h>

#include "ism/dataset/coco.hpp"
#include "ism/dataset/labelled_image.hpp"

namespace ism_python {

namespace {

using ArraysById = std::map<std::int64_t, Arrays>;

bool is_dict(const py::object& arrays) {
    return py::hasattr(arrays, "get");
}

/// Makes sure that there is nothing else than a dict, or as many arrays as there are images.
void check_arrays(const py::object& arrays, std::size_t images, const char* what) {
    if (is_dict(arrays)) return;
    ism::expect(py::hasattr(arrays, "__getitem__") && py::hasattr(arrays, "__len__"), what,
                "a dict by image id, or a list in the order of coco['images']", type_text(arrays));
    const std::size_t count = py::len(arrays);
    ism::expect(count == images, what, ism::lazy_text(images, " arrays, one for each of coco['images']"),
                count);
}

/// Makes sure that each depth is of an image: another key would leave its image without depth.
void check_keys(const py::object& depths, const ism::Dataset& dataset) {
    if (!py::hasattr(depths, "keys")) return;
    py::set ids;
    for (const ism::DatasetImage& image : dataset.images) ids.add(image.id);
    for (const py::handle& key : depths.attr("keys")())
        ism::expect(ids.contains(key), "depths", "ids of coco['images'] as keys", std::string(py::repr(key)));
}

/// The array of image i: of a dict by the image's id, of a list (or a stack of arrays) by its place.
py::object array_of(const py::object& arrays, std::size_t i, std::int64_t id) {
    return is_dict(arrays) ? arrays.attr("get")(id) : py::object(arrays[py::int_(i)]);
}

ArraysById arrays_of(const ism::Dataset& dataset, const py::object& images, const py::object& depths,
                     const Training& training) {
    const bool bgr = is_bgr(training.order);
    check_arrays(images, dataset.images.size(), "images");
    if (!depths.is_none()) {
        check_arrays(depths, dataset.images.size(), "depths");
        check_keys(depths, dataset);
    }
    ArraysById arrays;
    for (std::size_t i = 0; i < dataset.images.size(); ++i) {
        const ism::DatasetImage& image = dataset.images[i];
        const std::string name = ism::join_text("image with id ", image.id);
        const auto check_size = [&](const ism::RawPixels& pixels, const char* what) {
            ism::expect(pixels.width == image.width && pixels.height == image.height,
                        ism::lazy_text(name, what), ism::lazy_text(image.width, "x", image.height),
                        size_text(pixels));
        };
        const py::object picture = array_of(images, i, image.id);
        ism::expect(!picture.is_none(), "images", ism::lazy_text("an array for image id ", image.id), "none");
        Arrays own{numpy_pixels(picture, name, bgr), {}};
        check_size(own.picture.pixels, ": size");
        const py::object depth = depths.is_none() ? py::object(depths) : array_of(depths, i, image.id);
        if (!depth.is_none()) {
            own.depth = numpy_depth(depth, name + ", depth", training.depth_scale);
            check_size(own.depth->units.pixels, ", depth: size");
        }
        arrays.emplace(image.id, std::move(own));
    }
    return arrays;
}

program::DepthImages depth_images(const ism::Dataset& dataset, const ArraysById& arrays) {
    program::DepthImages images;
    for (std::size_t i = 0; i < dataset.images.size(); ++i) {
        if (!arrays.at(dataset.images[i].id).depth) continue;
        ++images.with_depth;
        if (dataset.images[i].camera) images.usable.push_back(i);
    }
    return images;
}

/// Raises what a signal raises, as that of Ctrl-C does, or `progress`; it leaves the threads as an exception.
void tell(const py::object& progress, std::string_view stage, std::size_t done, std::size_t total) {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(std::string(stage), done, total);
}

/// Learns a model of all that images show; needs no Python.
ism::Model learn_colors(const ism::Dataset& dataset, const ism::TrainingSet& set, const Training& training,
                        ism::TrainOptions& options) {
    std::vector extractors{program::make_extractor(training.detector, training.descriptor)};
    const program::Orientation orientation = program::choose_orientation(
        training.orientation, dataset.class_names, set, extractors, options.threads);
    extractors.front().options().oriented = orientation.free;
    options.features.pixels = training.templates && orientation.templates;
    const ism::TrainingFeatures features =
        program::extract_training_features(dataset.class_names, set, extractors, options);
    ism::Model model = program::learn(features, options);
    return options.features.pixels ? program::learn_templates(std::move(model), features, options)
                                   : std::move(model);
}

}  // namespace

PythonModel train(const py::object& coco, const py::object& images, const py::object& depths,
                  const Training& training) {
    ism::Dataset dataset = ism::detail::dataset_from_json(to_json(coco, "coco"), "coco");
    ism::expect(!dataset.images.empty(), "coco", "at least one image", "none");
    const ArraysById arrays = arrays_of(dataset, images, depths, training);
    const std::vector<std::string> unused = program::leave_out_unused(dataset);
    if (!unused.empty())
        warn("left out, since no annotation is of this category: " + program::list_text(unused));

    ism::expect(training.progress.is_none() || PyCallable_Check(training.progress.ptr()) != 0, "progress",
                "a function of stage, done and total", type_text(training.progress));
    ism::TrainOptions options{
        .threads = training.threads,
        .progress = [&training](std::string_view stage, std::size_t done, std::size_t total) {
            tell(training.progress, stage, done, total);
        }};
    options.features.max_features = training.max_features;
    options.selection.max_words = training.max_words;
    options.codebook.seed = training.seed;
    ism::check(options);
    const ism::TrainingSet set{.size = dataset.images.size(),
                               .labels = [&](std::size_t i) { return ism::object_labels(dataset.images[i]); },
                               .image =
                                   [&](std::size_t i) {
                                       const ism::DatasetImage& image = dataset.images[i];
                                       return ism::to_training_image(
                                           image, to_frame(arrays.at(image.id), image.camera));
                                   },
                               .category_ids = dataset.category_ids};
    PythonModel learnt;
    std::string depth;
    {
        const py::gil_scoped_release released;
        for (std::size_t i = 0; i < set.size; ++i) ism::check(set.image(i), dataset.class_names.size());
        learnt.model = learn_colors(dataset, set, training, options);
        depth = program::add_depth(learnt.model, set, depth_images(dataset, arrays), options);
    }
    if (!depth.empty()) warn("depth " + depth);
    if (const std::string doubt = program::doubt_of_probabilities(learnt.model); !doubt.empty()) warn(doubt);
    return learnt;
}

}  // namespace ism_python
