// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ism/io/base64.hpp"
#include "ism/show/color.hpp"
#include "ism/show/report_labels.hpp"
#include "ism/show/report_parts.hpp"
#include "ism/show/report_style.hpp"
#include "ism/show/svg.hpp"

namespace ism {

/// @brief Pictures that a page shows from files beside it.
struct LinkedPictures {
    std::string folder = {};  ///< the page's address of it, with / between folders and %20 for blanks; empty
                              ///< = that of the page
    struct File {
        std::string name = {};  ///< in the folder
        std::vector<std::uint8_t> bytes = {};
    };
    std::vector<File> files = {};  ///< to_html() adds them
};

namespace detail {

/// The pictures of a page, each once.
using PagePictures = std::vector<const ReportPicture*>;

[[nodiscard]] inline std::string element(std::string_view name, std::string_view text) {
    return join_text("<", name, ">", escape_markup(text), "</", name, ">");
}

[[nodiscard]] inline bool is_png(const std::vector<std::uint8_t>& file) {
    return file.size() > 1 && file[0] == 0x89 && file[1] == 'P';
}

[[nodiscard]] inline std::string to_html(const ReportText& part, PagePictures&) {
    return element("p", part.text) + "\n";
}

/// Whether a column holds words: the first does, and those with a letter at the beginning of a cell.
[[nodiscard]] inline bool is_text_column(const ReportTable& table, std::size_t column) {
    return column == 0 || table.header.empty() ||
           std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
               if (column >= row.size() || row[column].empty()) return false;
               const auto byte = static_cast<unsigned char>(row[column][0] | 0x20);  // of a small letter
               return byte >= 'a' && byte <= 'z';
           });
}

[[nodiscard]] inline std::string to_html(const ReportTable& part, PagePictures&) {
    std::string html = part.header.empty() ? "<div class=\"wide\"><table>\n"
                                           : "<div class=\"wide\" tabindex=\"0\"><table>\n";
    std::vector<const char*> kinds;  // of columns
    const auto kind = [&](std::size_t column) {
        while (kinds.size() <= column)
            kinds.push_back(is_text_column(part, kinds.size()) ? " class=\"text\"" : "");
        return kinds[column];
    };
    if (!part.caption.empty()) html += element("caption", part.caption) + "\n";
    if (!part.header.empty()) {
        html += "<thead><tr>";
        for (std::size_t i = 0; i < part.header.size(); ++i)
            html += join_text("<th scope=\"col\"", kind(i), ">", escape_markup(part.header[i]), "</th>");
        html += "</tr></thead>\n";
    }
    html += "<tbody>\n";
    for (const auto& row : part.rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i)
            html += join_text("<td", kind(i), ">", escape_markup(row[i]), "</td>");
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

[[nodiscard]] inline std::string to_html(const ReportFigure& part, PagePictures& pictures) {
    const Box& shown = part.part;
    expect(shown.width > 0 && shown.height > 0, "part of a figure", "some pixels",
           lazy_text(shown.width, "x", shown.height));
    const auto number = [](double value) { return svg_number(value); };
    std::string html = "<figure style=\"width:" + std::to_string(part.width_px) + "px\">";
    if (!part.link.empty()) html += "<a href=\"" + escape_markup(part.link) + "\">";
    html += std::string("<div class=\"") + (part.picture ? "pic" : "pic bare") + "\"><svg viewBox=\"" +
            number(shown.x) + " " + number(shown.y) + " " + number(shown.width) + " " + number(shown.height) +
            "\" role=\"img\" aria-label=\"" + escape_markup(part.alt.empty() ? part.caption : part.alt) +
            "\">";
    if (part.picture) {
        auto at = std::find(pictures.begin(), pictures.end(), part.picture.get());
        if (at == pictures.end()) at = pictures.insert(at, part.picture.get());
        html += join_text("<use href=\"#p", at - pictures.begin(), "\"/>");
    }
    html += part.shapes + "</svg>";
    const std::vector<LabelPlace> places =
        place_labels(shown, part.labels, std::min(330.0, double(part.width_px)));
    for (std::size_t i = 0; i < places.size(); ++i) {
        const ReportLabel& label = part.labels[i];
        html += std::string("<span aria-hidden=\"true\" dir=\"auto\" class=\"label") +
                (places[i].above ? " above" : "") + "\" style=\"left:" + number(places[i].left) +
                "%;top:" + number(places[i].top) + "%;background:" + hex_color(label.color) +
                ";color:" + hex_color(ink_on(label.color)) + "\">" + escape_markup(label.text) + "</span>";
    }
    html += "</div>";
    if (!part.caption.empty()) html += element("figcaption", part.caption);
    return html + (part.link.empty() ? "</figure>\n" : "</a></figure>\n");
}

[[nodiscard]] inline std::string to_html(const ReportGallery& part, PagePictures& pictures) {
    std::string html = "<div class=\"gallery\">\n";
    for (const ReportFigure& figure : part.figures) html += to_html(figure, pictures);
    return html + "</div>\n";
}

[[nodiscard]] inline std::string to_html(const ReportPlot& part, PagePictures&) {
    return "<figure>" + part.svg + "</figure>\n";
}

[[nodiscard]] inline std::string to_html(const ReportSection& section, int level, PagePictures& pictures) {
    const std::string heading = element(level < 4 ? (level == 2 ? "h2" : "h3") : "h4", section.title);
    const std::string id = section.id.empty() ? "" : " id=\"" + escape_markup(section.id) + "\"";
    std::string html = section.folded ? "<details" + id + "><summary>" + heading + "</summary>\n"
                                      : "<section" + id + ">" + heading + "\n";
    for (const ReportPart& part : section.parts)
        html += std::visit([&](const auto& p) { return to_html(p, pictures); }, part);
    for (const ReportSection& inner : section.sections) html += to_html(inner, level + 1, pictures);
    return html + (section.folded ? "</details>\n" : "</section>\n");
}

/// Title, summary, legend and what can be hidden.
[[nodiscard]] inline std::string head_html(const Report& report) {
    std::string html = element("h1", report.title) + "\n";
    if (!report.summary.empty()) {
        html += "<dl>\n";
        for (const auto& [what, value] : report.summary)
            html += "<div>" + element("dt", what) + element("dd", value) + "</div>\n";
        html += "</dl>\n";
    }
    if (!report.legend.empty()) {
        html += "<ul class=\"legend\" aria-label=\"legend\">\n";
        for (const ReportKey& key : report.legend)
            html += std::string("<li dir=\"auto\"><i class=\"") + (key.dashed ? "dashed" : "full") +
                    "\" style=\"--c:" + hex_color(key.color) + "\"></i>" + escape_markup(key.name) +
                    "</li>\n";
        html += "</ul>\n";
    }
    if (!report.layers.empty()) {
        html += "<p class=\"layers\">Show:";
        for (const ReportLayer& layer : report.layers)
            html += " <label><input type=\"checkbox\" checked id=\"show-" + escape_markup(layer.css_class) +
                    "\"> " + escape_markup(layer.name) + "</label>";
        html += "</p>\n";
    }
    return html;
}

}  // namespace detail

/// @brief The report as one HTML page without scripts, light or dark as the reader's screen is. Each picture
/// is in the page once, or in a file beside it.
/// @param linked  takes the pictures' files, to be written beside the page; none = they are in the page,
/// which
///                then needs no other file. Several pages may share it
/// @throws Error where a figure shows no pixels.
[[nodiscard]] inline std::string to_html(const Report& report, LinkedPictures* linked = nullptr) {
    detail::PagePictures pictures;
    std::string body = detail::head_html(report);
    for (const ReportSection& section : report.sections) body += detail::to_html(section, 2, pictures);
    std::string style(detail::report_style);
    for (const ReportLayer& layer : report.layers)
        style += ":root:has(#show-" + layer.css_class + ":not(:checked)) ." + layer.css_class +
                 " { display: none; }\n";
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<link rel=\"icon\" href=\"data:,\">\n" +
        detail::element("title", report.title) + "\n<style>" + style + "</style>\n</head>\n<body>\n";
    if (!pictures.empty()) html += "<svg class=\"pictures\" aria-hidden=\"true\"><defs>\n";
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const ReportPicture& picture = *pictures[i];
        const bool png = detail::is_png(picture.file);
        std::string address = std::string("data:image/") + (png ? "png" : "jpeg") + ";base64," +
                              (linked ? "" : base64(picture.file));
        if (linked) {
            linked->files.push_back(
                {join_text(linked->files.size() + 1, png ? ".png" : ".jpg"), picture.file});
            address = (linked->folder.empty() ? "" : linked->folder + "/") + linked->files.back().name;
        }
        html += join_text("<image id=\"p", i, "\" width=\"") + detail::svg_number(picture.width) +
                "\" height=\"" + detail::svg_number(picture.height) +
                "\" preserveAspectRatio=\"none\" href=\"" + escape_markup(address) + "\"/>\n";
    }
    if (!pictures.empty()) html += "</defs></svg>\n";
    return html + "<main>\n" + body + "</main>\n</body>\n</html>\n";
}

}  // namespace ism
