// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <set>

#include "commands.hpp"
#include "input.hpp"
#include "models.hpp"
#include "progress.hpp"

#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/model_file/model_file.hpp"

namespace program {

void run_train(const TrainCommand& command) {
    const Stopwatch watch;
    check_output(command.model, std::array{command.data, command.add_to});
    std::string detector = command.detector, descriptor = command.descriptor;
    if (!command.add_to.empty()) {
        const ism::ModelInfo info = ism::read_model_info(command.add_to);
        detector = info.detector, descriptor = info.descriptor;
    }
    ism::Dataset dataset = ism::read_dataset(command.data);
    if (!command.classes.empty()) dataset = ism::select_classes(dataset, command.classes);
    const std::size_t skipped =
        check_images(dataset, command.options.threads, command.skip_bad, [&](const ism::DatasetImage& image) {
            ism::TrainingImage training = ism::read_training_image(image);
            training.name = ism::file_text(image.file);
            ism::detail::check_training_image(training, dataset.class_names.size());
        });

    ProgressLine progress;
    Lessons lessons{.dataset = dataset, .options = command.options, .add_to = command.add_to};
    lessons.options.progress = [&](std::string_view stage, std::size_t done, std::size_t total) {
        progress.tell(stage, done, total);
    };
    const AnyModel model = learn_any(detector, descriptor, lessons);
    save_any(command.model, model);
    progress.clear();

    const ism::Shapes& shapes = shapes_of(model);
    std::set<std::uint32_t> features;
    for (const ism::Occurrence& o : shapes.occurrences) features.insert(o.feature);
    std::printf("model        %s (%s, %s)\n", command.model.string().c_str(), detector.c_str(),
                descriptor.c_str());
    std::printf("classes      %s\n", list_text(shapes.class_names).c_str());
    std::printf("images       %zu\n", dataset.images.size());
    if (skipped > 0) std::printf("skipped      %zu\n", skipped);
    std::printf("objects      %zu\n", shapes.objects.size());
    std::printf("features     %zu\n", features.size());
    std::printf("words        %zu\n", shapes.first.size() - 1);
    std::printf("occurrences  %zu\n", shapes.occurrences.size());
    std::printf("upsampling   %.3g\n",
                std::visit([](const auto& m) { return m.extractor.options.upsampling; }, model));
    std::printf("seconds      %.1f\n", watch.seconds());
}

}  // namespace program
