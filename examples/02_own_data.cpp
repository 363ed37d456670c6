// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Your own data: learns from labelled images, keeps the model, finds objects in other images, writes what was
// found and measures it.
//     02_own_data TRAIN.json TEST.json MODEL.safetensors RESULTS.json
// The JSON files are COCO; an image may also have depth_file_name, depth_scale and camera.
#include <cstdio>
#include <exception>
#include <utility>
#include <vector>

#include "ism/core/frame.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/detect/detect.hpp"
#include "ism/evaluate/coco.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/train/train.hpp"

int main(int argc, char** argv) try {
    if (argc != 5) {
        std::fprintf(stderr, "usage: %s TRAIN.json TEST.json MODEL.safetensors RESULTS.json\n", argv[0]);
        return 2;
    }
    // Images are read when they are needed, so a large set does not have to fit into memory.
    const ism::Dataset lessons = ism::read_dataset(argv[1]);
    const auto read = [&](std::size_t i) { return ism::read_training_image(lessons.images[i]); };
    const auto model =
        ism::train<ism::HessianLaplace, ism::RootSift>(lessons.class_names, lessons.images.size(), read);
    ism::save_model(argv[3], model);  // later: ism::load_model<ism::HessianLaplace, ism::RootSift>(path)

    const ism::Dataset scenes = ism::read_dataset(argv[2]);
    std::vector<ism::Result> results;
    for (const ism::DatasetImage& image : scenes.images) {
        const ism::Frame frame = ism::read_frame(image);
        const ism::Detections found = ism::detect<ism::Jism>(model, frame);
        for (ism::Result& result : ism::to_results(found, image, lessons.category_ids))
            results.push_back(std::move(result));
    }
    ism::write_results(argv[4], results);
    std::fputs(ism::to_table(ism::evaluate(scenes, results)).c_str(), stdout);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
