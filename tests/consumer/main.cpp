// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "ism/ism.hpp"

std::size_t pixels_elsewhere(const ism::GrayImage& image);  // second.cpp

int main() {
    std::printf("ism %s\n", ism::version_text);

    // A few bright squares, learnt and found again.
    std::vector<ism::TrainingImage> images(2);
    for (auto& image : images) {
        image.frame.gray = ism::GrayImage(96, 96, 0.2f);
        for (int i = 0; i < 96 * 96; ++i)
            if ((i % 96 / 8 * 7 + i / 96 / 8 * 3) % 5 < 2) image.frame.gray(i % 96, i / 96) = 0.9f;
        image.objects.push_back({.class_index = 0, .box = {16, 16, 64, 64}});
    }
    const auto model =
        ism::train<ism::HessianLaplace, ism::RootSift>(std::vector<std::string>{"pattern"}, images);
    const auto found = ism::detect<ism::Jism>(model, images[0].frame);
    std::printf("%zu words, %zu found\n", model.words(), found.objects.size());
    return !found.objects.empty() && pixels_elsewhere(images[0].frame.gray) == 96 * 96 ? 0 : 1;
}
