// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <optional>

#include "commands.hpp"
#include "data.hpp"
#include "extractors.hpp"
#include "input.hpp"
#include "learning.hpp"
#include "lessons.hpp"
#include "pictures.hpp"
#include "progress.hpp"

#include "ism/dataset/camera_doubt.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/train/append_training_features.hpp"
#include "ism/train/select_words.hpp"
#include "ism/train/vote_agreement.hpp"

namespace program {

namespace {

/// What a model was learnt from, to go on with.
struct Known {
    ism::TrainingFeatures features;
    std::vector<ism::AnyExtractor> extractors;
    bool templates = false, depth = false;
};

/// The lessons of a model, and the options that it was learnt with.
Known lessons_of(const std::filesystem::path& path, ism::TrainOptions& options) {
    const ism::Model model = ism::load_model(path);
    const ism::Channel& channel = model.channels.front();
    options.codebook.min_similarity =
        1 - channel.codebook.max_sq_distance() / (2 * channel.features.sq_length);
    const auto& groups = channel.codebook.groups();
    if (std::any_of(groups.begin(), groups.end(), [](std::uint32_t group) { return group > 0; }))
        options.codebook.kind = ism::CodebookKind::per_class;
    options.features.choose_upsampling = false;
    return {ism::load_training_features(path), extractors_of(model), !model.templates.empty(),
            !model.rgbd.empty()};
}

ism::WordWorth worth_of(const std::string& measure) {
    if (measure == "occurrences") return ism::word_occurrences;
    if (measure == "gain") return ism::word_information_gain;
    return ism::vote_agreement;
}

/// The images of a data set, named as seen from its folder.
ism::TrainingSet named_images(const ism::Dataset& dataset) {
    ism::TrainingSet set = ism::training_set(dataset, read_picture);
    set.image = [&dataset](std::size_t i) {
        ism::TrainingImage image = ism::read_training_image(dataset.images[i], read_picture);
        image.name = short_name(dataset, dataset.images[i]);
        return image;
    };
    return set;
}

DepthImages depth_images(const ism::Dataset& dataset) {
    DepthImages images;
    for (std::size_t i = 0; i < dataset.images.size(); ++i) {
        if (dataset.images[i].depth_file.empty()) continue;
        ++images.with_depth;
        if (dataset.images[i].camera) images.usable.push_back(i);
    }
    return images;
}

/// Tells beforehand where the part for depth will be left out, since it has to know all classes.
void tell_lack_of_depth(const ism::Dataset& dataset) {
    const DepthImages images = depth_images(dataset);
    std::vector<bool> shown(dataset.class_names.size(), false);
    for (const std::size_t i : images.usable)
        for (const ism::DatasetAnnotation& object : dataset.images[i].objects)
            if (!object.crowd) shown[object.class_index] = true;
    std::vector<std::string> lacking;
    for (std::size_t c = 0; c < shown.size(); ++c)
        if (!shown[c]) lacking.push_back(ism::one_line(dataset.class_names[c]));
    if (images.usable.empty() || lacking.empty()) return;
    std::fprintf(
        stderr,
        "ism: note: without the space metric, since no image with depth and camera shows %s (--class "
        "names the classes to learn)\n",
        list_text(lacking).c_str());
}

/// Learns the model for frames with depth, which what --add-to keeps cannot.
/// @return what came of it, to be told; empty where nothing has depth
std::string learn_depth(ism::Model& model, const ism::Dataset& dataset, const ism::TrainOptions& options,
                        const Known* known) {
    const DepthImages images = depth_images(dataset);
    if (known != nullptr)
        return known->depth || images.with_depth > 0
                   ? "left out: what --add-to keeps has none; train anew for the space metric"
                   : "";
    const std::string left_out = add_depth(model, named_images(dataset), images, options);
    if (model.rgbd.empty()) return left_out;
    const ism::Model& rgbd = model.rgbd[0];
    return ism::join_text("of ", images.usable.size(), " images: ", rgbd.words(), " words, ",
                          rgbd.shapes.frames.size(), " of them on objects, ", rgbd.mask_judge.examples.size(),
                          " regions");
}

/// "car (30 objects), cow (1 object)".
std::string lessons_text(const ism::ShapeModel& shapes) {
    std::vector<std::size_t> objects(shapes.class_names.size(), 0);
    for (const ism::TrainingObject& object : shapes.objects) ++objects[object.class_index];
    std::vector<std::string> lessons;
    for (std::size_t c = 0; c < objects.size(); ++c)
        lessons.push_back(ism::join_text(ism::one_line(shapes.class_names[c]), " (", objects[c],
                                         objects[c] == 1 ? " object)" : " objects)"));
    return list_text(lessons);
}

/// Leaves out classes that nothing shows, and tells which.
void use_shown_classes(ism::Dataset& dataset) {
    const std::vector<std::string> unused = leave_out_unused(dataset);
    if (!unused.empty())
        std::fprintf(stderr, "ism: note: left out, since no label is of this class: %s\n",
                     list_text(unused).c_str());
}

/// The images and labels to learn from.
ism::Dataset read_lessons(const TrainCommand& command) {
    ism::Dataset dataset = read_data(command.data, ism::DatasetPart::train, command.skip_bad);
    check_not_labels(dataset, std::array{command.model});
    ism::expect(!dataset.class_names.empty(), ism::file_text(command.data), "labels to learn from",
                "images without (labels are folders named as classes, or files of COCO, VOC, YOLO, labelme)");
    if (!command.classes.empty()) return ism::select_classes(dataset, command.classes);
    use_shown_classes(dataset);
    return dataset;
}

/// Reads all images once, before what takes long, and tells what looks wrong. Depth without a reading counts
/// as none.
/// @return how many were left out
std::size_t check_lessons(ism::Dataset& dataset, unsigned threads, bool skip_bad) {
    Doubts doubts;
    const std::size_t skipped = check_images(dataset, threads, skip_bad, [&](ism::DatasetImage& image) {
        ism::TrainingImage training = ism::read_training_image(image, read_picture);
        training.name = ism::file_text(image.file);
        ism::check(training, dataset.class_names.size());
        if (!image.depth_file.empty())
            doubts.add(image.depth_file, ism::depth_scale_doubt(training.frame.depth_m, image.depth_scale));
        if (training.frame.depth_m.empty()) image.depth_file.clear();
        if (image.camera && !image.depth_file.empty())
            doubts.add(image.file, ism::camera_doubt(*image.camera, image.width, image.height));
    });
    doubts.tell();
    return skipped;
}

/// A model, and what is to be told of how it was learnt.
struct Learnt {
    ism::Model model;
    ism::TrainingFeatures features = {};  ///< as far as they are kept with the model
    std::string why_so = {};              ///< it is upright or free, where that was chosen
    std::string depth = {};               ///< what came of it
    std::size_t cut_out = 0;              ///< objects whose masks were made from their boxes
};

/// @param known  of the model that is to be added to, if any
Learnt learn_lessons(const TrainCommand& command, ism::TrainOptions options, const ism::Dataset& dataset,
                     std::optional<Known> known) {
    Learnt learnt;
    auto extractors =
        known ? known->extractors : std::vector{make_extractor(command.detector, command.descriptor)};
    bool templates = command.templates && (!known || known->templates);
    if (!known) {
        const Orientation orientation = choose_orientation(
            command.orientation, dataset.class_names, named_images(dataset), extractors, options.threads);
        extractors.front().options().oriented = orientation.free;
        templates = templates && orientation.templates;
        learnt.why_so = orientation.why_so;
    }
    options.features.pixels = templates;
    ism::TrainingFeatures features =
        extract_training_features(dataset.class_names, named_images(dataset), extractors, options);
    if (known) features = ism::append(std::move(known->features), std::move(features));
    learnt.model = learn(features, options);
    if (templates) learnt.model = learn_templates(std::move(learnt.model), features, options);
    for (std::size_t i = 0; i < features.objects.size(); ++i)
        learnt.cut_out += learnt.model.shapes.objects[i].mask != features.objects[i].mask;
    if (command.growable || known)
        learnt.features = std::move(features);
    else
        features = {};  // the memory is needed
    if (command.depth) learnt.depth = learn_depth(learnt.model, dataset, options, known ? &*known : nullptr);
    return learnt;
}

/// Prints what was learnt, line by line.
void print_summary(const TrainCommand& command, const Learnt& learnt, std::size_t skipped, double seconds) {
    const ism::Model& model = learnt.model;
    const ism::FeatureSettings& settings = model.channels.front().features;
    const ism::TrainingSummary& summary = model.training;
    std::printf("model        %s (%s, %s)\n", command.model.string().c_str(), settings.detector.c_str(),
                settings.descriptor.c_str());
    std::printf("classes      %s\n", list_text(model.shapes.class_names).c_str());
    std::printf("images       %zu\n", summary.images);
    if (skipped > 0) std::printf("skipped      %zu\n", skipped);
    std::printf("objects      %zu\n", model.shapes.objects.size());
    if (learnt.cut_out > 0) std::printf("masks        of %zu objects from their boxes\n", learnt.cut_out);
    std::printf("features     %zu", summary.features_used);
    if (summary.features_used < summary.features_found) {
        std::printf(" of %zu, the strongest of each object", summary.features_found);
        if (command.add_to.empty())
            std::printf(" (--max-features %zu)", command.options.features.max_features);
    }
    std::printf("\nwords        %zu\n", model.words());
    std::printf("occurrences  %zu\n", model.shapes.occurrences.values().size());
    std::printf("upsampling   %.3g\n", settings.options.upsampling);
    std::printf("orientation  %s%s\n", settings.options.oriented ? "free" : "upright", learnt.why_so.c_str());
    std::printf("templates    %s\n", model.templates.empty() ? "no" : "yes");
    if (!learnt.depth.empty()) std::printf("depth        %s\n", learnt.depth.c_str());
    std::printf("seconds      %.1f\n", seconds);
    if (const std::string doubt = doubt_of_probabilities(model); !doubt.empty())
        std::fprintf(stderr, "ism: note: %s\n", doubt.c_str());
    std::printf("\nLearnt %s. Next:\n  %s detect --model %s photo.jpg\n", lessons_text(model.shapes).c_str(),
                command.program.c_str(), shell_word(command.model.string()).c_str());
}

}  // namespace

void run_train(const TrainCommand& command) {
    const Stopwatch watch;
    check_output(command.model, std::array{command.data, command.add_to});
    ism::TrainOptions options = command.options;
    options.selection.worth = worth_of(command.best_words);
    ism::check(options);
    std::optional<Known> known;
    if (!command.add_to.empty()) known = lessons_of(command.add_to, options);
    ism::Dataset dataset = read_lessons(command);
    const std::size_t skipped = check_lessons(dataset, options.threads, command.skip_bad);
    if (command.depth && !known) tell_lack_of_depth(dataset);

    ProgressLine progress;
    options.progress = [&](std::string_view stage, std::size_t done, std::size_t total) {
        progress.tell(stage, done, total);
    };
    const bool keep_features = command.growable || known;
    const Learnt learnt = learn_lessons(command, options, dataset, std::move(known));
    ism::save_model(command.model, learnt.model, keep_features ? &learnt.features : nullptr);
    progress.clear();
    print_summary(command, learnt, skipped, watch.seconds());
}

}  // namespace program
