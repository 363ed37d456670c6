// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "detect_page.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "input.hpp"

#include "ism/evaluate/coco.hpp"
#include "ism/evaluate/plot.hpp"

namespace program {

namespace {

/// Of these so many are shown; the others are counted.
constexpr std::size_t most_mistakes = 36, most_named = 300;

std::uint32_t index_of(const std::vector<std::string>& names, const std::string& name) {
    return std::uint32_t(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Without crowds.
std::ptrdiff_t labelled_objects(const ism::DatasetImage& image) {
    return std::count_if(image.objects.begin(), image.objects.end(),
                         [](const ism::DatasetAnnotation& object) { return !object.crowd; });
}

/// How well each class was found, and the curves.
ism::ReportSection figures_section(const ism::Dataset& dataset, std::span<const ism::Result> results,
                                   const std::vector<std::string>& names) {
    const ism::Evaluation evaluation = ism::evaluate(dataset, results);
    ism::ReportTable table{.header = {"class", "objects", "right", "missed", "wrong", "AP %", "mask IoU %"}};
    std::vector<ism::Rgb> colors;
    for (const ism::ClassEvaluation& one : evaluation.classes)
        colors.push_back(ism::class_color(index_of(names, one.name)));
    ism::Plot plot = ism::precision_recall_plot(evaluation, "Precision and recall", colors);
    plot.width_px = 380, plot.height_px = 320;
    for (const ism::ClassEvaluation& one : evaluation.classes) {
        if (one.objects + one.detections == 0) continue;
        table.rows.push_back({one.name, std::to_string(one.objects), std::to_string(one.true_positives),
                              std::to_string(one.objects - one.true_positives),
                              std::to_string(one.detections - one.true_positives),
                              ism::percent_text(one.figures.ap), ism::mask_iou_text(one)});
    }
    ism::ReportSection section{.title = "How well they were found"};
    table.rows.push_back({"mean", "", "", "", "", ism::percent_text(evaluation.mean.ap),
                          ism::percent_text(evaluation.mean.mask_iou)});
    section.parts.push_back(ism::ReportPlot{ism::to_svg(plot)});
    section.parts.push_back(std::move(table));
    section.parts.push_back(
        ism::ReportText{"A box is right from an IoU of .5. What was not told for its low score (--min-score) "
                        "counts as missed."});
    return section;
}

}  // namespace

DetectPage::DetectPage(const ism::Dataset& dataset, const std::vector<std::vector<ism::Result>>& results,
                       std::span<const std::string> class_names, std::vector<std::string> image_names,
                       std::size_t most)
    : dataset_(dataset),
      results_(results),
      names_(class_names.begin(), class_names.end()),
      image_names_(std::move(image_names)),
      folder_(take_folder(image_names_)),
      images_(results.size()) {
    const bool labelled = std::any_of(dataset.images.begin(), dataset.images.end(),
                                      [](const auto& image) { return !image.objects.empty(); });
    for (const std::string& name : dataset.class_names)
        if (index_of(names_, name) == names_.size()) names_.push_back(name);
    std::iota(images_.begin(), images_.end(), std::size_t(0));
    if (labelled) {
        mistakes_ = find_mistakes(dataset, results);
        std::stable_sort(images_.begin(), images_.end(), [&](std::size_t a, std::size_t b) {
            return mistakes_[a].weight > mistakes_[b].weight;
        });
    }
    images_.resize(std::min(most, images_.size()));
    pages_.resize(images_.size());
}

void DetectPage::add(std::size_t k, const ism::RgbImage& picture, ism::Detections detections,
                     std::size_t rows, const PageOptions& options,
                     std::span<const ism::TrainingObject> objects) {
    const std::size_t i = images_[k];
    const ism::DatasetImage& image = dataset_.images[i];
    std::erase_if(detections.objects, [&](const ism::Detection& one) {  // as to_results() does
        return !(
            ism::intersection(one.box, {0, 0, double(picture.width()), double(picture.height())}).area() > 0);
    });
    std::string remark;
    std::vector<ism::ShownLabel> labels;
    std::span<const ism::Judged> judged;
    if (!mistakes_.empty()) {
        const Mistakes& mistakes = mistakes_[i];
        remark = mistakes.text();
        for (const ism::DatasetAnnotation& object : image.objects)
            labels.push_back(
                {.class_index = index_of(names_, dataset_.class_names[object.class_index]),
                 .box = object.box,
                 .mask = object.crowd ? ism::Mask() : ism::read_mask(image, object),
                 .missed = std::count(mistakes.missed_objects.begin(), mistakes.missed_objects.end(),
                                      std::size_t(&object - image.objects.data())) > 0,
                 .ignored = object.crowd});
        judged = mistakes.judged;
    }
    pages_[k] = ism::detection_pages(image_names_[i], picture, detections, names_,
                                     {.rows = rows,
                                      .picture = picture_options(options, images_.size()),
                                      .labels = labels,
                                      .judged = judged,
                                      .objects = objects,
                                      .remark = remark,
                                      .id = ism::join_text("image-", i + 1)});
}

std::string DetectPage::shown_text() const {
    const std::string shown = ism::join_text(pages_.size(), " of ", results_.size(), " images");
    if (mistakes_.empty()) return shown + ": the first";
    const auto with = std::size_t(std::count_if(images_.begin(), images_.end(),
                                                [&](std::size_t i) { return mistakes_[i].weight > 0; }));
    if (with == pages_.size()) return shown + ": the worst mistakes";
    if (with == 0) return shown + ": the first, for there are no mistakes";
    return ism::join_text(shown, ": ", with, " with mistakes, then the first without");
}

ism::ReportSection DetectPage::mistakes_section() const {
    std::size_t missed = 0, wrong = 0;
    for (const Mistakes& one : mistakes_) missed += one.missed.size(), wrong += one.wrong.size();
    std::vector<std::pair<double, const ism::ReportFigure*>> shown;  // missed objects first, as weights are
    for (std::size_t k = 0; k < pages_.size(); ++k)
        for (std::size_t m = 0; m < pages_[k].mistakes.size(); ++m)
            shown.emplace_back(mistakes_[images_[k]].weights[m], &pages_[k].mistakes[m]);
    std::stable_sort(shown.begin(), shown.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    ism::ReportGallery gallery;
    for (std::size_t m = 0; m < std::min(most_mistakes, shown.size()); ++m)
        gallery.figures.push_back(*shown[m].second);
    ism::ReportSection section{.title = ism::join_text("Mistakes: ", missed, " missed, ", wrong, " wrong")};
    if (gallery.figures.empty())
        section.parts.push_back(ism::ReportText{"None: every labelled object was found, and nothing else."});
    if (gallery.figures.size() < missed + wrong)
        section.parts.push_back(ism::ReportText{
            ism::join_text("The worst ", gallery.figures.size(), " of ", missed + wrong,
                           pages_.size() < results_.size() ? ", in the images shown:" : ":")});
    section.parts.push_back(std::move(gallery));
    return section;
}

ism::ReportSection DetectPage::images_section() const {
    ism::ReportSection section{.title = "Images"};
    ism::ReportGallery gallery;
    for (const ism::DetectionPages& page : pages_) gallery.figures.push_back(page.thumbnail);
    section.parts.push_back(std::move(gallery));
    if (pages_.size() == results_.size()) return section;
    ism::ReportSection others{.title = "All images in words", .folded = true};
    ism::ReportTable table{.header = {"image", "objects", "detections", "mistakes"}};
    for (std::size_t i = 0; i < std::min(results_.size(), most_named); ++i)
        table.rows.push_back({image_names_[i], std::to_string(labelled_objects(dataset_.images[i])),
                              std::to_string(results_[i].size()),
                              mistakes_.empty() ? "" : mistakes_[i].text()});
    others.parts.push_back(std::move(table));
    if (results_.size() > most_named)
        others.parts.push_back(
            ism::ReportText{ism::join_text("… and ", results_.size() - most_named, " more.")});
    section.sections.push_back(std::move(others));
    return section;
}

ism::Report DetectPage::report(std::string title,
                               std::vector<std::pair<std::string, std::string>> summary) const {
    const bool labelled = !mistakes_.empty();
    ism::Report report{.title = std::move(title), .summary = std::move(summary)};
    if (!folder_.empty()) report.summary.emplace_back("folder", folder_);
    if (pages_.size() < results_.size()) report.summary.emplace_back("shown here", shown_text());
    std::size_t explained = 0, detections = 0;
    for (const ism::DetectionPages& page : pages_) explained += page.section.sections.size();
    for (const auto& results : results_) detections += results.size();
    if (explained < detections)
        report.summary.emplace_back("explained here",
                                    ism::join_text(explained, " of ", detections, " detections"));
    const bool ignored = std::any_of(dataset_.images.begin(), dataset_.images.end(), [](const auto& image) {
        return labelled_objects(image) < std::ptrdiff_t(image.objects.size());
    });
    report.legend = ism::detection_legend(names_, labelled, ignored);
    report.layers = ism::detection_layers(labelled);
    if (labelled) {
        report.sections.push_back(mistakes_section());
        std::vector<ism::Result> all;
        for (const auto& part : results_) all.insert(all.end(), part.begin(), part.end());
        report.sections.push_back(figures_section(dataset_, all, names_));
    }
    if (results_.size() > 1) report.sections.push_back(images_section());
    for (const ism::DetectionPages& page : pages_) report.sections.push_back(page.section);
    return report;
}

}  // namespace program
