// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "model.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "spaces.hpp"
#include "values.hpp"

#include "ism/dataset/coco.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/detect/detection.hpp"
#include "ism/model_file/model_file.hpp"

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
ism::Detections find(const ism::Model& model, const Search& search, const Input& input) {
    const ism::Frame frame = to_frame(input.arrays, input.camera);
    const std::string space = space_of(search, model, frame);
    ism::ThreadPool pool(search.threads);
    return program::Matcher(space == program::metric_space ? model.rgbd.front() : model, pool)
        .find(frame, {.space = space, .min_score = search.min_score, .turns = search.turns});
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

}  // namespace ism_python
