// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "ism/show/markup.hpp"
#include "ism/show/report_style.hpp"

namespace ism {

/// @brief A paragraph.
struct ReportText {
    std::string text;
};

/// @brief A table; the first column is text, the others stand to the right as numbers do.
struct ReportTable {
    std::string caption = {};
    std::vector<std::string> header = {};
    std::vector<std::vector<std::string>> rows = {};
};

/// @brief An image with its PNG file's bytes.
struct ReportImage {
    std::string caption = {};
    std::vector<std::uint8_t> png = {};
};

/// @brief An <svg> element, such as to_svg() gives; it goes into the page as it is.
struct ReportPlot {
    std::string svg;
};

using ReportPart = std::variant<ReportText, ReportTable, ReportImage, ReportPlot>;

/// @brief A part of a report under a heading.
struct ReportSection {
    std::string title = {};
    std::vector<ReportPart> parts = {};
    std::vector<ReportSection> sections = {};  ///< under smaller headings
    bool folded = false;                       ///< only the heading shows until it is clicked
};

/// @brief What a report says.
struct Report {
    std::string title = {};
    std::vector<std::pair<std::string, std::string>> summary = {};  ///< what and how much, shown at the top
    std::vector<ReportSection> sections = {};
};

namespace detail {

[[nodiscard]] inline std::string element(std::string_view name, std::string_view text) {
    return join_text("<", name, ">", escape_markup(text), "</", name, ">");
}

[[nodiscard]] inline std::string to_html(const ReportText& part) {
    return element("p", part.text) + "\n";
}

[[nodiscard]] inline std::string to_html(const ReportTable& part) {
    std::string html = "<div class=\"wide\"><table>\n";
    if (!part.caption.empty()) html += element("caption", part.caption) + "\n";
    if (!part.header.empty()) {
        html += "<thead><tr>";
        for (const std::string& cell : part.header) html += element("th", cell);
        html += "</tr></thead>\n";
    }
    html += "<tbody>\n";
    for (const auto& row : part.rows) {
        html += "<tr>";
        for (const std::string& cell : row) html += element("td", cell);
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

/// Width of a PNG file's image over its height; 0 where the bytes are none.
[[nodiscard]] inline double png_aspect(const std::vector<std::uint8_t>& png) {
    if (png.size() < 24) return 0;
    const auto side = [&](std::size_t at) {
        double value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value * 256 + png[at + i];
        return value;
    };
    return side(20) > 0 ? side(16) / side(20) : 0;
}

[[nodiscard]] inline std::string to_html(const ReportImage& part) {
    std::string html = png_aspect(part.png) > 2.5 ? "<figure class=\"row\">" : "<figure>";
    html += "<img loading=\"lazy\" alt=\"" + escape_markup(part.caption) + "\" src=\"data:image/png;base64," +
            base64(part.png) + "\">";
    if (!part.caption.empty()) html += element("figcaption", part.caption);
    return html + "</figure>\n";
}

[[nodiscard]] inline std::string to_html(const ReportPlot& part) {
    return "<figure>" + part.svg + "</figure>\n";
}

[[nodiscard]] inline std::string to_html(const ReportSection& section, int level) {
    const std::string heading = element(level < 4 ? (level == 2 ? "h2" : "h3") : "h4", section.title);
    std::string html =
        section.folded ? "<details><summary>" + heading + "</summary>\n" : "<section>" + heading + "\n";
    for (const ReportPart& part : section.parts)
        html += std::visit([](const auto& p) { return to_html(p); }, part);
    for (const ReportSection& inner : section.sections) html += to_html(inner, level + 1);
    return html + (section.folded ? "</details>\n" : "</section>\n");
}

}  // namespace detail

/// @brief The report as one HTML page that needs no other file: images are inside it, there are no scripts.
[[nodiscard]] inline std::string to_html(const Report& report) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    html += detail::element("title", report.title) + "\n<style>" + std::string(detail::report_style) +
            "</style>\n</head>\n<body>\n<main>\n" + detail::element("h1", report.title) + "\n";
    if (!report.summary.empty()) {
        html += "<dl>\n";
        for (const auto& [what, value] : report.summary)
            html += "<div>" + detail::element("dt", what) + detail::element("dd", value) + "</div>\n";
        html += "</dl>\n";
    }
    for (const ReportSection& section : report.sections) html += detail::to_html(section, 2);
    return html + "</main>\n</body>\n</html>\n";
}

}  // namespace ism
