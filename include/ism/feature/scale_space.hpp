// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "ism/core/aligned.hpp"
#include "ism/core/image.hpp"
#include "ism/feature/blur.hpp"
#include "ism/feature/brightness.hpp"
#include "ism/feature/row_sweep.hpp"
#include "ism/feature/scale_space_options.hpp"
#include "ism/feature/workspace.hpp"

namespace ism {

/// @brief Where a level lies in a scale space.
struct LevelIndex {
    int octave = 0, level = 0;
    [[nodiscard]] constexpr bool operator==(const LevelIndex&) const = default;
};

/// @brief A Gaussian pyramid (Lowe 2004, section 3): octave o holds the levels i = 0 … S + 2 with the
/// deviation sigma(o, i) = base_sigma · step(o) · 2^(i/S) in pixels of the input image, where step(o) is the
/// input pixels a pixel of the octave: 0.5 in a doubled octave, then 1, 2, 4 …
/// Pixel (x, y) of octave o lies at (x · step(o), y · step(o)) in the input image.
class ScaleSpace {
public:
    /// @brief Fills the scale space from `image` (brightness, at least 16×16), reusing its memory. The result
    /// is the same for any workspace.
    /// Where the image is blurrier than the first level should be, it is taken as it is.
    /// @throws Error where the image is smaller, a pixel is not finite or an option out of range.
    void build(ImageView<const float> image, const ScaleSpaceOptions& options, Workspace& workspace) {
        check_brightness(image, workspace);
        build(image, options, workspace, 0, [](int, int, int, unsigned) {});
    }

    /// @brief The same for pixels that are checked already, and calls `watch(octave, first, end, worker)` for
    /// rows of the octave, on many threads, as soon as all levels have them and `reach` rows above and below:
    /// while they are in the cache.
    template <std::invocable<int, int, int, unsigned> Watch>
    void build(ImageView<const float> image, const ScaleSpaceOptions& options, Workspace& workspace,
               int reach, const Watch& watch) {
        check_size(image), check(options);
        options_ = options;
        lay_out(image.width(), image.height());
        // stages: the doubled image, the levels, the watch
        const std::size_t stages = std::size_t(levels()) + 2;
        std::array<std::span<const float>, detail::most_stages> kernels;
        std::array<int, detail::most_stages> reaches{};
        for (std::size_t stage = 2; stage + 1 < stages; ++stage)
            kernels[stage] = workspace.kernel(missing_sigma(int(stage) - 1));
        if (const double missing = missing_base_sigma(); missing > 0) kernels[1] = workspace.kernel(missing);
        for (int o = 0; o < octaves(); ++o) {
            for (std::size_t stage = 1; stage + 1 < stages; ++stage)
                reaches[stage] = kernels[stage].empty() ? 0 : int(kernels[stage].size()) - 1;
            reaches[stages - 1] = reach;
            const auto make = [&](std::size_t stage, int first, int end, unsigned worker) {
                if (stage + 1 == stages)
                    watch(o, first, end, worker);
                else if (stage == 0)
                    make_doubled(image, o, first, end, worker, workspace);
                else
                    make_level(image, o, int(stage) - 1, kernels[stage], first, end, worker, workspace);
            };
            detail::sweep_rows(workspace.pool(), octaves_[std::size_t(o)].height,
                               std::span(reaches).first(stages), make);
            kernels[1] = {};  // the first level of the next octave is there
        }
    }

    /// @brief The same with threads and memory of its own.
    void build(ImageView<const float> image, const ScaleSpaceOptions& options = {}, unsigned threads = 1) {
        Workspace workspace(threads);
        build(image, options, workspace);
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

    /// @brief Every second pixel of the rows and columns of a level i = 1 … S, pixel (0, 0) the first.
    [[nodiscard]] ImageView<const float> halved(int octave, int i) const {
        const Octave& o = octaves_[std::size_t(octave)];
        return {o.halves.data() + o.half_plane() * std::size_t(i - 1), (o.width + 1) / 2, (o.height + 1) / 2,
                o.half_stride()};
    }

    /// @brief A level or half of one, and input pixels a pixel of it.
    struct Sampling {
        ImageView<const float> image;
        float step = 1;
    };
    /// @brief Where to look at what is around a feature of a scale (pixels of the input image): the level
    /// nearest to it, halved where it is blurred enough for that.
    /// @throws Error before build().
    [[nodiscard]] Sampling sampling(float scale) const {
        const auto [octave, i] = nearest_level(scale);
        if (i == 0) return {level(octave, 0), step(octave)};
        return {halved(octave, std::min(i, options_.levels_per_octave)), 2 * step(octave)};
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
        AlignedVector<float> pixels, halves;  // levels one after another
        [[nodiscard]] std::size_t plane() const { return std::size_t(stride) * std::size_t(height); }
        [[nodiscard]] std::ptrdiff_t half_stride() const { return whole_lines((width + 1) / 2); }
        [[nodiscard]] std::size_t half_plane() const {
            return std::size_t(half_stride()) * std::size_t((height + 1) / 2);
        }
    };

    static void check_size(ImageView<const float> image) {
        constexpr int longest = 1 << 16;
        expect(image.width() >= 16 && image.height() >= 16, "image size", "at least 16x16", size_text(image));
        expect(image.width() <= longest && image.height() <= longest, "image size", "at most 65536x65536",
               size_text(image));
    }

    void lay_out(int width, int height) {
        width_ = width, height_ = height, octave_count_ = 0;
        int w = options_.double_first_octave ? 2 * width - 1 : width;
        int h = options_.double_first_octave ? 2 * height - 1 : height;
        for (; octave_count_ < options_.max_octaves; ++octave_count_, w = (w + 1) / 2, h = (h + 1) / 2) {
            if (octave_count_ > 0 && std::min(w, h) < options_.smallest_side) break;
            if (octaves_.size() == std::size_t(octave_count_)) octaves_.emplace_back();
            Octave& o = octaves_[std::size_t(octave_count_)];
            o.width = w, o.height = h, o.stride = whole_lines(w);
            o.pixels.resize(std::size_t(levels()) * o.plane());
            o.halves.resize(std::size_t(options_.levels_per_octave) * o.half_plane());
            if (octave_count_ == 0 && options_.double_first_octave) doubled_.resize(o.plane());
        }
    }

    [[nodiscard]] ImageView<float> plane(int octave, int i) {
        Octave& o = octaves_[std::size_t(octave)];
        return {o.pixels.data() + o.plane() * std::size_t(i), o.width, o.height, o.stride};
    }

    [[nodiscard]] ImageView<float> half_plane(int octave, int i) {
        Octave& o = octaves_[std::size_t(octave)];
        return {o.halves.data() + o.half_plane() * std::size_t(i - 1), (o.width + 1) / 2, (o.height + 1) / 2,
                o.half_stride()};
    }

    /// What blur makes a level out of the one before it.
    [[nodiscard]] double missing_sigma(int level) const {
        const double octaves = 2.0 / options_.levels_per_octave;
        return options_.base_sigma * std::sqrt(std::exp2(level * octaves) - std::exp2((level - 1) * octaves));
    }

    /// What blur makes the first level out of the image, doubled or not; 0 where it needs none.
    [[nodiscard]] double missing_base_sigma() const {
        const double have = double(options_.input_sigma) * (options_.double_first_octave ? 2 : 1);
        const double missing = double(options_.base_sigma) * options_.base_sigma - have * have;
        return missing > 1e-3 ? std::sqrt(missing) : 0;
    }

    /// Rows of a level from the one before it, and of its half.
    void make_level(ImageView<const float> image, int octave, int i, std::span<const float> kernel, int first,
                    int end, unsigned worker, Workspace& workspace) {
        if (octave == 0 && options_.double_first_octave) image = doubled_plane();
        const ImageView<const float> from = i > 0        ? level(octave, i - 1)
                                            : octave > 0 ? halved(octave - 1, options_.levels_per_octave)
                                                         : image;
        const ImageView<float> to = plane(octave, i);
        if (kernel.empty()) {
            for (int y = first; y < end; ++y) std::copy_n(from.row(y).data(), to.width(), to.row(y).data());
        } else {
            const int radius = int(kernel.size()) - 1;
            const auto scratch = workspace.rows(worker, detail::blur_scratch(to.width(), radius));
            detail::blur_band([&](int y) { return from.row(y).data(); }, to.width(), to.height(), kernel,
                              first, end, scratch.data(), [&](int y) { return to.row(y).data(); });
        }
        if (i < 1 || i > options_.levels_per_octave) return;
        const ImageView<float> half = half_plane(octave, i);
        for (int y = (first + 1) / 2; 2 * y < end; ++y) {
            const float* row = to.row(2 * y).data();
            float* half_row = half.row(y).data();
            for (int x = 0; x < half.width(); ++x) half_row[x] = row[2 * x];
        }
    }

    /// Rows of the doubled image. Pixel 2x is pixel x of the image. Those between come from four neighbours
    /// by the weights (−1, 9, 9, −1)/16, whose variance is 0: unlike means they add no blur.
    void make_doubled(ImageView<const float> image, int octave, int first, int end, unsigned worker,
                      Workspace& workspace) {
        if (octave > 0 || !options_.double_first_octave) return;
        const int width = image.width(), last = image.height() - 1;
        const auto between = [](float a, float b, float c, float d) {
            return 0.5625f * (b + c) - 0.0625f * (a + d);
        };
        const auto source = [&](int y) { return image.row(std::clamp(y, 0, last)).data(); };
        const ImageView<float> out = doubled_plane();
        float* __restrict row = workspace.rows(worker, std::size_t(width) + 3).data() + 1;
        for (int y = first; y < end; ++y) {
            const float *a = source(y / 2 - 1), *b = source(y / 2), *c = source(y / 2 + 1),
                        *d = source(y / 2 + 2);
            if (y % 2 == 0)
                std::copy_n(b, width, row);
            else
                for (int x = 0; x < width; ++x) row[x] = between(a[x], b[x], c[x], d[x]);
            row[-1] = row[0], row[width] = row[width + 1] = row[width - 1];
            float* __restrict to = out.row(y).data();
            for (int x = 0; x < width - 1; ++x) {
                to[2 * x] = row[x];
                to[2 * x + 1] = between(row[x - 1], row[x], row[x + 1], row[x + 2]);
            }
            to[2 * width - 2] = row[width - 1];
        }
    }

    [[nodiscard]] ImageView<float> doubled_plane() {
        const Octave& o = octaves_[0];
        return {doubled_.data(), o.width, o.height, o.stride};
    }

    ScaleSpaceOptions options_;
    int width_ = 0, height_ = 0, octave_count_ = 0;
    std::vector<Octave> octaves_;
    AlignedVector<float> doubled_;
};

}  // namespace ism
