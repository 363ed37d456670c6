// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <utility>

#include "input.hpp"
#include "models.hpp"

#include "ism/detect/detect.hpp"
#include "ism/io/model_file.hpp"
#include "ism/io/write_file.hpp"

// The bodies of the templates of models.hpp; each models_*.cpp compiles them for one detector.
namespace program {

template <ism::Detector D, ism::Descriptor Desc>
ism::Model<D, Desc> learn(const Lessons& lessons) {
    const ism::Dataset& set = lessons.dataset;
    const auto source = [&](std::size_t i) {
        ism::TrainingImage image = ism::read_training_image(set.images[i]);
        image.name = short_name(set, set.images[i]);
        return image;
    };
    return ism::train<D, Desc>(set.class_names, set.images.size(), source, lessons.options);
}

template <ism::Detector D, ism::Descriptor Desc>
ism::Model<D, Desc> load(const std::filesystem::path& path) {
    return ism::load_model<D, Desc>(path);
}

template <ism::Detector D, ism::Descriptor Desc>
void save(const std::filesystem::path& path, const ism::Model<D, Desc>& model) {
    ism::save_model(path, model);
}

template <ism::Detector D, ism::Descriptor Desc>
Matched look_up(const ism::Model<D, Desc>& model, const ism::Frame& frame, unsigned threads) {
    auto found = ism::extract(frame.gray, model.extractor, threads);
    if (!frame.depth_m.empty()) found.features = ism::with_depth(std::move(found.features), frame.depth_m);
    auto matches = ism::match(model.codebook, found.descriptors, threads);
    return {std::move(found.features), std::move(matches)};
}

}  // namespace program
