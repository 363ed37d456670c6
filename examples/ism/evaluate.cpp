// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "commands.hpp"
#include "data.hpp"
#include "input.hpp"
#include "pictures.hpp"

#include "ism/core/number_text.hpp"
#include "ism/dataset/any_dataset.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/evaluate/coco.hpp"
#include "ism/evaluate/plot.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/version.hpp"

namespace program {

namespace {

/// Whether a file holds labels of COCO or labelme.
bool are_labels(const std::filesystem::path& file) {
    try {
        const ism::detail::Json root = ism::detail::read_json(file);
        return root.contains("images") || root.contains("annotations") || root.contains("shapes");
    } catch (const ism::FileError&) {
        return false;
    }
}

/// Results of another program or of `ism detect -o`.
/// @throws ism::FileError where the file holds the lines of `ism detect --json`, and as ism::read_results().
std::vector<ism::Result> read_detections(const std::filesystem::path& file) {
    try {
        return ism::read_results(file);
    } catch (const ism::FileError&) {
        if (!std::filesystem::is_regular_file(file) || !ism::detail::begins_as_object(file)) throw;
        if (are_labels(file))
            throw ism::FileError(ism::file_text(file) +
                                 ": expected an array of results, as ism detect -o writes it, got labels");
        throw ism::FileError(ism::file_text(file) +
                             ": expected an array of results, as ism detect -o writes it, got an object; ism "
                             "detect --json writes such lines, for other programs");
    }
}

/// What is measured, and how, with the figures.
std::string figures_json(const EvaluateCommand& command, const ism::Dataset& dataset,
                         nlohmann::ordered_json figures) {
    const bool uiuc = command.options.rule == ism::EvaluateOptions::Rule::uiuc;
    nlohmann::ordered_json root = {{"version", ism::version_text},
                                   {"images", dataset.images.size()},
                                   {"rule", command.masks  ? "coco-masks"
                                            : command.coco ? "coco"
                                            : uiuc         ? "uiuc"
                                                           : "iou"}};
    if (!command.coco && !uiuc) root["iou"] = command.options.iou_threshold;
    root.update(figures);
    return ism::detail::indented(root) + "\n";
}

/// Leaves out, and tells, results of classes that no label names, where classes are only those that labels
/// name.
void leave_out_unknown(const ism::Dataset& dataset, std::vector<ism::Result>& results) {
    if (dataset.classes_listed) return;
    std::set<std::string> unknown;
    const std::size_t left_out = std::erase_if(results, [&](const ism::Result& result) {
        const auto& names = dataset.class_names;
        const auto& ids = dataset.category_ids;
        const bool known = result.class_name.empty()
                               ? std::find(ids.begin(), ids.end(), result.category_id) != ids.end()
                               : std::find(names.begin(), names.end(), result.class_name) != names.end();
        if (!known)
            unknown.insert(result.class_name.empty() ? ism::join_text(result.category_id)
                                                     : result.class_name);
        return !known;
    });
    if (left_out == 0) return;
    std::fprintf(
        stderr, "ism: note: %zu of %zu results are left out: no label names %s (labels name %s)\n", left_out,
        left_out + results.size(), ism::one_line(list_text(unknown)).c_str(),
        dataset.class_names.empty() ? "nothing" : ism::one_line(list_text(dataset.class_names)).c_str());
}

/// Tells where what is improbable may have been left out, as ism detect does by default.
void tell_if_cut(const std::vector<ism::Result>& results, bool coco) {
    constexpr double improbable = 0.1;
    if (results.empty()) return;
    double least = 1;
    for (const ism::Result& result : results) {
        if (!(result.probability >= improbable)) return;  // or not known
        least = std::min(least, result.probability);
    }
    std::fprintf(stderr,
                 "ism: note: no result is less probable than %s: where ism detect was not asked for all "
                 "(--min-score 0) AP and %s are too low\n",
                 ism::number_text(least, 2).c_str(), coco ? "recall" : "EER");
}

/// Leaves out images that cannot be read, as ism detect --skip-bad does, and what was found in them. Where
/// none of the images is there, labels alone are measured against.
void leave_out_bad(ism::Dataset& dataset, std::vector<ism::Result>& results) {
    std::error_code ignored;
    const auto is_there = [&](const auto& image) { return std::filesystem::exists(image.file, ignored); };
    if (std::none_of(dataset.images.begin(), dataset.images.end(), is_there)) return;
    std::set<std::int64_t> bad;
    for (const ism::DatasetImage& image : dataset.images) bad.insert(image.id);
    const std::size_t images = check_images(dataset, 0, true, [](const ism::DatasetImage& image) {
        static_cast<void>(ism::read_frame(image, read_picture));
    });
    if (images == 0) return;
    for (const ism::DatasetImage& image : dataset.images) bad.erase(image.id);
    const std::size_t left_out =
        std::erase_if(results, [&](const ism::Result& result) { return bad.contains(result.image_id); });
    std::fprintf(stderr, "ism: note: %zu of %zu images are left out, and %zu results in them\n", images,
                 images + dataset.images.size(), left_out);
}

}  // namespace

void run_evaluate(const EvaluateCommand& command) {
    ism::expect(command.plot != "-", "--plot", "a file", "standard output");
    for (const auto& output : {command.json, command.plot})
        if (!output.empty() && !is_standard_output(output))
            check_output(output, std::array{command.data, command.detections});
    ism::expect(command.plot.empty() || command.plot.lexically_normal() != command.json.lexically_normal(),
                "--plot", "another file than --json", "the same");
    ism::Dataset dataset = read_data(command.data, ism::DatasetPart::test, command.skip_bad);
    check_not_labels(dataset, std::array{command.json, command.plot});
    ism::expect<ism::FileError>(!dataset.class_names.empty(), ism::file_text(command.data),
                                "labels or a list of classes", "none");
    std::vector<ism::Result> results = read_detections(command.detections);
    if (command.skip_bad) leave_out_bad(dataset, results);
    leave_out_unknown(dataset, results);
    const auto tell = [&](const auto& evaluation) {
        tell_if_cut(results, command.coco);
        const std::string json = figures_json(command, dataset, ism::detail::json_of(evaluation));
        if (is_standard_output(command.json)) {
            std::fputs(json.c_str(), stdout);
            return;
        }
        if (!command.json.empty()) ism::write_file(command.json, json);
        std::fputs(ism::to_table(evaluation).c_str(), stdout);
    };
    const std::string place = ism::file_text(command.detections);
    if (command.coco)
        return tell(ism::at_place(place, [&] {
            return command.masks ? ism::evaluate_coco_masks(dataset, results)
                                 : ism::evaluate_coco(dataset, results);
        }));
    const ism::Evaluation evaluation =
        ism::at_place(place, [&] { return ism::evaluate(dataset, results, command.options); });
    if (!command.plot.empty())
        ism::write_file(command.plot, ism::to_svg(ism::precision_recall_plot(evaluation)));
    tell(evaluation);
}

}  // namespace program
