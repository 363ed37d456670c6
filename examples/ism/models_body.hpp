// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <utility>

#include "input.hpp"
#include "models.hpp"

#include "ism/dataset/read_images.hpp"
#include "ism/detect/frame_matcher.hpp"
#include "ism/io/write_file.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/train/add_classes.hpp"

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
    if (!lessons.add_to.empty())
        return ism::add_classes(ism::load_model<D, Desc>(lessons.add_to), set.class_names, set.images.size(),
                                source,
                                {.min_cluster_size = lessons.options.min_cluster_size,
                                 .seed = lessons.options.seed,
                                 .threads = lessons.options.threads,
                                 .progress = lessons.options.progress});
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
PictureMatcher make_matcher(const ism::Model<D, Desc>& model, unsigned threads) {
    const auto matcher = std::make_shared<ism::FrameMatcher<D, Desc>>(model, threads);
    return [matcher](const ism::Frame& frame) { return matcher->match(frame); };
}

}  // namespace program
