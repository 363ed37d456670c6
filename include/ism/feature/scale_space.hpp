// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/feature/blur.hpp"
#include "ism/feature/gradient.hpp"

namespace ism {

/// @brief How a scale space is laid out. Deviations are in pixels.
struct ScaleSpaceOptions {
    int levels_per_octave = 3;        ///< S ≥ 1
    float base_sigma = 1.6f;          ///< of an octave's first level, in pixels of that level
    float input_sigma = 0.5f;         ///< blur the image comes with, in its pixels
    bool double_first_octave = true;  ///< begin with the image at twice its size
    int max_octaves = 16;             ///< at most so many
    int smallest_side = 8;            ///< no octave's shorter side, in its pixels, is below this
};

/// @brief Where a level lies in a scale space.
struct LevelIndex {
    int octave = 0, level = 0;
    [[nodiscard]] constexpr bool operator==(const LevelIndex&) const = default;
};

/// @brief A Gaussian pyramid (Lowe 2004, section 3): octave o holds the levels i = 0 … S + 2 with the
/// deviation sigma(o, i) = base_sigma · step(o) · 2^(i/S) in pixels of the input image, where step(o) is the
/// input pixels a pixel of the octave: 0.5 in a doubled octave, then 1, 2, 4 …
/// Pixel (x, y) of octave o lies at (x · step(o), y · step(o)) in the input image.
/// Reading is safe from many threads at once.
class ScaleSpace {
public:
    /// @brief Fills the scale space from `image` (brightness, at least 16×16), reusing its memory. The result
    /// is the same for any number of threads (0 = all the machine has).
    /// Where the image is blurrier than the first level should be, it is taken as it is.
    /// @throws Error where the image is smaller or an option out of range.
    void build(ImageView<const float> image, const ScaleSpaceOptions& options = {}, unsigned threads = 1) {
        check(image, options);
        options_ = options;
        lay_out(image.width(), image.height());
        fill_base(image, threads);
        std::vector<std::vector<float>> kernels;
        for (int i = 1; i < levels(); ++i)
            kernels.push_back(gaussian_kernel(options.base_sigma *
                                              std::sqrt(relative_variance(i) - relative_variance(i - 1))));
        for (int o = 0; o < octaves(); ++o) {
            if (o > 0) halve(level(o - 1, options.levels_per_octave), plane(o, 0));
            for (int i = 1; i < levels(); ++i)
                blur(level(o, i - 1), kernels[std::size_t(i - 1)], plane(o, i), threads);
        }
    }

    /// @brief Number of octaves; 0 before build().
    [[nodiscard]] int octaves() const { return octave_count_; }
    /// @brief Levels in each octave, S + 3.
    [[nodiscard]] int levels() const { return options_.levels_per_octave + 3; }
    [[nodiscard]] int levels_per_octave() const { return options_.levels_per_octave; }
    [[nodiscard]] const ScaleSpaceOptions& options() const { return options_; }
    /// @brief Size of the input image.
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// @brief Input pixels a pixel of the octave.
    [[nodiscard]] float step(int octave) const {
        return std::ldexp(1.0f, octave - (options_.double_first_octave ? 1 : 0));
    }
    /// @brief Deviation of a level (`level` may lie between two) in pixels of the input image.
    [[nodiscard]] float sigma(int octave, float level) const { return step(octave) * level_sigma(level); }
    /// @brief Deviation of a level (`level` may lie between two) in its own pixels.
    [[nodiscard]] float level_sigma(float level) const {
        return options_.base_sigma * std::exp2(level / float(options_.levels_per_octave));
    }

    /// @brief Brightness of a level.
    [[nodiscard]] ImageView<const float> level(int octave, int i) const {
        const Octave& o = octaves_[std::size_t(octave)];
        return {o.pixels.data() + o.plane() * std::size_t(i), o.width, o.height, o.stride};
    }

    /// @brief Gradient of a level, computed when first asked for.
    [[nodiscard]] GradientView gradient(int octave, int i, unsigned threads = 1) const {
        Octave& o = octaves_[std::size_t(octave)];
        const std::size_t size = o.plane();
        std::vector<float>& values = o.gradients[std::size_t(i)];
        {
            const std::lock_guard lock(*mutex_);
            values.resize(2 * size);
            if (!o.has_gradient[std::size_t(i)])
                detail::polar_gradient(level(octave, i), {values.data(), o.width, o.height, o.stride},
                                       {values.data() + size, o.width, o.height, o.stride}, threads);
            o.has_gradient[std::size_t(i)] = true;
        }
        return {{values.data(), o.width, o.height, o.stride},
                {values.data() + size, o.width, o.height, o.stride}};
    }

    /// @brief The level whose deviation is nearest to `scale` (pixels of the input image), among the levels
    /// 1 … S of an octave where there is a choice.
    /// @throws Error before build().
    [[nodiscard]] LevelIndex nearest_level(float scale) const {
        expect(octaves() > 0, "scale space", "a built one", "an empty one");
        const int levels_an_octave = options_.levels_per_octave;
        const float base = sigma(0, 0.0f);
        if (!(scale > base)) return {0, 0};
        const float octaves_up = std::min(64.0f, std::log2(scale / base));
        const int steps = int(std::lround(float(levels_an_octave) * octaves_up));
        const int octave = std::clamp((steps - 1) / levels_an_octave, 0, octaves() - 1);
        return {octave, std::min(steps - octave * levels_an_octave, levels() - 1)};
    }

private:
    struct Octave {
        int width = 0, height = 0;
        std::ptrdiff_t stride = 0;
        std::vector<float> pixels;                  // levels one after another
        std::vector<std::vector<float>> gradients;  // a level's magnitudes, then its angles
        std::vector<char> has_gradient;
        [[nodiscard]] std::size_t plane() const { return std::size_t(stride) * std::size_t(height); }
    };

    static void check(ImageView<const float> image, const ScaleSpaceOptions& options) {
        expect(image.width() >= 16 && image.height() >= 16, "image size", "at least 16x16", size_text(image));
        expect(options.levels_per_octave >= 1 && options.levels_per_octave <= 32, "levels_per_octave",
               "1 to 32", options.levels_per_octave);
        expect(options.base_sigma >= 0.5f && options.base_sigma <= 16, "base_sigma (pixels)", "0.5 to 16",
               options.base_sigma);
        expect(std::isfinite(options.input_sigma) && options.input_sigma >= 0, "input_sigma (pixels)",
               "0 or more", options.input_sigma);
        expect(options.max_octaves >= 1, "max_octaves", "1 or more", options.max_octaves);
        expect(options.smallest_side >= 2, "smallest_side (pixels)", "2 or more", options.smallest_side);
    }

    void lay_out(int width, int height) {
        width_ = width, height_ = height, octave_count_ = 0;
        if (!mutex_) mutex_ = std::make_unique<std::mutex>();
        int w = options_.double_first_octave ? 2 * width - 1 : width;
        int h = options_.double_first_octave ? 2 * height - 1 : height;
        for (; octave_count_ < options_.max_octaves; ++octave_count_, w = (w + 1) / 2, h = (h + 1) / 2) {
            if (octave_count_ > 0 && std::min(w, h) < options_.smallest_side) break;
            if (octaves_.size() == std::size_t(octave_count_)) octaves_.emplace_back();
            Octave& o = octaves_[std::size_t(octave_count_)];
            o.width = w, o.height = h, o.stride = (w + 15) / 16 * 16;
            o.pixels.resize(std::size_t(levels()) * o.plane());
            o.gradients.resize(std::size_t(levels()));
            o.has_gradient.assign(std::size_t(levels()), false);
        }
    }

    [[nodiscard]] ImageView<float> plane(int octave, int i) {
        Octave& o = octaves_[std::size_t(octave)];
        return {o.pixels.data() + o.plane() * std::size_t(i), o.width, o.height, o.stride};
    }

    [[nodiscard]] double relative_variance(int level) const {
        return std::exp2(2.0 * level / options_.levels_per_octave);
    }

    /// The first level. A doubled image is put into the place of the second level, which is not yet used.
    void fill_base(ImageView<const float> image, unsigned threads) {
        double have = options_.input_sigma;
        if (options_.double_first_octave) {
            twice(image, plane(0, 1), threads);
            image = level(0, 1);
            have *= 2;
        }
        const double missing = double(options_.base_sigma) * options_.base_sigma - have * have;
        if (missing > 1e-3) return blur(image, gaussian_kernel(std::sqrt(missing)), plane(0, 0), threads);
        for (int y = 0; y < image.height(); ++y)
            std::copy_n(image.row(y).data(), image.width(), plane(0, 0).row(y).data());
    }

    /// Pixel 2x is pixel x of the image. Those between come from four neighbours by the weights
    /// (−1, 9, 9, −1)/16, whose variance is 0: unlike means they add no blur.
    static void twice(ImageView<const float> image, ImageView<float> out, unsigned threads) {
        const int width = image.width(), last = image.height() - 1;
        const auto between = [](float a, float b, float c, float d) {
            return 0.5625f * (b + c) - 0.0625f * (a + d);
        };
        const auto source = [&](int y) { return image.row(std::clamp(y, 0, last)).data(); };
        parallel_for(std::size_t(last) + 1, threads, [&](std::size_t task) {
            std::vector<float> padded(std::size_t(width) + 3);
            float* const row = padded.data() + 1;
            for (int y = 2 * int(task); y < std::min(out.height(), 2 * int(task) + 2); ++y) {
                const float *a = source(y / 2 - 1), *b = source(y / 2), *c = source(y / 2 + 1),
                            *d = source(y / 2 + 2);
                for (int x = 0; x < width; ++x) row[x] = y % 2 == 0 ? b[x] : between(a[x], b[x], c[x], d[x]);
                row[-1] = row[0], row[width] = row[width + 1] = row[width - 1];
                float* to = out.row(y).data();
                for (int x = 0; x < width; ++x) to[2 * x] = row[x];
                for (int x = 0; x < width - 1; ++x)
                    to[2 * x + 1] = between(row[x - 1], row[x], row[x + 1], row[x + 2]);
            }
        });
    }

    static void halve(ImageView<const float> image, ImageView<float> out) {
        for (int y = 0; y < out.height(); ++y) {
            const float* from = image.row(2 * y).data();
            float* to = out.row(y).data();
            for (int x = 0; x < out.width(); ++x) to[x] = from[2 * x];
        }
    }

    ScaleSpaceOptions options_;
    int width_ = 0, height_ = 0, octave_count_ = 0;
    mutable std::vector<Octave> octaves_;
    std::unique_ptr<std::mutex> mutex_;
};

}  // namespace ism
