// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "degrade.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "ism/core/random.hpp"
#include "ism/dataset/rle.hpp"
#include "ism/io/images.hpp"

namespace reproduce {

Shot with_depth_noise(Shot shot, double noise_m, std::uint64_t seed) {
    ism::Random random(seed);
    for (float& z : shot.frame.depth_m.pixels()) {
        const double noise = noise_m * random.normal();
        if (ism::is_depth(z)) z = float(std::max(0.05, z + noise * double(z) * double(z)));
    }
    return shot;
}

Shot with_holes(Shot shot, double share, std::uint64_t seed) {
    ism::DepthMap& depth = shot.frame.depth_m;
    constexpr int radius_px = 5;
    const double area = std::numbers::pi * radius_px * radius_px;
    // Of so many discs by chance 1 − exp(−discs · area / pixels) is covered.
    const double pixels = double(depth.width()) * depth.height();
    const auto discs = std::size_t(-std::log(1 - share) * pixels / area);
    ism::Random random(seed);
    for (std::size_t i = 0; i < discs; ++i) {
        const int x = int(random.index(std::uint64_t(depth.width()))),
                  y = int(random.index(std::uint64_t(depth.height())));
        for (int v = -radius_px; v <= radius_px; ++v)
            for (int u = -radius_px; u <= radius_px; ++u)
                if (u * u + v * v <= radius_px * radius_px && depth.contains(x + u, y + v))
                    depth(x + u, y + v) = 0;
    }
    return shot;
}

Shot with_shifted_depth(Shot shot, int shift_px) {
    const ism::DepthMap before = shot.frame.depth_m;
    for (int y = 0; y < before.height(); ++y)
        for (int x = 0; x < before.width(); ++x)
            shot.frame.depth_m(x, y) = before.contains(x - shift_px, y) ? before(x - shift_px, y) : 0;
    return shot;
}

Shot turned_in_plane(const Shot& shot, double degrees) {
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    const int width = shot.frame.gray.width(), height = shot.frame.gray.height();
    const ism::Camera& camera = *shot.frame.camera;
    /// The image that takes each pixel from where it was before the turn.
    const auto turned = [&](auto image, const auto& value_at) {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double u = x - camera.cx, v = y - camera.cy;
                image(x, y) = value_at(camera.cx + c * u + s * v, camera.cy - s * u + c * v);
            }
        return image;
    };
    const auto nearest = [](const auto& image) {
        return [&image](double x, double y) {
            using Value = std::remove_cvref_t<decltype(image(0, 0))>;
            const int i = int(std::lround(x)), j = int(std::lround(y));
            return image.contains(i, j) ? image(i, j) : Value{};
        };
    };
    const auto smooth = [&](double x, double y) {
        const ism::RgbImage& image = shot.frame.color;
        const int i = int(std::floor(x)), j = int(std::floor(y));
        if (!image.contains(i, j) || !image.contains(i + 1, j + 1)) return ism::Rgb{};
        const double a = x - i, b = y - j;
        const auto mix = [&](auto part) {
            return std::uint8_t(
                std::lround((1 - a) * (1 - b) * part(image(i, j)) + a * (1 - b) * part(image(i + 1, j)) +
                            (1 - a) * b * part(image(i, j + 1)) + a * b * part(image(i + 1, j + 1))));
        };
        return ism::Rgb{mix([](ism::Rgb p) { return p.r; }), mix([](ism::Rgb p) { return p.g; }),
                        mix([](ism::Rgb p) { return p.b; })};
    };
    Shot result = shot;
    result.frame.color = turned(ism::RgbImage(width, height), smooth);
    result.frame.gray = ism::to_gray(result.frame.color);
    result.frame.depth_m = turned(ism::DepthMap(width, height), nearest(shot.frame.depth_m));
    result.labels.objects.clear();
    for (ism::DatasetAnnotation label : shot.labels.objects) {
        const ism::Mask before = ism::read_mask(shot.labels, label);
        const ism::Mask mask = turned(ism::Mask(width, height), nearest(before));
        if (2 * ism::mask_area(mask) < ism::mask_area(before)) continue;
        label.box = ism::mask_box(mask);
        label.segmentation = ism::compress_mask(mask);
        if (label.position_m)
            label.position_m =
                ism::Point3{c * label.position_m->x - s * label.position_m->y,
                            s * label.position_m->x + c * label.position_m->y, label.position_m->z};
        result.labels.objects.push_back(std::move(label));
    }
    return result;
}

}  // namespace reproduce
