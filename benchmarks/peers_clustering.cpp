// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Time and memory of average-link clustering of real descriptors, ours beside fastcluster and SciPy, which a
// script runs on the same rows: same sum of heights, same clusters at the cut.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/data_sets.hpp"
#include "support/options.hpp"
#include "support/real_descriptors.hpp"
#include "support/resident_memory.hpp"
#include "support/rows.hpp"
#include <nlohmann/json.hpp>

#include "ism/cluster/cluster.hpp"
#include "ism/train/train_options.hpp"

namespace {

namespace fs = std::filesystem;
using Descriptor = ism::RootSift;

struct Rows {
    std::vector<float> values;
    fs::path file;
    double cut = 0;
    [[nodiscard]] std::size_t size() const { return values.size() / Descriptor::dimension; }
    [[nodiscard]] ism::MergeTrace trace(double max_sq_distance, unsigned threads) const {
        return ism::trace_average_link(
            {.dimension = Descriptor::dimension, .means = values, .mean_sq_lengths = {}, .sizes = {}},
            {.max_sq_distance = max_sq_distance}, threads);
    }
};

double sum_of_heights(const ism::MergeTrace& trace) {
    double sum = 0;
    for (const ism::Merge& merge : trace.merges) sum += merge.sq_distance;
    return sum;
}

/// What the script tells.
struct Peer {
    double distances_s = 0, linkage_s = 0, sum = 0, memory_mib = 0;
    std::vector<std::uint32_t> labels;
    [[nodiscard]] double ms() const { return 1000 * (distances_s + linkage_s); }
};

std::string quoted(const fs::path& path) {
    return "'" + path.string() + "'";
}

class Script {
public:
    explicit Script(std::string python) : python_(std::move(python)) {}

    /// Nothing where Python or a library is missing.
    [[nodiscard]] std::optional<Peer> run(const Rows& rows, const std::string& linkage,
                                          const std::string& distances) const {
        const fs::path labels = rows.file.string() + ".labels", answer = rows.file.string() + ".json";
        const std::string command = "OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 " + python_ + " " +
                                    quoted(fs::path(ISM_BENCHMARKS) / "peers_clustering.py") + " " +
                                    quoted(rows.file) + " " + quoted(labels) + " --dimension " +
                                    std::to_string(Descriptor::dimension) + " --cut " +
                                    bench::number(rows.cut, 6) + " --linkage " + linkage + " --distances " +
                                    distances + " > " + quoted(answer);
        if (std::system(command.c_str()) != 0) return std::nullopt;
        std::ifstream file(answer);
        const auto told = nlohmann::json::parse(file);
        Peer peer{told.at("distances_s"), told.at("linkage_s"), told.at("sum"), told.at("memory_mib"), {}};
        peer.labels.resize(rows.size());
        std::ifstream(labels, std::ios::binary)
            .read(reinterpret_cast<char*>(peer.labels.data()), std::streamsize(4 * rows.size()));
        return peer;
    }

private:
    std::string python_;
};

/// Whether a full trace of ours is the dendrogram of the peer.
bool same(const ism::MergeTrace& trace, const Peer& peer, double cut) {
    return std::abs(sum_of_heights(trace) - peer.sum) <= 1e-6 * peer.sum &&
           ism::cut(trace, cut).label == peer.labels;
}

Rows make_rows(const std::vector<float>& all, std::size_t count, double cut, const fs::path& folder) {
    Rows rows{{}, folder / (std::to_string(count) + ".float32"), cut};
    const std::size_t total = all.size() / Descriptor::dimension;
    for (std::size_t i = 0; i < count; ++i) {
        const auto row = all.begin() + std::ptrdiff_t(i * total / count * Descriptor::dimension);
        rows.values.insert(rows.values.end(), row, row + Descriptor::dimension);
    }
    std::ofstream(rows.file, std::ios::binary)
        .write(reinterpret_cast<const char*>(rows.values.data()), std::streamsize(4 * rows.values.size()));
    return rows;
}

}  // namespace

int main(int argc, char** argv) try {
    fs::path json, data = bench::data_folder();
    std::string python = "/usr/bin/python3";
    std::vector<std::size_t> counts = {2000, 10000, 30000};
    std::size_t rounds = 3;
    double similarity = ism::CodebookOptions{}.min_similarity;
    bench::Options command_line("Time of average-link clustering, ours beside fastcluster and SciPy.");
    command_line.add("--data", data, "folder of the real images");
    command_line.add("--python", python, "Python that has numpy, scipy and fastcluster");
    command_line.add("--counts", counts, "numbers of descriptors");
    command_line.add("--rounds", rounds, "measurements of ours, their median counts", {1, 100});
    command_line.add("--similarity", similarity, "the cut, as in training");
    command_line.add("--json", json, "write the rows to this file");
    if (const auto code = command_line.parse(argc, argv)) return *code;

    const double cut = 2 * (1 - similarity) * Descriptor::sq_length,
                 whole = std::numeric_limits<double>::infinity();
    const std::vector<float> all = bench::real_descriptors<Descriptor>(
        {data / "sysu-shapes/images", data / "weizmann-horses/images", data / "msrc/images"},
        *std::max_element(counts.begin(), counts.end()));
    const fs::path folder =
        fs::temp_directory_path() / ("ism-clustering-" + std::to_string(std::random_device()()));
    fs::create_directories(folder);
    const Script script(python);
    std::printf(
        "RootSIFT of Hessian-Laplace features of photographs; squared distances, cut at %g (similarity %g). "
        "The peers' "
        "time is that of distances (float32 products by numpy's BLAS) and linkage in Python, one thread, "
        "without "
        "files; they have no cut. Correct: sum of heights to 1e-6 and clusters at the cut as those of "
        "fastcluster from "
        "float64 distances.\n",
        cut, similarity);

    std::vector<bench::Row> table;
    for (const std::size_t count : counts) {
        const Rows rows = make_rows(all, count, cut, folder);
        const std::string name = std::to_string(count) + " descriptors, ";
        ism::MergeTrace full, lower, two;
        std::optional<double> mib;
        const auto ours = [&](std::size_t times) {
            return bench::interleaved_ms(
                {[&] { full = rows.trace(whole, 1); }, [&] { lower = rows.trace(cut, 1); },
                 [&] { two = rows.trace(cut, 2); }},
                times);
        };
        mib = bench::peak_mib([&] { full = rows.trace(whole, 1); });
        const auto before = ours(rounds);
        const auto peer = script.run(rows, "fastcluster", "float32");
        const auto after = ours(rounds);
        const auto mean = [&](std::size_t i) { return (before[i] + after[i]) / 2; };
        const bool same_two = two.merges == lower.merges;
        table.push_back({name + "cut, 2 threads against 1", mean(2), mean(1), "ism, 1 thread", "ms", same_two,
                         "same bits"});
        if (!peer) {
            std::printf("fastcluster or SciPy is missing: not compared\n");
            continue;
        }
        const auto exact = script.run(rows, "fastcluster", "float64");
        const bool correct = exact && same(full, *exact, cut);
        const bool correct_cut = exact && ism::cut(lower, cut).label == exact->labels;
        char remark[200];
        std::snprintf(remark, sizeof(remark),
                      "sum of heights %.7g, peer %.7g; peer: distances %.0f ms, linkage %.0f ms",
                      sum_of_heights(full), exact ? exact->sum : 0.0, 1000 * peer->distances_s,
                      1000 * peer->linkage_s);
        table.push_back({name + "full", mean(0), peer->ms(), "fastcluster", "ms", correct, remark});
        table.push_back({name + "cut", mean(1), peer->ms(), "fastcluster", "ms", correct_cut,
                         std::to_string(ism::cut(lower, cut).count) + " clusters"});
        if (mib)
            table.push_back({name + "memory", *mib, peer->memory_mib, "fastcluster", "MiB",
                             *mib <= 60 || count > 30000, "beyond the descriptors"});
        if (count > 10000) continue;
        const auto scipy = script.run(rows, "scipy", "float32");
        if (scipy) table.push_back({name + "full", mean(0), scipy->ms(), "SciPy", "ms", correct, ""});
        const auto pdist = script.run(rows, "fastcluster", "pdist");
        if (pdist)
            table.push_back({name + "full", mean(0), pdist->ms(), "fastcluster, pdist", "ms", correct,
                             "SciPy's distances instead"});
    }
    fs::remove_all(folder);
    bench::print(table);
    if (!json.empty()) bench::write_json(json, table);
} catch (const std::exception& error) {
    std::fprintf(stderr, "peers_clustering: %s\n", error.what());
    return 2;
}
