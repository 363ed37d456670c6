// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#if defined(ISM_HAVE_DLIB)
#include <dlib/image_processing.h>
#include <dlib/svm_threaded.h>
#endif

#include "ism/core/frame.hpp"
#include "ism/core/frame_colors.hpp"
#include "ism/evaluate/matching.hpp"
#include "ism/train/training_image.hpp"

namespace bench {

/// @brief How dlib's detectors are trained.
struct DlibOptions {
    double window_area_px = 80 * 80;  ///< of the sliding window, whose aspect is the middle one of the class
    double cost = 5;                  ///< C of the structural support vector machine
    double epsilon = 0.01;            ///< where its solver ends
    bool mirror = false;              ///< images are also shown mirrored
    unsigned threads = 1;
    std::chrono::seconds max_time{600};  ///< of training a class
};

#if defined(ISM_HAVE_DLIB)

/// @brief A detector a class by dlib's sliding windows over gradient histograms (King 2015: Max-margin object
/// detection; Dalal and Triggs 2005, the cells of Felzenszwalb et al. 2010).
class DlibDetector {
public:
    using Scanner = dlib::scan_fhog_pyramid<dlib::pyramid_down<6>>;

    /// @param images  the objects of other classes are background
    DlibDetector(std::span<const ism::TrainingImage> images, std::size_t classes,
                 const DlibOptions& options) {
        for (std::uint32_t c = 0; c < classes; ++c) detectors_.push_back(trained(images, c, options));
    }

    /// @brief All that scores above −1, the margin of what is none.
    [[nodiscard]] std::vector<ism::FoundObject> detect(const ism::Frame& frame, std::size_t image) {
        std::vector<ism::FoundObject> found;
        const Picture picture = picture_of(frame);
        for (std::uint32_t c = 0; c < detectors_.size(); ++c) {
            std::vector<std::pair<double, dlib::rectangle>> boxes;
            detectors_[c](picture, boxes, -1);
            for (const auto& [score, r] : boxes)
                found.push_back({image,
                                 c,
                                 {double(r.left()), double(r.top()), double(r.width()), double(r.height())},
                                 score});
        }
        return found;
    }

private:
    using Picture = dlib::array2d<dlib::rgb_pixel>;

    [[nodiscard]] static Picture picture_of(const ism::Frame& frame) {
        const ism::RgbImage color = ism::FrameColors(frame).image();
        Picture picture(color.height(), color.width());
        for (int y = 0; y < color.height(); ++y)
            for (int x = 0; x < color.width(); ++x)
                picture[y][x] = {color(x, y).r, color(x, y).g, color(x, y).b};
        return picture;
    }

    [[nodiscard]] static dlib::object_detector<Scanner> trained(std::span<const ism::TrainingImage> images,
                                                                std::uint32_t class_index,
                                                                const DlibOptions& options) {
        dlib::array<Picture> pictures;
        std::vector<std::vector<dlib::rectangle>> boxes;
        std::vector<double> aspects;
        for (const ism::TrainingImage& image : images) {
            Picture picture = picture_of(image.frame);
            pictures.push_back(picture);
            boxes.emplace_back();
            for (const ism::LabelledObject& object : image.objects) {
                if (object.class_index != class_index) continue;
                const ism::Box& b = object.box;
                boxes.back().emplace_back(std::lround(b.x), std::lround(b.y), std::lround(b.x + b.width) - 1,
                                          std::lround(b.y + b.height) - 1);
                aspects.push_back(b.width / b.height);
            }
        }
        if (options.mirror) dlib::add_image_left_right_flips(pictures, boxes);
        std::sort(aspects.begin(), aspects.end());
        const double aspect = aspects[aspects.size() / 2];
        Scanner scanner;
        scanner.set_detection_window_size(
            (unsigned long)std::lround(std::sqrt(options.window_area_px * aspect)),
            (unsigned long)std::lround(std::sqrt(options.window_area_px / aspect)));
        dlib::structural_object_detection_trainer<Scanner> trainer(scanner);
        trainer.set_num_threads(options.threads);
        trainer.set_c(options.cost);
        trainer.set_epsilon(options.epsilon);
        trainer.set_max_runtime(options.max_time);
        // what no window overlaps by a half, by size or aspect, is neither object nor background
        const auto beyond = dlib::remove_unobtainable_rectangles(trainer, pictures, boxes);
        return trainer.train(pictures, boxes, beyond);
    }

    std::vector<dlib::object_detector<Scanner>> detectors_;
};

#endif

}  // namespace bench
