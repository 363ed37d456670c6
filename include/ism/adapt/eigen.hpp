// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief Eigen: images as arrays on the same memory, positions, rotations and cameras.

#if !__has_include(<Eigen/Core>)
#error "ism/adapt/eigen.hpp needs Eigen 3 (Debian: libeigen3-dev), by find_package(Eigen3) in CMake"
#include "ism_needs_Eigen"  // no such file: the compilation ends here
#endif
#include <optional>
#include <type_traits>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "ism/core/camera.hpp"
#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/rotation.hpp"
#include "ism/core/vec3.hpp"
#include "ism/detect/detection.hpp"

namespace ism {

/// @brief An image as Eigen sees it: rows are the image's rows, so a pixel is (y, x). Floats or whole
/// numbers.
template <class T>
using EigenImage = Eigen::Array<std::remove_const_t<T>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// @brief A view as an Eigen array on the same memory, without a copy; the image has to stay as long as the
/// map.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] auto eigen_map(ImageView<T> image) {
    using Array = std::conditional_t<std::is_const_v<T>, const EigenImage<T>, EigenImage<T>>;
    return Eigen::Map<Array, Eigen::Unaligned, Eigen::OuterStride<>>(image.empty() ? nullptr : &image(0, 0),
                                                                     image.height(), image.width(),
                                                                     Eigen::OuterStride<>(image.stride()));
}

/// @brief The same of an image; one that may be changed where the image may.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] auto eigen_map(Image<T>& image) {
    return eigen_map(image.view());
}
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] auto eigen_map(const Image<T>& image) {
    return eigen_map(image.view());
}
template <class T>
auto eigen_map(const Image<T>&& image) = delete;  // would not stay

/// @brief A matrix or array of Eigen, or a part of one.
template <class M>
concept EigenMatrix = requires(const M& matrix) {
    typename M::Scalar;
    matrix.derived();
    matrix.outerStride();
};

/// @brief A matrix or array of Eigen as a view, without a copy: any whose rows lie one after another in
/// memory (Eigen::RowMajor), a block too. It has to stay as long as the view.
template <EigenMatrix M>
[[nodiscard]] auto view_of(const M& matrix) {
    static_assert(bool(M::IsRowMajor),
                  "an image is a row-major matrix: Eigen::Array<float, Dynamic, Dynamic, RowMajor>");
    const auto& pixels = matrix.derived();
    expect(pixels.innerStride() == 1, "view of an Eigen matrix: inner stride", 1,
           (long long)(pixels.innerStride()));
    return ImageView<const typename M::Scalar>(pixels.data(), int(pixels.cols()), int(pixels.rows()),
                                               pixels.outerStride());
}

/// @brief A position in the camera frame, metres.
[[nodiscard]] inline Eigen::Vector3d to_eigen(const Point3& point) {
    return {point.x, point.y, point.z};
}
[[nodiscard]] inline Eigen::Vector3f to_eigen(Vec3f v) {
    return {v.x, v.y, v.z};
}
[[nodiscard]] inline Point3 to_point3(const Eigen::Vector3d& point) {
    return {point.x(), point.y(), point.z()};
}

/// @brief A rotation.
[[nodiscard]] inline Eigen::Quaternionf to_eigen(const Rotation& r) {
    return {r.w, r.x, r.y, r.z};
}
/// @param q  of any length but 0
[[nodiscard]] inline Rotation to_rotation(const Eigen::Quaternionf& q) {
    return normalized(Rotation{q.w(), q.x(), q.y(), q.z()});
}

/// @brief The camera's matrix K.
[[nodiscard]] inline Eigen::Matrix3d to_eigen(const Camera& camera) {
    return Eigen::Matrix3d{{camera.fx, 0, camera.cx}, {0, camera.fy, camera.cy}, {0, 0, 1}};
}
/// @throws Error as camera_of_matrix() does.
[[nodiscard]] inline Camera to_camera(const Eigen::Matrix3d& k) {
    return camera_of_matrix(
        {k(0, 0), k(0, 1), k(0, 2), k(1, 0), k(1, 1), k(1, 2), k(2, 0), k(2, 1), k(2, 2)});
}

/// @brief Where a detection's object is in the camera frame, metres, and how it is turned
/// (Detection::rotation; not at all where that is not known). None where its position is not known.
[[nodiscard]] inline std::optional<Eigen::Isometry3d> camera_from_object(const Detection& detection) {
    if (!detection.position_m) return {};
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = to_eigen(*detection.position_m);
    if (detection.rotation) pose.linear() = to_eigen(*detection.rotation).cast<double>().toRotationMatrix();
    return pose;
}

}  // namespace ism
