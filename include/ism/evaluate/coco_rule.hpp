// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/callable.hpp"
#include "ism/core/order.hpp"
#include "ism/evaluate/evaluate.hpp"

namespace ism {

/// @brief Figures by COCO's rule, all 0 … 1; NaN without objects.
struct CocoFigures {
    double ap = std::numeric_limits<double>::quiet_NaN();      ///< mean over the ten IoU thresholds
    double ap50 = std::numeric_limits<double>::quiet_NaN();    ///< at IoU .5
    double ap75 = std::numeric_limits<double>::quiet_NaN();    ///< at IoU .75
    double recall = std::numeric_limits<double>::quiet_NaN();  ///< of all counted, mean over the thresholds
};

/// @brief The figures of one class.
struct CocoClass {
    std::string name;
    std::size_t objects = 0;     ///< to find
    std::size_t detections = 0;  ///< the best 100 of each image; those ignored at IoU .5 are left out
    CocoFigures figures;
};

/// @brief An evaluation by COCO's rule.
struct CocoEvaluation {
    std::vector<CocoClass> classes;  ///< in the order of the class names
    CocoFigures mean;                ///< over classes with objects
};

/// @brief IoU thresholds: .5, .55 … .95, to the last bit those of the official evaluation.
inline constexpr std::array<double, 10> coco_thresholds = [] {
    std::array<double, 10> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = 0.5 + double(i) * ((0.95 - 0.5) / 9);
    all.back() = 0.95;
    return all;
}();

/// @brief Detections of an image and class that count, the best ones.
inline constexpr std::size_t coco_max_detections = 100;

/// @brief How much a detection overlaps an object, 0 … 1: the IoU, and of what is ignored the part of the
/// detection that lies in it.
template <class F>
concept CocoOverlap = Callable<F, const FoundObject&, const TruthObject&>;

/// @brief That of their boxes.
[[nodiscard]] inline double coco_box_overlap(const FoundObject& found, const TruthObject& truth) {
    return truth.ignore ? detail::share_inside(found.box, truth.box) : iou(found.box, truth.box);
}

namespace detail {

/// The objects and detections of one class in one image: crowds last, best score first.
struct CocoImage {
    std::vector<const TruthObject*> truth;
    std::vector<const FoundObject*> found;
};

/// A detection as it is counted at each threshold.
struct CocoVerdicts {
    double score = 0;
    std::array<Verdict, coco_thresholds.size()> at{};
};

/// The detections of one image: best score first each takes the object that overlaps most and is still free,
/// of equal ones the last; where there is none, any crowd.
template <CocoOverlap Overlap>
[[nodiscard]] std::vector<CocoVerdicts> coco_match(const CocoImage& image, const Overlap& overlap) {
    std::vector<CocoVerdicts> verdicts;
    std::vector<double> overlaps;
    for (const FoundObject* found : image.found) {
        verdicts.push_back({found->score});
        for (const TruthObject* truth : image.truth) overlaps.push_back(overlap(*found, *truth));
    }
    const std::size_t objects = image.truth.size();
    for (std::size_t t = 0; t < coco_thresholds.size(); ++t) {
        std::vector<char> taken(objects, 0);
        for (std::size_t f = 0; f < verdicts.size(); ++f) {
            Verdict& verdict = verdicts[f].at[t] = Verdict::false_positive;
            double best = coco_thresholds[t];
            std::size_t match = objects;
            for (std::size_t o = 0; o < objects; ++o) {
                const bool crowd = image.truth[o]->ignore;
                if (crowd && verdict == Verdict::true_positive) break;
                if (taken[o] != 0 || overlaps[f * objects + o] < best) continue;
                best = overlaps[f * objects + o], match = o;
                verdict = crowd ? Verdict::ignored : Verdict::true_positive;
            }
            if (verdict == Verdict::true_positive) taken[match] = 1;
        }
    }
    return verdicts;
}

/// Average precision at one threshold, and recall.
/// @param verdicts  best score first
[[nodiscard]] inline std::pair<double, double> coco_precision(std::span<const CocoVerdicts> verdicts,
                                                              std::size_t threshold, std::size_t objects) {
    std::vector<double> recall, precision;
    std::size_t right = 0, counted = 0;
    for (const CocoVerdicts& one : verdicts) {
        if (one.at[threshold] == Verdict::ignored) continue;
        right += one.at[threshold] == Verdict::true_positive, ++counted;
        recall.push_back(double(right) / double(objects));
        precision.push_back(double(right) / double(counted));
    }
    for (std::size_t i = precision.size(); i-- > 1;)
        precision[i - 1] = std::max(precision[i - 1], precision[i]);
    double sum = 0;
    for (std::size_t k = 0, i = 0; k <= 100; ++k) {
        while (i < recall.size() && recall[i] < double(k) * 0.01) ++i;
        if (i < recall.size()) sum += precision[i];
    }
    return {sum / 101, recall.empty() ? 0 : recall.back()};
}

template <CocoOverlap Overlap>
[[nodiscard]] CocoClass coco_class(std::span<CocoImage> images, std::string name, const Overlap& overlap) {
    CocoClass result;
    result.name = std::move(name);
    std::vector<CocoVerdicts> verdicts;
    for (CocoImage& image : images) {
        sort_by(image.truth, [](const TruthObject* o) { return std::uint64_t(o->ignore); });
        sort_by(image.found, [](const FoundObject* o) { return falling(o->score); });
        image.found.resize(std::min(image.found.size(), coco_max_detections));
        for (const TruthObject* truth : image.truth) result.objects += !truth->ignore;
        for (const CocoVerdicts& one : coco_match(image, overlap)) {
            verdicts.push_back(one);
            result.detections += one.at[0] != Verdict::ignored;
        }
    }
    if (result.objects == 0) return result;
    sort_by(verdicts, [](const CocoVerdicts& one) { return falling(one.score); });
    result.figures.ap = result.figures.recall = 0;
    for (std::size_t t = 0; t < coco_thresholds.size(); ++t) {
        const auto [precision, recall] = coco_precision(verdicts, t, result.objects);
        result.figures.ap += precision, result.figures.recall += recall;
        if (t == 0) result.figures.ap50 = precision;
        if (t == 5) result.figures.ap75 = precision;
    }
    result.figures.ap /= double(coco_thresholds.size());
    result.figures.recall /= double(coco_thresholds.size());
    return result;
}

}  // namespace detail

/// @brief Measures what was found in `image_count` images as the official evaluation of COCO does (Lin,
/// Maire, Belongie and others 2014; its program pycocotools, objects of any area): ten IoU thresholds, the
/// precision at 101 recalls, at most 100 detections of a class in an image. Of equal scores that of the image
/// of the lower index counts first.
/// @param overlap  of elements of `found` and `truth`
/// @throws Error where an index of an image or class is too large, or a score or box is not finite.
template <CocoOverlap Overlap>
[[nodiscard]] CocoEvaluation evaluate_coco(std::span<const TruthObject> truth,
                                           std::span<const FoundObject> found, std::size_t image_count,
                                           std::span<const std::string> class_names, const Overlap& overlap) {
    detail::check_indices(truth, found, image_count, class_names.size());
    for (const FoundObject& f : found) check(f);
    CocoEvaluation result;
    detail::Mean ap, ap50, ap75, recall;
    for (std::size_t c = 0; c < class_names.size(); ++c) {
        std::vector<detail::CocoImage> images(image_count);
        for (const TruthObject& t : truth)
            if (t.class_index == c) images[t.image].truth.push_back(&t);
        for (const FoundObject& f : found)
            if (f.class_index == c) images[f.image].found.push_back(&f);
        result.classes.push_back(detail::coco_class(images, class_names[c], overlap));
        const CocoFigures& figures = result.classes.back().figures;
        ap.add(figures.ap), ap50.add(figures.ap50), ap75.add(figures.ap75), recall.add(figures.recall);
    }
    result.mean = {ap.value(), ap50.value(), ap75.value(), recall.value()};
    return result;
}

/// @brief The same of boxes.
[[nodiscard]] inline CocoEvaluation evaluate_coco(std::span<const TruthObject> truth,
                                                  std::span<const FoundObject> found, std::size_t image_count,
                                                  std::span<const std::string> class_names) {
    return evaluate_coco(truth, found, image_count, class_names, coco_box_overlap);
}

}  // namespace ism
