// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/core/progress.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/voted_boxes.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/hog/search_box.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/train/linear_svm.hpp"
#include "ism/train/pyramid_workers.hpp"
#include "ism/train/training_image.hpp"

namespace ism {

/// @brief How a template of each class is fitted to the boxes of its objects.
struct TemplateOptions {
    int cells = 100;          ///< of a box, about
    int jittered_copies = 2;  ///< of each object's box, moved by a few hundredths
    int mining_rounds = 2;    ///< searches of the training images for boxes that are found wrongly
    double cost = 0.05;       ///< C of the support vector machine
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const TemplateOptions& options) {
    expect(options.cells >= 9 && options.cells <= 1000, "TemplateOptions::cells", "9 ... 1000",
           options.cells);
    expect(options.jittered_copies >= 0 && options.jittered_copies <= 100, "TemplateOptions::jittered_copies",
           "0 ... 100", options.jittered_copies);
    expect(options.mining_rounds >= 0 && options.mining_rounds <= 100, "TemplateOptions::mining_rounds",
           "0 ... 100", options.mining_rounds);
    expect(options.cost >= 1e-9 && options.cost <= 1e9, "TemplateOptions::cost", "1e-9 ... 1e9",
           options.cost);
}

/// @brief A training image for templates, with the hypotheses that were found on it without votes of its own
/// objects.
struct TemplateImage {
    ImageView<const Rgb> color;
    std::vector<ObjectLabel> labels;
    std::vector<ProposedBox> proposals;
    WordMap words = {};     ///< for judges that know words too …
    VotedBoxes voted = {};  ///< … and votes, without those of its own objects
};

namespace detail {

/// A box near another: moved by up to so many parts of its sides, its size and aspect changed by up to so
/// much (logarithms).
[[nodiscard]] inline Box jittered(const Box& box, Random& random, double place, double size, double aspect) {
    const double s = std::exp(random.uniform(-size, size));
    const double w = box.width * s * std::exp(random.uniform(-aspect, aspect)), h = box.height * s;
    const double x = box.x + box.width / 2 + random.uniform(-place, place) * box.width;
    const double y = box.y + box.height / 2 + random.uniform(-place, place) * box.height;
    return {x - w / 2, y - h / 2, w, h};
}

/// Of the objects of a class, the IoU with that which overlaps most.
[[nodiscard]] inline double best_iou(const Box& box, const std::vector<ObjectLabel>& labels,
                                     std::uint32_t class_index) {
    double best = 0;
    for (const ObjectLabel& label : labels)
        if (label.class_index == class_index) best = std::max(best, iou(box, label.box));
    return best;
}

/// A template without weights: the grid and the aspects of a class from its labelled boxes. It has a ring
/// where more than half of what lies around its boxes lies in the images.
[[nodiscard]] inline BoxTemplate blank_template(std::span<const TemplateImage> images,
                                                std::uint32_t class_index, int cells) {
    std::vector<double> aspects;
    double inside = 0, around = 0;
    for (const TemplateImage& image : images)
        for (const ObjectLabel& label : image.labels) {
            if (label.class_index != class_index) continue;
            aspects.push_back(std::log(label.box.width / label.box.height));
            const double m = std::sqrt(label.box.area() / cells);
            const Box wide{label.box.x - m, label.box.y - m, label.box.width + 2 * m,
                           label.box.height + 2 * m};
            const Box picture{0, 0, double(image.color.width()), double(image.color.height())};
            inside += (intersection(wide, picture).area() - intersection(label.box, picture).area()) /
                      (wide.area() - label.box.area());
            around += 1;
        }
    expect(!aspects.empty(), lazy_text("templates: objects of class ", class_index), "1 or more", 0);
    BoxTemplate result;
    std::sort(aspects.begin(), aspects.end());
    const double middle = aspects[aspects.size() / 2];
    double mean = 0, spread = 0;
    for (const double a : aspects) mean += a / double(aspects.size());
    for (const double a : aspects) spread += (a - mean) * (a - mean) / double(aspects.size());
    result.log_aspect = float(middle), result.log_aspect_spread = float(std::max(0.1, std::sqrt(spread)));
    result.grid = {.columns = std::max(3, int(std::lround(std::sqrt(cells * std::exp(middle))))),
                   .rows = std::max(3, int(std::lround(std::sqrt(cells / std::exp(middle))))),
                   .ring = inside > 0.5 * around};
    return result;
}

/// Which of the positives are shown mirrored: the assignment whose mean is longest, from six starts.
[[nodiscard]] inline std::vector<std::uint8_t> sides_of(std::span<const float* const> plain,
                                                        std::span<const float* const> mirrored,
                                                        std::size_t dimension) {
    const std::size_t count = plain.size();
    std::vector<std::uint8_t> best;
    double longest = -1;
    for (std::uint64_t start = 0; start < 6; ++start) {
        Random random(start);
        std::vector<std::uint8_t> side(count, 0);
        if (start > 0)
            for (auto& s : side) s = random.uniform() < 0.5;
        std::vector<double> mean(dimension);
        for (int round = 0; round < 12; ++round) {
            std::fill(mean.begin(), mean.end(), 0.0);
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t k = 0; k < dimension; ++k) mean[k] += (side[i] ? mirrored : plain)[i][k];
            bool changed = false;
            for (std::size_t i = 0; i < count; ++i) {
                double a = 0, b = 0;
                for (std::size_t k = 0; k < dimension; ++k)
                    a += mean[k] * plain[i][k], b += mean[k] * mirrored[i][k];
                const std::uint8_t now = b > a;
                changed = changed || now != side[i];
                side[i] = now;
            }
            if (!changed) break;
        }
        double length = 0;
        for (const double m : mean) length += m * m;
        if (length > longest * (1 + 1e-9)) longest = length, best = side;
    }
    return best;
}

/// What a template is fitted to, of one image: rows of cells.
struct TemplateExamples {
    std::vector<float> plain = {}, mirrored = {};  ///< boxes of objects, and the same as a mirror shows them
    std::vector<float> negative = {};
};

/// The cells of boxes, as they are or mirrored, one row after another.
class CellRows {
public:
    CellRows(const HogPyramid& pyramid, const BoxGrid& grid)
        : pyramid_(pyramid), grid_(grid), cells_(grid.cells() * cell_numbers) {}

    void append(const Box& box, bool mirrored, std::vector<float>& rows) {
        describe_cells(pyramid_, box, grid_, cells_, scratch_);
        const std::vector<float>& row = mirrored ? mirror_ = mirrored_cells(cells_, grid_) : cells_;
        rows.insert(rows.end(), row.begin(), row.end());
    }

private:
    const HogPyramid& pyramid_;
    const BoxGrid& grid_;
    CellScratch scratch_;
    std::vector<float> cells_, mirror_;
};

/// The hypotheses and the labelled boxes of an image.
[[nodiscard]] inline std::vector<ProposedBox> all_boxes(const TemplateImage& image) {
    std::vector<ProposedBox> boxes = image.proposals;
    for (const ObjectLabel& label : image.labels) boxes.push_back({label.class_index, label.box});
    return boxes;
}

/// What an image shows of a class, and what is none: hypotheses, and boxes beside or across objects.
[[nodiscard]] inline TemplateExamples first_examples(const TemplateImage& image, const HogPyramid& pyramid,
                                                     std::uint32_t class_index, const BoxGrid& grid,
                                                     int copies, std::size_t max_negatives, Random& random) {
    TemplateExamples examples;
    CellRows rows(pyramid, grid);
    std::vector<Box> others;
    for (const ProposedBox& proposal : image.proposals) others.push_back(proposal.box);
    for (const ObjectLabel& label : image.labels) {
        for (int k = 0; k < 6; ++k) others.push_back(jittered(label.box, random, 0.6, 0.7, 0.2));
        if (label.class_index != class_index) continue;
        for (int k = 0; k <= copies; ++k) {
            const Box box = k == 0 ? label.box : jittered(label.box, random, 0.04, 0.08, 0.08);
            rows.append(box, false, examples.plain);
            rows.append(box, true, examples.mirrored);
        }
    }
    std::erase_if(others, [&](const Box& box) { return best_iou(box, image.labels, class_index) >= 0.4; });
    for (std::size_t count = 0; count < max_negatives && !others.empty(); ++count) {
        std::swap(others[random.index(others.size())], others.back());
        rows.append(others.back(), random.uniform() < 0.5, examples.negative);
        others.pop_back();
    }
    return examples;
}

/// Boxes that a template takes for objects of its class, the best first.
struct MinedBoxes {
    std::vector<SearchedBox> boxes = {};
    std::vector<float> negative = {};  ///< the cells of those that show none
};

/// Lets a template look for its class where detection would.
[[nodiscard]] inline MinedBoxes mined_boxes(const TemplateImage& image, const HogPyramid& pyramid,
                                            std::uint32_t class_index, const TemplateScorer& scorer,
                                            std::size_t max_negatives, ThreadPool& pool, Random& random) {
    std::vector<ProposedBox> proposals = image.proposals;
    for (const ObjectLabel& label : image.labels)
        for (int k = 0; k < 4 && label.class_index == class_index; ++k)
            proposals.push_back({class_index, jittered(label.box, random, 0.4, 0.3, 0.3)});
    MinedBoxes mined;
    CellRows rows(pyramid, scorer.box_template().grid);
    std::size_t count = 0;
    for (const SearchedBox& box :
         propose_boxes(scorer, class_index, pyramid, proposals, searched_boxes, pool)) {
        if (count == max_negatives || box.score <= -1) break;
        mined.boxes.push_back(box);
        if (best_iou(box.box, image.labels, class_index) >= 0.5) continue;
        rows.append(box.box, box.mirrored, mined.negative);
        ++count;
    }
    return mined;
}

/// Where the rows of all images begin.
[[nodiscard]] inline std::vector<const float*> row_starts(std::span<const TemplateExamples> of_images,
                                                          std::vector<float> TemplateExamples::*rows,
                                                          std::size_t dimension) {
    std::vector<const float*> starts;
    for (const TemplateExamples& image : of_images) append(starts, ism::row_starts(image.*rows, dimension));
    return starts;
}

/// Fits the weights of a template, and then turns each object to the side that fits better.
inline void fit_template(BoxTemplate& one, std::span<const TemplateExamples> examples,
                         std::vector<std::uint8_t>& side, double cost) {
    const std::size_t dimension = one.grid.cells() * cell_numbers;
    const auto plain = row_starts(examples, &TemplateExamples::plain, dimension),
               mirrored = row_starts(examples, &TemplateExamples::mirrored, dimension),
               negative = row_starts(examples, &TemplateExamples::negative, dimension);
    if (side.empty()) side = sides_of(plain, mirrored, dimension);
    const std::size_t positives = plain.size(), negatives = negative.size();
    std::vector<const float*> rows;
    for (std::size_t i = 0; i < positives; ++i) rows.push_back(side[i] ? mirrored[i] : plain[i]);
    rows.insert(rows.end(), negative.begin(), negative.end());
    std::vector<std::uint8_t> positive(rows.size(), 0);
    std::fill_n(positive.begin(), positives, std::uint8_t(1));
    const double rarer = double(negatives) / double(positives);
    LinearClassifier fit = fit_linear_svm(rows, dimension, positive,
                                          {.cost = cost, .positive_cost = std::max(1.0, 0.1 * rarer)});
    for (std::size_t i = 0; i < positives; ++i) {
        double ahead = 0;
        for (std::size_t k = 0; k < dimension; ++k)
            ahead += double(fit.weights[k]) * double(mirrored[i][k] - plain[i][k]);
        side[i] = ahead > 0;
    }
    one.weights = std::move(fit.weights), one.bias = float(fit.bias);
}

}  // namespace detail

/// @brief The template of each class, and of each image the boxes that they took for objects when it was last
/// searched for negatives, the likeliest first.
struct FittedTemplates {
    std::vector<BoxTemplate> templates;
    std::vector<std::vector<Box>> taken;
};

/// @brief Fits a template of each class to the boxes of its objects: a linear support vector machine over the
/// cells, for objects that look left or right (which is latent), with what it takes for objects wrongly on
/// the training images as further negatives (Felzenszwalb, Girshick, McAllester and Ramanan 2010).
/// @return the same for any number of threads
/// @throws Error where a class has no object, or an option is out of range.
[[nodiscard]] inline FittedTemplates fit_box_templates(std::span<const TemplateImage> images,
                                                       std::size_t classes, const TemplateOptions& options,
                                                       PyramidWorkers& workers,
                                                       const Progress& progress = {}) {
    check(options);
    FittedTemplates fitted{.templates = {}, .taken = std::vector<std::vector<Box>>(images.size())};
    std::vector<BoxTemplate>& templates = fitted.templates;
    for (std::uint32_t c = 0; c < classes; ++c)
        templates.push_back(detail::blank_template(images, c, options.cells));
    // so that the rows of all classes stay below a gigabyte
    const std::size_t max_rows = std::min<std::size_t>(6000, 40000 / classes),
                      of_image = std::max<std::size_t>(2, max_rows / images.size());
    std::vector<std::vector<detail::TemplateExamples>> examples(classes);
    std::vector<std::vector<std::uint8_t>> sides(classes);
    for (int round = 0; round <= options.mining_rounds; ++round) {
        std::vector<TemplateScorer> scorers;
        for (std::size_t c = 0; round > 0 && c < classes; ++c) scorers.emplace_back(templates[c]);
        std::vector<std::vector<detail::TemplateExamples>> found(images.size());
        ProgressCounter counter(progress, round == 0 ? "describing boxes" : "mining negatives",
                                images.size());
        workers.for_each(images.size(), [&](std::size_t i, HogPyramid& pyramid) {
            ThreadPool pool(1);
            pyramid.assign(images[i].color, finest_level(detail::all_boxes(images[i])), pool);
            Random random(i + 1 + std::size_t(round) * images.size());
            std::vector<SearchedBox> taken;
            for (std::uint32_t c = 0; c < classes; ++c) {
                if (round == 0) {
                    found[i].push_back(detail::first_examples(images[i], pyramid, c, templates[c].grid,
                                                              options.jittered_copies, of_image, random));
                } else {
                    detail::MinedBoxes mined = detail::mined_boxes(
                        images[i], pyramid, c, scorers[c], std::min<std::size_t>(6, of_image), pool, random);
                    taken.insert(taken.end(), mined.boxes.begin(), mined.boxes.end());
                    found[i].push_back({.negative = std::move(mined.negative)});
                }
            }
            detail::sort_by(taken, [](const SearchedBox& box) { return detail::falling(box.score); });
            fitted.taken[i].clear();
            for (const SearchedBox& box : taken) fitted.taken[i].push_back(box.box);
            counter.step();
        });
        for (auto& of_one : found)
            for (std::size_t c = 0; c < classes; ++c) examples[c].push_back(std::move(of_one[c]));
        workers.pool().for_each(classes, [&](std::size_t c, unsigned) {
            detail::fit_template(templates[c], examples[c], sides[c], options.cost);
        });
    }
    return fitted;
}

}  // namespace ism
