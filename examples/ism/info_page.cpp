// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "info_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "input.hpp"
#include "pictures.hpp"
#include "spaces.hpp"

#include "ism/evaluate/table.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/show/report_explanation.hpp"

namespace program {

namespace {

constexpr std::size_t words_a_class = 6, patches_a_word = 6, objects_a_class = 12, most_classes = 24;

using ism::detail::OpacitySteps;
using ism::detail::tenth;

/// On how many objects of each class each word was seen: words × classes.
std::vector<double> word_counts(const ism::Model& model) {
    const std::size_t classes = model.shapes.class_names.size();
    std::vector<double> counts(model.words() * classes, 0);
    std::vector<std::size_t> last(model.shapes.objects.size(),
                                  model.words());  // word seen last on each object
    for (std::size_t w = 0; w < model.words(); ++w)
        for (const ism::Occurrence& one : model.shapes.occurrences[w])
            if (std::exchange(last[one.object], w) != w) counts[w * classes + one.class_index] += 1;
    return counts;
}

/// The words that tell most of a class: P(w, c) log(P(w, c) / (P(w) P(c))), the part of a class in the
/// information gain of a word.
std::vector<std::uint32_t> telling_words(const std::vector<double>& counts, std::size_t classes,
                                         std::size_t c) {
    const std::size_t words = counts.size() / classes;
    double all = 0, of_class = 0;
    std::vector<double> of_word(words, 0), gain(words, 0);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        all += counts[i], of_word[i / classes] += counts[i];
        if (i % classes == c) of_class += counts[i];
    }
    std::vector<std::uint32_t> order;
    for (std::uint32_t w = 0; w < words; ++w) {
        const double here = counts[w * classes + c];
        if (here < 2) continue;
        gain[w] = classes > 1 ? here * std::log(here * all / (of_word[w] * of_class)) : here;
        order.push_back(w);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return gain[a] > gain[b]; });
    order.resize(std::min(order.size(), words_a_class));
    return order;
}

std::vector<const ism::TrainingObject*> objects_of(const ism::Model& model, std::size_t c) {
    std::vector<const ism::TrainingObject*> objects;
    for (const ism::TrainingObject& object : model.shapes.objects)
        if (object.class_index == c) objects.push_back(&object);
    return objects;
}

/// The pixels of the reference size that most objects of a class cover; they begin at (−150, −150).
constexpr int mean_side = 100, mean_cell_px = 3;
ism::Mask mean_mask(const std::vector<const ism::TrainingObject*>& objects, double least_share) {
    ism::Mask mask(mean_side, mean_side);
    for (int y = 0; y < mean_side; ++y)
        for (int x = 0; x < mean_side; ++x) {
            double sum = 0;
            for (const ism::TrainingObject* object : objects)
                sum += double(ism::figure_share(*object, float((x + 0.5) * mean_cell_px - 150),
                                                float((y + 0.5) * mean_cell_px - 150)));
            mask(x, y) = sum > least_share * double(objects.size());
        }
    return mask;
}

/// Where most objects of a class are, as shapes around (0, 0) in pixels of the reference size.
std::string mean_shapes(const std::vector<const ism::TrainingObject*>& objects) {
    std::string shapes =
        "<g transform=\"translate(-150 -150) scale(3)\" fill=\"#888\" fill-rule=\"evenodd\">";
    for (const double share : {0.2, 0.6})
        shapes += "<path fill-opacity=\".35\" d=\"" + ism::mask_path(mean_mask(objects, share)) + "\"/>";
    return shapes + "</g>";
}

/// Where a word was seen on the objects of a class.
ism::ReportFigure places_figure(const ism::Model& model, std::uint32_t word, std::size_t c,
                                const std::string& mean) {
    constexpr std::size_t most_dots = 120;
    const ism::Rgb color = ism::class_color(c);
    std::string path;
    std::size_t here = 0;
    std::set<std::uint32_t> objects;
    for (const ism::Occurrence& one : model.shapes.occurrences[word]) {
        if (one.class_index != c) continue;
        objects.insert(one.object);
        if (++here <= most_dots)
            path += ism::detail::circle_path({one.x, one.y}, std::clamp(double(one.scale), 2.0, 30.0));
    }
    const std::size_t all = model.shapes.occurrences[word].size();
    return {.caption = ism::join_text("word ", word, ": ", here, " of ", all, " times on this class, ",
                                      objects.size()) +
                       " objects",
            .alt = ism::join_text("where word ", word, " was seen on the objects"),
            .part = {-150, -150, 300, 300},
            .shapes = mean + "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + ism::hex_color(color) +
                      "\" stroke-width=\"1.5\" stroke-opacity=\".8\"/>",
            .width_px = 150};
}

/// A word of SIFT as gradients in 4 × 4 cells.
ism::ReportFigure gradients_figure(std::span<const float> mean, std::uint32_t word) {
    float most = 1e-9f;
    for (const float value : mean) most = std::max(most, value);
    OpacitySteps lines;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        const double angle = double(i % 8) * std::numbers::pi / 4, length = 9.5 * double(mean[i] / most);
        const double x = 10 + 20 * double(i / 8 % 4), y = 10 + 20 * double(i / 32);
        lines.add(double(mean[i] / most),
                  ism::join_text('M', tenth(x), ' ', tenth(y), 'l', tenth(length * std::cos(angle)), ' ',
                                 tenth(length * std::sin(angle))));
    }
    return {.caption = "its gradients",
            .alt = ism::join_text("gradients of word ", word),
            .part = {0, 0, 80, 80},
            .shapes = "<path d=\"M20 0v80M40 0v80M60 0v80M0 20h80M0 40h80M0 60h80\" stroke=\"#8888\"/>" +
                      lines.svg("stroke", {40, 150, 230}, 1, "stroke-width=\"2\""),
            .width_px = 110};
}

/// What the template of a class looks for, or against: edges of each cell.
ism::ReportFigure template_figure(const ism::BoxTemplate& shape, bool good) {
    const ism::BoxGrid& grid = shape.grid;
    const auto weight = [&](std::size_t cell, std::size_t k) {
        const float* numbers = shape.weights.data() + cell * ism::cell_numbers;
        const double sum = double(numbers[18 + k]) + 0.5 * (double(numbers[k]) + double(numbers[k + 9]));
        return std::max(0.0, good ? sum : -sum);
    };
    double most = 1e-9;
    for (std::size_t cell = 0; cell < grid.cells(); ++cell)
        for (std::size_t k = 0; k < 9; ++k) most = std::max(most, weight(cell, k));
    const double width =
        20 * std::exp(double(shape.log_aspect)) * grid.rows / grid.columns;  // of a cell 20 high
    OpacitySteps lines;
    for (std::size_t cell = 0; cell < grid.cells(); ++cell)
        for (std::size_t k = 0; k < 9; ++k) {
            const double share = weight(cell, k) / most;
            if (share < 0.12) continue;
            const ism::Box place = grid.cell({0, 0, width * grid.columns, 20.0 * grid.rows}, cell);
            const double angle = (double(k) / 9 + 0.5) * std::numbers::pi,
                         reach = 0.45 * std::min(width, 20.0);
            const double dx = reach * std::cos(angle), dy = reach * std::sin(angle);
            lines.add(share,
                      ism::join_text('M', tenth(place.centre().x - dx), ' ', tenth(place.centre().y - dy),
                                     'l', tenth(2 * dx), ' ', tenth(2 * dy)));
        }
    ism::ReportFigure figure{
        .caption = good ? "edges that speak for it" : "edges that speak against it",
        .part = {-width * grid.ring, -20.0 * grid.ring, width * grid.all_columns(), 20.0 * grid.all_rows()},
        .shapes =
            ism::svg_box({0, 0, width * grid.columns, 20.0 * grid.rows}, "fill=\"none\" stroke=\"#888\"") +
            lines.svg("stroke", good ? ism::detail::for_color : ism::detail::against_color, 1,
                      "stroke-width=\"2\"")};
    figure.width_px = ism::figure_width_px(figure.part, 400);
    return figure;
}

ism::ReportFigure object_figure(const ism::TrainingObject& object, std::size_t c) {
    ism::Mask figure = object.mask;
    for (std::uint8_t& pixel : figure.pixels()) pixel = pixel > 127;
    const std::string name = ism::path_to_utf8(std::filesystem::path(object.image).filename());
    ism::ReportFigure shown{.caption = name,
                            .alt = "mask of a training object in " + name,
                            .part = {0, 0, double(figure.width()), double(figure.height())},
                            .shapes = "<path fill-rule=\"evenodd\" d=\"" + ism::mask_path(figure) +
                                      "\" fill=\"" + ism::hex_color(ism::class_color(c)) + "\"/>"};
    shown.width_px = ism::figure_width_px(shown.part, 90);
    return shown;
}

/// Where the training objects are in the data set they were learnt from.
class Sources {
public:
    explicit Sources(const ism::Dataset& data) : data_(data) {
        for (std::size_t i = 0; i < data.images.size(); ++i)
            by_name_.emplace(data.images[i].file.filename().string(), i);
    }

    /// The image and the box of an object; none where it is not in the data set.
    [[nodiscard]] std::pair<const ism::DatasetImage*, ism::Box> find(
        const ism::TrainingObject& object) const {
        const auto [first, last] =
            by_name_.equal_range(std::filesystem::path(object.image).filename().string());
        for (auto at = first; at != last; ++at)
            for (const ism::DatasetAnnotation& label : data_.images[at->second].objects) {
                const double size = std::sqrt(label.box.area()), aspect = label.box.width / label.box.height;
                if (std::abs(size / double(object.size_px) - 1) < 0.002 &&
                    std::abs(aspect / double(object.width / object.height) - 1) < 0.002)
                    return {&data_.images[at->second], label.box};
            }
        return {nullptr, {}};
    }

    /// The picture of an image, read once.
    [[nodiscard]] const ism::RgbImage& picture(const ism::DatasetImage& image) {
        ism::RgbImage& picture = pictures_[&image];
        if (picture.empty())
            picture = program::read_picture(image.file, ism::ImageSize{image.width, image.height}).color;
        return picture;
    }

private:
    const ism::Dataset& data_;
    std::multimap<std::string, std::size_t> by_name_;
    std::map<const ism::DatasetImage*, ism::RgbImage> pictures_;
};

/// Patches of a word as they were seen on the objects of a class, turned upright; none where no object is in
/// the data set.
std::optional<ism::ReportFigure> patches_figure(const ism::Model& model, std::uint32_t word, std::size_t c,
                                                Sources& sources) {
    constexpr int side = 56;
    std::vector<ism::RgbImage> patches;
    std::set<std::uint32_t> objects;
    for (const ism::Occurrence& one : model.shapes.occurrences[word]) {
        if (one.class_index != c || patches.size() == patches_a_word || !objects.insert(one.object).second)
            continue;
        const ism::TrainingObject& object = model.shapes.objects[one.object];
        const auto [image, box] = sources.find(object);
        if (image == nullptr) continue;
        const ism::RgbImage& picture = sources.picture(*image);
        const double zoom = double(object.size_px) / ism::reference_size_px,
                     step = 12 * double(one.scale) * zoom / side;
        const double cosine = std::cos(double(one.angle)) * step, sine = std::sin(double(one.angle)) * step;
        const ism::Point2 at{box.centre().x + double(one.x) * zoom, box.centre().y + double(one.y) * zoom};
        ism::RgbImage patch(side, side);
        for (int v = 0; v < side; ++v)
            for (int u = 0; u < side; ++u) {
                const double du = u + 0.5 - side / 2.0, dv = v + 0.5 - side / 2.0;
                const double x = std::clamp(at.x + cosine * du - sine * dv - 0.5, 0.0, picture.width() - 1.0);
                const double y =
                    std::clamp(at.y + sine * du + cosine * dv - 0.5, 0.0, picture.height() - 1.0);
                const int x0 = int(x), y0 = int(y);
                const int x1 = std::min(x0 + 1, picture.width() - 1),
                          y1 = std::min(y0 + 1, picture.height() - 1);
                patch(u, v) = ism::mix(ism::mix(picture(x0, y0), picture(x1, y0), x - x0),
                                       ism::mix(picture(x0, y1), picture(x1, y1), x - x0), y - y0);
            }
        patches.push_back(std::move(patch));
    }
    if (patches.empty()) return std::nullopt;
    ism::RgbImage row(int(patches.size()) * (side + 2) - 2, side, ism::white);
    for (std::size_t i = 0; i < patches.size(); ++i)
        for (int y = 0; y < side; ++y)
            std::copy(patches[i].row(y).begin(), patches[i].row(y).end(),
                      row.row(y).begin() + int(i) * (side + 2));
    ism::ReportFigure figure =
        ism::picture_figure(ism::report_picture(row, {.side_px = 720, .most_bytes = 7000}), "as it was seen");
    figure.alt = ism::join_text("patches of word ", word);
    figure.width_px = row.width();
    return figure;
}

ism::ReportSection class_section(const ism::Model& model, std::size_t c, const std::vector<double>& counts,
                                 Sources* sources) {
    const std::vector<const ism::TrainingObject*> objects = objects_of(model, c);
    ism::ReportSection section{.title = model.shapes.class_names[c]};
    if (c < model.templates.size() && !model.templates[c].weights.empty()) {
        const ism::BoxTemplate& shape = model.templates[c];
        ism::ReportSection cells{.title = ism::join_text("Template: ", shape.grid.columns, " x ",
                                                         shape.grid.rows, " cells",
                                                         shape.grid.ring ? " and those around them" : "")};
        cells.parts.push_back(
            ism::ReportGallery{{template_figure(shape, true), template_figure(shape, false)}});
        section.sections.push_back(std::move(cells));
    }
    if (!objects.empty()) {
        const std::size_t shown = std::min(objects.size(), objects_a_class);
        ism::ReportSection masks{
            .title = shown < objects.size()
                         ? ism::join_text("Training objects: ", shown, " of ", objects.size(), " are shown")
                         : ism::join_text("Training objects: ", objects.size())};
        ism::ReportGallery gallery;
        for (std::size_t k = 0; k < shown; ++k)  // evenly from all
            gallery.figures.push_back(object_figure(*objects[k * objects.size() / shown], c));
        masks.parts.push_back(std::move(gallery));
        section.sections.push_back(std::move(masks));
    }
    const std::string mean = mean_shapes(objects);
    ism::ReportSection words{.title = "Most telling words"};
    for (const std::uint32_t word : telling_words(counts, model.shapes.class_names.size(), c)) {
        ism::ReportGallery row{{places_figure(model, word, c, mean)}};
        std::size_t channel = 0;
        while (channel + 1 < model.channels.size() && word >= model.first_word(channel + 1)) ++channel;
        const ism::Codebook& codebook = model.channels[channel].codebook;
        const auto descriptor = codebook[word - model.first_word(channel)].mean;
        if (descriptor.size() == 128) row.figures.push_back(gradients_figure(descriptor, word));
        if (sources)
            if (auto patches = patches_figure(model, word, c, *sources))
                row.figures.push_back(std::move(*patches));
        words.parts.push_back(std::move(row));
    }
    section.sections.push_back(std::move(words));
    return section;
}

}  // namespace

ism::Report model_report(const ism::Model& model, const std::string& title, const ism::Dataset* data) {
    const ism::ShapeModel& shapes = model.shapes;
    const std::size_t classes = shapes.class_names.size();
    const std::vector<double> counts = word_counts(model);
    ism::Report report{.title = title};
    report.summary = {
        {"classes", std::to_string(classes)},
        {"learnt from",
         ism::join_text(model.training.images, " images, ", shapes.objects.size(), " objects")},
        {"words", std::to_string(model.words())},
        {"occurrences", std::to_string(shapes.occurrences.values().size())},
        {"templates", model.templates.empty() ? "none" : "one a class"},
        {"lent masks", std::to_string(model.exemplars.size())},
        {"depth", model.rgbd.empty() ? "not learnt"
                                     : ism::join_text(model.rgbd[0].words(), " words, ",
                                                      model.rgbd[0].mask_judge.examples.size(), " regions")},
        {"probabilities", model.calibration.empty()     ? "none"
                          : learnt_probabilities(model) ? "learnt"
                                                        : "not learnt"}};
    ism::ReportTable table{
        .header = {"class", "objects", "images", "size px", "occurrences", "words of its own"}};
    for (std::size_t c = 0; c < classes; ++c) {
        std::vector<double> sizes;
        std::set<std::string> images;
        for (const ism::TrainingObject* object : objects_of(model, c))
            sizes.push_back(double(object->size_px)), images.insert(object->image);
        std::sort(sizes.begin(), sizes.end());
        std::size_t seen = 0, own = 0;
        for (const ism::Occurrence& one : shapes.occurrences.values()) seen += one.class_index == c;
        for (std::size_t w = 0; w < model.words(); ++w) {
            double all = 0;
            for (std::size_t other = 0; other < classes; ++other) all += counts[w * classes + other];
            own += counts[w * classes + c] > 0 && counts[w * classes + c] == all;
        }
        table.rows.push_back({shapes.class_names[c], std::to_string(sizes.size()),
                              std::to_string(images.size()),
                              sizes.empty() ? ""
                                            : ism::join_text(ism::number_text(sizes.front(), 3), " … ",
                                                             ism::number_text(sizes.back(), 3)),
                              std::to_string(seen), std::to_string(own)});
    }
    ism::ReportSection trained{.title = "What it was learnt from"};
    trained.parts.push_back(std::move(table));
    report.sections.push_back(std::move(trained));
    std::optional<Sources> sources;
    if (data) {
        sources.emplace(*data);
        const auto is_there = [&](const ism::TrainingObject& object) {
            return sources->find(object).first != nullptr;
        };
        ism::expect(std::any_of(shapes.objects.begin(), shapes.objects.end(), is_there), "info --data",
                    "the data set that the model was learnt from", "one that shows none of its objects");
    }
    for (std::size_t c = 0; c < std::min(classes, most_classes); ++c)
        report.sections.push_back(class_section(model, c, counts, sources ? &*sources : nullptr));
    if (classes > most_classes)
        report.sections.push_back({.title = ism::join_text("… and ", classes - most_classes, " more classes"),
                                   .parts = {ism::ReportText{ism::join_text(
                                       "The first ", most_classes, " of ", classes,
                                       " classes are shown; the table above tells of all.")}}});
    ism::ReportSection settings{.title = "Settings", .folded = true};
    for (const ism::Channel& channel : model.channels) {
        ism::ReportTable rows{.caption = "features"};
        rows.rows = {
            {"detector", channel.features.detector},
            {"descriptor",
             ism::join_text(channel.features.descriptor, ", ", channel.features.dimension, " numbers")},
            {"upsampling", ism::number_text(channel.features.options.upsampling)},
            {"match within", ism::number_text(channel.codebook.max_sq_distance()) + " (squared distance)"}};
        settings.parts.push_back(std::move(rows));
    }
    settings.parts.push_back(ism::ReportText{
        ism::join_text("Objects are brought to a size of ", ism::reference_size_px,
                       " px. File format: version ", ism::detail::model_format_version, ".")});
    report.sections.push_back(std::move(settings));
    return report;
}

}  // namespace program
