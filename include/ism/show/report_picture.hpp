// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "ism/core/image.hpp"
#include "ism/io/jpeg.hpp"
#include "ism/show/report_parts.hpp"
#include "ism/show/shrunk.hpp"
#include "ism/show/svg.hpp"

namespace ism {

/// @brief How much room a picture of a report may take.
struct ReportPictureOptions {
    int side_px = 720;               ///< its longer side; larger pictures are made smaller
    std::size_t most_bytes = 60000;  ///< of its file; 0 = any. Quality goes down first, then size
};

/// @brief Throws Error where an option is out of range.
inline void check(const ReportPictureOptions& options) {
    expect(options.side_px >= 16, "report pictures: longer side", "16 or more pixels", options.side_px);
}

/// @brief A picture for the figures of a report: a JPEG file of at most so many pixels and bytes.
/// @throws Error where the image has no pixels, or an option is out of range.
[[nodiscard]] inline std::shared_ptr<const ReportPicture> report_picture(
    ImageView<const Rgb> image, const ReportPictureOptions& options = {}) {
    check(options);
    expect(!image.empty(), "picture of a report", "at least 1x1 pixels", size_text(image));
    ReportPicture picture{.file = {}, .width = double(image.width()), .height = double(image.height())};
    double zoom = std::min(1.0, double(options.side_px) / std::max(image.width(), image.height()));
    for (;; zoom *= 0.75) {
        const RgbImage small = shrunk(image, zoom);
        for (const int quality : {88, 78, 66, 52}) {
            picture.file = encode_jpeg(small, quality);
            if (options.most_bytes == 0 || picture.file.size() <= options.most_bytes)
                return std::make_shared<const ReportPicture>(std::move(picture));
        }
        if (std::max(small.width(), small.height()) <= 32) break;
    }
    return std::make_shared<const ReportPicture>(std::move(picture));
}

/// @brief A figure that shows a whole picture.
[[nodiscard]] inline ReportFigure picture_figure(std::shared_ptr<const ReportPicture> picture,
                                                 std::string caption = {}) {
    const Box whole{0, 0, picture->width, picture->height};
    return {.caption = std::move(caption), .picture = std::move(picture), .part = whole};
}

/// @brief How wide a figure is on the screen so that it is not higher than `most_px`.
[[nodiscard]] inline int figure_width_px(const Box& part, int most_px) {
    return std::max(1, int(std::lround(std::min(1.0, part.width / part.height) * most_px)));
}

/// @brief A `rect` for a figure; `more` are further attributes.
[[nodiscard]] inline std::string svg_box(const Box& box, const std::string& more) {
    return "<rect x=\"" + detail::svg_number(box.x) + "\" y=\"" + detail::svg_number(box.y) + "\" width=\"" +
           detail::svg_number(box.width) + "\" height=\"" + detail::svg_number(box.height) + "\" " + more +
           "/>";
}

}  // namespace ism
