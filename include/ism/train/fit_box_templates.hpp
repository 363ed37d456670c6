// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/lanes.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/hog/search_box.hpp"
#include "ism/train/linear_svm.hpp"
#include "ism/train/other_ground.hpp"
#include "ism/train/template_examples.hpp"

namespace ism::detail {

/// By how much a row is likelier by these weights as a mirror shows it.
template <RowNumber T>
[[nodiscard]] float ahead_mirrored(std::span<const float> weights, const T* plain, const T* mirrored) {
    return sum_in_lanes<float, 16>(weights.size(),
                                   [&](std::size_t k) { return weights[k] * float(mirrored[k] - plain[k]); });
}

/// Which of the positives are shown mirrored: the assignment whose mean is longest, from six starts.
[[nodiscard]] inline std::vector<std::uint8_t> sides_of(std::span<const ExampleNumber* const> plain,
                                                        std::span<const ExampleNumber* const> mirrored,
                                                        std::size_t dimension) {
    const std::size_t count = plain.size();
    std::vector<std::uint8_t> best;
    double longest = -1;
    for (std::uint64_t start = 0; start < 6; ++start) {
        Random random(start);
        std::vector<std::uint8_t> side(count, 0);
        if (start > 0)
            for (auto& s : side) s = random.uniform() < 0.5;
        std::vector<float> mean(dimension);
        for (int round = 0; round < 12; ++round) {
            std::fill(mean.begin(), mean.end(), 0.0f);
            for (std::size_t i = 0; i < count; ++i) {
                const ExampleNumber* shown = side[i] ? mirrored[i] : plain[i];
                for (std::size_t k = 0; k < dimension; ++k) mean[k] += float(shown[k]);
            }
            bool changed = false;
            for (std::size_t i = 0; i < count; ++i) {
                const std::uint8_t now = ahead_mirrored(mean, plain[i], mirrored[i]) > 0;
                changed = changed || now != side[i];
                side[i] = now;
            }
            if (!changed) break;
        }
        double length = 0;
        for (const float m : mean) length += double(m) * double(m);
        if (length > longest * (1 + 1e-9)) longest = length, best = side;
    }
    return best;
}

/// Templates of all classes that are fitted to all images, or to all but those of one fold.
struct TemplateFit {
    static constexpr std::size_t no_fold = std::numeric_limits<std::size_t>::max();

    std::size_t fold = no_fold;    ///< whose images they do not see
    std::vector<bool> known = {};  ///< of each class: whether other images show it
    std::vector<BoxTemplate> templates = {};
    std::vector<TemplateScorer> scorers = {};           ///< of these templates
    std::vector<std::vector<std::uint8_t>> sides = {};  ///< of each class: which objects are shown mirrored
    std::vector<std::vector<std::vector<ExampleNumber>>> mined = {};  ///< of each class and image: negatives
    std::vector<std::vector<Box>> taken = {};  ///< of each image: what they took for objects when they last
                                               ///< searched it, the likeliest first
};

/// @brief Fits a template of each class to the boxes of its objects: a linear support vector machine over the
/// cells, for objects that look left or right (which is latent), with what it takes for objects wrongly on
/// the training images as further negatives (Felzenszwalb, Girshick, McAllester and Ramanan 2010). It does so
/// for all images and side by side for all but each fold, since describing an image takes longer than
/// fitting. The same for any number of threads.
class TemplateFitter {
public:
    /// @param fold_of  of each image, below `folds`
    /// @throws Error where a class has no object, or an option is out of range.
    TemplateFitter(std::span<const TemplateImage> images, std::span<const std::size_t> fold_of,
                   std::size_t folds, std::size_t classes, const TemplateOptions& options)
        : images_(images),
          fold_of_(fold_of),
          options_(options),
          turned_copies_(object_count(images) <= 1000 ? options.turned_copies : 0),
          ground_copies_(object_count(images) <= 1000 ? options.ground_copies : 0),
          max_rows_(std::min<std::size_t>(6000, 40000 / classes)),
          examples_(classes, std::vector<TemplateExamples>(images.size())) {
        check(options);
        for (std::uint32_t c = 0; c < classes; ++c) {
            const auto own =
                std::size_t(std::count_if(images.begin(), images.end(), [&](const TemplateImage& image) {
                    return shows(image.labels, c);
                }));
            learnt_from_.push_back(std::min(images.size(), own + max_other_images(classes)));
        }
        TemplateFit blank{.sides = std::vector<std::vector<std::uint8_t>>(classes),
                          .mined = {classes, std::vector<std::vector<ExampleNumber>>(images.size())},
                          .taken = std::vector<std::vector<Box>>(images.size())};
        for (std::uint32_t c = 0; c < classes; ++c)
            blank.templates.push_back(blank_template(images, c, options.cells));
        blank.known.assign(classes, true);
        fits_.push_back(blank);
        for (blank.fold = 0; blank.fold < folds; ++blank.fold) {
            blank.known = seen_classes(blank);
            if (std::find(blank.known.begin(), blank.known.end(), true) != blank.known.end())
                fits_.push_back(blank);
        }
    }

    /// The first sees all images. The others see all but a fold, and know the classes that these show.
    [[nodiscard]] const std::vector<TemplateFit>& fits() const { return fits_; }
    [[nodiscard]] bool sees(const TemplateFit& fit, std::size_t image) const {
        return fold_of_[image] != fit.fold;
    }

    /// Describes the boxes of an image that are known beforehand.
    void describe(std::size_t image, const HogPyramid& pyramid, ThreadPool& pool) {
        Random random(image + 1);
        HogPyramid of_pictures;
        std::vector<const TemplateImage*> others;  // seen by the same fits
        for (std::size_t i = 0; i < images_.size(); ++i)
            if (i != image && fold_of_[i] == fold_of_[image] && images_[i].color.width() >= 2 &&
                images_[i].color.height() >= 2)
                others.push_back(&images_[i]);
        for (std::uint32_t c = 0; c < examples_.size(); ++c) {
            if (!learns_from(images_[image], c)) continue;
            const BoxGrid& grid = fits_[0].templates[c].grid;
            TemplateExamples& examples = examples_[c][image];
            examples = first_examples(images_[image], pyramid, c, grid, options_.jittered_copies,
                                      negatives_of_image(c), random);
            add_turned_examples(images_[image], c, grid, turned_copies_, random, of_pictures, pool, examples);
            add_examples_before(others, images_[image], c, grid, ground_copies_, random, of_pictures, pool,
                                examples);
        }
    }
    /// Lets templates look for their class where detection would, and keeps what they take for it wrongly.
    /// @param chosen  numbers of fits that see the image
    /// @param round   1 …
    void mine(std::size_t image, std::span<const std::size_t> chosen, int round, const HogPyramid& pyramid,
              ThreadPool& pool) {
        Random random(image + 1 + std::size_t(round) * images_.size());
        const TemplateImage& shown = images_[image];
        std::vector<std::vector<SearchedBox>> taken(chosen.size());
        for (std::uint32_t c = 0; c < examples_.size(); ++c) {
            if (!learns_from(shown, c)) continue;
            std::vector<ProposedBox> proposals = shown.asked[c];
            for (const ObjectLabel& label : shown.labels)
                for (int k = 0; k < 4 && label.class_index == c; ++k)
                    proposals.push_back({c, jittered(label.box, random, 0.4, 0.3, 0.3)});
            std::vector<std::size_t> knowing;  // places in `chosen`
            std::vector<const TemplateScorer*> scorers;
            for (std::size_t k = 0; k < chosen.size(); ++k)
                if (fits_[chosen[k]].known[c])
                    knowing.push_back(k), scorers.push_back(&fits_[chosen[k]].scorers[c]);
            if (scorers.empty()) continue;
            const auto found = propose_boxes(scorers, c, pyramid, proposals, searched_boxes, pool);
            CellRows rows(pyramid, fits_[0].templates[c].grid);
            for (std::size_t n = 0; n < knowing.size(); ++n) {
                const std::size_t k = knowing[n];
                TemplateFit& fit = fits_[chosen[k]];
                std::size_t room = mined_of_image(fit, c);
                for (const SearchedBox& box : found[n]) {
                    if (room == 0 || box.score <= -1) break;
                    const bool right = best_iou(box.box, shown.labels, c) >= right_iou;
                    if (!right && is_ignored(box.box, shown.ignored)) continue;
                    taken[k].push_back(box);
                    if (right) continue;
                    rows.append(box.box, box.mirrored, fit.mined[c][image]);
                    --room;
                }
            }
        }
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            sort_by(taken[k], [](const SearchedBox& box) { return falling(box.score); });
            std::vector<Box>& boxes = fits_[chosen[k]].taken[image];
            boxes.clear();
            for (const SearchedBox& box : taken[k]) boxes.push_back(box.box);
        }
    }
    /// Fits templates to what was described and mined so far.
    /// @param chosen  numbers of fits
    void fit(std::span<const std::size_t> chosen, ThreadPool& pool) {
        const std::size_t classes = examples_.size();
        pool.for_each(chosen.size() * classes,
                      [&](std::size_t i, unsigned) { fit_class(fits_[chosen[i / classes]], i % classes); });
        for (const std::size_t f : chosen)
            fits_[f].scorers = {fits_[f].templates.begin(), fits_[f].templates.end()};
    }

    /// The mean of the templates of all fits that know the class (bagging: Breiman 1996): much of what each
    /// has from the chance of its own examples cancels. Some come out mirrored: each is added on the side
    /// that is more like the first.
    [[nodiscard]] std::vector<BoxTemplate> mean_templates() const {
        std::vector<BoxTemplate> means = fits_[0].templates;
        for (std::size_t c = 0; c < means.size(); ++c) {
            const auto knows = [c](const TemplateFit& fit) { return bool(fit.known[c]); };
            const float share = 1 / float(std::count_if(fits_.begin(), fits_.end(), knows));
            const BoxTemplate& first = fits_[0].templates[c];
            BoxTemplate& mean = means[c];
            std::fill(mean.weights.begin(), mean.weights.end(), 0.0f), mean.bias = 0;
            for (const TemplateFit& fit : fits_) {
                if (!knows(fit)) continue;
                const std::vector<float>& plain = fit.templates[c].weights;
                const std::vector<float> mirrored = mirrored_cells(plain, first.grid);
                const bool turned = ahead_mirrored(first.weights, plain.data(), mirrored.data()) > 0;
                add_share(share, turned ? mirrored : plain, mean.weights);
                mean.bias += share * fit.templates[c].bias;
            }
        }
        return means;
    }

private:
    // so that the rows of all classes stay below half a gigabyte
    [[nodiscard]] std::size_t negatives_of_image(std::size_t class_index) const {
        return std::max<std::size_t>(2, max_rows_ / learnt_from_[class_index]);
    }
    [[nodiscard]] std::size_t mined_of_image(const TemplateFit& fit, std::size_t class_index) const {
        const std::size_t share = fit.fold == TemplateFit::no_fold ? 1 : fits_.size() - 1;
        return std::clamp<std::size_t>(max_rows_ / learnt_from_[class_index] / share, 2, 6);
    }
    [[nodiscard]] std::vector<bool> seen_classes(const TemplateFit& fit) const {
        std::vector<bool> seen(examples_.size(), false);
        for (std::size_t i = 0; i < images_.size(); ++i)
            for (const ObjectLabel& label : images_[i].labels)
                if (sees(fit, i)) seen[label.class_index] = true;
        return seen;
    }
    /// Fits the weights of a template, and then turns each object to the side that fits better.
    void fit_class(TemplateFit& fit, std::size_t class_index) const {
        BoxTemplate& one = fit.templates[class_index];
        std::vector<std::uint8_t>& side = fit.sides[class_index];
        const std::size_t dimension = one.grid.cells() * cell_numbers;
        one.weights.assign(dimension, 0.0f);
        if (!fit.known[class_index]) return;
        std::vector<const ExampleNumber*> plain, mirrored, negative;
        for (std::size_t i = 0; i < images_.size(); ++i) {
            if (!sees(fit, i)) continue;
            const TemplateExamples& examples = examples_[class_index][i];
            append(plain, row_starts(examples.plain, dimension));
            append(mirrored, row_starts(examples.mirrored, dimension));
            append(negative, row_starts(examples.negative, dimension));
            append(negative, row_starts(fit.mined[class_index][i], dimension));
        }
        if (side.empty()) side = sides_of(plain, mirrored, dimension);
        const std::size_t positives = plain.size();
        std::vector<const ExampleNumber*> rows;
        for (std::size_t i = 0; i < positives; ++i) rows.push_back(side[i] ? mirrored[i] : plain[i]);
        append(rows, negative);
        std::vector<std::uint8_t> positive(rows.size(), 0);
        std::fill_n(positive.begin(), positives, std::uint8_t(1));
        const double rarer = double(negative.size()) / double(positives);
        LinearClassifier classifier = fit_linear_svm<ExampleNumber>(
            rows, dimension, positive,
            {.cost = options_.cost, .positive_cost = std::max(1.0, 0.1 * rarer), .unit = example_unit});
        for (std::size_t i = 0; i < positives; ++i) {
            side[i] = ahead_mirrored(classifier.weights, plain[i], mirrored[i]) > 0;
        }
        one.weights = std::move(classifier.weights), one.bias = float(classifier.bias);
    }

    std::span<const TemplateImage> images_;
    std::span<const std::size_t> fold_of_;
    TemplateOptions options_;
    int turned_copies_, ground_copies_;
    std::size_t max_rows_;                                 // of negatives of a class
    std::vector<std::size_t> learnt_from_;                 // images, of each class
    std::vector<std::vector<TemplateExamples>> examples_;  // of each class and image
    std::vector<TemplateFit> fits_ = {};
};

}  // namespace ism::detail
