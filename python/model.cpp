// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "model.hpp"

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "input.hpp"
#include "spaces.hpp"
#include "values.hpp"

#include "ism/dataset/coco.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/detect/detection.hpp"
#include "ism/model_file/model_bytes.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/show/overlay.hpp"

namespace ism_python {

namespace {

/// The vote space that the frame is searched in, by what the model knows of depth.
std::string space_of(const Search& search, const ism::Model& model, const ism::Frame& frame) {
    const bool with_depth = !frame.depth_m.empty() && frame.camera;
    std::string space = search.space;
    if (space == program::auto_space)
        space = !model.rgbd.empty() && with_depth && search.turns == 1 ? program::metric_space : "jism";
    const bool metric = space == program::metric_space;
    ism::expect(!metric || search.turns == 1, "turns", "1 in the space metric, which finds what is turned",
                search.turns);
    ism::expect(!metric || !model.rgbd.empty(), "space metric",
                "a model learnt from images with depth and camera", "one without");
    ism::expect(!metric || with_depth, "space metric", "an image with depth and camera", "one without");
    ism::expect(metric || !program::needs_depth(space) || !frame.depth_m.empty(),
                ism::lazy_text("space ", space), "an image with depth", "one without");
    return space;
}

/// What is searched, as the library takes it.
struct Input {
    Arrays arrays;
    std::optional<ism::Camera> camera;
};

Input input_of(const Search& search) {
    Input input{{numpy_pixels(search.image, "image", is_bgr(search.order)), {}}, {}};
    if (!search.depth.is_none()) input.arrays.depth = numpy_depth(search.depth, "depth", search.depth_scale);
    if (!search.camera.is_none())
        input.camera = ism::detail::camera_from_json(to_json(search.camera, "camera"), "detect");
    ism::expect(!search.min_score || (*search.min_score >= 0 && *search.min_score <= 1), "min_score",
                "0 ... 1", search.min_score.value_or(0));
    return input;
}

/// What is found; needs no Python.
/// @param explain  also what templates saw
ism::Detections find(const ism::Model& model, const Search& search, const Input& input,
                     bool explain = false) {
    const ism::Frame frame = to_frame(input.arrays, input.camera);
    const std::string space = space_of(search, model, frame);
    ism::ThreadPool pool(search.threads);
    return program::Matcher(space == program::metric_space ? model.rgbd.front() : model, pool)
        .find(frame,
              {.space = space, .min_score = search.min_score, .turns = search.turns, .explain = explain});
}

py::array to_array(const ism::RgbImage& image) {
    py::array_t<std::uint8_t> array({image.height(), image.width(), 3});
    std::memcpy(array.mutable_data(), image.pixels().data(), image.pixels().size_bytes());
    return array;
}

}  // namespace

bool is_bgr(const std::string& order) {
    ism::expect(order == "rgb" || order == "bgr", "order", "'rgb' or 'bgr'", ism::lazy_text("'", order, "'"));
    return order == "bgr";
}

PythonModel PythonModel::load(const std::filesystem::path& path) {
    const py::gil_scoped_release released;
    return {ism::load_model(path)};
}

void PythonModel::save(const std::filesystem::path& path) const {
    const py::gil_scoped_release released;
    ism::save_model(path, model);
}

py::bytes PythonModel::to_bytes() const {
    std::string bytes;
    {
        const py::gil_scoped_release released;
        bytes = ism::model_to_bytes(model);
    }
    return bytes;
}

PythonModel PythonModel::from_bytes(const py::bytes& bytes) {
    const std::string held = bytes;
    const py::gil_scoped_release released;
    return {ism::model_from_bytes(held)};
}

std::string PythonModel::text() const {
    return ism::join_text("<ism.Model of ", program::list_text(model.shapes.class_names), ": ",
                          model.shapes.objects.size(), " objects, ", model.words(), " words",
                          model.templates.empty() ? "" : ", templates", model.rgbd.empty() ? "" : ", depth",
                          ">");
}

py::list PythonModel::categories() const {
    py::list list;
    const std::vector<std::int64_t> category_ids = ism::result_category_ids(model.shapes);
    for (std::size_t c = 0; c < category_ids.size(); ++c) {
        py::dict category;
        category["id"] = category_ids[c], category["name"] = model.shapes.class_names[c];
        list.append(category);
    }
    return list;
}

void PythonModel::set_categories(const py::object& dicts) {
    std::vector<std::pair<std::string, std::int64_t>> given;
    std::set<std::int64_t> ids;
    ism::expect(PyDict_Check(dicts.ptr()) == 0 && py::hasattr(dicts, "__iter__"), "categories",
                "dicts with id and name", type_text(dicts));
    for (const py::handle& dict : dicts) {
        const std::string place = ism::join_text("categories[", given.size(), "]");
        const Json category = to_json(py::reinterpret_borrow<py::object>(dict), place);
        const std::string& name = ism::detail::text_member(category, "name", place);
        const std::int64_t id = ism::detail::integer_member(category, "id", place);
        ism::expect(ids.insert(id).second, "categories", "each id once", ism::lazy_text(id, " twice"));
        const bool known =
            std::any_of(given.begin(), given.end(), [&](const auto& one) { return one.first == name; });
        ism::expect(!known, "categories", "each name once", ism::lazy_text("'", name, "' twice"));
        given.emplace_back(name, id);
    }
    std::vector<std::int64_t> own;
    for (const std::string& name : model.shapes.class_names) {
        const auto found =
            std::find_if(given.begin(), given.end(), [&](const auto& one) { return one.first == name; });
        ism::expect(found != given.end(), "categories", ism::lazy_text("one named '", name, "'"), "none");
        own.push_back(found->second);
    }
    model.shapes.category_ids = own;
    for (ism::Model& rgbd : model.rgbd) rgbd.shapes.category_ids = own;
}

py::dict PythonModel::info() const {
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
    info["orientation"] = channel.features.options.oriented ? "free" : "upright";
    info["detector"] = channel.features.detector;
    info["descriptor"] = channel.features.descriptor;
    return info;
}

py::object PythonModel::detect(const Search& search, std::int64_t image_id) const {
    const Input input = input_of(search);
    const ism::RawPixels& picture = input.arrays.picture.pixels;
    std::vector<ism::Result> results;
    {
        const py::gil_scoped_release released;
        results = ism::to_results(
            find(model, search, input),
            {.id = image_id, .file = {}, .depth_file = {}, .width = picture.width, .height = picture.height},
            model.shapes);
    }
    Json list = Json::array();
    for (const ism::Result& result : results) list.push_back(ism::detail::result_to_json(result));
    return to_python(list);
}

py::array PythonModel::draw(const Search& search) const {
    const Input input = input_of(search);
    ism::RgbImage drawn;
    {
        const py::gil_scoped_release released;
        const ism::Font font = ism::system_font(model.shapes.class_names);
        drawn = ism::draw_detections(to_rgb(input.arrays), find(model, search, input),
                                     model.shapes.class_names, {.font = &font});
    }
    return to_array(drawn);
}

py::array PythonModel::explain(const Search& search, std::int64_t which) const {
    const Input input = input_of(search);
    ism::RgbImage drawn;
    {
        const py::gil_scoped_release released;
        const ism::Font font = ism::system_font(model.shapes.class_names);
        ism::Detections found = find(model, search, input, true);
        const ism::Box picture{0, 0, double(input.arrays.picture.pixels.width),
                               double(input.arrays.picture.pixels.height)};
        std::erase_if(found.objects, [&](const ism::Detection& one) {  // as detect() does
            return !(ism::intersection(one.box, picture).area() > 0);
        });
        const auto count = std::int64_t(found.objects.size());
        ism::expect(count > 0, "which", "an object to be found", "none");
        ism::expect(which >= 0 && which < count, "which",
                    ism::lazy_text("one of the objects found, 0 ... ", count - 1), which);
        drawn = ism::draw_explanation(to_rgb(input.arrays), found, std::size_t(which),
                                      model.shapes.class_names, {.font = &font});
    }
    return to_array(drawn);
}

}  // namespace ism_python
