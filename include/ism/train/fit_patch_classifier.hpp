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
#include "ism/core/lists.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/fisher_vector.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/model/patch_classifier.hpp"
#include "ism/train/linear_svm.hpp"
#include "ism/train/pyramid_workers.hpp"
#include "ism/train/template_examples.hpp"
#include "ism/train/training_image.hpp"

namespace ism::detail {

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

/// The Fisher vectors of boxes of an image, one after another, and how far each box overlaps objects.
struct PatchRows {
    std::vector<float> rows = {};
    std::vector<std::vector<float>> overlaps = {};  ///< of each row, by class: the greatest IoU
};

/// Describes boxes of training images by their patches.
class PatchDescriber {
public:
    /// @param mixture  has to stay as long as this
    PatchDescriber(const PatchMixture& mixture, std::span<const TemplateImage> images, std::size_t classes)
        : encoder_(mixture), images_(images), classes_(classes) {
        copies_ = object_count(images) <= 1000 ? 2 : 0;
    }

    /// Objects on both sides, with copies that are a little off.
    [[nodiscard]] PatchRows objects(std::size_t image, const HogPyramid& pyramid) const {
        PatchRows result;
        const std::size_t rows = images_[image].labels.size() * std::size_t(2 * (1 + copies_));
        result.rows.reserve(rows * PatchMixture::vector_numbers);
        Random random(image + 1);
        for (const ObjectLabel& label : images_[image].labels)
            for (int k = 0; k <= copies_; ++k)
                add(k == 0 ? label.box : jittered(label.box, random, 0.04, 0.08, 0.08), image, pyramid, true,
                    true, result);
        return result;
    }
    /// Other boxes on one side, the first of them, so that the rows of a thousand images take 200 MB.
    /// @param share  of the rows, where several describe theirs
    [[nodiscard]] PatchRows others(std::size_t image, std::span<const Box> boxes, std::size_t share,
                                   const HogPyramid& pyramid) const {
        const std::size_t most = std::max<std::size_t>(4, 6000 / images_.size() / share);
        PatchRows result;
        result.rows.reserve(std::min(most, boxes.size()) * PatchMixture::vector_numbers);
        Random random(image + 1);
        for (const Box& box : boxes.first(std::min(most, boxes.size()))) {
            const bool mirrored = random.uniform() < 0.5;
            add(box, image, pyramid, !mirrored, mirrored, result);
        }
        return result;
    }

private:
    void add(const Box& box, std::size_t image, const HogPyramid& pyramid, bool plain, bool mirrored,
             PatchRows& to) const {
        CellScratch scratch;
        const BoxGrid grid = patch_grid(box);
        std::vector<float> cells(grid.cells() * cell_numbers);
        describe_cells(pyramid, box, grid, cells, scratch);
        std::vector<float> overlaps;
        for (std::uint32_t c = 0; c < classes_; ++c)
            overlaps.push_back(float(best_iou(box, images_[image].labels, c)));
        for (const bool mirror : {false, true}) {
            if (!(mirror ? mirrored : plain)) continue;
            append(to.rows, encoder_.encode(mirror ? mirrored_cells(cells, grid) : cells, grid));
            to.overlaps.push_back(overlaps);
        }
    }

    FisherEncoder encoder_;
    std::span<const TemplateImage> images_;
    std::size_t classes_;
    int copies_ = 0;  // of each object
};

/// Those that show the class against those that do not; what overlaps an object in part is left out. Where
/// none shows it the class stays unknown.
inline void fit_patch_weights(PatchClassifier& classifier, std::uint32_t class_index,
                              std::span<const PatchRows* const> parts) {
    constexpr double same_iou = 0.7, other_iou = 0.35;
    std::vector<const float*> rows;
    std::vector<std::uint8_t> positive;
    for (const PatchRows* part : parts)
        for (std::size_t i = 0; i < part->overlaps.size(); ++i) {
            const double overlap = double(part->overlaps[i][class_index]);
            if (overlap >= other_iou && overlap < same_iou) continue;
            rows.push_back(&part->rows[i * PatchMixture::vector_numbers]);
            positive.push_back(overlap >= same_iou);
        }
    const auto positives = double(std::count(positive.begin(), positive.end(), std::uint8_t(1))),
               negatives = std::max(1.0, double(positive.size()) - positives);
    if (positives == 0) return;
    // both kinds cost alike together
    LinearClassifier fit = fit_linear_svm(rows, PatchMixture::vector_numbers, positive,
                                          {.cost = (positives + negatives) / (2 * negatives),
                                           .positive_cost = negatives / positives,
                                           .bias_scale = 1});
    classifier.weights[class_index] = std::move(fit.weights);
    classifier.bias[class_index] = float(fit.bias);
}

/// Fits a classifier of what the patches of boxes look like, by linear support vector machines: boxes of
/// objects against boxes of other objects and of what templates took for objects. The same for any number of
/// threads.
[[nodiscard]] inline PatchClassifier fit_patch_classifier(std::span<const PatchRows* const> parts,
                                                          const PatchMixture& mixture, std::size_t classes,
                                                          ThreadPool& pool) {
    PatchClassifier classifier{.mixture = mixture,
                               .weights = std::vector<std::vector<float>>(classes),
                               .bias = std::vector<float>(classes)};
    pool.for_each(classes,
                  [&](std::size_t c, unsigned) { fit_patch_weights(classifier, std::uint32_t(c), parts); });
    return classifier;
}

}  // namespace ism::detail
