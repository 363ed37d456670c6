// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Detectors and descriptors on the Oxford sequences (Mikolajczyk et al. 2005), ours and those of the
// libraries at hand. For each pair (img1, imgK), of the features that both images show:
//   repeatability   pairs with an overlap error of at most 40 %, regions normalised to a radius of 30 pixels,
//                   best first, each feature in one; over the smaller number of features
//   matching score  mutual nearest descriptors with such an overlap, over the smaller number of features
//   AP              of the mutual matches ranked by the ratio of the nearest to the second distance
//   within 3 px     mutual matches that the homography confirms
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "support/data_sets.hpp"
#include "support/options.hpp"
#include "support/our_features.hpp"
#include "support/peer_features.hpp"
#include "support/photographs.hpp"
#include "support/region_overlap.hpp"
#include "support/rows.hpp"
#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "ism/io/write_file.hpp"

namespace {

namespace fs = std::filesystem;
using bench::ByteImage;
using bench::Features;
using bench::Homography;

constexpr double most_overlap_error = 0.4;

struct Method {
    std::string name;
    std::function<Features(const ByteImage&)> extract;
};

struct Figures {
    double features = 0, repeatability = 0, matching = 0, ap = 0, right_3px = 0, pairs = 0;
    void add(const Figures& other) {
        features += other.features, repeatability += other.repeatability, matching += other.matching;
        ap += other.ap, right_3px += other.right_3px, pairs += 1;
    }
};

[[nodiscard]] Features root(Features set) {
    for (std::size_t i = 0; i < set.descriptors.size(); ++i) {
        float sum = 0;
        for (const float value : set.descriptors.row(i)) sum += value;
        if (!(sum > 0)) continue;
        for (float& value : set.descriptors.row(i)) value = std::sqrt(std::max(0.0f, value) / sum);
    }
    return set;
}

template <ism::Detector D>
[[nodiscard]] Method our_method(const std::string& name) {
    return {name, [](const ByteImage& image) {
                return ism::extract(ism::to_gray(image), bench::like_peers<D>(), 2);
            }};
}

/// The features whose centre the other image shows.
[[nodiscard]] Features shown_by(const Features& set, const Homography& map, int width, int height) {
    Features kept = bench::sift_features();
    for (std::size_t i = 0; i < set.features.size(); ++i) {
        const ism::Point2 at = map(set.features[i].x, set.features[i].y);
        if (at.x < 0 || at.y < 0 || at.x > width - 1 || at.y > height - 1) continue;
        kept.features.push_back(set.features[i]);
        kept.descriptors.push_back(set.descriptors.row(i));
    }
    return kept;
}

/// Each region once, however many directions it has.
[[nodiscard]] std::vector<ism::Feature> regions(const Features& set) {
    std::vector<ism::Feature> list = set.features;
    const auto key = [](const ism::Feature& f) { return std::tie(f.x, f.y, f.scale); };
    std::sort(list.begin(), list.end(), [&](auto& a, auto& b) { return key(a) < key(b); });
    list.erase(std::unique(list.begin(), list.end(), [&](auto& a, auto& b) { return key(a) == key(b); }),
               list.end());
    return list;
}

[[nodiscard]] std::size_t repeated(const std::vector<ism::Feature>& first,
                                   const std::vector<ism::Feature>& second, const Homography& to_first) {
    struct Pair {
        double error;
        std::size_t a, b;
    };
    std::vector<std::pair<double, std::size_t>> by_x;
    for (std::size_t i = 0; i < first.size(); ++i) by_x.emplace_back(first[i].x, i);
    std::sort(by_x.begin(), by_x.end());
    std::vector<Pair> pairs;
    for (std::size_t b = 0; b < second.size(); ++b) {
        const ism::Point2 at = to_first(second[b].x, second[b].y);
        const auto [p, q, r, s] = to_first.affine(second[b].x, second[b].y);
        const double scale = second[b].scale * std::sqrt(std::fabs(p * s - q * r));
        constexpr double reach = 15;  // circles of 30 pixels further apart overlap less
        for (auto it = std::lower_bound(by_x.begin(), by_x.end(), std::pair(at.x - reach, std::size_t{0}));
             it != by_x.end() && it->first <= at.x + reach; ++it) {
            const ism::Feature& f = first[it->second];
            if (std::fabs(f.y - at.y) > reach || f.scale > 1.8 * scale || scale > 1.8 * f.scale) continue;
            const double error = bench::overlap_error(f, second[b], to_first);
            if (error <= most_overlap_error) pairs.push_back({error, it->second, b});
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& l, const Pair& r) {
        return std::tie(l.error, l.a, l.b) < std::tie(r.error, r.a, r.b);
    });
    std::vector<char> used_a(first.size()), used_b(second.size());
    std::size_t count = 0;
    for (const Pair& pair : pairs) {
        if (used_a[pair.a] || used_b[pair.b]) continue;
        used_a[pair.a] = used_b[pair.b] = 1;
        ++count;
    }
    return count;
}

struct Nearest {
    std::size_t index = 0;
    double sq_distance = INFINITY, second = INFINITY;
};

using Rows = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// For each row of `from` the nearest of `to`, and of each of `to` the nearest of `from`.
void nearest(const Features& from, const Features& to, std::vector<Nearest>& of_from,
             std::vector<Nearest>& of_to) {
    const Rows a(from.descriptors.values().data(), Eigen::Index(from.descriptors.size()), 128);
    const Rows b(to.descriptors.values().data(), Eigen::Index(to.descriptors.size()), 128);
    const Eigen::VectorXf length_a = a.rowwise().squaredNorm(), length_b = b.rowwise().squaredNorm();
    of_from.assign(from.descriptors.size(), {});
    of_to.assign(to.descriptors.size(), {});
    const auto offer = [](Nearest& best, std::size_t index, double sq_distance) {
        if (sq_distance < best.sq_distance)
            best = {index, sq_distance, best.sq_distance};
        else
            best.second = std::min(best.second, sq_distance);
    };
    constexpr Eigen::Index block = 256;
    for (Eigen::Index first = 0; first < a.rows(); first += block) {
        const Eigen::Index count = std::min(block, a.rows() - first);
        const Eigen::MatrixXf dots = b * a.middleRows(first, count).transpose();
        for (Eigen::Index i = 0; i < count; ++i)
            for (Eigen::Index j = 0; j < b.rows(); ++j) {
                const double d = std::max(0.0f, length_a[first + i] + length_b[j] - 2 * dots(j, i));
                offer(of_from[std::size_t(first + i)], std::size_t(j), d);
                offer(of_to[std::size_t(j)], std::size_t(first + i), d);
            }
    }
}

[[nodiscard]] Figures compare(const Features& all_first, const Features& all_second,
                              const Homography& to_second, const ByteImage& first_image,
                              const ByteImage& second_image) {
    const Homography to_first = to_second.inverse();
    const Features first = shown_by(all_first, to_second, second_image.width(), second_image.height());
    const Features second = shown_by(all_second, to_first, first_image.width(), first_image.height());
    Figures figures{.features = double(all_first.features.size())};
    const double least = double(std::min(first.features.size(), second.features.size()));
    if (least < 2) return figures;
    const std::vector<ism::Feature> first_regions = regions(first), second_regions = regions(second);
    figures.repeatability = double(repeated(first_regions, second_regions, to_first)) /
                            double(std::min(first_regions.size(), second_regions.size()));

    std::vector<Nearest> of_first, of_second;
    nearest(first, second, of_first, of_second);
    std::vector<std::pair<double, bool>> ranked;
    for (std::size_t i = 0; i < of_first.size(); ++i) {
        const Nearest& match = of_first[i];
        if (of_second[match.index].index != i) continue;
        const ism::Feature &f = first.features[i], &g = second.features[match.index];
        const bool right = bench::overlap_error(f, g, to_first) <= most_overlap_error;
        ranked.emplace_back(std::sqrt(match.sq_distance / std::max(1e-12, match.second)), right);
        figures.matching += right / least;
        const ism::Point2 at = to_second(f.x, f.y);
        figures.right_3px += std::hypot(at.x - g.x, at.y - g.y) <= 3;
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](auto& l, auto& r) { return l.first < r.first; });
    double right = 0;
    for (std::size_t i = 0; i < ranked.size(); ++i)
        if (ranked[i].second) figures.ap += ++right / double(i + 1);
    if (right > 0) figures.ap /= right;
    return figures;
}

}  // namespace

int main(int argc, char** argv) try {
    fs::path data = bench::data_folder() / "oxford-affine", json;
    std::vector<std::string> only;
    bench::Options command_line(
        "Repeatability and matching on the Oxford sequences, ours beside other libraries.");
    command_line.add("--data", data,
                     "a sequence, img1 ... img6 and H1to2p ... H1to6p, or a folder of sequences");
    command_line.add("--json", json, "write the rows to this file");
    command_line.add("--only", only, "only methods whose name holds one of these");
    if (const auto code = command_line.parse(argc, argv)) return *code;

    std::vector<Method> methods = {our_method<ism::DifferenceOfGaussians>("ism DoG"),
                                   our_method<ism::HessianLaplace>("ism Hessian-Laplace"),
                                   our_method<ism::HarrisLaplace>("ism Harris-Laplace")};
    for (const bench::FeaturePeer& peer : bench::feature_peers())
        methods.push_back({peer.name, [peer](const ByteImage& image) { return peer.extract(image, 2); }});
    if (!only.empty())
        std::erase_if(methods, [&](const Method& method) {
            return std::none_of(only.begin(), only.end(), [&](const std::string& text) {
                return method.name.find(text) != std::string::npos;
            });
        });

    std::vector<fs::path> sequences;
    if (fs::exists(data / "H1to2p")) sequences.push_back(data);
    for (const auto& entry : fs::directory_iterator(bench::data_file(data)))
        if (fs::exists(entry.path() / "H1to2p")) sequences.push_back(entry.path());
    std::sort(sequences.begin(), sequences.end());
    ism::expect(!sequences.empty(), data.string(), "folders with img1 and H1to2p", "none");

    std::map<std::pair<std::string, std::string>, Figures> sums;  // of method and sequence, "" = all
    for (const fs::path& sequence : sequences) {
        std::vector<ByteImage> images;
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(sequence))
            if (entry.path().stem().string().starts_with("img")) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files) images.push_back(bench::read_bytes(file));
        std::vector<Features> features;
        for (const Method& method : methods)
            for (const bool rooted : {false, true}) {
                const std::string name = method.name + (rooted ? " + RootSIFT" : " + SIFT");
                if (!rooted) features.clear();
                for (std::size_t i = 0; i < images.size(); ++i)
                    if (rooted)
                        features[i] = root(std::move(features[i]));
                    else
                        features.push_back(method.extract(images[i]));
                for (std::size_t k = 1; k < images.size(); ++k) {
                    const Homography map =
                        bench::read_homography(sequence / ism::join_text("H1to", k + 1, "p"));
                    const Figures figures = compare(features[0], features[k], map, images[0], images[k]);
                    sums[{name, ""}].add(figures);
                    sums[{name, sequence.filename().string()}].add(figures);
                }
            }
    }

    std::vector<std::vector<std::string>> cells = {
        {"method", "sequence", "features", "repeatability", "matching score", "AP", "within 3 px"}};
    nlohmann::json list = nlohmann::json::array();
    for (const auto& [key, sum] : sums) {
        const double n = sum.pairs;
        cells.push_back({key.first, key.second.empty() ? "all" : key.second,
                         bench::number(sum.features / n, 0), bench::number(sum.repeatability / n, 3),
                         bench::number(sum.matching / n, 3), bench::number(sum.ap / n, 3),
                         bench::number(sum.right_3px / n, 0)});
        list.push_back({{"method", key.first},
                        {"sequence", key.second.empty() ? "all" : key.second},
                        {"pairs", n},
                        {"features", sum.features / n},
                        {"repeatability", sum.repeatability / n},
                        {"matching_score", sum.matching / n},
                        {"ap", sum.ap / n},
                        {"within_3px", sum.right_3px / n}});
    }
    std::fputs(ism::align_columns(cells).c_str(), stdout);
    if (!json.empty()) ism::write_file(json, [&](std::ostream& out) { out << list.dump(1) << '\n'; });
} catch (const std::exception& error) {
    std::fprintf(stderr, "oxford: %s\n", error.what());
    return 2;
}
