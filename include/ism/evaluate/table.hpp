// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/number_text.hpp"
#include "ism/evaluate/coco_rule.hpp"
#include "ism/evaluate/evaluate.hpp"
#include "ism/io/paths.hpp"
#include "ism/show/short_text.hpp"

namespace ism {

/// @brief A share as percent with one decimal: 0.8347 as "83.5", NaN as "-".
[[nodiscard]] inline std::string percent_text(double share) {
    if (std::isnan(share)) return "-";
    return fixed_text(100 * share, 1);
}

namespace detail {

/// Number of characters of UTF-8 text.
[[nodiscard]] inline std::size_t letter_count(const std::string& text) {
    return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace detail

/// @brief Rows of cells as text: the first column left-aligned, the others right-aligned, two blanks between;
/// a newline after each row. Short rows are filled with empty cells.
[[nodiscard]] inline std::string align_columns(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (i == widths.size()) widths.push_back(0);
            widths[i] = std::max(widths[i], detail::letter_count(row[i]));
        }
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string blanks(widths[i] - detail::letter_count(row[i]), ' ');
            line += (i > 0 ? "  " : "") + (i > 0 ? blanks + row[i] : row[i] + blanks);
        }
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

/// @brief The mean IoU of masks in percent, and where some right detections or their objects have none, of
/// how many it is: "87.5 (3 of 4)".
[[nodiscard]] inline std::string mask_iou_text(const ClassEvaluation& c) {
    const std::string text = percent_text(c.figures.mask_iou);
    if (c.masks == 0 || c.masks == c.true_positives) return text;
    return join_text(text, " (", c.masks, " of ", c.true_positives, ")");
}

/// @brief The cells of the table of an evaluation: a heading, a row for each class and their mean, percent.
/// "EER" is the precision where it equals recall.
[[nodiscard]] inline std::vector<std::vector<std::string>> table_cells(const Evaluation& evaluation) {
    std::vector<std::vector<std::string>> rows = {
        {"class", "objects", "detections", "right", "AP %", "EER %", "F1 %", "mask IoU %"}};
    ClassEvaluation all;
    all.name = "mean", all.figures = evaluation.mean;
    const auto add = [&](const ClassEvaluation& c) {
        rows.push_back({c.name, std::to_string(c.objects), std::to_string(c.detections),
                        std::to_string(c.true_positives)});
        for (const double figure : {c.figures.ap, c.figures.eer, c.figures.best_f1})
            rows.back().push_back(percent_text(figure));
        rows.back().push_back(mask_iou_text(c));
    };
    for (const ClassEvaluation& c : evaluation.classes) {
        add(c);
        all.objects += c.objects, all.detections += c.detections;
        all.true_positives += c.true_positives, all.masks += c.masks;
    }
    add(all);
    return rows;
}

/// @brief The cells of the confusion matrix: a row for each true class, a column for each class it was taken
/// for and one for "none", images.
[[nodiscard]] inline std::vector<std::vector<std::string>> table_cells(
    const Confusion& confusion, const std::vector<ClassEvaluation>& classes) {
    std::vector<std::vector<std::string>> rows = {{"true \\ detected as"}};
    for (const ClassEvaluation& c : classes) rows[0].push_back(c.name);
    rows[0].emplace_back("none");
    for (std::size_t truth = 0; truth < confusion.class_count; ++truth) {
        rows.push_back({classes.at(truth).name});
        for (std::size_t found = 0; found <= confusion.class_count; ++found)
            rows.back().push_back(std::to_string(confusion.count(truth, found)));
    }
    return rows;
}

namespace detail {

/// Cells as text, their first column and the heading, which are names, short and each in a line.
[[nodiscard]] inline std::string named_rows(std::vector<std::vector<std::string>> rows) {
    constexpr std::size_t most_letters = 32, most_in_heading = 14;
    for (std::size_t column = 1; column < rows[0].size(); ++column)
        rows[0][column] = shortened(one_line(rows[0][column]), most_in_heading);
    for (auto& row : rows) row[0] = shortened(one_line(row[0]), most_letters);
    return align_columns(rows);
}

/// The classes that were taken for others, most images first.
[[nodiscard]] inline std::string confusions_text(const Confusion& confusion,
                                                 const std::vector<ClassEvaluation>& classes) {
    constexpr std::size_t most_rows = 20, most_letters = 28;
    const std::size_t count = confusion.class_count;
    const auto name = [&](std::size_t c) {
        return c < count ? shortened(one_line(classes.at(c).name), most_letters) : std::string("none");
    };
    std::vector<std::pair<std::size_t, std::size_t>> wrong;
    for (std::size_t truth = 0; truth < count; ++truth)
        for (std::size_t found = 0; found <= count; ++found)
            if (found != truth && confusion.count(truth, found) > 0) wrong.emplace_back(truth, found);
    if (wrong.empty()) return "no class was taken for another\n";
    std::stable_sort(wrong.begin(), wrong.end(), [&](const auto& a, const auto& b) {
        return confusion.count(a.first, a.second) > confusion.count(b.first, b.second);
    });
    std::vector<std::vector<std::string>> rows = {{"true -> detected as", "images"}};
    for (std::size_t k = 0; k < std::min(most_rows, wrong.size()); ++k)
        rows.push_back({name(wrong[k].first) + " -> " + name(wrong[k].second),
                        std::to_string(confusion.count(wrong[k].first, wrong[k].second))});
    std::string text = align_columns(rows);
    if (wrong.size() > most_rows) text += join_text("... and ", wrong.size() - most_rows, " more\n");
    return text;
}

}  // namespace detail

/// @brief An evaluation as lines of text with aligned columns: figures in percent ("-" = nothing to measure),
/// then, where every image holds one object, the accuracy and for several classes the confusion matrix; of
/// more than twelve the confusions that happened, the worst first. Long names are shortened.
[[nodiscard]] inline std::string to_table(const Evaluation& evaluation) {
    constexpr std::size_t largest_matrix = 12;
    std::string text = detail::named_rows(table_cells(evaluation));
    if (!evaluation.confusion) return text;
    text += "\naccuracy " + percent_text(evaluation.confusion->accuracy()) +
            " %: images whose best detection is of the right class, wherever it lies\n";
    if (evaluation.classes.size() < 2) return text;
    return text + '\n' +
           (evaluation.classes.size() > largest_matrix
                ? detail::confusions_text(*evaluation.confusion, evaluation.classes)
                : detail::named_rows(table_cells(*evaluation.confusion, evaluation.classes)));
}

/// @brief An evaluation by COCO's rule as lines of text: figures in percent, "-" = nothing to measure.
[[nodiscard]] inline std::string to_table(const CocoEvaluation& evaluation) {
    std::vector<std::vector<std::string>> rows = {
        {"class", "objects", "detections", "AP %", "AP50 %", "AP75 %", "recall %"}};
    const auto add = [&](std::vector<std::string> row, const CocoFigures& figures) {
        for (const double figure : {figures.ap, figures.ap50, figures.ap75, figures.recall})
            row.push_back(percent_text(figure));
        rows.push_back(std::move(row));
    };
    std::size_t objects = 0, detections = 0;
    for (const CocoClass& c : evaluation.classes) {
        add({c.name, std::to_string(c.objects), std::to_string(c.detections)}, c.figures);
        objects += c.objects, detections += c.detections;
    }
    add({"mean", std::to_string(objects), std::to_string(detections)}, evaluation.mean);
    return detail::named_rows(std::move(rows));
}

}  // namespace ism
