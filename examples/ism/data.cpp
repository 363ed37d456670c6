// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "data.hpp"

#include <string>

#include "input.hpp"
#include "pictures.hpp"
#include "voc.hpp"

namespace program {

namespace {

/// Tells masks that make no sense; their objects are ignored as crowds are.
void ignore_bad_masks(ism::Dataset& dataset, ism::Faults& faults) {
    for (ism::DatasetImage& image : dataset.images)
        for (ism::DatasetAnnotation& object : image.objects) {
            if (object.crowd) continue;
            object.crowd = !ism::read_or_tell(&faults, [&] {
                const ism::Mask mask = read_mask(image, object);
                const std::size_t area = mask_area(mask);
                if (!mask.empty() && area < 2)
                    throw ism::FileError(
                        ism::join_text(ism::file_text(image.file), ", annotation ", object.id,
                                       ": mask: expected at least 2 figure pixels, got ", area));
            });
        }
}

}  // namespace

ism::Dataset read_labels(const std::filesystem::path& path, ism::DatasetPart part, ism::Faults& faults) {
    const ism::DatasetReadOptions options{.faults = &faults, .part = part, .image_size = read_image_size};
    const ism::DatasetPlace place = ism::find_dataset(path);
    ism::Dataset dataset = place.format == ism::DatasetFormat::voc ? read_voc(place.path, options)
                                                                   : ism::read_any_dataset(place, options);
    tell_depth_left_out(dataset.depth_left_out);
    return dataset;
}

ism::Dataset read_data(const std::filesystem::path& path, ism::DatasetPart part, bool skip_bad) {
    ism::Faults faults;
    ism::Dataset dataset = read_labels(path, part, faults);
    ignore_bad_masks(dataset, faults);
    if (faults.size() == 1 && !skip_bad) throw ism::Error(faults[0] + " (--skip-bad goes on without it)");
    tell_faults(faults, "labels and images", skip_bad);
    ism::expect(!dataset.images.empty(), ism::file_text(path), "a data set with images", "one without");
    return dataset;
}

}  // namespace program
