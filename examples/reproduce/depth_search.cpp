// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "depth_search.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <tuple>
#include <utility>

#include "experiment.hpp"
#include "extractors.hpp"
#include "learning.hpp"
#include "spaces.hpp"

#include "ism/core/stopwatch.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/dataset/to_results.hpp"
#include "ism/detect/metric.hpp"
#include "ism/detect/metric_proposals.hpp"
#include "ism/train/describe_object.hpp"

namespace reproduce {

namespace {

using Spaces = std::tuple<ism::Ism, ism::Jism, ism::Ji3sm1, ism::Ji3sm2, ism::Ji3sm3, ism::Metric>;
static_assert(std::tuple_size_v<Spaces> == depth_spaces.size());

/// Does something for each space of a row and its number.
template <std::size_t... I>
void for_each_space(std::index_sequence<I...>, const auto& visit) {
    (visit.template operator()<std::tuple_element_t<I, Spaces>>(I), ...);
}
void for_each_space(const auto& visit) {
    for_each_space(std::make_index_sequence<depth_spaces.size()>{}, visit);
}

template <ism::VoteSpaceType Space>
ism::DetectOptions options_of() {
    return Space::needs_pose ? ism::metric_proposal_options() : ism::DetectOptions{};
}

program::SearchOptions search_of(std::size_t way) {
    program::SearchOptions search;
    if (way < metric_index) {
        search = votes_alone(depth_spaces[way]);
    } else {
        search.space = program::metric_space;
        if (way == metric_index) search.rescorer = "none";
    }
    search.min_score = 0, search.keep = 0;
    return search;
}

/// Finds the features of pictures and their words, for one model after the other.
class Looker {
public:
    Looker(const DepthModels& models, ism::ThreadPool& pool)
        : words_(models.words, pool), metric_(models.metric, pool) {}

    /// @param with_reading  without the matches of features that have no depth
    [[nodiscard]] ism::Scene words(const ism::Frame& frame, bool with_reading) {
        return kept(words_.scene(frame, depth_spaces.front()), with_reading);
    }
    [[nodiscard]] ism::Scene metric(const ism::Frame& frame) {
        ism::Scene scene = metric_.scene(frame, program::metric_space);
        ism::add_surface(scene);
        return scene;
    }

private:
    static ism::Scene kept(ism::Scene scene, bool with_reading) {
        if (with_reading)
            std::erase_if(scene.matches, [&](const ism::Match& match) {
                return !ism::is_depth(scene.features[match.feature].depth_m);
            });
        return scene;
    }

    program::Matcher words_, metric_;
};

std::vector<ism::TrueObject> true_objects(const Shot& shot) {
    std::vector<ism::TrueObject> objects;
    for (const ism::DatasetAnnotation& label : shot.labels.objects) {
        if (label.crowd) continue;
        const ism::Mask mask = ism::read_mask(shot.labels, label);
        ism::TrueObject object{
            .class_index = label.class_index, .box = label.box, .mask = ism::region_of(mask)};
        object.depth_m = label.position_m ? label.position_m->z : double(ism::object_depth(shot.frame, mask));
        if (!ism::is_depth(object.depth_m)) continue;
        object.centre_m = label.position_m.value_or(
            ism::back_project(*shot.frame.camera, label.box.centre(), object.depth_m));
        objects.push_back(std::move(object));
    }
    return objects;
}

}  // namespace

DepthModels learn_both(const std::vector<std::string>& class_names, const ism::TrainingSet& set,
                       unsigned threads) {
    const ism::TrainOptions options{.box_classifier = {}, .calibrate = false, .threads = threads};
    const auto features = program::extract_training_features(
        class_names, set, {program::make_extractor(program::default_detector, program::default_descriptor)},
        options);
    return {program::learn(features, options), program::learn_rgbd(class_names, set, options)};
}

DepthOutcome search_depth(const DepthModels& models, std::span<const Shot> shots,
                          std::span<const std::size_t> ways, bool with_reading, unsigned threads) {
    std::vector<DepthOutcome> parts(shots.size());
    ism::ThreadPool pool(threads);
    std::deque<ism::ThreadPool> single;  // one a worker
    std::deque<Looker> lookers;
    for (unsigned worker = 0; worker < pool.size(); ++worker)
        lookers.emplace_back(models, single.emplace_back(1u));
    const std::vector<std::int64_t> ids = [&] {
        std::vector<std::int64_t> numbers;
        for (std::size_t c = 0; c < models.words.shapes.class_names.size(); ++c)
            numbers.push_back(std::int64_t(c) + 1);
        return numbers;
    }();
    pool.for_each(shots.size(), [&](std::size_t i, unsigned worker) {
        const Shot& shot = shots[i];
        ism::Stopwatch watch;
        const ism::Scene words = lookers[worker].words(shot.frame, with_reading);
        const double words_ms = watch.lap_ms();
        const ism::Scene metric = lookers[worker].metric(shot.frame);
        const double metric_ms = watch.lap_ms();
        for (const std::size_t way : ways) {
            watch.lap_ms();
            const auto found = program::find_objects(way < metric_index ? words : metric, search_of(way));
            parts[i].ms[way] = watch.lap_ms() + (way < metric_index ? words_ms : metric_ms);
            parts[i].results[way] = ism::to_results(found, shot.labels, ids);
        }
        const std::vector<ism::TrueObject> objects = true_objects(shot);
        for_each_space([&]<class Space>(std::size_t s) {
            if (std::find(ways.begin(), ways.end(), s) == ways.end()) return;
            const ism::Scene& scene = Space::needs_pose ? metric : words;
            const ism::DetectOptions options = options_of<Space>();
            const auto votes =
                ism::cast_votes<Space>(scene, options.matching, ism::vote_limits(scene, options));
            for (const ism::TrueObject& object : objects)
                parts[i].confidence[s].push_back(ism::voting_confidence<Space>(scene, object, votes));
        });
    });
    DepthOutcome all;
    for (const DepthOutcome& part : parts) {
        for (std::size_t w = 0; w < way_count; ++w) {
            all.results[w].insert(all.results[w].end(), part.results[w].begin(), part.results[w].end());
            all.ms[w] += part.ms[w] / double(shots.size());
        }
        for (std::size_t s = 0; s < depth_spaces.size(); ++s)
            all.confidence[s].insert(all.confidence[s].end(), part.confidence[s].begin(),
                                     part.confidence[s].end());
    }
    return all;
}

std::array<Between, depth_spaces.size()> shown_between(const DepthModels& models, const Shot& shot,
                                                       double t_ratio) {
    std::array<Between, depth_spaces.size()> shows{};
    const std::vector<ism::TrueObject> cars = true_objects(shot);
    if (cars.size() != 2) return shows;
    ism::ThreadPool pool(1);
    Looker looker(models, pool);
    const ism::Scene words = looker.words(shot.frame, false), metric = looker.metric(shot.frame);
    const auto share_on = [](const ism::Detection& found, const ism::Scene& scene,
                             const ism::RegionMask& mask) {
        double on = 0, all = 0;
        for (const ism::Support& s : found.support) {
            const ism::Feature& f = scene.features[s.feature];
            all += s.weight;
            if (ism::contains(mask, int(std::lround(f.x)), int(std::lround(f.y)))) on += s.weight;
        }
        return on / all;
    };
    const double left = std::min(cars[0].box.centre().x, cars[1].box.centre().x),
                 right = std::max(cars[0].box.centre().x, cars[1].box.centre().x);
    for_each_space([&]<class Space>(std::size_t s) {
        const ism::Scene& scene = Space::needs_pose ? metric : words;
        ism::DetectOptions options = options_of<Space>();
        options.min_relative_score = t_ratio;
        const auto votes = ism::cast_votes<Space>(scene, options.matching, ism::vote_limits(scene, options));
        const auto found = ism::find_hypotheses<ism::EpanechnikovKernel, Space::dimension>(
            scene, votes, ism::default_bandwidth<Space>(), options, ism::describe_in<Space>());
        for (const ism::Detection& one : found) {
            const double way = (one.centre.x - left) / (right - left);
            if (way > 0 && way < 1 && share_on(one, scene, cars[0].mask) >= 0.2 &&
                share_on(one, scene, cars[1].mask) >= 0.2)
                shows[s].of_both = true;
            if (way > 0.25 && way < 0.75) shows[s].any = true;
        }
    });
    return shows;
}

ism::Detections found_in(const DepthModels& models, const Shot& shot, std::size_t way) {
    ism::ThreadPool pool(1);
    Looker looker(models, pool);
    return program::find_objects(
        way < metric_index ? looker.words(shot.frame, false) : looker.metric(shot.frame), search_of(way));
}

std::vector<ism::Result> relative_scores(std::vector<ism::Result> results) {
    std::map<std::int64_t, double> strongest;
    for (const ism::Result& r : results) strongest[r.image_id] = std::max(strongest[r.image_id], r.score);
    for (ism::Result& r : results)
        if (strongest[r.image_id] > 0) r.score /= strongest[r.image_id];
    return results;
}

}  // namespace reproduce
