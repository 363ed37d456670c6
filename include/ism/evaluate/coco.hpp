// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/nearest_name.hpp"
#include "ism/dataset/coco_results.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/evaluate/coco_rule.hpp"
#include "ism/evaluate/evaluate.hpp"
#include "ism/evaluate/figures_json.hpp"
#include "ism/io/paths.hpp"
#include "ism/train/describe_object.hpp"

namespace ism {

/// @brief Options of evaluate().
struct EvaluateOptions {
    enum class Rule { iou, uiuc };
    Rule rule = Rule::iou;       ///< when a box matches: IouRule or UiucRule
    double iou_threshold = 0.5;  ///< of IouRule, above 0, up to 1
};

namespace detail {

/// What `measure(rule)` gives for the rule of the options.
template <class Measure>
[[nodiscard]] Evaluation with_rule(const EvaluateOptions& options, const Measure& measure) {
    if (options.rule == EvaluateOptions::Rule::uiuc) return measure(UiucRule{});
    expect(options.iou_threshold > 0 && options.iou_threshold <= 1, "IoU threshold", "above 0, at most 1",
           options.iou_threshold);
    return measure(IouRule{options.iou_threshold});
}

/// The objects of a data set, and what is to be ignored; where[i] is the image and the annotation of object
/// i, the number past the last one where an incomplete image as a whole is to be ignored.
struct DatasetTruth {
    std::vector<TruthObject> objects;
    std::vector<std::pair<std::size_t, std::size_t>> where;
};

[[nodiscard]] inline DatasetTruth truth_of(const Dataset& dataset) {
    DatasetTruth truth;
    for (std::size_t i = 0; i < dataset.images.size(); ++i)
        for (std::size_t a = 0; a < dataset.images[i].objects.size(); ++a) {
            const DatasetAnnotation& object = dataset.images[i].objects[a];
            truth.objects.push_back({i, object.class_index, object.box, object.crowd});
            truth.where.emplace_back(i, a);
        }
    for (std::size_t i = 0; i < dataset.images.size(); ++i) {
        const DatasetImage& image = dataset.images[i];
        for (std::uint32_t c = 0; image.incomplete && c < dataset.class_names.size(); ++c) {
            truth.objects.push_back({i, c, {0, 0, double(image.width), double(image.height)}, true});
            truth.where.emplace_back(i, image.objects.size());
        }
    }
    return truth;
}

/// Results with the data set's image and category numbers as indices; a result that names its class is of the
/// class of that name, whatever its number.
[[nodiscard]] inline std::vector<FoundObject> found_in(const Dataset& dataset,
                                                       std::span<const Result> results) {
    std::map<std::int64_t, std::size_t> image_of;
    std::map<std::int64_t, std::uint32_t> class_of;
    std::map<std::string, std::uint32_t> class_named;
    for (std::size_t i = 0; i < dataset.images.size(); ++i) image_of[dataset.images[i].id] = i;
    for (std::uint32_t c = 0; c < dataset.category_ids.size(); ++c) class_of[dataset.category_ids[c]] = c;
    for (std::uint32_t c = 0; c < dataset.class_names.size(); ++c) class_named[dataset.class_names[c]] = c;
    const std::string set =
        dataset.source.empty() ? "the data set" : "data set '" + one_line(dataset.source.string()) + "'";
    std::vector<FoundObject> found;
    for (const Result& result : results) {
        const auto image = image_of.find(result.image_id);
        const auto named = class_named.find(result.class_name);
        const auto category = class_of.find(result.category_id);
        const std::string place = join_text("result ", found.size(), ": ");
        expect(image != image_of.end(), lazy_text(place, "image_id"), lazy_text("an image of ", set),
               result.image_id);
        if (!result.class_name.empty() && named == class_named.end())
            throw Error(join_text(place, "class: expected a category of ", set, ", got '",
                                  one_line(result.class_name), "'",
                                  did_you_mean(result.class_name, dataset.class_names)));
        expect(named != class_named.end() || category != class_of.end(), lazy_text(place, "category_id"),
               lazy_text("a category of ", set), result.category_id);
        const DatasetImage& shown = dataset.images[image->second];
        if (const auto& packed = result.segmentation; packed)
            expect(packed->width == shown.width && packed->height == shown.height,
                   lazy_text(place, "mask size"), lazy_text(shown.width, "x", shown.height),
                   lazy_text(packed->width, "x", packed->height));
        found.push_back({image->second, named != class_named.end() ? named->second : category->second,
                         result.box, result.score});
    }
    return found;
}

}  // namespace detail

/// @brief Measures results against a data set; a result is of the class that it names, else of its category
/// id. Crowds are ignored, and in incomplete images what is no labelled object; masks are compared where both
/// have one, two at a time in memory.
/// @throws Error, naming the result, for an image or category number that the data set lacks, a mask of
/// another size than the image, or a score or box that is not finite.
template <MatchRule R>
[[nodiscard]] Evaluation evaluate(const Dataset& dataset, std::span<const Result> results, const R& rule) {
    const detail::DatasetTruth truth = detail::truth_of(dataset);
    const auto overlap = [&](std::size_t f, std::size_t t) {
        const DatasetImage& image = dataset.images[truth.where[t].first];
        const Mask mask =
            results[f].segmentation ? read_mask(image, image.objects[truth.where[t].second]) : Mask();
        if (mask.empty()) return std::numeric_limits<double>::quiet_NaN();
        return mask_iou(decompress_mask(*results[f].segmentation), mask);
    };
    return evaluate(truth.objects, detail::found_in(dataset, results), dataset.images.size(),
                    dataset.class_names, rule, overlap);
}

/// @brief The same with a rule chosen at run time.
/// @throws Error as above, and for a threshold that is not above 0 and at most 1.
[[nodiscard]] inline Evaluation evaluate(const Dataset& dataset, std::span<const Result> results,
                                         const EvaluateOptions& options = {}) {
    return detail::with_rule(options, [&](const auto& rule) { return evaluate(dataset, results, rule); });
}

namespace detail {

/// Images by the order of their numbers, as the official evaluation of COCO takes them.
class CocoOrder {
public:
    explicit CocoOrder(const Dataset& dataset) : dataset_(dataset) {
        for (const DatasetImage& image : dataset.images) place_[image.id];
        for (std::size_t next = 0; auto& [id, where] : place_) where = next++;
    }
    /// Objects or detections whose images are counted so.
    template <class Object>
    [[nodiscard]] std::vector<Object> ordered(std::vector<Object> objects) const {
        for (Object& object : objects) object.image = place_.at(dataset_.images[object.image].id);
        return objects;
    }

private:
    const Dataset& dataset_;
    std::map<std::int64_t, std::size_t> place_;
};

/// Overlaps of masks. The masks compared last are kept.
class CutOutOverlap {
public:
    /// @param truth, found  whose elements are compared
    CutOutOverlap(const Dataset& dataset, std::span<const Result> results, const DatasetTruth& truth,
                  std::span<const FoundObject> found, std::span<const TruthObject> objects)
        : dataset_(dataset), results_(results), truth_(truth), found_(found), objects_(objects) {}

    [[nodiscard]] double operator()(const FoundObject& found, const TruthObject& object) const {
        const auto f = std::size_t(&found - found_.data()), t = std::size_t(&object - objects_.data());
        if (!results_[f].segmentation) return 0;
        if (last_found_ != f) found_mask_ = decompress_mask(*results_[f].segmentation), last_found_ = f;
        if (!masks_.contains(t)) {
            if (last_image_ != truth_.where[t].first) masks_.clear();
            last_image_ = truth_.where[t].first;
            masks_[t] = mask_of(t);
        }
        return object.ignore ? share_in_mask(found_mask_, masks_[t]) : mask_iou(found_mask_, masks_[t]);
    }

private:
    /// Of what is ignored and has no mask, a difficult object or the rest of an image, all of its box.
    [[nodiscard]] Mask mask_of(std::size_t t) const {
        const auto [i, annotation] = truth_.where[t];
        const DatasetImage& image = dataset_.images[i];
        if (annotation == image.objects.size() || !image.objects[annotation].masked())
            return object_mask({.box = objects_[t].box}, image.width, image.height);
        return read_mask(image, image.objects[annotation]);
    }
    [[nodiscard]] static double share_in_mask(const Mask& found, const Mask& crowd) {
        std::size_t all = 0, inside = 0;
        for (std::size_t i = 0; i < found.pixels().size(); ++i) {
            all += found.pixels()[i] != 0;
            inside += found.pixels()[i] != 0 && crowd.pixels()[i] != 0;
        }
        return all > 0 ? double(inside) / double(all) : 0;
    }

    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    const Dataset& dataset_;
    std::span<const Result> results_;
    const DatasetTruth& truth_;
    std::span<const FoundObject> found_;
    std::span<const TruthObject> objects_;
    mutable std::size_t last_found_ = none, last_image_ = none;
    mutable Mask found_mask_;
    mutable std::map<std::size_t, Mask> masks_;  // of objects of the last image
};

}  // namespace detail

/// @brief Measures the boxes of results against a data set as the official evaluation of COCO does: images
/// come in the order of their numbers, crowds are ignored.
/// @throws Error as above.
[[nodiscard]] inline CocoEvaluation evaluate_coco(const Dataset& dataset, std::span<const Result> results) {
    const detail::CocoOrder order(dataset);
    return evaluate_coco(order.ordered(detail::truth_of(dataset).objects),
                         order.ordered(detail::found_in(dataset, results)), dataset.images.size(),
                         dataset.class_names);
}

/// @brief Measures the masks of results in the same way (the official evaluation's iouType "segm"). A result
/// without a mask overlaps nothing.
/// @throws Error as above, where an object that is not ignored is labelled by a box alone, and where no
/// result has a mask.
[[nodiscard]] inline CocoEvaluation evaluate_coco_masks(const Dataset& dataset,
                                                        std::span<const Result> results) {
    const detail::DatasetTruth truth = detail::truth_of(dataset);
    for (const DatasetImage& image : dataset.images)
        for (const DatasetAnnotation& object : image.objects)
            expect(object.crowd || object.masked(), lazy_text("label of ", file_text(image.file)),
                   "a mask, to measure masks", "a box alone");
    const auto is_cut_out = [](const Result& result) { return result.segmentation.has_value(); };
    expect(results.empty() || std::any_of(results.begin(), results.end(), is_cut_out), "results",
           "masks (segmentation)", "boxes alone");
    const detail::CocoOrder order(dataset);
    const std::vector<TruthObject> objects = order.ordered(truth.objects);
    const std::vector<FoundObject> found = order.ordered(detail::found_in(dataset, results));
    return evaluate_coco(objects, found, dataset.images.size(), dataset.class_names,
                         detail::CutOutOverlap(dataset, results, truth, found, objects));
}

}  // namespace ism
