// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief The Point Cloud Library: an organised cloud as an RGB-D frame, detections as positions and as the
/// points that belong to them. Needs the headers of its module common.

#if !__has_include(<pcl/point_cloud.h>)
#error "ism/adapt/pcl.hpp needs PCL (Debian: libpcl-dev), by find_package(PCL COMPONENTS common) in CMake"
#include "ism_needs_PCL"  // no such file: the compilation ends here
#endif
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <pcl/PointIndices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "ism/core/camera.hpp"
#include "ism/core/error.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/detect/detection.hpp"

namespace ism {

/// @brief A point of PCL with a place and a colour: pcl::PointXYZRGB, PointXYZRGBA, PointXYZRGBNormal …
template <class P>
concept ColoredPoint = requires(const P& point) {
    { point.x } -> std::convertible_to<float>;
    { point.y } -> std::convertible_to<float>;
    { point.z } -> std::convertible_to<float>;
    { point.r } -> std::convertible_to<std::uint8_t>;
    { point.g } -> std::convertible_to<std::uint8_t>;
    { point.b } -> std::convertible_to<std::uint8_t>;
};

namespace detail {

/// The straight line pixel = f·slope + c through the most points, by least squares.
class LineFit {
public:
    void add(double slope, double pixel) {
        ++count_, s_ += slope, p_ += pixel, ss_ += slope * slope, sp_ += slope * pixel;
    }
    [[nodiscard]] double f() const { return (count_ * sp_ - s_ * p_) / (count_ * ss_ - s_ * s_); }
    [[nodiscard]] double c() const { return (p_ - f() * s_) / count_; }

private:
    double count_ = 0, s_ = 0, p_ = 0, ss_ = 0, sp_ = 0;
};

}  // namespace detail

namespace detail {

template <ColoredPoint P>
void check_organised(const pcl::PointCloud<P>& cloud) {
    expect(cloud.isOrganized(), "cloud", "an organised one (rows and columns of an image)",
           lazy_text(cloud.width, "x", cloud.height));
    expect(cloud.size() == std::size_t(cloud.width) * cloud.height, "cloud: points",
           lazy_text(cloud.width, "x", cloud.height), cloud.size());
}

/// Calls `look(x, y, point)` for each point that was seen.
template <ColoredPoint P, class Look>
void for_each_reading(const pcl::PointCloud<P>& cloud, const Look& look) {
    for (int y = 0; y < int(cloud.height); ++y)
        for (int x = 0; x < int(cloud.width); ++x)
            if (const P& point = cloud(x, y); is_depth(point.z) && std::isfinite(point.x + point.y))
                look(x, y, point);
}

}  // namespace detail

/// @brief The camera that an organised cloud was seen by: pixel x is fx·X/Z + cx, by least squares over its
/// points.
/// @throws Error where the cloud is not organised, has points in fewer than two rows or columns, or more than
/// a hundredth of its points lie off the rays of a camera (x right, y down, z forward).
template <ColoredPoint P>
[[nodiscard]] Camera camera_of(const pcl::PointCloud<P>& cloud) {
    detail::check_organised(cloud);
    detail::LineFit along_x, along_y;
    std::size_t readings = 0, off = 0;
    detail::for_each_reading(cloud, [&](int x, int y, const P& point) {
        along_x.add(double(point.x) / double(point.z), x);
        along_y.add(double(point.y) / double(point.z), y);
        ++readings;
    });
    const Camera camera{along_x.f(), along_y.f(), along_x.c(), along_y.c()};
    expect(std::isfinite(camera.fx + camera.fy), "cloud", "points with depth in two rows and columns or more",
           lazy_text(readings, " with depth"));
    constexpr const char* rays = "points on the rays of a camera (x right, y down, z forward)";
    expect(camera.fx >= 1 && camera.fy >= 1, "cloud", rays,
           lazy_text("focal lengths of ", camera.fx, " and ", camera.fy, " px"));
    check(camera);
    detail::for_each_reading(cloud, [&](int x, int y, const P& point) {
        const Point2 pixel = project(camera, {point.x, point.y, point.z});
        off += std::hypot(pixel.x - x, pixel.y - y) > 1;
    });
    expect(off <= readings / 100, "cloud", rays, lazy_text(off, " of ", readings, " more than 1 px off"));
    return camera;
}

/// @brief An organised cloud as a frame: brightness, colour, depth along the optical axis, camera.
/// @param camera  of the cloud; none = camera_of(cloud)
/// @throws Error where the cloud is not organised, and as camera_of() does.
template <ColoredPoint P>
[[nodiscard]] Frame to_frame(const pcl::PointCloud<P>& cloud, const std::optional<Camera>& camera = {}) {
    detail::check_organised(cloud);
    Frame frame;
    frame.camera = camera ? *camera : camera_of(cloud);
    const int width = int(cloud.width), height = int(cloud.height);
    frame.color = RgbImage(width, height), frame.depth_m = DepthMap(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const P& point = cloud(x, y);
            frame.color(x, y) = {point.r, point.g, point.b};
            frame.depth_m(x, y) = is_depth(point.z) ? float(point.z) : no_depth;
        }
    frame.gray = to_gray(frame.color);
    return frame;
}

/// @brief Where the objects are that have a position, in the camera frame, metres; the label is the class.
[[nodiscard]] inline pcl::PointCloud<pcl::PointXYZL> to_positions(const Detections& detections) {
    pcl::PointCloud<pcl::PointXYZL> cloud;
    for (const Detection& object : detections.objects)
        if (const auto& p = object.position_m) {
            pcl::PointXYZL point;
            point.x = float(p->x), point.y = float(p->y), point.z = float(p->z),
            point.label = object.class_index;
            cloud.push_back(point);
        }
    return cloud;
}

/// @brief Which points of an organised cloud of width × height belong to an object: for pcl::ExtractIndices
/// and the like.
[[nodiscard]] inline pcl::PointIndices to_indices(const Segmentation& segmentation, int width, int height) {
    pcl::PointIndices indices;
    const Mask mask = whole_mask(segmentation, width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (mask(x, y) != 0) indices.indices.push_back(y * width + x);
    return indices;
}

}  // namespace ism
