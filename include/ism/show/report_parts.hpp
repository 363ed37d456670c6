// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"

namespace ism {

/// @brief A paragraph.
struct ReportText {
    std::string text;
};

/// @brief A table; columns of words, such as the first, break long ones, the others stand to the right as
/// numbers do.
struct ReportTable {
    std::string caption = {};
    std::vector<std::string> header = {};
    std::vector<std::vector<std::string>> rows = {};
};

/// @brief The file of a picture, PNG or JPEG, which may be shown by many figures and is in the page once.
struct ReportPicture {
    std::vector<std::uint8_t> file = {};
    double width = 0, height = 0;  ///< in the pixels that figures draw in; the file's may be fewer
};

/// @brief Words at a box of a figure, as large on a small screen as on a large one.
struct ReportLabel {
    Box box;
    std::string text = {};
    Rgb color = {};  ///< of the ground behind the words
};

/// @brief A picture or a part of it, and what is drawn over it.
struct ReportFigure {
    std::string caption = {};
    std::string alt = {};  ///< what it shows, for those who cannot see it; empty = the caption
    std::shared_ptr<const ReportPicture> picture = {};  ///< none = shapes alone
    Box part = {};                                      ///< what is shown, in pixels of the picture
    std::string shapes = {};  ///< SVG elements in pixels of the picture, as they are
    std::vector<ReportLabel> labels = {};
    std::string link = {};  ///< where a click leads; empty = nowhere
    int width_px = 640;     ///< on the screen, at most
};

/// @brief Figures side by side, as many as there is room for.
struct ReportGallery {
    std::vector<ReportFigure> figures = {};
};

/// @brief An `svg` element, such as to_svg() gives; it goes into the page as it is.
struct ReportPlot {
    std::string svg;
};

using ReportPart = std::variant<ReportText, ReportTable, ReportFigure, ReportGallery, ReportPlot>;

/// @brief A part of a report under a heading.
struct ReportSection {
    std::string title = {};
    std::vector<ReportPart> parts = {};
    std::vector<ReportSection> sections = {};  ///< under smaller headings
    bool folded = false;                       ///< only the heading shows until it is clicked
    std::string id = {};                       ///< for links to it: "#" + id
};

/// @brief What a colour, or a line, means.
struct ReportKey {
    std::string name = {};
    Rgb color = {};
    bool dashed = false;
};

/// @brief Shapes of a class of SVG elements, which a reader can hide.
struct ReportLayer {
    std::string css_class = {}, name = {};
};

/// @brief What a report says.
struct Report {
    std::string title = {};
    std::vector<std::pair<std::string, std::string>> summary = {};  ///< what and how much, shown at the top
    std::vector<ReportKey> legend = {};
    std::vector<ReportLayer> layers = {};
    std::vector<ReportSection> sections = {};
};

}  // namespace ism
