// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <functional>

#include "commands.hpp"
#include "data.hpp"
#include "input.hpp"

#include "ism/evaluate/coco.hpp"
#include "ism/evaluate/plot.hpp"
#include "ism/evaluate/table.hpp"

namespace program {

void run_evaluate(const EvaluateCommand& command) {
    for (const auto& output : {command.json, command.plot})
        if (!output.empty()) check_output(output, std::array{command.data, command.detections});
    const ism::Dataset dataset = read_data(command.data, ism::DatasetPart::test, command.skip_bad);
    std::vector<ism::Result> results = ism::read_results(command.detections);
    // Where classes are only those that labels name, what was found of others is of no image's class.
    const auto is_known = [&](const ism::Result& result) {
        const auto& names = dataset.class_names;
        const auto& ids = dataset.category_ids;
        if (!result.class_name.empty())
            return std::find(names.begin(), names.end(), result.class_name) != names.end();
        return std::find(ids.begin(), ids.end(), result.category_id) != ids.end();
    };
    if (!dataset.classes_listed) std::erase_if(results, std::not_fn(is_known));
    const auto tell = [&](const auto& evaluation) {
        if (!command.json.empty()) ism::write_file(command.json, ism::to_json(evaluation) + "\n");
        std::fputs(ism::to_table(evaluation).c_str(), stdout);
    };
    const std::string place = ism::file_text(command.detections);
    if (command.coco) return tell(ism::at_place(place, [&] { return ism::evaluate_coco(dataset, results); }));
    const ism::Evaluation evaluation =
        ism::at_place(place, [&] { return ism::evaluate(dataset, results, command.options); });
    if (!command.plot.empty())
        ism::write_file(command.plot, ism::to_svg(ism::precision_recall_plot(evaluation)));
    tell(evaluation);
}

}  // namespace program
