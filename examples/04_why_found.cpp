// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Why something was found: which features voted for the most confident detection, through which words, and on
// which training images these were seen. Also writes why.png: the votes, p(figure), p(ground), the
// segmentation.
#include <cstdio>
#include <exception>

#include "toy_lessons.hpp"

#include "ism/detect/detect.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/io/png.hpp"
#include "ism/show/overlay.hpp"
#include "ism/train/train.hpp"

int main() try {
    const auto model =
        ism::train<ism::HessianLaplace, ism::RootSift>(toy::class_names(), toy::make_lessons(6));
    const toy::ToyScene scene = toy::make_test();
    const ism::Detections found = ism::detect<ism::Jism>(model, toy::to_frame(scene));
    if (found.objects.empty()) {
        std::printf("nothing was found\n");
        return 0;
    }

    const ism::Detection& object = found.objects.front();
    std::printf("%s with score %.2f by %zu votes, the heaviest of them:\n",
                model.shapes.class_names[object.class_index].c_str(), object.score, object.support.size());
    for (const ism::Support& vote :
         std::span(object.support).first(std::min<std::size_t>(8, object.support.size()))) {
        const ism::Feature& feature = found.features[vote.feature];
        const ism::Occurrence& occurrence = model.shapes.occurrence(vote.occurrence);
        std::printf("  %.4f  feature at (%3.0f, %3.0f), word %u, seen at (%+.0f, %+.0f) on '%s'\n",
                    vote.weight, feature.x, feature.y, vote.word, occurrence.x, occurrence.y,
                    model.shapes.objects[occurrence.object].image.c_str());
    }
    const ism::Font font = ism::system_font(model.shapes.class_names);
    ism::write_png("why.png",
                   ism::draw_explanation(scene.color, found, 0, model.shapes.class_names, {.font = &font}));
    std::printf("wrote why.png\n");
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
