// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/fisher_vector.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/model/patch_classifier.hpp"
#include "ism/train/fit_box_templates.hpp"
#include "ism/train/linear_svm.hpp"
#include "ism/train/pyramid_workers.hpp"
#include "ism/train/training_image.hpp"

namespace ism {

namespace detail {

/// Patches of objects and of the strongest hypotheses, from up to a hundred images.
[[nodiscard]] inline std::vector<float> sampled_patches(std::span<const TemplateImage> images,
                                                        PyramidWorkers& workers) {
    constexpr std::size_t max_images = 100, max_patches = 12000, max_hypotheses = 3;
    const std::size_t count = std::min(max_images, images.size()), of_image = max_patches / count;
    std::vector<std::vector<float>> found(count);
    workers.for_each(count, [&](std::size_t i, HogPyramid& pyramid) {
        const TemplateImage& image = images[i * images.size() / count];
        std::vector<ProposedBox> boxes(
            image.proposals.begin(),
            image.proposals.begin() + std::ptrdiff_t(std::min(max_hypotheses, image.proposals.size())));
        for (const ObjectLabel& label : image.labels) boxes.push_back({label.class_index, label.box});
        if (boxes.empty()) return;
        ThreadPool pool(1);
        pyramid.assign(image.color, finest_level(boxes), pool);
        CellScratch scratch;
        Random random(i + 1);
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            const BoxGrid grid = patch_grid(boxes[b].box);
            std::vector<float> cells(grid.cells() * cell_numbers);
            describe_cells(pyramid, boxes[b].box, grid, cells, scratch);
            const auto columns = std::size_t(grid.all_columns());
            for (std::size_t k = b * of_image / boxes.size(); k < (b + 1) * of_image / boxes.size(); ++k) {
                const std::size_t x = random.index(columns - 1),
                                  y = random.index(std::uint64_t(grid.all_rows() - 1));
                for (const std::size_t first : {y * columns + x, (y + 1) * columns + x}) {
                    const auto pair = std::span(cells).subspan(first * cell_numbers, 2 * cell_numbers);
                    found[i].insert(found[i].end(), pair.begin(), pair.end());
                }
            }
        }
    });
    std::vector<float> patches;
    for (const auto& part : found) patches.insert(patches.end(), part.begin(), part.end());
    return patches;
}

/// The Fisher vectors of an image's boxes, one after another, and how far each box overlaps objects.
struct PatchRows {
    std::vector<float> rows = {};
    std::vector<std::vector<float>> overlaps = {};  ///< of each row, by class: the greatest IoU
};

/// Objects on both sides, with copies that are a little off, and other boxes on one side.
[[nodiscard]] inline PatchRows patch_rows(const TemplateImage& image, std::span<const Box> others,
                                          const FisherEncoder& encoder, const HogPyramid& pyramid,
                                          std::size_t classes, int copies, Random& random) {
    PatchRows result;
    CellScratch scratch;
    std::vector<float> cells;
    const auto add = [&](const Box& box, bool plain, bool mirrored) {
        const BoxGrid grid = patch_grid(box);
        cells.resize(grid.cells() * cell_numbers);
        describe_cells(pyramid, box, grid, cells, scratch);
        std::vector<float> overlaps;
        for (std::uint32_t c = 0; c < classes; ++c) overlaps.push_back(float(best_iou(box, image.labels, c)));
        for (const bool mirror : {false, true}) {
            if (!(mirror ? mirrored : plain)) continue;
            const std::vector<float> row = encoder.encode(mirror ? mirrored_cells(cells, grid) : cells, grid);
            result.rows.insert(result.rows.end(), row.begin(), row.end());
            result.overlaps.push_back(overlaps);
        }
    };
    for (const ObjectLabel& label : image.labels)
        for (int k = 0; k <= copies; ++k)
            add(k == 0 ? label.box : jittered(label.box, random, 0.04, 0.08, 0.08), true, true);
    for (const Box& box : others) {
        const bool mirrored = random.uniform() < 0.5;
        add(box, !mirrored, mirrored);
    }
    return result;
}

/// Those that show the class against those that do not; what overlaps an object in part is left out.
inline void fit_patch_weights(PatchClassifier& classifier, std::uint32_t class_index,
                              std::span<const PatchRows> of_images) {
    constexpr double same_iou = 0.7, other_iou = 0.35;
    std::vector<const float*> rows;
    std::vector<std::uint8_t> positive;
    for (const PatchRows& image : of_images)
        for (std::size_t i = 0; i < image.overlaps.size(); ++i) {
            const double overlap = double(image.overlaps[i][class_index]);
            if (overlap >= other_iou && overlap < same_iou) continue;
            rows.push_back(&image.rows[i * PatchMixture::vector_numbers]);
            positive.push_back(overlap >= same_iou);
        }
    const auto positives = double(std::count(positive.begin(), positive.end(), std::uint8_t(1))),
               negatives = std::max(1.0, double(positive.size()) - positives);
    // both kinds cost alike together
    LinearClassifier fit = fit_linear_svm(rows, PatchMixture::vector_numbers, positive,
                                          {.cost = (positives + negatives) / (2 * negatives),
                                           .positive_cost = negatives / std::max(1.0, positives),
                                           .bias_scale = 1});
    classifier.weights[class_index] = std::move(fit.weights);
    classifier.bias[class_index] = float(fit.bias);
}

}  // namespace detail

/// @brief Fits a classifier of what the patches of boxes look like, by linear support vector machines: boxes
/// of objects against boxes of other objects and of what templates took for objects.
/// @param boxes  of each image: what fit_box_templates() found
/// @return the same for any number of threads
[[nodiscard]] inline PatchClassifier fit_patch_classifier(std::span<const TemplateImage> images,
                                                          std::span<const std::vector<Box>> boxes,
                                                          const PatchMixture& mixture, std::size_t classes,
                                                          PyramidWorkers& workers) {
    // so that the rows of a thousand images and as many objects take 200 MB
    const std::size_t of_image = std::max<std::size_t>(4, 6000 / images.size());
    std::size_t objects = 0;
    for (const TemplateImage& image : images) objects += image.labels.size();
    const int copies = objects <= 1000 ? 2 : 0;
    PatchClassifier classifier{.mixture = mixture,
                               .weights = std::vector<std::vector<float>>(classes),
                               .bias = std::vector<float>(classes)};
    const FisherEncoder encoder(classifier.mixture);
    std::vector<detail::PatchRows> examples(images.size());
    workers.for_each(images.size(), [&](std::size_t i, HogPyramid& pyramid) {
        const auto others = std::span(boxes[i]).first(std::min(of_image, boxes[i].size()));
        std::vector<ProposedBox> all;
        for (const Box& box : others) all.push_back({0, box});
        for (const ObjectLabel& label : images[i].labels) all.push_back({label.class_index, label.box});
        ThreadPool pool(1);
        pyramid.assign(images[i].color, finest_level(all), pool);
        Random random(i + 1);
        examples[i] = detail::patch_rows(images[i], others, encoder, pyramid, classes, copies, random);
    });
    workers.pool().for_each(classes, [&](std::size_t c, unsigned) {
        detail::fit_patch_weights(classifier, std::uint32_t(c), examples);
    });
    return classifier;
}

}  // namespace ism
