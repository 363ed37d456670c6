// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/parallel.hpp"
#include "ism/detect/harvest.hpp"
#include "ism/feature/extract.hpp"
#include "ism/io/coco.hpp"

namespace bench {

/// @brief Real objects, each a class of its own: as many classes as there are objects.
struct PseudoClasses {
    std::vector<ism::TrainingImage> images;  ///< with one object each; image i shows class i
    std::vector<std::string> names;
};

/// @brief Objects of several sets by turns, at most `count`, so that any first part has some of each; only
/// those that an extractor finds 20 features on.
/// @param files  COCO files
template <ism::Detector D, ism::Descriptor Desc>
[[nodiscard]] PseudoClasses pseudo_classes(const std::vector<std::filesystem::path>& files, std::size_t count,
                                           const ism::Extractor<D, Desc>& extractor) {
    std::vector<std::vector<std::pair<ism::DatasetImage, std::size_t>>> sets;  // image and object of each
    std::size_t longest = 0;
    for (const auto& file : files) {
        sets.emplace_back();
        for (const ism::DatasetImage& image : ism::read_dataset(file).images)
            for (std::size_t o = 0; o < image.objects.size(); ++o)
                if (!image.objects[o].crowd) sets.back().emplace_back(image, o);
        longest = std::max(longest, sets.back().size());
    }
    PseudoClasses result;
    for (std::size_t turn = 0; turn < longest && result.images.size() < count; ++turn) {
        std::vector<ism::TrainingImage> round(sets.size());
        ism::parallel_for(sets.size(), 0, [&](std::size_t s) {
            if (turn >= sets[s].size()) return;
            ism::TrainingImage image = ism::read_training_image(sets[s][turn].first);
            const ism::LabelledObject object = image.objects.at(sets[s][turn].second);
            std::size_t features = 0;
            for (const ism::Feature& f : ism::extract(image.frame.gray.view(), extractor).features)
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
    return result;
}

/// @brief What a harvest of images with one object and one class each gives for the first `classes` alone.
template <ism::Detector D, ism::Descriptor Desc>
[[nodiscard]] ism::Harvest<D, Desc> first_classes(const ism::Harvest<D, Desc>& all, std::size_t classes) {
    ism::Harvest<D, Desc> part{
        .extractor = all.extractor,
        .class_names = {all.class_names.begin(), all.class_names.begin() + std::ptrdiff_t(classes)},
        .objects = {},
        .first_object = {0},
        .seen = {},
        .descriptors = {}};
    for (const ism::TrainingObject& object : all.objects)
        if (object.class_index < classes) part.objects.push_back(object);
    for (std::size_t i = 0; i < all.seen.size(); ++i)
        if (all.seen[i].class_index < classes) {
            part.seen.push_back(all.seen[i]);
            part.descriptors.push_back(all.descriptors.row(i));
        }
    for (std::uint32_t i = 1; i <= part.objects.size(); ++i) part.first_object.push_back(i);
    return part;
}

}  // namespace bench
