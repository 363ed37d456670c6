// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/dataset/inspect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "commands.hpp"
#include "data.hpp"
#include "input.hpp"
#include "page.hpp"
#include "pictures.hpp"
#include "progress.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/show/short_text.hpp"

namespace program {

namespace {

constexpr std::size_t few_examples = 5;

/// A remark and the image it is on.
struct Placed {
    std::size_t image = 0;
    ism::Remark remark;
};

/// What is in a data set.
struct Contents {
    std::vector<ism::ImageFacts> images;
    std::vector<std::string> of_set;                     ///< remarks on no single image
    std::map<std::string, std::vector<Placed>> by_kind;  ///< the others
};

/// A label of a class and where it is.
struct Example {
    std::size_t image = 0;
    ism::ObjectFacts facts;
};

Contents look(const ism::Dataset& dataset, unsigned threads) {
    Contents contents;
    contents.images.resize(dataset.images.size());
    {
        ProgressLine progress;
        ism::parallel_for(dataset.images.size(), threads, [&](std::size_t i) {
            const ism::DatasetImage& image = dataset.images[i];
            try {
                contents.images[i] = ism::inspect_image(image, ism::read_frame(image, read_picture));
            } catch (const ism::Error& error) {
                ism::ImageFacts& facts = contents.images[i];
                facts.remarks.push_back({.kind = "file that cannot be used", .text = error.what()});
                for (std::size_t k = 0; k < image.objects.size(); ++k)  // what the label alone tells
                    if (!image.objects[k].crowd)
                        facts.objects.push_back(
                            {.object = k, .size_px = std::sqrt(image.objects[k].box.area())});
            }
            progress.step("looking at images", dataset.images.size());
        });
    }
    std::map<std::uint64_t, std::size_t> first;
    for (std::size_t i = 0; i < contents.images.size(); ++i) {
        ism::ImageFacts& facts = contents.images[i];
        if (facts.fingerprint != 0) {
            const auto [same, is_new] = first.emplace(facts.fingerprint, i);
            const ism::DatasetImage& other = dataset.images[same->second];
            if (!is_new)
                facts.remarks.push_back({.kind = same_labels(dataset.images[i], other)
                                                     ? "same picture twice"
                                                     : "same picture twice, with other labels",
                                         .text = "also " + short_name(dataset, other)});
        }
        for (const ism::Remark& remark : facts.remarks) contents.by_kind[remark.kind].push_back({i, remark});
    }
    return contents;
}

std::vector<std::vector<Example>> by_class(const ism::Dataset& dataset, const Contents& contents) {
    std::vector<std::vector<Example>> examples(dataset.class_names.size());
    for (std::size_t i = 0; i < contents.images.size(); ++i)
        for (const ism::ObjectFacts& facts : contents.images[i].objects)
            examples[dataset.images[i].objects[facts.object].class_index].push_back({i, facts});
    return examples;
}

/// The least, the median and the largest of some numbers: "2.5 … 45 … 1200".
std::string spread_text(std::vector<double> values) {
    if (values.empty()) return ism::number_text(NAN);
    std::sort(values.begin(), values.end());
    const auto text = [](double value) {
        return value < 100 ? ism::number_text(value, 3) : ism::fixed_text(value, 0);
    };
    const double median = (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
    return ism::join_text(text(values.front()), " … ", text(median), " … ", text(values.back()));
}

/// The first of some texts, and how many more there are.
std::string some_text(std::vector<std::string> texts) {
    constexpr std::size_t most = 10;
    const std::size_t more = texts.size() - std::min(most, texts.size());
    texts.resize(texts.size() - more);
    return list_text(texts) + (more > 0 ? ism::join_text(" and ", more, " more") : "");
}

std::vector<std::vector<std::string>> class_table(const ism::Dataset& dataset,
                                                  const std::vector<std::vector<Example>>& examples,
                                                  bool depth) {
    std::vector<std::vector<std::string>> rows = {{"class", "objects", "images", "masks", "size px"}};
    if (depth) rows[0].insert(rows[0].end(), {"distance m", "depth %"});
    for (std::size_t c = 0; c < examples.size(); ++c) {
        std::vector<std::size_t> images;
        std::vector<double> sizes, distances;
        std::size_t masks = 0;
        double share = 0;
        for (const Example& one : examples[c]) {
            if (images.empty() || images.back() != one.image) images.push_back(one.image);
            sizes.push_back(one.facts.size_px), masks += one.facts.masked, share += one.facts.depth_share;
            if (ism::is_depth(one.facts.depth_m)) distances.push_back(one.facts.depth_m);
        }
        rows.push_back({dataset.class_names[c], std::to_string(examples[c].size()),
                        std::to_string(images.size()), std::to_string(masks), spread_text(sizes)});
        if (depth)
            rows.back().insert(rows.back().end(),
                               {spread_text(distances),
                                examples[c].empty() ? ism::number_text(NAN)
                                                    : ism::percent_text(share / double(examples[c].size()))});
    }
    return rows;
}

/// A part of an image with one of its labels, small enough for many on a page.
ism::ReportFigure crop_figure(const ism::Dataset& dataset, std::size_t i, std::size_t object,
                              std::string caption) {
    constexpr ism::ReportPictureOptions small = {.side_px = 220, .most_bytes = 7000};
    const ism::DatasetImage& image = dataset.images[i];
    ism::RgbImage color;
    try {
        color = program::read_picture(image.file, ism::ImageSize{image.width, image.height}).color;
    } catch (const ism::Error&) {  // said in words
        color = ism::RgbImage(std::max(1, image.width), std::max(1, image.height), {128, 128, 128});
    }
    ism::Box part{0, 0, double(color.width()), double(color.height())};
    ism::ShownLabel label;
    const bool whole = object == ism::Remark::whole_image;
    if (!whole) {
        const ism::DatasetAnnotation& one = image.objects[object];
        label = {.class_index = one.class_index, .box = one.box};
        try {
            label.mask = ism::read_mask(image, one);
        } catch (const ism::Error&) {
        }
        const ism::ReportPicture page{.width = part.width, .height = part.height};
        part = ism::detail::with_margin(ism::intersection(one.box, part), page);
        part.x = std::floor(part.x), part.y = std::floor(part.y);
        part.width = std::floor(part.width), part.height = std::floor(part.height);
    }
    ism::ReportPicture picture = *ism::report_picture(
        color.view().region(int(part.x), int(part.y), int(part.width), int(part.height)), small);
    ism::ReportFigure figure{.caption = std::move(caption),
                             .picture = std::make_shared<ism::ReportPicture>(picture)};
    figure.part = {0, 0, part.width, part.height};
    if (!whole) {
        const std::string fill = ism::hex_color(ism::class_color(label.class_index));
        const std::string outline = ism::mask_path(label.mask);
        figure.shapes = "<g transform=\"translate(" + ism::detail::tenth(-part.x) + " " +
                        ism::detail::tenth(-part.y) + ")\">";
        if (!outline.empty())
            figure.shapes += "<path class=\"mask\" fill-rule=\"evenodd\" d=\"" + outline + "\" fill=\"" +
                             fill + "\" fill-opacity=\".3\" stroke=\"" + fill + "\" stroke-width=\"2\"/>";
        figure.shapes += ism::svg_box(label.box, "class=\"found\" fill=\"none\" stroke=\"" + fill +
                                                     "\" stroke-width=\"2\"") +
                         "</g>";
    }
    figure.width_px = ism::figure_width_px(figure.part, 150);
    return figure;
}

/// How many objects there are of each size: a bar for each factor of √2, under its number.
std::string size_plot(const std::vector<Example>& examples, ism::Rgb color) {
    constexpr std::size_t bars = 15;  // 8 … 1024 px
    std::array<std::size_t, bars> counts{};
    std::size_t most = 1;
    for (const Example& one : examples) {
        const double at = 2 * std::log2(std::max(1.0, one.facts.size_px) / 8);
        most = std::max(most, ++counts[std::size_t(std::clamp(at, 0.0, double(bars - 1)))]);
    }
    std::string svg =
        "<svg class=\"plot\" viewBox=\"0 0 340 120\" width=\"340\" height=\"120\" role=\"img\" "
        "aria-label=\"how large the objects are\" font-size=\"12\">";
    for (std::size_t i = 0; i < bars; ++i) {
        const double height = 76 * double(counts[i]) / double(most);
        svg += "<path d=\"" + ism::detail::rectangle_path({20 + 20.0 * double(i), 90 - height, 18, height}) +
               "\" style=\"stroke:none;fill:" + ism::hex_color(color) + "\"/>";
        if (counts[i] > 0)
            svg += ism::detail::svg_text(29 + 20.0 * double(i), 87 - height, std::to_string(counts[i]),
                                         "text-anchor=\"middle\" font-size=\"10\"");
        if (i % 2 == 0)
            svg += ism::detail::svg_text(20 + 20.0 * double(i), 105, std::to_string(8u << (i / 2)),
                                         "text-anchor=\"middle\"");
    }
    return svg + ism::detail::svg_text(320, 118, "size, px", "text-anchor=\"end\"") + "</svg>";
}

ism::Report page_of(const ism::Dataset& dataset, const Contents& contents,
                    const std::vector<std::vector<Example>>& examples,
                    std::vector<std::pair<std::string, std::string>> summary,
                    const std::vector<std::vector<std::string>>& table) {
    constexpr std::size_t most_crops = 56, most_faults = 24, crops_a_kind = 6, texts_a_kind = 12;
    ism::Report report{.title = "Data set " + ism::path_to_utf8(dataset.source.filename()),
                       .summary = std::move(summary)};
    report.legend = ism::detection_legend(dataset.class_names, false);
    report.layers = {{"found", "boxes"}, {"mask", "masks"}};

    std::vector<std::string> names = short_names(dataset);
    if (std::string folder = take_folder(names); !folder.empty())
        report.summary.emplace_back("folder", std::move(folder));

    ism::ReportSection wrong{.title = "What looks wrong"};
    for (const std::string& remark : contents.of_set) wrong.parts.push_back(ism::ReportText{remark});
    std::size_t crops = 0;
    for (const auto& [kind, remarks] : contents.by_kind) {
        ism::ReportSection section{.title = ism::join_text(kind, ": ", remarks.size())};
        ism::ReportGallery gallery;
        ism::ReportTable texts{.header = {"image", "what"}};
        for (const Placed& one : remarks) {
            const std::string& name = names[one.image];
            if (texts.rows.size() < texts_a_kind) texts.rows.push_back({name, one.remark.text});
            if (kind == "file that cannot be used" || gallery.figures.size() >= crops_a_kind ||
                crops >= most_faults)
                continue;
            gallery.figures.push_back(crop_figure(dataset, one.image, one.remark.object,
                                                  ism::join_text(name, ": ", one.remark.text)));
            ++crops;
        }
        if (gallery.figures.size() < remarks.size()) section.parts.push_back(std::move(texts));
        if (!gallery.figures.empty()) section.parts.push_back(std::move(gallery));
        wrong.sections.push_back(std::move(section));
    }
    if (contents.of_set.empty() && contents.by_kind.empty())
        wrong.parts.push_back(ism::ReportText{"Nothing was noticed."});
    report.sections.push_back(std::move(wrong));

    ism::ReportSection classes{.title = "Classes"};
    classes.parts.push_back(
        ism::ReportTable{.caption = "size: root of the box's area; least … median … largest",
                         .header = table.front(),
                         .rows = {table.begin() + 1, table.end()}});
    report.sections.push_back(std::move(classes));
    const std::size_t each =
        std::clamp<std::size_t>(most_crops / std::max<std::size_t>(1, examples.size()), 1, 10);
    for (std::size_t c = 0; c < examples.size(); ++c) {
        if (examples[c].empty()) continue;
        ism::ReportSection section{.title = dataset.class_names[c], .folded = c >= most_crops};
        ism::ReportGallery gallery;
        const std::size_t shown = c < most_crops ? std::min(each, examples[c].size()) : 0;
        for (std::size_t k = 0; k < shown; ++k) {  // evenly from all
            const Example& one = examples[c][k * examples[c].size() / shown];
            gallery.figures.push_back(crop_figure(dataset, one.image, one.facts.object, names[one.image]));
        }
        if (shown < examples[c].size())
            section.parts.push_back(ism::ReportText{ism::join_text(shown, " of ", examples[c].size(), ":")});
        if (shown > 0) section.parts.push_back(std::move(gallery));
        section.parts.push_back(ism::ReportPlot{size_plot(examples[c], ism::class_color(c))});
        report.sections.push_back(std::move(section));
    }
    return report;
}

}  // namespace

void run_inspect(const InspectCommand& command) {
    if (!command.report.empty()) check_page(command.report, std::array{command.data}, command.page);
    ism::Faults faults;
    const ism::Dataset dataset = read_labels(command.data, ism::DatasetPart::train, faults);
    check_not_labels(dataset, std::array{command.report});
    Contents contents = look(dataset, command.threads);
    constexpr std::size_t most_faults = 20;
    for (std::size_t i = 0; i < std::min(most_faults, faults.size()); ++i)
        contents.of_set.push_back("label that cannot be used: " + faults[i]);
    if (faults.size() > most_faults)
        contents.of_set.push_back(
            ism::join_text("... and ", faults.size() - most_faults, " more labels that cannot be used"));
    const auto examples = by_class(dataset, contents);

    std::size_t objects = 0, background = 0, crowds = 0, with_depth = 0, with_camera = 0, without_camera = 0;
    double depth_share = 0;
    for (std::size_t i = 0; i < dataset.images.size(); ++i) {
        const ism::DatasetImage& image = dataset.images[i];
        objects += contents.images[i].objects.size();
        background += ism::ignored_boxes(image).empty() && image.objects.empty();
        for (const ism::DatasetAnnotation& object : image.objects) crowds += object.crowd;
        with_depth += contents.images[i].depth_share > 0, with_camera += image.camera.has_value();
        without_camera += contents.images[i].depth_share > 0 && !image.camera;
        depth_share += contents.images[i].depth_share;
    }
    std::vector<std::string> without, few;
    for (std::size_t c = 0; c < examples.size(); ++c) {
        const std::string& name = dataset.class_names[c];
        if (examples[c].empty())
            without.push_back(name);
        else if (examples[c].size() < few_examples)
            few.push_back(ism::join_text(name, " has ", examples[c].size()));
    }
    if (!without.empty()) contents.of_set.push_back("classes without objects: " + some_text(without));
    if (!few.empty()) contents.of_set.push_back("few examples: " + some_text(few));
    if (without_camera > 0)
        contents.of_set.push_back(ism::join_text(without_camera,
                                                 without_camera == 1 ? " image has" : " images have",
                                                 " depth but no camera: the space metric needs both"));
    if (dataset.class_names.empty())
        contents.of_set.push_back("no labels: there is nothing to learn from these images");
    std::vector<std::pair<std::string, std::string>> summary = {
        {"images", std::to_string(dataset.images.size())},
        {"without objects", std::to_string(background)},
        {"classes", std::to_string(dataset.class_names.size())},
        {"objects", crowds == 0
                        ? std::to_string(objects)
                        : ism::join_text(objects, ", and ", crowds, " crowds or difficult ones, ignored")},
        {"with depth", std::to_string(with_depth)}};
    if (!dataset.part.empty())
        summary.insert(summary.begin(), {"part", dataset.part + ", which ism train reads"});
    if (with_depth > 0) {
        summary.emplace_back("with camera", std::to_string(with_camera));
        summary.emplace_back("depth readings",
                             ism::percent_text(depth_share / double(with_depth)) + " % of pixels");
    }
    std::size_t remarks = contents.of_set.size();
    for (const auto& [kind, list] : contents.by_kind) remarks += list.size();
    summary.emplace_back("remarks", std::to_string(remarks));

    auto table = class_table(dataset, examples, with_depth > 0);
    if (!command.report.empty())
        write_page(command.report, page_of(dataset, contents, examples, summary, table), command.page);
    for (const auto& [what, value] : summary) std::printf("%-16s%s\n", what.c_str(), value.c_str());
    for (auto& row : table) row[0] = ism::shortened(ism::one_line(row[0]), 32);
    std::printf("\n%s", ism::align_columns(table).c_str());
    if (remarks > 0) std::printf("\nWhat looks wrong:\n");
    for (const std::string& text : contents.of_set) std::printf("  %s\n", ism::one_line(text).c_str());
    constexpr std::size_t most_told = 3;
    for (const auto& [kind, list] : contents.by_kind) {
        std::printf("  %s: %zu\n", kind.c_str(), list.size());
        for (std::size_t k = 0; k < std::min(most_told, list.size()); ++k)
            std::printf("    %s: %s\n",
                        ism::one_line(short_name(dataset, dataset.images[list[k].image])).c_str(),
                        ism::one_line(list[k].remark.text).c_str());
        if (list.size() > most_told) std::printf("    ... and %zu more\n", list.size() - most_told);
    }
}

}  // namespace program
