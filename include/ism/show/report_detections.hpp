// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/show/report.hpp"
#include "ism/show/report_explanation.hpp"
#include "ism/show/report_tables.hpp"

namespace ism {

/// @brief An object as a label tells it.
struct ShownLabel {
    std::uint32_t class_index = 0;
    Box box;
    Mask mask = {};        ///< of the image's size; empty = none
    bool missed = false;   ///< no detection found it
    bool ignored = false;  ///< a crowd, or difficult: neither right nor wrong where it is found
};

/// @brief Whether a detection is right, where labels tell; ignored where it lies on what is to be ignored.
enum class Judged { unknown, right, wrong, ignored };

/// @brief How much a report says about one image.
struct DetectionReportOptions {
    std::size_t rows = 5;       ///< detections that are explained: wrong ones first, then the strongest
    std::size_t reasons = 6;    ///< words and features named for each
    std::size_t labelled = 20;  ///< detections with their names in the picture
    double circle_scales = 3;   ///< radius of a feature's circle in multiples of its scale
    ReportPictureOptions picture = {};
    std::span<const ShownLabel> labels = {};  ///< of the image, where they are known
    std::span<const Judged> judged = {};      ///< each detection; empty = not known
    /// The model's, to name the training images that a detection looks like; empty = numbers alone.
    std::span<const TrainingObject> objects = {};
    std::string remark = {};  ///< behind the title of the section
    std::string id = {};      ///< for links to the section
};

/// @brief What a report shows of an image.
struct DetectionPages {
    ReportSection section = {};
    ReportFigure thumbnail = {};              ///< for a list of images; leads to the section
    std::vector<ReportFigure> mistakes = {};  ///< each missed object and wrong detection, for a list of them
};

namespace detail {

inline constexpr Rgb ignored_color{160, 160, 160};

}  // namespace detail

/// @brief What can be hidden in the figures of detections.
[[nodiscard]] inline std::vector<ReportLayer> detection_layers(bool labels) {
    std::vector<ReportLayer> layers = {{"found", "boxes"}, {"mask", "masks"}, {"label", "names"}};
    if (labels) layers.push_back({"labelled", "labels"});
    return layers;
}

/// @brief The colours of classes and, where labels are shown, what they look like, with what is to be
/// ignored.
[[nodiscard]] inline std::vector<ReportKey> detection_legend(std::span<const std::string> class_names,
                                                             bool labels, bool ignored = false) {
    std::vector<ReportKey> legend;
    for (std::size_t c = 0; c < class_names.size(); ++c) legend.push_back({class_names[c], class_color(c)});
    if (labels) legend.push_back({"labelled object", white, true});
    if (labels && ignored) legend.push_back({"ignored: a crowd, or difficult", detail::ignored_color, true});
    return legend;
}

namespace detail {

[[nodiscard]] inline std::string found_svg(const Detection& detection) {
    const std::string color = hex_color(class_color(detection.class_index));
    const Segmentation& cut = detection.segmentation;
    const std::string outline = mask_path(cut.mask, cut.x, cut.y);
    std::string svg;
    if (!outline.empty())
        svg = "<path class=\"mask\" fill-rule=\"evenodd\" d=\"" + outline + "\" fill=\"" + color +
              "\" fill-opacity=\".3\" stroke=\"" + color + "\" stroke-width=\"1.5\"/>";
    return svg + svg_box(detection.box,
                         "class=\"found\" fill=\"none\" stroke=\"" + color + "\" stroke-width=\"2\"");
}

[[nodiscard]] inline std::string labelled_svg(const ShownLabel& label) {
    const std::string outline = mask_path(label.mask);
    std::string svg = "<g class=\"labelled\">";
    for (const char* line : {"truth under", label.ignored ? "truth ignored" : "truth"})
        svg += outline.empty() ? svg_box(label.box, std::string("class=\"") + line + "\"")
                               : std::string("<path class=\"") + line + "\" d=\"" + outline + "\"/>";
    return svg + "</g>\n";
}

[[nodiscard]] inline std::string judged_text(const Detection& detection, std::span<const std::string> names,
                                             Judged judged) {
    const char* mark = judged == Judged::right ? "✓ " : judged == Judged::wrong ? "✗ " : "";
    return mark + label_text(detection, names) + (judged == Judged::ignored ? ", ignored" : "");
}

/// A box with some of its surroundings, as far as there are any.
[[nodiscard]] inline Box with_margin(const Box& box, const ReportPicture& picture) {
    const double margin = std::max(6.0, 0.25 * std::max(box.width, box.height));
    const Box wide{box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin};
    const Box page{0, 0, picture.width, picture.height}, part = intersection(wide, page);
    return part.width >= 4 && part.height >= 4 ? part : page;
}

/// The figures that explain a detection.
[[nodiscard]] inline ReportGallery explanation(std::shared_ptr<const ReportPicture> picture,
                                               const Detections& detections, const Detection& detection,
                                               double circle_scales) {
    const Box part =
        surroundings(detections, detection, int(picture->width), int(picture->height), circle_scales);
    Detection alone;  // without what votes for it, which may lie far off
    alone.box = detection.box, alone.centre = detection.box.centre();
    alone.segmentation = detection.segmentation;
    const Box near = surroundings({}, alone, int(picture->width), int(picture->height), 0);
    ReportGallery gallery;
    gallery.figures = {votes_figure(picture, part, detections, detection, circle_scales)};
    if (!detection.cells.shares.empty()) gallery.figures.push_back(cells_figure(picture, near, detection));
    gallery.figures.push_back(cut_out_figure(picture, near, detection));
    for (ReportFigure& map : map_figures(near, detections, detection))
        gallery.figures.push_back(std::move(map));
    for (ReportFigure& figure : gallery.figures) figure.width_px = figure_width_px(figure.part, 300);
    return gallery;
}

}  // namespace detail

/// @brief What a report shows of an image: all detections in it, beside what its labels tell; then, for those
/// that are wrong and for the strongest, why they were found; and its mistakes one by one.
/// @throws Error where the class of a detection or label has no name, its votes point to features that are
/// not there, or its segmentation's parts differ in size.
[[nodiscard]] inline DetectionPages detection_pages(const std::string& title, ImageView<const Rgb> image,
                                                    const Detections& detections,
                                                    std::span<const std::string> class_names,
                                                    const DetectionReportOptions& options = {}) {
    const auto picture = report_picture(image, options.picture);
    const std::size_t count = detections.objects.size();
    const auto judged = [&](std::size_t i) {
        return i < options.judged.size() ? options.judged[i] : Judged::unknown;
    };
    DetectionPages pages;
    ReportFigure all = picture_figure(picture);
    all.width_px = figure_width_px(all.part, 640);
    for (std::size_t i = count; i-- > 0;) all.shapes += detail::found_svg(detections.objects[i]);
    for (const ShownLabel& label : options.labels) {
        expect(label.class_index < class_names.size(), "class of a label",
               lazy_text("below ", class_names.size()), label.class_index);
        all.shapes += detail::labelled_svg(label);
    }
    std::string names;
    for (std::size_t i = 0; i < std::min(count, options.labelled); ++i) {
        const Detection& one = detections.objects[i];
        all.labels.push_back(
            {one.box, detail::judged_text(one, class_names, judged(i)), class_color(one.class_index)});
        names += (i > 0 ? ", " : ": ") + detail::judged_text(one, class_names, judged(i));
    }
    for (const ShownLabel& label : options.labels)
        if (label.missed) names += ", missed: " + class_names[label.class_index];
    constexpr Rgb missed_color{196, 28, 40};
    const std::string where = options.id.empty() ? "" : "#" + options.id;
    for (const ShownLabel& label : options.labels) {
        if (!label.missed) continue;
        const std::string text = "missed: " + class_names[label.class_index];
        all.labels.push_back({label.box, text, missed_color});
        ReportFigure crop{.caption = text + ", " + title,
                          .picture = picture,
                          .part = detail::with_margin(label.box, *picture)};
        crop.shapes = detail::labelled_svg(label);
        pages.mistakes.push_back(std::move(crop));
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (judged(i) != Judged::wrong) continue;
        const Detection& one = detections.objects[i];
        ReportFigure crop{.caption = join_text("wrong: ", detail::label_text(one, class_names), ", ", title),
                          .picture = picture,
                          .part = detail::with_margin(intersection(one.box, all.part), *picture)};
        crop.shapes = detail::found_svg(one);
        for (const ShownLabel& label : options.labels)
            if (intersection(label.box, crop.part).area() > 0) crop.shapes += detail::labelled_svg(label);
        pages.mistakes.push_back(std::move(crop));
    }
    for (ReportFigure& crop : pages.mistakes)
        crop.width_px = figure_width_px(crop.part, 160), crop.link = where;

    const std::string told =
        count == 0 ? "nothing found" : join_text(count, count == 1 ? " detection" : " detections");
    all.caption = told, all.alt = title + ", " + told + names;
    pages.section = {.title = options.remark.empty() ? title : join_text(title, ": ", options.remark),
                     .id = options.id};
    pages.thumbnail = picture_figure(picture, pages.section.title);
    pages.thumbnail.width_px = figure_width_px(all.part, 150);
    pages.thumbnail.link = where;
    for (const Detection& one : detections.objects)
        pages.thumbnail.shapes +=
            svg_box(one.box, "class=\"found\" fill=\"none\" stroke=\"" +
                                 hex_color(class_color(one.class_index)) + "\" stroke-width=\"2\"");

    pages.section.parts.push_back(std::move(all));
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t i) { return judged(i) == Judged::wrong; });
    const std::size_t shown = std::min(count, options.rows);
    for (std::size_t k = 0; k < shown; ++k) {
        const Detection& detection = detections.objects[order[k]];
        ReportSection why{
            .title = join_text("Why ", detail::judged_text(detection, class_names, judged(order[k]))),
            .folded = true};
        why.parts.push_back(detail::explanation(picture, detections, detection, options.circle_scales));
        if (!detection.box_reasons.empty()) why.parts.push_back(reason_table(detection.box_reasons));
        if (detection.reasons) why.parts.push_back(reason_table(*detection.reasons, options.objects));
        why.parts.push_back(fact_table(detection));
        why.parts.push_back(word_table(detection, options.reasons));
        why.parts.push_back(feature_table(detections, detection, options.reasons));
        pages.section.sections.push_back(std::move(why));
    }
    if (shown < count)
        pages.section.parts.push_back(ReportText{join_text("Explained below: ", shown, " of ", count, ".")});
    return pages;
}

}  // namespace ism
