// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "extractors.hpp"
#include "support/data_sets.hpp"
#include "support/many_classes.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/feature/any_extractor.hpp"

namespace bench {

/// @brief Real objects, each a class of its own that is learnt from one picture: of several sets by turns, so
/// that any first part has some of each, and only those that the program finds 20 features on. Pictures to
/// search are those of desks in osd/val, to check the training images of the first 32 classes.
/// @param data  folder of the data sets
[[nodiscard]] inline ManyClasses real_classes(const std::filesystem::path& data, std::size_t count) {
    const ism::AnyExtractor extractor =
        program::make_extractor(program::default_detector, program::default_descriptor);
    std::vector<std::vector<std::pair<ism::DatasetImage, std::size_t>>> sets;  // image and object of each
    std::size_t longest = 0;
    for (const char* set : {"four-class/train", "msrc/train", "osd/train", "sysu-shapes/train",
                            "weizmann-horses/train", "uiuc-cars/train", "sysu-shapes/val", "msrc/val"}) {
        sets.emplace_back();
        for (const ism::DatasetImage& image : read_set(data / (std::string(set) + ".json")).images)
            for (std::size_t o = 0; o < image.objects.size(); ++o)
                if (!image.objects[o].crowd) sets.back().emplace_back(image, o);
        longest = std::max(longest, sets.back().size());
    }
    ManyClasses result{.what = "real objects as classes, one picture each"};
    for (std::size_t turn = 0; turn < longest && result.images.size() < count; ++turn) {
        std::vector<ism::TrainingImage> round(sets.size());
        ism::parallel_for(sets.size(), 0, [&](std::size_t s) {
            if (turn >= sets[s].size()) return;
            ism::TrainingImage image = ism::read_training_image(sets[s][turn].first);
            const ism::LabelledObject object = image.objects.at(sets[s][turn].second);
            ism::ThreadPool one(1);
            std::size_t features = 0;
            for (const ism::Feature& f : extractor.start(one)(image.frame).features)
                features += f.x >= object.box.x && f.y >= object.box.y &&
                            f.x < object.box.x + object.box.width && f.y < object.box.y + object.box.height;
            if (features < 20) return;
            image.objects = {object};
            round[s] = std::move(image);
        });
        for (ism::TrainingImage& image : round) {
            if (image.objects.empty() || result.images.size() == count) continue;
            image.objects[0].class_index = result.images.size();
            result.names.push_back(ism::join_text("class ", result.images.size()));
            result.images.push_back(std::move(image));
        }
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(32, result.images.size()); ++i)
        result.checks.push_back(result.images[i]);
    const ism::Dataset scenes = read_set(data / "osd" / "val.json");
    for (std::size_t i = 0; i < 8; ++i) result.frames.push_back(ism::read_frame(scenes.images.at(i * 5)));
    return result;
}

}  // namespace bench
