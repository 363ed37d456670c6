// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/voted_boxes.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/train/training_image.hpp"
#include "ism/train/turned_object.hpp"

namespace ism {

/// @brief How a template of each class is fitted to the boxes of its objects.
struct TemplateOptions {
    int cells = 100;          ///< of a box, about
    int jittered_copies = 2;  ///< of each object's box, moved by a few hundredths
    int turned_copies = 2;    ///< … and turned by 2 to 5 degrees, of up to a thousand objects
    int ground_copies = 1;    ///< … and cut out and put before the ground of other images
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
    expect(options.turned_copies >= 0 && options.turned_copies <= 100, "TemplateOptions::turned_copies",
           "0 ... 100", options.turned_copies);
    expect(options.ground_copies >= 0 && options.ground_copies <= 100, "TemplateOptions::ground_copies",
           "0 ... 100", options.ground_copies);
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
    std::vector<Box> ignored = {};                     ///< TrainingImage::ignored
    std::vector<ProposedBox> proposals = {};           ///< in what is ignored those of objects alone
    std::vector<std::vector<ProposedBox>> asked = {};  ///< … those that each class is asked about
    std::vector<const Mask*> masks = {};               ///< of each label; none where it is not known
    WordMap words = {};                                ///< for judges that know words too …
    VotedBoxes voted = {};                             ///< … and votes, without those of its own objects
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

/// Whether a box is that of a labelled object.
[[nodiscard]] inline bool shows_any(const Box& box, const std::vector<ObjectLabel>& labels) {
    return any_of(labels, [&](const ObjectLabel& label) { return iou(box, label.box) >= right_iou; });
}

/// Whether an image shows an object of a class.
[[nodiscard]] inline bool shows(const std::vector<ObjectLabel>& labels, std::uint32_t class_index) {
    return any_of(labels, [&](const ObjectLabel& label) { return label.class_index == class_index; });
}

/// How many images that do not show a class it learns from, at most: each class searches them all, which
/// otherwise takes time as the square of the classes.
[[nodiscard]] inline std::size_t max_other_images(std::size_t classes) {
    return std::max<std::size_t>(200, 4000 / classes);
}

/// Whether a class learns from an image, as an example of itself or of what it is not.
[[nodiscard]] inline bool learns_from(const TemplateImage& image, std::uint32_t class_index) {
    return !image.asked[class_index].empty() || shows(image.labels, class_index);
}

/// The number of objects in images.
[[nodiscard]] inline std::size_t object_count(std::span<const TemplateImage> images) {
    std::size_t count = 0;
    for (const TemplateImage& image : images) count += image.labels.size();
    return count;
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

/// A number of a cell as examples keep it, in multiples of example_unit: fitting waits for memory. Numbers of
/// cells lie within ±1.
using ExampleNumber = std::int16_t;
inline constexpr float example_unit = 1 / 16384.0f;

/// What a template is fitted to, of one image: rows of cells.
struct TemplateExamples {
    std::vector<ExampleNumber> plain = {}, mirrored = {};  ///< boxes of objects, and as a mirror shows them
    std::vector<ExampleNumber> negative = {};
};

/// The cells of boxes, as they are or mirrored, one row after another.
class CellRows {
public:
    CellRows(const HogPyramid& pyramid, const BoxGrid& grid)
        : pyramid_(pyramid), grid_(grid), cells_(grid.cells() * cell_numbers) {}

    void append(const Box& box, bool mirrored, std::vector<ExampleNumber>& rows) {
        describe_cells(pyramid_, box, grid_, cells_, scratch_);
        const std::vector<float>& row = mirrored ? mirror_ = mirrored_cells(cells_, grid_) : cells_;
        rows.resize(rows.size() + row.size());
        std::transform(row.begin(), row.end(), rows.end() - std::ptrdiff_t(row.size()), [](float number) {
            return ExampleNumber(number / example_unit + (number < 0 ? -0.5f : 0.5f));
        });
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
    std::erase_if(others, [&](const Box& box) {
        return best_iou(box, image.labels, class_index) >= 0.4 || is_ignored(box, image.ignored);
    });
    examples.negative.reserve(std::min(max_negatives, others.size()) * grid.cells() * cell_numbers);
    for (std::size_t count = 0; count < max_negatives && !others.empty(); ++count) {
        std::swap(others[random.index(others.size())], others.back());
        rows.append(others.back(), random.uniform() < 0.5, examples.negative);
        others.pop_back();
    }
    return examples;
}

/// Adds what a picture shows.
/// @param pyramid  for it
inline void add_picture(const ObjectPicture& object, std::uint32_t class_index, const BoxGrid& grid,
                        HogPyramid& pyramid, ThreadPool& pool, TemplateExamples& examples) {
    const ProposedBox shown[] = {{class_index, object.box}};
    pyramid.assign(object.picture, finest_level(shown), pool);
    CellRows rows(pyramid, grid);
    rows.append(object.box, false, examples.plain);
    rows.append(object.box, true, examples.mirrored);
}

/// What a picture has to show around a box, as a part of the root of its area: two cells.
[[nodiscard]] inline double picture_margin(const BoxGrid& grid) {
    return 2 / std::sqrt(double(grid.columns * grid.rows));
}

/// Adds the objects of a class turned a little to either side: as few training images show them, but others
/// will, where animals graze or rear, cars stand on a slope or the camera is held askew.
/// @param pyramid  for pictures of them
inline void add_turned_examples(const TemplateImage& image, std::uint32_t class_index, const BoxGrid& grid,
                                int copies, Random& random, HogPyramid& pyramid, ThreadPool& pool,
                                TemplateExamples& examples) {
    constexpr double least_rad = 2 * std::numbers::pi / 180, most_rad = 5 * std::numbers::pi / 180;
    for (const ObjectLabel& label : image.labels)
        for (int k = 0; k < copies && label.class_index == class_index; ++k) {
            const double angle_rad = random.uniform(least_rad, most_rad) * (k % 2 == 0 ? 1 : -1);
            add_picture(turned_object(image.color, label.box, angle_rad, picture_margin(grid)), class_index,
                        grid, pyramid, pool, examples);
        }
}

}  // namespace detail

}  // namespace ism
