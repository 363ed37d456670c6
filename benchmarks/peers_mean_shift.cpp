// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Time to find the modes of votes, ours beside other libraries, with the same starts, kernel, stopping rule
// and window, and whether the modes are the same.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/data_sets.hpp"
#include "support/options.hpp"
#include "support/photographs.hpp"
#include "support/real_votes.hpp"
#include "support/rows.hpp"

#include "ism/vote/mean_shift.hpp"

#if __has_include(<nanoflann.hpp>)
#include "support/nanoflann_shift.hpp"
#define ISM_HAVE_NANOFLANN
#endif

namespace {

namespace fs = std::filesystem;

/// How well the peer's modes are found: for each that detection would keep at the default T_ratio one of ours
/// that is near and not weaker.
template <std::size_t D>
struct Agreement {
    std::size_t modes = 0, found = 0;
    double distance = 0, score = 0;  ///< the worst: windows, relative

    Agreement(const std::vector<ism::Mode<D>>& ours, const std::vector<ism::Mode<D>>& peer,
              const std::array<double, D>& window, double near) {
        for (const auto& mode : peer) {
            if (mode.score < 0.05 * peer.front().score) break;
            ++modes;
            double nearest = near;
            const ism::Mode<D>* same = nullptr;
            for (const auto& other : ours)
                if (const double d = std::sqrt(ism::sq_windows(mode.at, other.at, window));
                    d < nearest && other.score >= 0.99 * mode.score)
                    nearest = d, same = &other;
            if (same == nullptr) continue;
            ++found;
            distance = std::max(distance, nearest);
            score = std::max(score, std::abs(same->score / mode.score - 1));
        }
    }
    [[nodiscard]] bool all() const { return modes > 0 && found == modes; }
    [[nodiscard]] std::string text() const {
        char line[120];
        std::snprintf(line, sizeof(line),
                      "%zu of the peer's %zu modes; off by at most %.0e windows, score %.0e", found, modes,
                      distance, score);
        return line;
    }
};

template <std::size_t D>
[[nodiscard]] ism::Bandwidth<D> fixed_bandwidth() {
    const auto defaults = ism::default_bandwidth<bench::FiveAxes>().at_scale_1;
    ism::Bandwidth<D> bandwidth{};
    std::copy_n(defaults.begin(), D, bandwidth.at_scale_1.begin());
    bandwidth.scaling.fill(ism::BandwidthScaling::none);
    return bandwidth;
}

template <std::size_t D>
[[nodiscard]] std::string name(std::size_t count) {
    return std::to_string(D) + "-D, " + std::to_string(count) + " votes";
}

#ifdef ISM_HAVE_NANOFLANN
template <std::size_t D>
[[nodiscard]] bench::Row beside_nanoflann(const std::vector<ism::Vote<D>>& votes, std::size_t rounds) {
    using K = ism::EpanechnikovKernel;
    const std::span<const ism::Vote<D>> all(votes);
    const auto bandwidth = fixed_bandwidth<D>();
    const ism::MeanShiftOptions options{.max_iterations = 500};  // to rest: else both stop on their way
    ism::SeedBins<D> bins;
    const auto starts = bins.find(all, bandwidth, options.max_seeds, options.min_relative_weight);
    std::vector<ism::Mode<D>> ours, peer;
    const auto times = bench::interleaved_ms(
        {[&] { ours = ism::find_modes<K>(all, bandwidth, options); },
         [&] {
             peer = bench::NanoflannShift<D>(all, bandwidth.at_scale_1).template modes<K>(starts, options);
         }},
        rounds);
    auto exhaustive = options;
    exhaustive.merge_radius = 0;
    const Agreement<D> agreement(ours, peer, bandwidth.at_scale_1, 0.05),
        exact(ism::find_modes<K>(all, bandwidth, exhaustive), peer, bandwidth.at_scale_1, 0.05);
    return {.name = name<D>(votes.size()),
            .ours = times[0],
            .peer = times[1],
            .peer_name = "nanoflann + loop",
            .unit = "ms",
            .correct = agreement.all() && exact.all(),
            .remark = std::to_string(starts.size()) + " starts; " + agreement.text() + "; without merging " +
                      exact.text()};
}
#endif

/// Where Python or scikit-learn is missing the row is left out.
template <std::size_t D>
[[nodiscard]] std::vector<bench::Row> beside_sklearn(std::vector<ism::Vote<D>> votes, std::size_t rounds) {
    using K = ism::FlatKernel;
    for (auto& vote : votes) vote.weight = 1;  // it knows no weights
    const std::span<const ism::Vote<D>> all(votes);
    const auto bandwidth = fixed_bandwidth<D>();
    ism::SeedBins<D> bins;
    const auto starts = bins.find(all, bandwidth, 30, 0.05);

    const fs::path folder = fs::temp_directory_path() / ("ism_mean_shift_" + std::to_string(std::rand()));
    fs::create_directories(folder);
    const auto write = [&](const char* file, const auto& places) {
        std::ofstream out(folder / file, std::ios::binary);
        for (const auto& place : places)
            for (std::size_t k = 0; k < D; ++k) {
                const float value = float(place.at[k] / bandwidth.at_scale_1[k]);
                out.write(reinterpret_cast<const char*>(&value), sizeof(value));
            }
    };
    write("votes", votes);
    write("starts", starts);
    const fs::path script = fs::path(__FILE__).parent_path() / "support" / "sklearn_mean_shift.py";
    const std::string in = folder.string();
    std::ostringstream command;
    command << "/usr/bin/env OMP_NUM_THREADS=1 /usr/bin/python3 '" << script.string() << "' '" << in
            << "/votes' '" << in << "/starts' " << D << ' ' << rounds << " > '" << in << "/modes' 2> '" << in
            << "/errors'";
    const int status = std::system(command.str().c_str());
    std::ifstream result(folder / "modes");
    double peer_ms = 0;
    result >> peer_ms;
    std::vector<ism::Mode<D>> peer;
    ism::Mode<D> mode;
    while (status == 0 && [&] {
        for (std::size_t k = 0; k < D; ++k) result >> mode.at[k];
        return bool(result);
    }()) {
        for (std::size_t k = 0; k < D; ++k) mode.at[k] *= bandwidth.at_scale_1[k];
        mode.score = 0;
        for (const auto& vote : votes)
            mode.score += K::profile(float(ism::sq_windows(vote.at, mode.at, bandwidth.at_scale_1)));
        peer.push_back(mode);
    }
    result.close();
    fs::remove_all(folder);
    if (status != 0 || peer.empty()) {
        std::fprintf(stderr, "peers_mean_shift: no scikit-learn (python3-sklearn), left out\n");
        return {};
    }
    std::vector<ism::Mode<D>> ours;
    const auto times = bench::interleaved_ms({[&] { ours = ism::find_modes<K>(all, bandwidth); }},
                                             std::max<std::size_t>(5, rounds));
    // it counts votes: of several near modes with as many votes either may be chosen
    const Agreement<D> agreement(ours, peer, bandwidth.at_scale_1, 0.5);
    return {{name<D>(votes.size()) + ", flat, weights 1", times[0], peer_ms, "scikit-learn", "ms",
             agreement.all(), std::to_string(starts.size()) + " starts; " + agreement.text()}};
}

}  // namespace

int main(int argc, char** argv) try {
    fs::path data = bench::data_folder(), json;
    std::size_t rounds = 9, python_votes = 10000;
    std::vector<std::size_t> counts = {1000, 10000, 100000};
    bench::Options command_line(
        "Time of mean shift, ours beside other libraries, on votes cast by a model of osd.");
    command_line.add("--data", data, "the folder of data sets");
    command_line.add("--votes", counts, "numbers of votes");
    command_line.add("--rounds", rounds, "measurements, their median counts", {1, 1000});
    command_line.add("--python-votes", python_votes, "scikit-learn gets no more votes than this");
    command_line.add("--json", json, "write the rows to this file");
    if (const auto code = command_line.parse(argc, argv)) return *code;

    const auto images = bench::osd_votes(data);
    std::size_t total = 0;
    for (const auto& image : images) total += image.size();
    std::printf(
        "Real votes: model of osd/train.json (Hessian-Laplace, RootSIFT), soft matching, %zu votes in %zu "
        "images "
        "of osd/val.json; so many of them drawn at random and laid into one picture and one class. One "
        "thread, "
        "fixed windows of 40 px, 40 px, 0.4, 0.15 m, 0.15 m. Ours: grid, starts, search; nanoflann: tree and "
        "search, given the starts.\n",
        total, images.size());
    std::vector<bench::Row> rows;
    for (const std::size_t count : counts) {
        const auto votes = bench::pooled(images, count);
#ifdef ISM_HAVE_NANOFLANN
        rows.push_back(beside_nanoflann(bench::first_axes<3>(votes), rounds));
        rows.push_back(beside_nanoflann(votes, rounds));
#endif
        if (count > python_votes) continue;
        for (auto& row : beside_sklearn(bench::first_axes<3>(votes), 3)) rows.push_back(row);
    }
    bench::print(rows);
    if (!json.empty()) bench::write_json(json, rows);
} catch (const std::exception& error) {
    std::fprintf(stderr, "peers_mean_shift: %s\n", error.what());
    return 2;
}
