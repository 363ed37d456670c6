// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "ism/core/image.hpp"
#include "ism/feature/blur.hpp"
#include "ism/feature/brightness.hpp"
#include "ism/feature/double_rows.hpp"
#include "ism/feature/row_sweep.hpp"
#include "ism/feature/row_window.hpp"
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
///
/// Either all of it is made at once by build(), or begin() is followed by calls of advance(), each of which
/// makes further rows of all octaves: then the finest octaves hold a band of rows only.
class ScaleSpace {
public:
    /// @brief Fills the scale space from `image` (brightness, at least 16×16), reusing its memory. The result
    /// is the same for any workspace.
    /// Where the image is blurrier than the first level should be, it is taken as it is.
    /// @throws Error where the image is smaller, check_brightness() refuses it or an option is out of range.
    void build(ImageView<const float> image, const ScaleSpaceOptions& options, Workspace& workspace) {
        check_brightness(image, workspace);
        begin(image, options, workspace);
        while (advance(workspace)) continue;
    }

    /// @brief The same with threads and memory of its own.
    void build(ImageView<const float> image, const ScaleSpaceOptions& options = {}, unsigned threads = 1) {
        Workspace workspace(threads);
        build(image, options, workspace);
    }

    /// @brief Prepares for advance(); `image`, which check_brightness() has accepted, is to stay until all
    /// rows are made. Where all levels take more than `max_bytes`, the finest octaves are held in bands, as
    /// many as it takes for the others to fit into half of it.
    /// @throws Error where the image is smaller than 16×16 or an option out of range.
    void begin(ImageView<const float> image, const ScaleSpaceOptions& options, const Workspace& workspace,
               std::size_t max_bytes = std::size_t(-1)) {
        constexpr int longest = 1 << 16;
        expect(image.width() >= 16 && image.height() >= 16, "image size", "at least 16x16", size_text(image));
        expect(image.width() <= longest && image.height() <= longest, "image size", "at most 65536x65536",
               size_text(image));
        check(options);
        options_ = options, image_ = image;
        lay_out(max_bytes);
        rows_at_once_ = std::clamp(128 * int(workspace.threads()), 256, 1024);
    }

    /// @brief Makes further rows of all octaves, as far as they follow from a band of the first one; all rows
    /// where no octave is held in bands. False where there was none to make.
    bool advance(Workspace& workspace) {
        const int height = level_height(0), before = octaves_[0].swept;
        if (before == height) return false;
        sweep(0, banded_ > 0 ? std::min(height, before + rows_at_once_) : height, workspace);
        for (int o = 1; o < octave_count_; ++o) {
            const int rows = rows_made(o - 1, options_.levels_per_octave);
            sweep(o, rows == level_height(o - 1) ? level_height(o) : (rows + 1) / 2, workspace);
        }
        return true;
    }

    /// @brief Octaves held in bands are made from their first row on again by advance(); the others stay.
    void rewind() {
        for (int o = 0; o < banded_; ++o) {
            Octave& octave = octaves_[std::size_t(o)];
            octave.swept = octave.wanted = 0;
            octave.levels.rewind(), octave.halves.rewind(), octave.doubled.rewind();
        }
    }

    /// @brief How many octaves, the finest ones, are held in bands.
    [[nodiscard]] int banded_octaves() const { return banded_; }
    /// @brief Number of rows of an octave that all its levels have. In an octave held in bands, rows before
    /// the one last given to forget() may be gone.
    [[nodiscard]] int rows_ready(int octave) const { return rows_made(octave, levels() - 1); }
    /// @brief Rows of an octave before `row` will not be looked at.
    void forget(int octave, int row) { octaves_[std::size_t(octave)].wanted = row; }

    /// @brief Number of octaves; 0 before build().
    [[nodiscard]] int octaves() const { return octave_count_; }
    /// @brief Levels in each octave, S + 3.
    [[nodiscard]] int levels() const { return options_.levels_per_octave + 3; }
    [[nodiscard]] int levels_per_octave() const { return options_.levels_per_octave; }
    /// @brief Size of the input image.
    [[nodiscard]] int width() const { return image_.width(); }
    [[nodiscard]] int height() const { return image_.height(); }
    /// @brief Rows of the levels of an octave.
    [[nodiscard]] int level_height(int octave) const { return octaves_[std::size_t(octave)].height; }

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
        return octaves_[std::size_t(octave)].levels.view(i);
    }
    /// @brief Every second pixel of the rows and columns of a level i = 1 … S, pixel (0, 0) the first.
    [[nodiscard]] ImageView<const float> halved(int octave, int i) const {
        return octaves_[std::size_t(octave)].halves.view(i - 1);
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
        int height = 0;
        detail::RowWindow levels, halves, doubled;
        int swept = 0;   // rows given of what level 0 is made of
        int wanted = 0;  // rows before are not looked at from outside
    };

    void lay_out(std::size_t max_bytes) {
        const bool doubled = options_.double_first_octave;
        std::array<int, max_scale_octaves> width, height;
        std::array<double, max_scale_octaves> bytes;
        double all_bytes = 0;
        int w = doubled ? 2 * image_.width() - 1 : image_.width();
        int h = doubled ? 2 * image_.height() - 1 : image_.height(), count = 0;
        for (; count < options_.max_octaves; ++count, w = (w + 1) / 2, h = (h + 1) / 2) {
            if (count > 0 && std::min(w, h) < options_.smallest_side) break;
            const auto o = std::size_t(count);
            const double planes = levels() + 0.25 * levels_per_octave() + (doubled && o == 0 ? 1 : 0);
            width[o] = w, height[o] = h;
            all_bytes += bytes[o] = planes * sizeof(float) * w * h;
        }
        banded_ = 0, octave_count_ = count;
        if (all_bytes > double(max_bytes))
            for (double rest = all_bytes; banded_ < count && rest > double(max_bytes) / 2; ++banded_)
                rest -= bytes[std::size_t(banded_)];
        for (int i = 0; i < count; ++i) {
            const auto hold = i < banded_ ? &detail::RowWindow::hold_some : &detail::RowWindow::hold_all;
            Octave& o = octaves_[std::size_t(i)];
            w = width[std::size_t(i)], h = height[std::size_t(i)];
            o.height = h, o.swept = o.wanted = 0;
            (o.levels.*hold)(levels(), w, h);
            (o.halves.*hold)(levels_per_octave(), (w + 1) / 2, (h + 1) / 2);
            if (doubled && i == 0) (o.doubled.*hold)(1, w, h);
        }
    }

    /// Rows of a level that can be made from the rows given.
    [[nodiscard]] int rows_made(int octave, int level) const {
        const Octave& o = octaves_[std::size_t(octave)];
        if (o.swept == o.height) return o.height;
        int lag = 0;
        for (int i = 0; i <= level; ++i) lag += kernel_radius(detail::missing_sigma(options_, octave, i));
        return std::max(0, o.swept - lag);
    }

    /// Makes what follows from the rows up to end − 1 of what level 0 of the octave is made of.
    void sweep(int octave, int end, Workspace& workspace) {
        Octave& o = octaves_[std::size_t(octave)];
        if (end <= o.swept) return;
        // stages: the doubled image, the levels
        const std::size_t stages = std::size_t(levels()) + 1;
        std::array<std::span<const float>, detail::most_stages> kernels;
        std::array<int, detail::most_stages> reaches{};
        int lag = 0, largest = 0;
        for (std::size_t stage = 1; stage < stages; ++stage) {
            const double missing = detail::missing_sigma(options_, octave, int(stage) - 1);
            if (missing > 0) kernels[stage] = workspace.kernel(missing);
            reaches[stage] = kernel_radius(missing);
            lag += reaches[stage], largest = std::max(largest, reaches[stage]);
        }
        if (octave < banded_) {
            int needed = std::min(o.wanted, o.swept - lag - largest);
            if (octave + 1 < octave_count_)
                needed = std::min(needed, 2 * octaves_[std::size_t(octave) + 1].swept);
            needed = std::max(0, needed / 2 * 2);
            o.levels.slide(needed, o.swept, end, workspace.pool());
            o.halves.slide(needed / 2, (o.swept + 1) / 2, (end + 1) / 2, workspace.pool());
            if (octave == 0 && options_.double_first_octave)
                o.doubled.slide(needed, o.swept, end, workspace.pool());
        }
        const auto make = [&](std::size_t stage, int first, int last, unsigned worker) {
            if (stage > 0)
                make_level(octave, int(stage) - 1, kernels[stage], first, last, worker, workspace);
            else if (octave == 0 && options_.double_first_octave)
                detail::double_rows(image_, first, last,
                                    workspace.rows(worker, detail::double_scratch(image_.width())).data(),
                                    o.doubled.view(0));
        };
        detail::sweep_rows(workspace.pool(), o.swept, end, o.height, {reaches.data(), stages}, make);
        o.swept = end;
    }

    /// Rows of a level from the one before it, and of its half.
    void make_level(int octave, int i, std::span<const float> kernel, int first, int end, unsigned worker,
                    Workspace& workspace) {
        Octave& o = octaves_[std::size_t(octave)];
        const ImageView<const float> from = i > 0        ? level(octave, i - 1)
                                            : octave > 0 ? halved(octave - 1, options_.levels_per_octave)
                                            : options_.double_first_octave
                                                ? ImageView<const float>(o.doubled.view(0))
                                                : image_;
        const ImageView<float> to = o.levels.view(i);
        if (kernel.empty()) {
            for (int y = first; y < end; ++y) std::copy_n(from.row(y).data(), to.width(), to.row(y).data());
        } else {
            const int radius = int(kernel.size()) - 1;
            const auto scratch = workspace.rows(worker, detail::blur_scratch(to.width(), radius));
            detail::blur_band([&](int y) { return from.row(y).data(); }, to.width(), to.height(), kernel,
                              first, end, scratch.data(), [&](int y) { return to.row(y).data(); });
        }
        if (i < 1 || i > options_.levels_per_octave) return;
        const ImageView<float> half = o.halves.view(i - 1);
        for (int y = (first + 1) / 2; 2 * y < end; ++y) {
            const float* row = to.row(2 * y).data();
            float* half_row = half.row(y).data();
            for (int x = 0; x < half.width(); ++x) half_row[x] = row[2 * x];
        }
    }

    ScaleSpaceOptions options_;
    ImageView<const float> image_;
    int octave_count_ = 0, banded_ = 0, rows_at_once_ = 0;
    std::array<Octave, max_scale_octaves> octaves_;
};

}  // namespace ism
