// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Time to find and describe the features of an image, ours beside other libraries, interleaved image by
// image.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "support/options.hpp"
#include "support/our_features.hpp"
#include "support/peer_features.hpp"
#include "support/photographs.hpp"
#include "support/rows.hpp"

namespace {

namespace fs = std::filesystem;
using bench::ByteImage;
using bench::Features;

/// An extractor of ours that keeps its memory, and what it gave last.
struct Ours {
    std::function<const Features&(const ByteImage&)> extract;

    template <ism::Detector D>
    [[nodiscard]] static Ours make(unsigned threads) {
        auto extractor =
            std::make_shared<ism::FeatureExtractor<D, ism::Sift>>(bench::like_peers<D>(), threads);
        return {[extractor](const ByteImage& image) -> const Features& { return extractor->extract(image); }};
    }
};

[[nodiscard]] bool same(const Features& a, const Features& b) {
    return a.features.size() == b.features.size() &&
           std::equal(a.descriptors.values().begin(), a.descriptors.values().end(),
                      b.descriptors.values().begin());
}

/// Share of the peer's features that ours has too: within 1.5 pixels, or a third of the scale where that is
/// more, and of a scale that differs by less than a factor 1.5.
[[nodiscard]] double shared(const Features& ours, const Features& peers) {
    std::size_t found = 0;
    for (const ism::Feature& p : peers.features)
        found += std::any_of(ours.features.begin(), ours.features.end(), [&](const ism::Feature& f) {
            return std::hypot(f.x - p.x, f.y - p.y) < std::max(1.5f, p.scale / 3) &&
                   f.scale < 1.5f * p.scale && p.scale < 1.5f * f.scale;
        });
    return double(found) / std::max(1.0, double(peers.features.size()));
}

struct Comparison {
    std::string name;
    std::function<Ours(unsigned)> make;
    bench::FeaturePeer peer;
};

}  // namespace

int main(int argc, char** argv) try {
    std::vector<std::string> files;
    fs::path json;
    std::size_t rounds = 5;
    bench::Options command_line(
        "Time of features, ours beside other libraries. Without images: ten crops of the Oxford set.");
    command_line.add("--images", files, "photographs to use, whole, or folders of them");
    command_line.add("--rounds", rounds, "measurements of each image, their median counts", {1, 1000});
    command_line.add("--json", json, "write the rows to this file");
    if (const auto code = command_line.parse(argc, argv)) return *code;
    const std::vector<ByteImage> images = bench::photographs(files);

    using Dog = ism::DifferenceOfGaussians;
    using Hessian [[maybe_unused]] = ism::HessianLaplace;  // unused where VLFeat is not installed
    using Harris [[maybe_unused]] = ism::HarrisLaplace;
    std::vector<Comparison> comparisons;
#ifdef ISM_HAVE_OPENCV
    comparisons.push_back({"DoG + SIFT", Ours::make<Dog>, bench::opencv_sift()});
#endif
#ifdef ISM_HAVE_VLFEAT
    comparisons.push_back({"DoG + SIFT", Ours::make<Dog>, bench::vlfeat_sift()});
    comparisons.push_back({"Hessian-Laplace + SIFT", Ours::make<Hessian>,
                           bench::vlfeat_covdet("VLFeat covdet", VL_COVDET_METHOD_HESSIAN_LAPLACE)});
    comparisons.push_back({"Harris-Laplace + SIFT", Ours::make<Harris>,
                           bench::vlfeat_covdet("VLFeat covdet", VL_COVDET_METHOD_HARRIS_LAPLACE)});
#endif
    std::printf(
        "%zu images; oriented features, first octave doubled, 3 levels an octave, 8-bit input, float "
        "SIFT; ours: contrast 0.04, edge 10, Laplace detectors with default thresholds, input_sigma 0 (it "
        "doubles without blur)\n",
        images.size());
    for (const Comparison& c : comparisons)
        std::printf("  %s: %s\n", c.peer.name.c_str(), c.peer.settings.c_str());

    std::vector<bench::Row> rows;
    const auto keypoints = [](double count, double ms) {
        return bench::number(count, 0) + " keypoints, " + bench::number(1000 * ms / std::max(1.0, count), 1) +
               " us each";
    };
    for (const unsigned threads : {1u, 2u})
        for (const Comparison& c : comparisons) {
            const Ours ours = c.make(threads), single = c.make(1);
            double our_ms = 0, peer_ms = 0, our_count = 0, peer_count = 0, share = 0;
            bool correct = true;
            for (const ByteImage& image : images) {
                Features peers;
                const auto times = bench::interleaved_ms(
                    {[&] { ours.extract(image); }, [&] { peers = c.peer.extract(image, threads); }}, rounds);
                const Features& mine = ours.extract(image);
                our_ms += times[0] / double(images.size()), peer_ms += times[1] / double(images.size());
                our_count += double(mine.features.size()) / double(images.size());
                peer_count += double(peers.features.size()) / double(images.size());
                share += shared(mine, peers) / double(images.size());
                correct = correct && same(mine, single.extract(image));
            }
            rows.push_back({c.name + (threads == 1 ? ", 1 thread" : ", 2 threads"), our_ms, peer_ms,
                            c.peer.name, "ms", correct && share > 0.5,
                            keypoints(our_count, our_ms) + "; peer " + keypoints(peer_count, peer_ms) +
                                "; has " + bench::number(100 * share, 0) + " % of the peer's"});
            std::fprintf(stderr, "%s beside %s: %.1f ms, %.1f ms\n", rows.back().name.c_str(),
                         c.peer.name.c_str(), our_ms, peer_ms);
        }
    // what a second thread gives, in one run again
    {
        const Ours one = Ours::make<Dog>(1), two = Ours::make<Dog>(2);
        double one_ms = 0, two_ms = 0;
        bool correct = true;
        for (const ByteImage& image : images) {
            const auto times =
                bench::interleaved_ms({[&] { two.extract(image); }, [&] { one.extract(image); }}, 2 * rounds);
            two_ms += times[0] / double(images.size()), one_ms += times[1] / double(images.size());
            correct = correct && same(one.extract(image), two.extract(image));
        }
        rows.push_back(
            {"DoG + SIFT, 2 threads against 1", two_ms, one_ms, "ism, 1 thread", "ms", correct, "same bits"});
    }
    bench::print(rows);
    if (!json.empty()) bench::write_json(json, rows);
} catch (const std::exception& error) {
    std::fprintf(stderr, "peers_features: %s\n", error.what());
    return 2;
}
