// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "degrade.hpp"
#include "depth_search.hpp"
#include "toy_cars.hpp"

#include "ism/dataset/read_images.hpp"
#include "ism/evaluate/coco.hpp"
#include "ism/evaluate/plot.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/show/report_detections.hpp"
#include "ism/train/training_set.hpp"

namespace reproduce {

namespace {

/// Voting confidence in the paper.
constexpr std::array<std::string_view, depth_spaces.size()> paper_confidence = {"58 %", "–",    "62 %",
                                                                                "64 %", "66 %", "–"};
constexpr std::size_t jism_index = 1;
constexpr std::array<std::size_t, way_count> all_ways = {0, 1, 2, 3, 4, 5, 6};
/// Of the most pictures, so that a worse picture is compared with the same way on a good one.
constexpr std::array<std::size_t, 4> compared_ways = {1, 2, 4, judged_index};

/// Mean, and deviation where there are several numbers.
std::string mean_text(std::span<const double> numbers, int digits, double unit) {
    double sum = 0, squares = 0;
    for (const double n : numbers) sum += n;
    const double mean = sum / double(numbers.size());
    for (const double n : numbers) squares += (n - mean) * (n - mean);
    std::string text = ism::fixed_text(unit * mean, digits);
    if (numbers.size() > 1)
        text += " ± " + ism::fixed_text(unit * std::sqrt(squares / double(numbers.size() - 1)), digits);
    return text;
}

/// Share of the votes in the window of the right hypothesis; none where it was not reached.
double mean_confidence(std::span<const ism::VotingConfidence> objects) {
    double sum = 0, count = 0;
    for (const ism::VotingConfidence& one : objects)
        if (!std::isnan(one.at_truth)) sum += one.found ? one.at_hypothesis : 0, ++count;
    return sum / count;
}

double mean_at_truth(std::span<const ism::VotingConfidence> objects) {
    double sum = 0, count = 0;
    for (const ism::VotingConfidence& one : objects)
        if (!std::isnan(one.at_truth)) sum += one.at_truth, ++count;
    return sum / count;
}

/// Distances between where objects were found and where they are, of those found rightly.
std::vector<double> position_errors(std::span<const Shot> shots, const ism::Evaluation& evaluation,
                                    std::span<const ism::Result> results) {
    std::vector<const ism::DatasetAnnotation*> truth;
    for (const Shot& shot : shots)
        for (const ism::DatasetAnnotation& label : shot.labels.objects) truth.push_back(&label);
    std::vector<double> errors;
    for (std::size_t i = 0; i < results.size(); ++i) {
        const ism::Judgement& judgement = evaluation.judgements[i];
        if (judgement.verdict != ism::Verdict::true_positive || !results[i].position_m) continue;
        const auto& at = truth[judgement.truth]->position_m;
        if (!at) continue;
        const ism::Point3& found = *results[i].position_m;
        errors.push_back(std::hypot(found.x - at->x, found.y - at->y, found.z - at->z));
    }
    return errors;
}

double median(std::vector<double> numbers) {
    if (numbers.empty()) return NAN;
    const auto middle = numbers.begin() + std::ptrdiff_t(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

/// Precision and recall of all classes together where T_ratio goes from 1 to 0.
ism::PlotCurve t_ratio_curve(const ism::Dataset& set, const std::vector<ism::Result>& results,
                             std::size_t way) {
    const std::vector<ism::Result> relative = relative_scores(results);
    const ism::Evaluation evaluation = ism::evaluate(set, relative);
    std::vector<ism::ScoredVerdict> verdicts;
    for (std::size_t i = 0; i < relative.size(); ++i)
        verdicts.push_back(
            {relative[i].score, evaluation.judgements[i].verdict == ism::Verdict::true_positive});
    std::size_t objects = 0;
    for (const ism::DatasetImage& image : set.images) objects += image.objects.size();
    ism::PlotCurve curve{.name = std::string(way_names[way]), .color = ism::class_color(way)};
    for (const ism::PrecisionRecallPoint& point : ism::precision_recall(verdicts, objects).points) {
        if (curve.x.empty()) curve.x.push_back(0), curve.y.push_back(point.precision);
        curve.x.push_back(point.recall), curve.y.push_back(point.precision);
    }
    return curve;
}

ism::ReportPlot t_ratio_plot(const std::string& title, const ism::Dataset& set, const DepthOutcome& found) {
    ism::Plot plot{.title = title, .x_label = "recall", .y_label = "precision"};
    for (const std::size_t way : all_ways) plot.curves.push_back(t_ratio_curve(set, found.results[way], way));
    return {ism::to_svg(plot)};
}

/// What is told of a way from several parts of the data.
struct WayFigures {
    std::vector<double> ap, confidence, at_truth, position_m;
    double ms = 0;
};

void add_outcome(std::array<WayFigures, way_count>& figures, const ism::Dataset& set,
                 std::span<const Shot> shots, const DepthOutcome& found) {
    for (const std::size_t way : all_ways) {
        const ism::Evaluation evaluation = ism::evaluate(set, found.results[way]);
        figures[way].ap.push_back(evaluation.mean.ap);
        figures[way].position_m.push_back(median(position_errors(shots, evaluation, found.results[way])));
        figures[way].ms = found.ms[way];
        if (way >= depth_spaces.size()) continue;
        figures[way].confidence.push_back(mean_confidence(found.confidence[way]));
        figures[way].at_truth.push_back(mean_at_truth(found.confidence[way]));
    }
}

std::vector<double> gain(std::vector<double> of, std::span<const double> over) {
    for (std::size_t i = 0; i < of.size(); ++i) of[i] -= over[i];
    return of;
}

ism::ReportTable space_table(std::string caption, const std::array<WayFigures, way_count>& figures,
                             bool exact) {
    ism::ReportTable table{
        .caption = std::move(caption),
        .header = {"space", "AP %", "… beyond jism", "voting confidence %", "… at the true place %", "paper",
                   "position error, median, cm", "ms/image"}};
    for (const std::size_t way : all_ways) {
        const WayFigures& of = figures[way];
        const bool votes = way < depth_spaces.size();
        table.rows.push_back(
            {std::string(way_names[way]), mean_text(of.ap, 1, 100),
             way == jism_index ? "–" : mean_text(gain(of.ap, figures[jism_index].ap), 1, 100),
             votes ? mean_text(of.confidence, 1, 100) : "–", votes ? mean_text(of.at_truth, 1, 100) : "–",
             std::string(votes ? paper_confidence[way] : "–"), exact ? mean_text(of.position_m, 2, 100) : "–",
             ism::fixed_text(of.ms, 0)});
    }
    return table;
}

/// AP of the paper's spaces where features without a reading vote in none of them.
ism::ReportTable reading_table(const ism::Dataset& set, const DepthOutcome& found) {
    ism::ReportTable table{.caption = "Features without a depth reading left out in every space",
                           .header = {"space", "AP %", "voting confidence %"}};
    for (std::size_t s = 0; s < metric_index; ++s)
        table.rows.push_back({std::string(depth_spaces[s]),
                              ism::percent_text(ism::evaluate(set, found.results[s]).mean.ap),
                              ism::percent_text(mean_confidence(found.confidence[s]))});
    return table;
}

/// What is lost where training labels tell no positions.
ism::ReportTable unlabelled_table(const std::array<WayFigures, way_count>& figures) {
    ism::ReportTable table{.caption =
                               "Learnt without positions: an object's centre is then the middle of its "
                               "box at the median depth of its mask",
                           .header = {"space", "AP %", "distance from the true middle, median, cm"}};
    for (const std::size_t way : all_ways)
        table.rows.push_back({std::string(way_names[way]), mean_text(figures[way].ap, 1, 100),
                              mean_text(figures[way].position_m, 2, 100)});
    return table;
}

constexpr std::array<std::size_t, metric_index> paper_ways = {0, 1, 2, 3, 4};

std::span<const ism::TrainingImage> view_of(const std::vector<ism::TrainingImage>& images) {
    return images;
}

/// A model of one part of the cars, and pictures of the others.
struct CarPart {
    DepthModels models;
    CarSplit cars;
};

CarPart learn_cars(const Settings& settings, std::uint64_t seed, bool with_positions) {
    CarPart part{{}, settings.quick ? split_cars(seed, 8, 3) : split_cars(seed)};
    std::vector<ism::TrainingImage> lessons = car_lessons(part.cars.learnt, settings.threads);
    if (!with_positions)
        for (ism::TrainingImage& lesson : lessons) lesson.objects.front().position_m.reset();
    part.models = learn_both({"car"}, ism::training_set(view_of(lessons)), settings.threads);
    return part;
}

/// Four pictures of what two ways found in a few scenes.
std::vector<ism::ReportSection> explained(const DepthModels& models, std::span<const Shot> shots) {
    std::vector<ism::ReportSection> sections;
    for (std::size_t i = 0; i < std::min<std::size_t>(2, shots.size()); ++i)
        for (const std::size_t way : {std::size_t(4), judged_index}) {
            ism::Detections found = found_in(models, shots[i], way);
            std::erase_if(found.objects, [&](const ism::Detection& d) {
                return d.score < 0.55 * found.objects.front().score;
            });
            sections.push_back(
                ism::detection_pages(ism::join_text("Scene ", i + 1, ", ", way_names[way], ", T_ratio = .55"),
                                     shots[i].frame.color, found, models.words.shapes.class_names,
                                     {.rows = 1, .picture = {.side_px = 640, .most_bytes = 40000}})
                    .section);
        }
    return sections;
}

/// Toy cars that were not learnt on cluttered tables.
ism::ReportSection toy_experiment(const Settings& settings, Times& times) {
    const std::size_t splits = settings.quick ? 1 : 5;
    const Tables tables{.count = settings.quick ? std::size_t(2) : 12};
    std::array<WayFigures, way_count> figures, unlabelled;
    DepthOutcome together, with_reading;
    std::vector<Shot> all;
    std::vector<ism::ReportSection> rows;
    for (std::uint64_t split = 0; split < splits; ++split) {
        const CarPart part = learn_cars(settings, split, true);
        std::vector<Shot> shots = car_tables(part.cars.unseen, tables, split + 1, settings.threads);
        for (Shot& shot : shots) shot.labels.id += std::int64_t(1000 * split);
        const ism::Dataset set = dataset_of(shots, {"car"});
        const DepthOutcome found = search_depth(part.models, shots, all_ways, false, settings.threads);
        add_outcome(figures, set, shots, found);
        const DepthOutcome reading = search_depth(part.models, shots, paper_ways, true, settings.threads);
        for (const std::size_t way : all_ways) {
            const auto join = [&](auto& to, const auto& from) {
                to.insert(to.end(), from.begin(), from.end());
            };
            join(together.results[way], found.results[way]);
            join(with_reading.results[way], reading.results[way]);
            if (way < depth_spaces.size()) join(with_reading.confidence[way], reading.confidence[way]);
        }
        if (split == 0) rows = explained(part.models, shots);
        const CarPart plain = learn_cars(settings, split, false);
        add_outcome(unlabelled, set, shots,
                    search_depth(plain.models, shots, all_ways, false, settings.threads));
        std::move(shots.begin(), shots.end(), std::back_inserter(all));
    }
    const ism::Dataset set = dataset_of(all, {"car"});
    std::size_t cars = 0;
    for (const ism::DatasetImage& image : set.images) cars += image.objects.size();
    times.add("toy cars: learning and searching");
    ism::ReportSection section{.title = "Toy cars (rendered)"};
    section.parts.push_back(ism::ReportText{
        ism::join_text("Of 40 cars 30 are learnt from two pictures each, with the position of their middle, "
                       "and the other 10 are found "
                       "on cluttered tables at .5 to 1.5 m; ",
                       splits, " random parts, ", all.size(), " pictures, ", cars,
                       " cars; mean and deviation over the parts. Votes alone, minimum description length. "
                       "Voting confidence: of the "
                       "votes that the features on a car cast for cars, the share of weight in the kernel of "
                       "the hypothesis that mean "
                       "shift reaches from the true place; none where that is a window or more away.")});
    add_table(section, space_table("Unseen toy cars", figures, true));
    add_table(section, unlabelled_table(unlabelled));
    add_table(section, reading_table(set, with_reading));
    section.parts.push_back(t_ratio_plot("Toy cars, T_ratio from 1 to 0", set, together));
    section.sections = std::move(rows);
    return section;
}

/// Real tables.
ism::ReportSection osd_experiment(const Settings& settings, Times& times) {
    const Images images = read_images(settings, "osd", "val");
    const DepthModels models =
        learn_both(images.train.class_names, ism::training_set(images.train), settings.threads);
    times.add("osd: learning both models");
    std::vector<Shot> shots;
    for (const ism::DatasetImage& image : images.test.images)
        shots.push_back({ism::read_frame(image), image});
    const ism::Dataset set = dataset_of(shots, images.train.class_names);
    const DepthOutcome found = search_depth(models, shots, all_ways, false, settings.threads);
    std::array<WayFigures, way_count> figures;
    add_outcome(figures, set, shots, found);
    times.add("osd: searching in all spaces");
    ism::ReportSection section{.title = "Depth in the vote space"};
    section.parts.push_back(
        ism::ReportText{"Cluttered tables, 640×480, colour and depth, votes alone but for the last row. "
                        "Depth beyond the table was "
                        "removed by the authors of the set, which helps the spaces with depth: features "
                        "there cast no vote; the second "
                        "table leaves these features out in every space."});
    add_table(section, space_table("osd, AP: mean over classes", figures, false));
    add_table(section, reading_table(set, search_depth(models, shots, paper_ways, true, settings.threads)));
    section.parts.push_back(t_ratio_plot("osd, T_ratio from 1 to 0", set, found));
    return section;
}

/// The car that is seen between two cars.
ism::ReportSection between_experiment(const Settings& settings, const CarPart& part, Times& times) {
    constexpr double t_ratio = 0.25;
    const std::size_t count = settings.quick ? 3 : 50;
    const std::vector<Shot> shots = cars_side_by_side(part.cars.unseen, count, 1, settings.threads);
    std::array<std::size_t, depth_spaces.size()> shown{}, with_ism{}, any{};
    for (const Shot& shot : shots) {
        const auto shows = shown_between(part.models, shot, t_ratio);
        for (std::size_t s = 0; s < depth_spaces.size(); ++s)
            shown[s] += shows[s].of_both, with_ism[s] += shows[s].of_both && shows[0].of_both,
                any[s] += shows[s].any;
    }
    times.add("the car between two cars");
    ism::ReportTable table{
        .caption = ism::join_text("A car between two cars, ", count, " scenes, T_ratio = .25"),
        .header = {"space", "scenes that show it", "of those where ism does", "gone",
                   "anything in the middle half"}};
    for (std::size_t s = 0; s < depth_spaces.size(); ++s)
        table.rows.push_back(
            {std::string(depth_spaces[s]), std::to_string(shown[s]), std::to_string(with_ism[s]),
             shown[0] > 0 ? ism::percent_text(1 - double(with_ism[s]) / double(shown[0])) + " %" : "–",
             std::to_string(any[s])});
    ism::ReportSection section{.title = "The car between two cars"};
    section.parts.push_back(
        ism::ReportText{"Two cars stand side by side in the picture, one .2 to .35 m behind the other, so "
                        "that wheels of both could be "
                        "those of a car between them. It is shown where a hypothesis between their middles "
                        "of at least a quarter of the "
                        "strongest has a fifth or more of its weight from each. In JI3SM-3 votes for both "
                        "agree, since s·d is "
                        "the size of a car at any distance, but of those in a window only votes for one "
                        "depth count."});
    if (!shots.empty())
        section.parts.push_back(
            ism::picture_figure(ism::report_picture(shots[0].frame.color), "one of the scenes"));
    add_table(section, std::move(table));
    return section;
}

/// What worse pictures cost.
ism::ReportSection degradation(const Settings& settings, const CarPart& part, Times& times) {
    const std::size_t count = settings.quick ? 1 : 10;
    const Tables tables{.count = count};
    const std::vector<Shot> good = car_tables(part.cars.unseen, tables, 1, settings.threads);
    struct Trouble {
        std::string name, unit;
        std::vector<double> levels;
        std::function<Shot(const Shot&, double level, std::uint64_t seed)> apply;
    };
    const std::vector<Trouble> troubles = {
        {"depth noise",
         "mm at 1 m",
         {0, 2, 5, 10, 20, 40},
         [](const Shot& s, double l, std::uint64_t seed) { return with_depth_noise(s, l / 1000, seed); }},
        {"holes",
         "% of the depth",
         {0, 10, 25, 50, 75, 90},
         [](const Shot& s, double l, std::uint64_t seed) { return with_holes(s, l / 100, seed); }},
        {"misregistration",
         "px",
         {0, 1, 2, 3, 4, 6},
         [](const Shot& s, double l, std::uint64_t) { return with_shifted_depth(s, int(l)); }},
        {"turn in the plane",
         "degrees",
         {0, 10, 20, 45, 90, 180},
         [](const Shot& s, double l, std::uint64_t) { return l == 0 ? s : turned_in_plane(s, l); }},
        {"distance", "m", {0.6, 0.75, 1, 1.25, 1.5, 1.75}, {}}};
    ism::ReportSection section{.title = "Worse pictures"};
    section.parts.push_back(
        ism::ReportText{"Toy cars of the first part; AP of a way on pictures that are made worse, or taken "
                        "from farther away."});
    for (const Trouble& trouble : troubles) {
        ism::Plot plot{.title = trouble.name, .x_label = trouble.unit, .y_label = "AP"};
        plot.x_range = {trouble.levels.front(), trouble.levels.back()};
        ism::ReportTable table{.caption = trouble.name + ", AP %", .header = {trouble.unit}};
        for (const std::size_t way : compared_ways) {
            table.header.emplace_back(way_names[way]);
            plot.curves.push_back({.name = std::string(way_names[way]), .color = ism::class_color(way)});
        }
        table.header.emplace_back("metric: position error, median, cm");
        const std::size_t step = settings.quick ? 5 : 1;
        for (std::size_t l = 0; l < trouble.levels.size(); l += step) {
            const double level = trouble.levels[l];
            std::vector<Shot> shots;
            if (!trouble.apply)
                shots = car_tables(part.cars.unseen, {count, level, level + 0.03}, 2, settings.threads);
            for (std::size_t i = 0; trouble.apply && i < good.size(); ++i)
                shots.push_back(trouble.apply(good[i], level, 100 + i));
            const ism::Dataset set = dataset_of(shots, {"car"});
            const DepthOutcome found =
                search_depth(part.models, shots, compared_ways, false, settings.threads);
            table.rows.push_back({ism::number_text(level, 3)});
            double error_m = NAN;
            for (std::size_t w = 0; w < compared_ways.size(); ++w) {
                const auto& results = found.results[compared_ways[w]];
                const ism::Evaluation evaluation = ism::evaluate(set, results);
                table.rows.back().push_back(ism::percent_text(evaluation.mean.ap));
                if (!std::isnan(evaluation.mean.ap))
                    plot.curves[w].x.push_back(level), plot.curves[w].y.push_back(evaluation.mean.ap);
                error_m = median(position_errors(shots, evaluation, results));
            }
            table.rows.back().push_back(std::isnan(error_m) ? "–" : ism::fixed_text(100 * error_m, 2));
        }
        add_table(section, std::move(table));
        section.parts.push_back(ism::ReportPlot{ism::to_svg(plot)});
    }
    times.add("worse pictures");
    return section;
}

}  // namespace

std::vector<ism::ReportSection> depth_experiments(const Settings& settings, Times& times) {
    std::vector<ism::ReportSection> sections;
    sections.push_back(toy_experiment(settings, times));
    sections.push_back(osd_experiment(settings, times));
    const CarPart part = learn_cars(settings, 0, true);
    sections.push_back(between_experiment(settings, part, times));
    sections.push_back(degradation(settings, part, times));
    return sections;
}

}  // namespace reproduce
