// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// The Python module ism._ism: images are numpy arrays, labels and results the dicts of COCO's JSON.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "commands.hpp"
#include "extractors.hpp"
#include "learning.hpp"
#include "spaces.hpp"
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "ism/dataset/coco.hpp"
#include "ism/dataset/labelled_image.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/detect/detection.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/version.hpp"

namespace ism_python {

using ism::detail::Json;

/// What json.dumps() does not know: numbers and arrays of numpy, and the bytes of packed masks.
py::object plain(const py::object& value) {
    if (py::isinstance<py::bytes>(value)) return value.attr("decode")("ascii");
    if (py::hasattr(value, "tolist")) return value.attr("tolist")();
    throw ism::Error(ism::join_text("coco: expected what JSON can hold, got ",
                                    std::string(py::str(py::type::of(value).attr("__name__")))));
}

Json to_json(const py::object& object, const std::string& place) {
    ism::expect(py::hasattr(object, "keys"), place, "a dict", array_text(object));
    const py::object text = py::module_::import("json").attr("dumps")(
        py::dict(object), py::arg("default") = py::cpp_function(plain), py::arg("allow_nan") = false);
    return ism::detail::parse_json(text.cast<std::string>(), place);
}

py::object to_python(const Json& json) {
    return py::module_::import("json").attr("loads")(ism::detail::dump_json(json, "results"));
}

bool is_bgr(const std::string& order) {
    ism::expect(order == "rgb" || order == "bgr", "order", "'rgb' or 'bgr'", ism::lazy_text("'", order, "'"));
    return order == "bgr";
}

/// The array of image i: of a dict by the image's id, of a list (or a stack of arrays) by its place.
py::object array_of(const py::object& arrays, std::size_t i, std::int64_t id, const char* what) {
    if (py::hasattr(arrays, "get")) return arrays.attr("get")(id);
    ism::expect(py::hasattr(arrays, "__getitem__") && py::hasattr(arrays, "__len__"), what,
                "a dict by image id, or a list in the order of coco['images']", array_text(arrays));
    ism::expect(i < py::len(arrays), what, ism::lazy_text("an array for image ", i, " of coco['images']"),
                ism::lazy_text(py::len(arrays), " arrays"));
    return arrays[py::int_(i)];
}

class PythonModel {
public:
    ism::Model model;

    static PythonModel load(const std::filesystem::path& path) {
        const py::gil_scoped_release released;
        return {ism::load_model(path)};
    }

    void save(const std::filesystem::path& path) const {
        const py::gil_scoped_release released;
        ism::save_model(path, model);
    }

    [[nodiscard]] py::list categories() const {
        py::list list;
        const std::vector<std::int64_t> category_ids = ism::result_category_ids(model.shapes);
        for (std::size_t c = 0; c < category_ids.size(); ++c) {
            py::dict category;
            category["id"] = category_ids[c], category["name"] = model.shapes.class_names[c];
            list.append(category);
        }
        return list;
    }

    void set_categories(const py::list& list) {
        std::vector<std::int64_t> ids;
        const Json json = to_json(py::dict(py::arg("categories") = list), "categories");
        for (const std::string& name : model.shapes.class_names) {
            const auto of_name = [&](const Json& category) {
                return ism::detail::text_member(category, "name", "category") == name;
            };
            const Json& all = json["categories"];
            const auto found = std::find_if(all.begin(), all.end(), of_name);
            ism::expect(found != all.end(), "categories", ism::lazy_text("one named '", name, "'"), "none");
            ids.push_back(ism::detail::integer_member(*found, "id", "category '" + name + "'"));
        }
        model.shapes.category_ids = ids;
        for (ism::Model& rgbd : model.rgbd) rgbd.shapes.category_ids = ids;
    }

    [[nodiscard]] py::dict info() const {
        py::dict info;
        const ism::Channel& channel = model.channels.front();
        info["format_version"] = ism::detail::model_format_version;
        info["classes"] = model.shapes.class_names;
        info["images"] = model.training.images;
        info["objects"] = model.shapes.objects.size();
        info["features"] = model.training.features_used;
        info["words"] = model.words();
        info["occurrences"] = model.shapes.occurrences.values().size();
        info["templates"] = model.templates.size();
        info["exemplars"] = model.exemplars.size();
        info["depth"] = !model.rgbd.empty();
        info["probabilities"] = !model.calibration.empty();
        info["detector"] = channel.features.detector;
        info["descriptor"] = channel.features.descriptor;
        return info;
    }

    [[nodiscard]] py::object detect(const py::object& image, const py::object& depth,
                                    const py::object& camera, std::int64_t image_id, const std::string& space,
                                    std::optional<double> min_score, int turns, double depth_scale,
                                    const std::string& order, unsigned threads) const {
        Arrays arrays{numpy_pixels(image, "image", is_bgr(order)), {}, depth_scale};
        if (!depth.is_none()) arrays.depth = numpy_pixels(depth, "depth");
        std::optional<ism::Camera> seen_by;
        if (!camera.is_none()) seen_by = ism::detail::camera_from_json(to_json(camera, "camera"), "detect");
        ism::expect(!min_score || (*min_score >= 0 && *min_score <= 1), "min_score", "0 ... 1",
                    min_score.value_or(0));
        std::vector<ism::Result> results;
        {
            const py::gil_scoped_release released;
            const ism::Frame frame = to_frame(arrays, seen_by);
            const bool with_depth = !frame.depth_m.empty() && frame.camera;
            program::SearchOptions search{.space = space, .min_score = min_score, .turns = turns};
            if (space == program::auto_space)
                search.space =
                    !model.rgbd.empty() && with_depth && turns == 1 ? program::metric_space : "jism";
            const bool metric = search.space == program::metric_space;
            ism::expect(!metric || turns == 1, "turns", "1 in the space metric, which finds what is turned",
                        turns);
            ism::expect(!metric || !model.rgbd.empty(), "space metric",
                        "a model learnt from images with depth and camera", "one without");
            ism::expect(!metric || with_depth, "space metric", "an image with depth and camera",
                        "one without");
            ism::expect(metric || !program::needs_depth(search.space) || !frame.depth_m.empty(),
                        ism::lazy_text("space ", search.space), "an image with depth", "one without");
            const ism::Model& used = metric ? model.rgbd.front() : model;
            ism::ThreadPool pool(threads);
            const ism::Detections found = program::Matcher(used, pool).find(frame, search);
            results = ism::to_results(found,
                                      {.id = image_id,
                                       .file = {},
                                       .depth_file = {},
                                       .width = frame.gray.width(),
                                       .height = frame.gray.height()},
                                      model.shapes);
        }
        Json list = Json::array();
        for (const ism::Result& result : results) list.push_back(ism::detail::result_to_json(result));
        return to_python(list);
    }
};

PythonModel train(const py::object& coco, const py::object& images, const py::object& depths,
                  const std::string& detector, const std::string& descriptor, bool templates,
                  std::size_t max_words, std::size_t max_features, double depth_scale,
                  const std::string& order, std::uint64_t seed, unsigned threads) {
    const ism::Dataset dataset = ism::detail::dataset_from_json(to_json(coco, "coco"), "coco");
    ism::expect(!dataset.images.empty(), "coco", "at least one image", "none");
    const bool bgr = is_bgr(order);
    std::vector<Arrays> arrays;
    bool with_depth = false;
    for (std::size_t i = 0; i < dataset.images.size(); ++i) {
        const ism::DatasetImage& image = dataset.images[i];
        const std::string name = ism::join_text("image with id ", image.id);
        const py::object picture = array_of(images, i, image.id, "images");
        ism::expect(!picture.is_none(), "images", ism::lazy_text("an array for image id ", image.id), "none");
        arrays.push_back({numpy_pixels(picture, name, bgr), {}, depth_scale});
        const ism::RawPixels& pixels = arrays.back().picture.pixels;
        ism::expect(pixels.width == image.width && pixels.height == image.height,
                    ism::lazy_text(name, ": size"), ism::lazy_text(image.width, "x", image.height),
                    size_text(pixels));
        const py::object depth =
            depths.is_none() ? py::object(depths) : array_of(depths, i, image.id, "depths");
        if (!depth.is_none()) arrays.back().depth = numpy_pixels(depth, name + ", depth");
        with_depth = with_depth || (arrays.back().depth && image.camera);
    }

    const py::gil_scoped_release released;
    ism::TrainingSet set = ism::training_set(std::span<const ism::TrainingImage>());
    set.size = dataset.images.size();
    set.labels = [&](std::size_t i) { return ism::object_labels(dataset.images[i]); };
    set.image = [&](std::size_t i) {
        const ism::DatasetImage& image = dataset.images[i];
        return ism::to_training_image(image, to_frame(arrays[i], image.camera));
    };
    for (std::size_t i = 0; i < set.size; ++i) ism::check(set.image(i), dataset.class_names.size());

    ism::TrainOptions options{.threads = threads};
    options.features.pixels = templates;
    options.features.max_features = max_features;
    options.selection.max_words = max_words;
    options.codebook.seed = seed;
    ism::check(options);
    set.category_ids = dataset.category_ids;
    PythonModel learnt;
    const ism::TrainingFeatures features = program::extract_training_features(
        dataset.class_names, set, {program::make_extractor(detector, descriptor)}, options);
    learnt.model = program::learn(features, options);
    if (templates) learnt.model = program::learn_templates(std::move(learnt.model), features, options);
    if (with_depth) {
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < set.size; ++i)
            if (arrays[i].depth && dataset.images[i].camera) chosen.push_back(i);
        const ism::TrainingSet rgbd{.size = chosen.size(),
                                    .labels = [&](std::size_t i) { return set.labels(chosen[i]); },
                                    .image = [&](std::size_t i) { return set.image(chosen[i]); },
                                    .category_ids = set.category_ids};
        learnt.model.rgbd = {program::learn_rgbd(dataset.class_names, rgbd, options)};
    }
    return learnt;
}

py::object encode_mask(const py::object& mask) {
    const auto bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>::ensure(mask);
    ism::expect(bytes && bytes.ndim() == 2, "mask", "an array of shape (height, width)", array_text(mask));
    return to_python(ism::detail::rle_to_json(ism::compress_mask(
        {bytes.data(), int(bytes.shape(1)), int(bytes.shape(0)), std::ptrdiff_t(bytes.shape(1))})));
}

py::array decode_mask(const py::object& rle) {
    const ism::Mask mask = ism::decompress_mask(ism::detail::rle_from_json(to_json(rle, "mask"), "mask"));
    return py::array_t<std::uint8_t>({mask.height(), mask.width()}, mask.pixels().data());
}

}  // namespace ism_python

PYBIND11_MODULE(_ism, module) {
    namespace py = pybind11;
    using namespace pybind11::literals;
    using ism_python::PythonModel;
    py::register_exception<ism::Error>(module, "Error", PyExc_ValueError).attr("__module__") = "ism";
    module.attr("__version__") = ism::version_text;

    py::class_<PythonModel>(module, "Model", "What train() learnt and detect() needs.")
        .def("detect", &PythonModel::detect, "image"_a, "depth"_a = py::none(), "camera"_a = py::none(),
             py::kw_only(), "image_id"_a = 1, "space"_a = "auto", "min_score"_a = py::none(), "turns"_a = 1,
             "depth_scale"_a = 0.001, "order"_a = "rgb", "threads"_a = 0,
             "Finds the objects of an image: a list of COCO results, strongest first.")
        .def("save", &PythonModel::save, "path"_a, "Writes the model as a safetensors file.")
        .def("info", &PythonModel::info, "What the model is made of.")
        .def_property(
            "categories", &PythonModel::categories, &PythonModel::set_categories,
            "COCO's categories, in the order of the classes: those of the training data, else 1, 2, ...");
    module.def("load", &PythonModel::load, "path"_a, "Reads a model of `ism train` or Model.save().");
    module.def("train", &ism_python::train, "coco"_a, "images"_a, "depths"_a = py::none(), py::kw_only(),
               "detector"_a = "hessian-laplace", "descriptor"_a = "root-sift", "templates"_a = true,
               "max_words"_a = 0, "max_features"_a = 40000, "depth_scale"_a = 0.001, "order"_a = "rgb",
               "seed"_a = 1, "threads"_a = 0, "Learns a model from images and their COCO labels.");
    module.def("encode_mask", &ism_python::encode_mask, "mask"_a, "A mask as COCO's packed run lengths.");
    module.def("decode_mask", &ism_python::decode_mask, "rle"_a,
               "COCO's run lengths as an array of 0 and 1.");
}
