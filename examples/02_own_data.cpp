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

#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/detect/detect.hpp"
#include "ism/evaluate/detections.hpp"
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
    const ism::Dataset lessons = ism::read_dataset(argv[1]);
    const auto model =
        ism::train<ism::HessianLaplace, ism::RootSift>(lessons.class_names, ism::training_set(lessons));
    ism::save_model(argv[3], model);  // later: ism::load_model<ism::HessianLaplace, ism::RootSift>(path)

    // the classes of the model, in its order
    const ism::Dataset scenes = ism::select_classes(ism::read_dataset(argv[2]), lessons.class_names);
    ism::FrameDetector detector(model);
    std::vector<ism::Detections> found;
    std::vector<ism::Result> results;
    for (const ism::DatasetImage& image : scenes.images) {
        found.push_back(detector.detect<ism::Jism>(ism::read_frame(image)));
        for (ism::Result& result : ism::to_results(found.back(), image, scenes.category_ids))
            results.push_back(std::move(result));
    }
    ism::write_results(argv[4], results);
    std::fputs(ism::to_table(ism::evaluate(scenes, found)).c_str(), stdout);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
