// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "tell.hpp"

#include <cmath>
#include <utility>

#include "ism/core/number_text.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/io/paths.hpp"

namespace program {

namespace {

std::string number_text(double number, int decimals) {
    return std::isnan(number) ? "-" : ism::fixed_text(number, decimals);
}

std::string probability_text(const ism::Result& result) {
    if (std::isnan(result.probability)) return "-";
    return ism::fixed_text(100 * result.probability, result.probability < 0.99 ? 0 : 1) + " %";
}

std::string box_text(const ism::Box& box) {
    std::string text;
    for (const double side : {box.x, box.y, box.width, box.height})
        text += (text.empty() ? "" : ", ") + ism::fixed_text(side, 0);
    return text;
}

std::string position_text(const ism::Result& result) {
    if (!result.position_m) return "-";
    const auto& [x, y, z] = *result.position_m;
    std::string text =
        "(" + ism::fixed_text(x, 3) + ", " + ism::fixed_text(y, 3) + ", " + ism::fixed_text(z, 3) + ") m";
    if (!std::isnan(result.position_error_m)) text += " ± " + ism::fixed_text(result.position_error_m, 3);
    return text;
}

ism::detail::Json detection_json(const ism::Result& result) {
    ism::detail::Json record = ism::detail::result_to_json(result);
    record.erase("image_id");
    return record;
}

}  // namespace

std::string object_lines(const FoundInImage& found) {
    std::string lines;
    for (const ism::Result& result : found.results) {
        lines += ism::one_line(found.name) + '\t' + ism::one_line(result.class_name) + '\t' +
                 number_text(result.probability, 3);
        for (const double side : {result.box.x, result.box.y, result.box.width, result.box.height})
            lines += '\t' + number_text(side, 1);
        lines += '\t' + number_text(result.depth_m, 3);
        const double unknown = std::nan("");
        const ism::Point3 position = result.position_m.value_or(ism::Point3{unknown, unknown, unknown});
        for (const double number : {position.x, position.y, position.z, result.position_error_m})
            lines += '\t' + number_text(number, 3);
        lines += '\n';
    }
    return lines;
}

std::string object_table(std::span<const FoundInImage> found) {
    std::vector<std::vector<std::string>> rows = {{"image", "class", "probability", "x, y, width, height"}};
    bool depth = false, position = false;
    for (const FoundInImage& image : found)
        for (const ism::Result& result : image.results)
            depth |= !std::isnan(result.depth_m), position |= result.position_m.has_value();
    if (depth) rows[0].emplace_back("depth");
    if (position) rows[0].emplace_back("position (right, down, ahead)");
    for (const FoundInImage& image : found)
        for (const ism::Result& result : image.results) {
            rows.push_back({ism::one_line(image.name), ism::one_line(result.class_name),
                            probability_text(result), box_text(result.box)});
            if (depth)
                rows.back().push_back(std::isnan(result.depth_m) ? "-"
                                                                 : ism::fixed_text(result.depth_m, 2) + " m");
            if (position) rows.back().push_back(position_text(result));
        }
    if (rows.size() == 1) return {};
    if (found.size() == 1)
        for (auto& row : rows) row.erase(row.begin());
    return ism::align_columns(rows);
}

std::string json_line(const FoundInImage& found) {
    using ism::detail::Json;
    Json line = {{"file", found.name}, {"width", found.width}, {"height", found.height}};
    if (found.image_id) line["image_id"] = *found.image_id;
    line["detections"] = Json::array();
    for (const ism::Result& result : found.results) line["detections"].push_back(detection_json(result));
    if (found.next_best) line["next_best"] = detection_json(*found.next_best);
    return line.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string nothing_found_text(const FoundInImage& found) {
    std::string text = ism::one_line(found.name) + ": nothing found";
    if (!found.next_best || found.next_best->probability < 0.01) return text;
    const ism::Result& best = *found.next_best;
    text += "; the best guess is " + ism::one_line(best.class_name) + ", " + probability_text(best);
    if (!found.best_is_cut_out)
        return text + " before it is cut out, at " + box_text(best.box) + " (--min-score 0 tells it)";
    // a limit of two digits that the guess meets
    const double limit = std::floor(100 * best.probability) / 100;
    return text + ", at " + box_text(best.box) + " (told with --min-score " + ism::fixed_text(limit, 2) + ")";
}

}  // namespace program
