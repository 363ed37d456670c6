// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Learns a few toys from pictures in memory and finds others of their kinds on a cluttered table, or, as
// 01_train_and_detect TRAIN.json IMAGE, learns from labelled images of your own (COCO) and looks at an image.
#include <cstdio>
#include <exception>

#include "toy_lessons.hpp"

#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/detect/detect.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/train.hpp"

int main(int argc, char** argv) try {
    std::vector<std::string> names = toy::class_names();
    std::vector<ism::TrainingImage> images;
    ism::Dataset dataset;
    ism::TrainingSet lessons;
    ism::Frame frame;
    if (argc == 3) {
        dataset = ism::read_dataset(argv[1]);
        names = dataset.class_names;
        lessons = ism::training_set(dataset);  // images are read when they are needed
        frame.gray = ism::read_gray(argv[2]);
    } else {
        images = toy::make_lessons(6);
        lessons = ism::training_set(images);
        frame = toy::to_frame(toy::make_test());
    }

    const auto model = ism::train<ism::HessianLaplace, ism::RootSift>(names, lessons);
    const ism::Detections found = ism::detect<ism::Jism>(model, frame);

    for (const ism::Detection& object : found.objects) {
        std::printf("%s, score %.2f, at (%.0f, %.0f) px", names[object.class_index].c_str(), object.score,
                    object.centre.x, object.centre.y);
        if (const auto& p = object.position_m) std::printf(", (%.2f, %.2f, %.2f) m", p->x, p->y, p->z);
        std::printf("\n");
    }
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
