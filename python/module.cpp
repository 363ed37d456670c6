// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// The Python module ism._ism: images are numpy arrays, labels and results the dicts of COCO's JSON.
#include <cstdint>
#include <optional>
#include <string>

#include "arrays.hpp"
#include "commands.hpp"
#include "model.hpp"
#include "training.hpp"
#include "values.hpp"
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "ism/core/error.hpp"
#include "ism/dataset/coco_fields.hpp"
#include "ism/version.hpp"

namespace ism_python {

using namespace pybind11::literals;

namespace {

py::object encode_mask(const py::object& mask) {
    return to_python(ism::detail::rle_to_json(packed_mask(mask, "mask")));
}

py::array decode_mask(const py::object& rle) {
    const ism::Mask mask = ism::decompress_mask(ism::detail::rle_from_json(to_json(rle, "mask"), "mask"));
    return py::array_t<std::uint8_t>({mask.height(), mask.width()}, mask.pixels().data());
}

constexpr const char* model_help = R"(What train() learnt or load() read, and what finds objects.

Models can be copied and pickled, so that other processes get them.)";

constexpr const char* detect_help = R"(Finds the objects of an image.

image        numpy array of uint8, uint16 or float (0 ... 1), of shape (height, width) or (height, width, 3 or 4)
depth        numpy array of shape (height, width), registered to the image: whole numbers of 16 bits or more, or
             floats; 0 and NaN are no reading
camera       {"fx": ..., "fy": ..., "cx": ..., "cy": ...} in pixels, for positions in metres
image_id     of the results
space        vote space: "ism", "jism", "ji3sm1", "ji3sm2", "ji3sm3" or "metric"; "auto": metric where the model
             knows depth and the image has depth and a camera, else jism
min_score    least `probability` of what is told, 0 ... 1; None: 0.2 where templates judge and in the space
             metric, else 0
turns        angles by which the image is turned, to find what lies turned; 24 for any angle
depth_scale  metres a unit of depth; None: 0.001 for whole numbers, 1 for floats
order        "rgb", or "bgr" as OpenCV has it
threads      0: as many as the machine has

Returns a list of dicts, strongest first: image_id, category_id, class, bbox (x, y, width, height in pixels),
score, scale, segmentation (see decode_mask()), and where they are known probability, depth_m, position_m,
position_error_m (metres) and angle_rad. Raises Error for what is wrong.)";

constexpr const char* draw_help = R"(Draws what is found in an image, as `ism detect --overlay` does.

The arguments are those of detect(), but for image_id. Returns an array of uint8 of shape (height, width, 3),
r g b; small images are magnified.)";

constexpr const char* explain_help = R"(Draws why an object is found, as `ism detect --overlay` does.

which  place of the object in the list of detect(), from 0; the other arguments are those of detect(), but for
       image_id

Returns an array of uint8 of shape (height, width, 3), r g b. From left to right: the features that voted for the
object; the cells that spoke for and against it, where a template judged; p(figure); p(ground); the mask. Raises
Error where there is no such object.)";

constexpr const char* save_help = "Writes the model as a safetensors file, which the program `ism` reads.";

constexpr const char* info_help = R"(What the model is made of, as a dict.

classes, images, objects, features, words, occurrences, templates, exemplars: what was learnt from and how much of
it; depth: whether it knows the space metric; orientation: "upright", or "free" where objects are found however
they are turned; probabilities, detector, descriptor, format_version.)";

constexpr const char* categories_help =
    R"(COCO's categories in the order of the classes: dicts of id and name.

They are those of the training data, else 1, 2, ... Any dicts can be set that have each class by its name, and each
id and name once.)";

constexpr const char* load_help =
    "Reads a model of `ism train` or Model.save(). Raises Error where it is none.";

constexpr const char* train_help = R"(Learns a model from images and their labels.

coco          COCO's dict: images, annotations, categories. Numbers and arrays of numpy will do; "segmentation" may
              be a mask of numpy, of the image's size. An image may have a "camera", as of Model.detect()
images        arrays, as of Model.detect(): a dict by image id, or a list or stack in the order of coco["images"]
depths        depth of images, in the same way; in a dict only of those that have it, in a list None for others
detector      "hessian-laplace", "harris-laplace", "dog" or "dense"
descriptor    "root-sift" or "sift"
orientation   "upright": objects have one side up; "free": they are found however they are turned; "auto": as
              training objects lie
templates     also learn a template of each class, which judges what votes propose
max_words     keep so many of the best words; 0: all
max_features  features of all objects together
depth_scale   metres a unit of depth; None: 0.001 for whole numbers, 1 for floats
order         "rgb", or "bgr" as OpenCV has it
seed          of random choices
threads       0: as many as the machine has; the model is the same for any number
progress      called with a text, how much is done, and how much there is

Warns of categories that no annotation shows, which are left out, of depth that cannot be learnt from, and of too
few objects. Raises Error for what is wrong. Ctrl-C stops it.)";

constexpr const char* encode_help = R"(A mask as COCO's packed run lengths, as pycocotools packs them.

mask  array of bool or whole numbers of shape (height, width); what is not 0 is figure)";

constexpr const char* decode_help =
    R"(COCO's run lengths as an array of uint8, 0 and 1, of shape (height, width).

rle  dict of size (height, width) and counts: packed, as text or bytes, or a list of numbers)";

/// Adds a method that searches an image, with arguments of its own between those of the search.
template <class... Own, class Method, class... Names>
void add_search(py::class_<PythonModel>& model, const char* name, const char* help, Method method,
                const Names&... names) {
    model.def(
        name,
        [method](const PythonModel& self, const py::object& image, const py::object& depth,
                 const py::object& camera, Own... own, const std::string& space,
                 std::optional<double> min_score, int turns, std::optional<double> depth_scale,
                 const std::string& order, unsigned threads) {
            return (self.*method)({.image = image,
                                   .depth = depth,
                                   .camera = camera,
                                   .space = space,
                                   .min_score = min_score,
                                   .turns = turns,
                                   .depth_scale = depth_scale,
                                   .order = order,
                                   .threads = threads},
                                  own...);
        },
        "image"_a, "depth"_a = py::none(), "camera"_a = py::none(), py::kw_only(), names...,
        "space"_a = "auto", "min_score"_a = py::none(), "turns"_a = 1, "depth_scale"_a = py::none(),
        "order"_a = "rgb", "threads"_a = 0, help);
}

void add_model(py::module_& module) {
    py::class_<PythonModel> model(module, "Model", model_help);
    model.attr("__module__") = "ism";
    add_search<std::int64_t>(model, "detect", detect_help, &PythonModel::detect, "image_id"_a = 1);
    add_search(model, "draw", draw_help, &PythonModel::draw);
    add_search<std::int64_t>(model, "explain", explain_help, &PythonModel::explain, "which"_a = 0);
    model.def("save", &PythonModel::save, "path"_a, save_help)
        .def("info", &PythonModel::info, info_help)
        .def("__repr__", &PythonModel::text)
        .def(py::pickle([](const PythonModel& self) { return self.to_bytes(); },
                        [](const py::bytes& bytes) { return PythonModel::from_bytes(bytes); }))
        .def_property("categories", &PythonModel::categories, &PythonModel::set_categories, categories_help);
}

void add_functions(py::module_& module) {
    module.def("load", &PythonModel::load, "path"_a, load_help);
    module.def(
        "train",
        [](const py::object& coco, const py::object& images, const py::object& depths,
           const std::string& detector, const std::string& descriptor, const std::string& orientation,
           bool templates, std::size_t max_words, std::size_t max_features, std::optional<double> depth_scale,
           const std::string& order, std::uint64_t seed, unsigned threads, const py::object& progress) {
            return train(coco, images, depths,
                         {.detector = detector,
                          .descriptor = descriptor,
                          .orientation = orientation,
                          .templates = templates,
                          .max_words = max_words,
                          .max_features = max_features,
                          .depth_scale = depth_scale,
                          .order = order,
                          .seed = seed,
                          .threads = threads,
                          .progress = progress});
        },
        "coco"_a, "images"_a, "depths"_a = py::none(), py::kw_only(),
        "detector"_a = std::string(program::default_detector),
        "descriptor"_a = std::string(program::default_descriptor),
        "orientation"_a = std::string(program::default_orientation), "templates"_a = true, "max_words"_a = 0,
        "max_features"_a = 40000, "depth_scale"_a = py::none(), "order"_a = "rgb", "seed"_a = 1,
        "threads"_a = 0, "progress"_a = py::none(), train_help);
    module.def("encode_mask", &encode_mask, "mask"_a, encode_help);
    module.def("decode_mask", &decode_mask, "rle"_a, decode_help);
}

}  // namespace

}  // namespace ism_python

PYBIND11_MODULE(_ism, module) {
    namespace py = pybind11;
    py::register_exception<ism::Error>(module, "Error", PyExc_ValueError).attr("__module__") = "ism";
    module.attr("__version__") = ism::version_text;
    ism_python::add_model(module);
    ism_python::add_functions(module);
}
