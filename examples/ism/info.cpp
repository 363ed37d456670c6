// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <optional>

#include "commands.hpp"
#include "data.hpp"
#include "info_page.hpp"
#include "input.hpp"
#include "page.hpp"
#include "spaces.hpp"

#include "ism/model_file/model_file.hpp"

namespace program {

void run_info(const InfoCommand& command) {
    const std::filesystem::path& path = command.model;
    if (!command.report.empty())
        check_page(command.report, std::array{command.model, command.data}, command.page);
    const ism::Model model = ism::load_model(path);
    if (!command.report.empty()) {
        std::optional<ism::Dataset> data;
        if (!command.data.empty()) data = read_data(command.data, ism::DatasetPart::train, true);
        if (data) check_not_labels(*data, std::array{command.report});
        write_page(
            command.report,
            model_report(model, "Model " + ism::path_to_utf8(path.filename()), data ? &*data : nullptr),
            command.page);
    }
    const ism::TrainingSummary& training = model.training;
    std::printf("format          ism model, version %lld\n",
                static_cast<long long>(ism::detail::model_format_version));
    std::printf("classes         %s\n", ism::one_line(list_text(model.shapes.class_names)).c_str());
    if (!model.shapes.category_ids.empty()) {
        std::vector<std::string> ids;
        for (const std::int64_t id : model.shapes.category_ids) ids.push_back(ism::join_text(id));
        std::printf("category ids    %s\n", list_text(ids).c_str());
    }
    std::printf("images          %zu\n", training.images);
    std::printf("objects         %zu\n", model.shapes.objects.size());
    std::printf("features        %zu of %zu on the objects\n", training.features_used,
                training.features_found);
    std::printf("words           %zu\n", model.words());
    std::printf("occurrences     %zu\n", model.shapes.occurrences.values().size());
    std::printf("box classifier  %s\n", model.box_classifier.empty() ? "no" : "yes");
    std::printf("templates       %s\n", model.templates.empty() ? "no" : "yes");
    std::printf("exemplars       %zu\n", model.exemplars.size());
    if (model.rgbd.empty()) std::printf("depth           no\n");
    for (const ism::Model& rgbd : model.rgbd)
        std::printf("depth           %zu words, %zu of them on objects, %zu regions\n", rgbd.words(),
                    rgbd.shapes.frames.size(), rgbd.mask_judge.examples.size());
    std::printf("probabilities   %s\n", model.calibration.empty()     ? "no"
                                        : learnt_probabilities(model) ? "yes"
                                                                      : "not learnt, for want of objects");
    std::printf("growable        %s\n", ism::has_training_features(path) ? "yes, by --add-to" : "no");
    std::printf("reference size  %g px\n", ism::reference_size_px);
    for (const ism::Channel& channel : model.channels) {
        const ism::FeatureSettings& settings = channel.features;
        std::printf("detector        %s\n", settings.detector.c_str());
        std::printf("descriptor      %s, %zu numbers\n", settings.descriptor.c_str(), settings.dimension);
        std::printf("orientation     %s\n", settings.options.oriented ? "free" : "upright");
        std::printf("upsampling      %g\n", settings.options.upsampling);
        std::printf("match within    %g (squared distance)\n", channel.codebook.max_sq_distance());
        std::printf("parameters      %s\n",
                    ism::detail::settings_to_json(settings, path.string()).dump().c_str());
    }
}

}  // namespace program
