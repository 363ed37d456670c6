// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Features of other libraries, where they are installed, in the types of ism: oriented, with float
/// SIFT descriptors, first octave doubled, 3 levels an octave.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/sift.hpp"

#ifdef ISM_HAVE_OPENCV
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#endif
#ifdef ISM_HAVE_VLFEAT
extern "C" {
#include <vl/covdet.h>
#include <vl/sift.h>
}
#endif

namespace bench {

using Features = ism::FeatureSet<float>;
using ByteImage = ism::Image<std::uint8_t>;

/// @brief So many features with SIFT descriptors of zeros.
[[nodiscard]] inline Features sift_features(std::size_t count = 0) {
    return {.features = std::vector<ism::Feature>(count),
            .descriptors = ism::Descriptors<float>(ism::Sift::dimension, count)};
}

/// @brief A library's detector and descriptor under a name.
struct FeaturePeer {
    std::string name, settings;
    std::function<Features(const ByteImage&, unsigned threads)> extract;
};

#ifdef ISM_HAVE_OPENCV
[[nodiscard]] inline FeaturePeer opencv_sift() {
    return {"OpenCV SIFT", "contrast 0.04, edge 10, sigma 1.6", [](const ByteImage& image, unsigned threads) {
                cv::setNumThreads(int(threads));
                const cv::Mat pixels(image.height(), image.width(), CV_8U,
                                     const_cast<std::uint8_t*>(image.pixels().data()));
                std::vector<cv::KeyPoint> keypoints;
                cv::Mat rows;
                cv::SIFT::create(0, 3, 0.04, 10, 1.6)->detectAndCompute(pixels, {}, keypoints, rows);
                Features set = sift_features(keypoints.size());
                for (std::size_t i = 0; i < keypoints.size(); ++i) {
                    const cv::KeyPoint& k = keypoints[i];
                    set.features[i] = {.x = k.pt.x,
                                       .y = k.pt.y,
                                       .scale = k.size / 2,
                                       .angle = float(k.angle * CV_PI / 180),
                                       .strength = k.response};
                    for (std::size_t j = 0; j < 128; ++j)
                        set.descriptors.row(i)[j] = rows.at<float>(int(i), int(j)) / 512;
                }
                return set;
            }};
}
#endif

#ifdef ISM_HAVE_VLFEAT
namespace detail {

struct Delete {
    void operator()(VlSiftFilt* filter) const { vl_sift_delete(filter); }
    void operator()(VlCovDet* detector) const { vl_covdet_delete(detector); }
};

}  // namespace detail

/// @brief The DoG detector and SIFT of vl_sift. The thresholds are those of OpenCV in its units.
[[nodiscard]] inline FeaturePeer vlfeat_sift() {
    return {
        "VLFeat DoG + SIFT", "peak 0.04/3, edge 10", [](const ByteImage& image, unsigned threads) {
            vl_set_num_threads(threads);
            std::vector<float> pixels(image.pixels().begin(), image.pixels().end());
            const std::unique_ptr<VlSiftFilt, detail::Delete> filter(
                vl_sift_new(image.width(), image.height(), -1, 3, -1));
            vl_sift_set_peak_thresh(filter.get(), 255 * 0.04 / 3);
            vl_sift_set_edge_thresh(filter.get(), 10);
            Features set = sift_features();
            std::vector<float> row(128);
            for (int more = vl_sift_process_first_octave(filter.get(), pixels.data()); more != VL_ERR_EOF;
                 more = vl_sift_process_next_octave(filter.get())) {
                vl_sift_detect(filter.get());
                const VlSiftKeypoint* keypoints = vl_sift_get_keypoints(filter.get());
                for (int i = 0; i < vl_sift_get_nkeypoints(filter.get()); ++i) {
                    double angles[4];
                    const int count = vl_sift_calc_keypoint_orientations(filter.get(), angles, &keypoints[i]);
                    for (int a = 0; a < count; ++a) {
                        vl_sift_calc_keypoint_descriptor(filter.get(), row.data(), &keypoints[i], angles[a]);
                        set.features.push_back({.x = keypoints[i].x,
                                                .y = keypoints[i].y,
                                                .scale = keypoints[i].sigma,
                                                .angle = float(angles[a])});
                        set.descriptors.push_back(row);
                    }
                }
            }
            return set;
        }};
}

/// @brief A detector of covdet, whose descriptors are taken from patches as its own front end does: 31 × 31
/// pixels over ±7.5 scales, smoothed by one scale.
[[nodiscard]] inline FeaturePeer vlfeat_covdet(const std::string& name, VlCovDetMethod method) {
    return {name, "default thresholds", [method](const ByteImage& image, unsigned threads) {
                vl_set_num_threads(threads);
                constexpr vl_size resolution = 15, side = 2 * resolution + 1;
                constexpr double extent = 7.5, smoothing = 1, step = extent / resolution;
                std::vector<float> pixels(image.pixels().begin(), image.pixels().end());
                for (float& value : pixels) value /= 255;
                const std::unique_ptr<VlCovDet, detail::Delete> detector(vl_covdet_new(method));
                vl_covdet_set_first_octave(detector.get(), -1);
                vl_covdet_put_image(detector.get(), pixels.data(), vl_size(image.width()),
                                    vl_size(image.height()));
                vl_covdet_detect(detector.get());
                vl_covdet_drop_features_outside(detector.get(), 2);
                vl_covdet_extract_orientations(detector.get());

                const std::unique_ptr<VlSiftFilt, detail::Delete> sift(vl_sift_new(16, 16, 1, 3, 0));
                vl_sift_set_magnif(sift.get(), 3);
                const auto* found =
                    static_cast<const VlCovDetFeature*>(vl_covdet_get_features(detector.get()));
                std::vector<float> patch(side * side), gradient(2 * side * side), row(128);
                Features set = sift_features();
                for (vl_size i = 0; i < vl_covdet_get_num_features(detector.get()); ++i) {
                    const VlFrameOrientedEllipse& frame = found[i].frame;
                    vl_covdet_extract_patch_for_frame(detector.get(), patch.data(), resolution, extent,
                                                      smoothing, frame);
                    vl_imgradient_polar_f(gradient.data(), gradient.data() + 1, 2, 2 * side, patch.data(),
                                          side, side, side);
                    vl_sift_calc_raw_descriptor(sift.get(), gradient.data(), row.data(), int(side), int(side),
                                                double(side - 1) / 2, double(side - 1) / 2,
                                                extent / (3.0 * (4 + 1) / 2) / step, VL_PI / 2);
                    const float scale = std::sqrt(std::fabs(frame.a11 * frame.a22 - frame.a12 * frame.a21));
                    set.features.push_back({.x = frame.x,
                                            .y = frame.y,
                                            .scale = scale,
                                            .angle = std::atan2(frame.a21, frame.a11),
                                            .strength = found[i].peakScore});
                    set.descriptors.push_back(row);
                }
                return set;
            }};
}
#endif

/// @brief All detectors of the libraries at hand, with SIFT.
[[nodiscard]] inline std::vector<FeaturePeer> feature_peers() {
    std::vector<FeaturePeer> peers;
#ifdef ISM_HAVE_OPENCV
    peers.push_back(opencv_sift());
#endif
#ifdef ISM_HAVE_VLFEAT
    peers.push_back(vlfeat_sift());
    peers.push_back(vlfeat_covdet("VLFeat Hessian-Laplace + SIFT", VL_COVDET_METHOD_HESSIAN_LAPLACE));
    peers.push_back(vlfeat_covdet("VLFeat Harris-Laplace + SIFT", VL_COVDET_METHOD_HARRIS_LAPLACE));
#endif
    return peers;
}

}  // namespace bench
