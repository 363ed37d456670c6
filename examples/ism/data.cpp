// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "data.hpp"

#include "input.hpp"

namespace program {

ism::Dataset read_data(const std::filesystem::path& path, ism::DatasetPart part, bool skip_bad) {
    ism::Faults faults;
    ism::Dataset dataset = ism::read_any_dataset(path, {.faults = &faults, .part = part});
    if (faults.size() == 1 && !skip_bad) throw ism::Error(faults[0]);
    tell_faults(faults, "labels and images", skip_bad);
    ism::expect(!dataset.images.empty(), ism::file_text(path), "a data set with images", "one without");
    return dataset;
}

}  // namespace program
