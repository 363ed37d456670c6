// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// What options of the way on colour images are chosen by: of train.json alone a random half of each class is
// learnt, and the other half is judged among training images of the other sets that show none of the classes.
// Told are the mean AP at IoU .5 among those, and of the objects that are found at any score the share that
// stays where at most so many objects an image without any are told: at a few rates, and their mean over
// rates of .025 to .4, which changes less from draw to draw.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "support/data_sets.hpp"
#include "support/program_model.hpp"
#include "support/rows.hpp"
#include "support/set_options.hpp"

#include "ism/core/random.hpp"
#include "ism/evaluate/detections.hpp"

namespace {

/// False objects told an image without any, at which what is kept is measured.
constexpr std::array<double, 3> false_rates = {0.05, 0.1, 0.2};

/// … and over which it is averaged, evenly by their logarithms: from this one on up to 16 times as many.
constexpr double least_rate = 0.025;
constexpr int rate_steps = 16;

/// Of one draw, or their mean.
struct Figures {
    double ap = 0, mask_iou = 0, found = 0, mean_kept = 0;
    std::array<double, false_rates.size()> kept = {};
    double told = 0, told_false = 0;  ///< at the program's default: share of objects, an image without any
};

/// Images of other sets that show no class of this name, at most so many of each, evenly.
[[nodiscard]] std::vector<ism::DatasetImage> images_without(const std::vector<std::string>& class_names,
                                                            const std::vector<ism::Dataset>& sets,
                                                            std::size_t most) {
    std::vector<ism::DatasetImage> images;
    for (const ism::Dataset& set : sets) {
        std::vector<const ism::DatasetImage*> without;
        for (const ism::DatasetImage& image : set.images)
            if (std::none_of(image.objects.begin(), image.objects.end(), [&](const auto& object) {
                    return std::find(class_names.begin(), class_names.end(),
                                     set.class_names[object.class_index]) != class_names.end();
                }))
                without.push_back(&image);
        const std::size_t count = std::min(most, without.size());
        for (std::size_t i = 0; i < count; ++i) {
            images.push_back(*without[i * without.size() / count]);
            images.back().objects.clear();
        }
    }
    return images;
}

/// A random half of each class's images, and the others.
[[nodiscard]] std::pair<ism::Dataset, ism::Dataset> halves(const ism::Dataset& set, std::uint64_t seed) {
    std::map<std::uint32_t, std::vector<const ism::DatasetImage*>> of_class;
    for (const ism::DatasetImage& image : set.images)
        if (!image.objects.empty()) of_class[image.objects.front().class_index].push_back(&image);
    std::set<const ism::DatasetImage*> learnt;
    ism::Random random(seed);
    for (auto& [c, images] : of_class)
        for (std::size_t k = 0; k < images.size() / 2; ++k) {
            std::swap(images[k], images[k + std::size_t(random.index(images.size() - k))]);
            learnt.insert(images[k]);
        }
    ism::Dataset known = set, unknown = set;
    known.images.clear(), unknown.images.clear();
    for (const ism::DatasetImage& image : set.images)
        (learnt.contains(&image) ? known : unknown).images.push_back(image);
    return {std::move(known), std::move(unknown)};
}

[[nodiscard]] Figures figures_of(const ism::Dataset& set, std::span<const ism::Detections> found) {
    const auto mean = ism::evaluate(set, found, ism::IouRule{}).mean;
    Figures figures{.ap = mean.ap, .mask_iou = mean.mask_iou};
    std::vector<double> right, wrong;  // probabilities
    double objects = 0, empty = 0;
    for (std::size_t i = 0; i < set.images.size(); ++i) {
        for (const auto& object : set.images[i].objects) {
            if (object.crowd) continue;
            double best = 0;
            for (const ism::Detection& d : found[i].objects)
                if (d.class_index == object.class_index && ism::iou(d.box, object.box) >= 0.5)
                    best = std::max(best, d.probability);
            objects += 1;
            if (best > 0) right.push_back(best);
        }
        if (!set.images[i].objects.empty()) continue;
        empty += 1;
        for (const ism::Detection& d : found[i].objects) wrong.push_back(d.probability);
    }
    std::sort(wrong.rbegin(), wrong.rend());
    const auto above = [](const std::vector<double>& of, double p) {
        return double(std::count_if(of.begin(), of.end(), [&](double q) { return q > p; }));
    };
    const auto kept_at = [&](double rate) {
        const auto allowed = std::size_t(rate * empty);
        return above(right, allowed < wrong.size() ? wrong[allowed] : 0) / double(right.size());
    };
    for (std::size_t r = 0; r < false_rates.size(); ++r) figures.kept[r] = kept_at(false_rates[r]);
    for (int k = 0; k <= rate_steps; ++k)
        figures.mean_kept += kept_at(least_rate * std::pow(16, double(k) / rate_steps)) / (rate_steps + 1);
    figures.found = double(right.size()) / objects;
    figures.told = above(right, program::default_min_score) / objects;
    figures.told_false = above(wrong, program::default_min_score) / empty;
    return figures;
}

}  // namespace

int main(int argc, char** argv) try {
    bench::SetOptions options{.sets = {"four-class", "sysu-shapes", "weizmann-horses", "msrc"}};
    std::size_t draws = 4, most = 60;
    bench::Options command_line("What options are chosen by: halves of train.json among other photographs.");
    options.add_to(command_line);
    command_line.add("--draws", draws, "random halves of each set", {1, 1000});
    command_line.add("--photographs", most, "of each other set, without the classes", {1, 100000});
    if (const auto code = command_line.parse(argc, argv)) return *code;

    std::vector<std::vector<std::string>> cells = {{"set", "mean AP %", "deviation", "mask IoU %", "found %",
                                                    "kept", "at .05", "at .1", "at .2", "told %", "false"}};
    std::vector<ism::Dataset> others;
    for (const char* name : {"sysu-shapes", "msrc", "osd", "weizmann-horses"})
        others.push_back(bench::read_set(options.data / name / "train.json"));
    for (const std::string& name : options.sets) {
        const ism::Dataset set = bench::read_set(options.data / name / "train.json");
        const auto photographs = images_without(set.class_names, others, most);
        Figures mean;
        double squares = 0;
        for (std::size_t draw = 1; draw <= draws; ++draw) {
            auto [known, unknown] = halves(set, draw);
            const ism::Model model = bench::learn_as_program(known, options.threads);
            unknown.images.insert(unknown.images.end(), photographs.begin(), photographs.end());
            const Figures one = figures_of(
                unknown, bench::find_as_program(model, unknown, bench::all_by_templates(), options.threads));
            const double share = 1 / double(draws);
            mean.ap += share * one.ap, squares += share * one.ap * one.ap;
            mean.mask_iou += share * one.mask_iou, mean.found += share * one.found,
                mean.mean_kept += share * one.mean_kept;
            for (std::size_t r = 0; r < one.kept.size(); ++r) mean.kept[r] += share * one.kept[r];
            mean.told += share * one.told, mean.told_false += share * one.told_false;
            std::fprintf(stderr, "%s %zu: AP %.1f, kept %.1f, told %.1f, false %.3f\n", name.c_str(), draw,
                         100 * one.ap, 100 * one.mean_kept, 100 * one.told, one.told_false);
        }
        cells.push_back({name, bench::number(100 * mean.ap, 1),
                         bench::number(100 * std::sqrt(std::max(0.0, squares - mean.ap * mean.ap)), 1),
                         bench::number(100 * mean.mask_iou, 1), bench::number(100 * mean.found, 1),
                         bench::number(100 * mean.mean_kept, 1)});
        for (const double kept : mean.kept) cells.back().push_back(bench::number(100 * kept, 1));
        cells.back().push_back(bench::number(100 * mean.told, 1));
        cells.back().push_back(bench::number(mean.told_false, 3));
    }
    std::fputs(ism::align_columns(cells).c_str(), stdout);
} catch (const std::exception& error) {
    std::fprintf(stderr, "folds: %s\n", error.what());
    return 2;
}
