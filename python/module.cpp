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

void add_model(py::module_& module) {
    py::class_<PythonModel>(module, "Model", "What train() learnt and detect() needs.")
        .def(
            "detect",
            [](const PythonModel& model, const py::object& image, const py::object& depth,
               const py::object& camera, std::int64_t image_id, const std::string& space,
               std::optional<double> min_score, int turns, std::optional<double> depth_scale,
               const std::string& order, unsigned threads) {
                return model.detect({.image = image,
                                     .depth = depth,
                                     .camera = camera,
                                     .space = space,
                                     .min_score = min_score,
                                     .turns = turns,
                                     .depth_scale = depth_scale,
                                     .order = order,
                                     .threads = threads},
                                    image_id);
            },
            "image"_a, "depth"_a = py::none(), "camera"_a = py::none(), py::kw_only(), "image_id"_a = 1,
            "space"_a = "auto", "min_score"_a = py::none(), "turns"_a = 1, "depth_scale"_a = py::none(),
            "order"_a = "rgb", "threads"_a = 0,
            "Finds the objects of an image: a list of COCO results, strongest first.")
        .def("save", &PythonModel::save, "path"_a, "Writes the model as a safetensors file.")
        .def("info", &PythonModel::info, "What the model is made of.")
        .def_property(
            "categories", &PythonModel::categories, &PythonModel::set_categories,
            "COCO's categories, in the order of the classes: those of the training data, else 1, 2, ...");
}

void add_functions(py::module_& module) {
    module.def("load", &PythonModel::load, "path"_a, "Reads a model of `ism train` or Model.save().");
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
        "threads"_a = 0, "progress"_a = py::none(), "Learns a model from images and their COCO labels.");
    module.def("encode_mask", &encode_mask, "mask"_a, "A mask as COCO's packed run lengths.");
    module.def("decode_mask", &decode_mask, "rle"_a, "COCO's run lengths as an array of 0 and 1.");
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
