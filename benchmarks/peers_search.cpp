// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// All words within a radius: ours beside products by Eigen and OpenBLAS, and beside the indexes of faiss,
// hnswlib, FLANN and nanoflann. One thread, real descriptors, words of real clusters.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "support/data_sets.hpp"
#include "support/options.hpp"
#include "support/peer_search.hpp"
#include "support/rows.hpp"
#include "support/search_data.hpp"

#include "ism/codebook/build_codebook.hpp"
#include "ism/codebook/match.hpp"

namespace {

namespace fs = std::filesystem;
using bench::Hit;
using bench::Rows;
using bench::Words;

/// By the definition of the distance, in double, one pair after another.
std::vector<Hit> exact_hits(const Words& words, const Rows& queries) {
    std::vector<Hit> hits;
    for (std::uint32_t i = 0; i < queries.size(); ++i)
        for (std::uint32_t w = 0; w < words.size(); ++w) {
            double square = 0, dot = 0;
            for (std::size_t k = 0; k < bench::sift_size; ++k) {
                const double d = queries.row(i)[k];
                square += d * d, dot += d * double(words.means().row(w)[k]);
            }
            if (square + double(words.mean_sq_lengths()[w]) - 2 * dot <= words.max_sq_distance())
                hits.emplace_back(i, w);
        }
    return hits;
}

std::vector<Hit> hits_of(const std::vector<ism::Match>& matches) {
    std::vector<Hit> hits;
    for (const ism::Match& m : matches) hits.emplace_back(m.feature, m.word);
    return hits;
}

/// Share of the exact answer that was found.
double recall(std::vector<Hit> found, const std::vector<Hit>& exact) {
    std::sort(found.begin(), found.end());
    std::vector<Hit> both;
    std::set_intersection(found.begin(), found.end(), exact.begin(), exact.end(), std::back_inserter(both));
    return exact.empty() ? 1 : double(both.size()) / double(exact.size());
}

std::vector<Hit> first_hits(std::vector<Hit> hits, std::size_t queries) {
    std::erase_if(hits, [&](const Hit& hit) { return hit.first >= queries; });
    return hits;
}

Rows first_rows(Rows rows, std::size_t count) {
    rows.resize(std::min(count, rows.size()));
    return rows;
}

/// Ours on queries of one kind, beside each peer on plain SIFT.
void compare(const std::string& name, const Words& words, const Rows& queries,
             const std::vector<bench::SearchPeer>& peers, const Words& peer_words, const Rows& peer_queries,
             ism::InstructionSet isa, std::size_t rounds, std::vector<bench::Row>& rows) {
    const ism::WordIndex index(words, isa);
    ism::ThreadPool pool(1);
    const auto exact = exact_hits(words, queries), peer_exact = exact_hits(peer_words, peer_queries);
    const auto ours = ism::match(index, queries, pool);
    const bool same = hits_of(ours) == exact;
    for (const bool slow : {false, true}) {
        const std::size_t count = slow ? std::min<std::size_t>(200, queries.size()) : queries.size();
        const auto mine = first_rows(queries, count);
        const auto theirs = first_rows(peer_queries, count);
        std::vector<const bench::SearchPeer*> chosen;
        for (const bench::SearchPeer& peer : peers)
            if (peer.slow == slow) chosen.push_back(&peer);
        std::vector<std::vector<Hit>> found(chosen.size());
        std::size_t kept = 0;
        std::vector<std::function<void()>> timed = {[&] { kept += ism::match(index, mine, pool).size(); }};
        for (std::size_t p = 0; p < chosen.size(); ++p)
            timed.emplace_back([&, p] { found[p].clear(), chosen[p]->search(theirs, found[p]); });
        const auto ms = bench::interleaved_ms(timed, slow ? 1 : rounds);
        const auto us = [&](double time) { return 1000 * time / double(count); };
        const auto expected = first_hits(peer_exact, count);
        for (std::size_t p = 0; p < chosen.size(); ++p) {
            const double theirs_us = us(ms[1 + p]);
            rows.push_back({name, us(ms[0]), theirs_us, chosen[p]->name, "us a query", same,
                            "recall: ours " + bench::number(recall(hits_of(ours), exact), 4) + ", peer " +
                                bench::number(recall(found[p], expected), 4) + "; " +
                                bench::number(double(exact.size()) / double(queries.size()), 1) +
                                " words a query"});
        }
    }
}

}  // namespace

int main(int argc, char** argv) try {
    fs::path json, data;
    std::size_t rounds = 5, queries_wanted = 2000, clustered = 40000;
    bool fast_only = false;
    ism::InstructionSet isa = ism::best_instruction_set();
    std::vector<std::size_t> sizes = {1000, 7000, 50000};
    bench::Options command_line(
        "Time to find all words within the default threshold, ours beside other libraries.");
    command_line.add("--data", data, "folder of the real images");
    command_line.add("--words", sizes, "numbers of words; more than were clustered: single descriptors");
    command_line.add("--queries", queries_wanted, "number of descriptors to look up", {12, 100000});
    command_line.add("--clustered", clustered, "number of descriptors to make words of", {1000, 1000000});
    command_line.add("--rounds", rounds, "measurements, their median counts", {1, 1000});
    command_line.add("--isa", isa, "instruction set of ours; without, the best there is");
    command_line.add("--fast-only", fast_only, "leave out the peers that are slow to build or to ask");
    command_line.add("--json", json, "write the rows to this file");
    if (const auto code = command_line.parse(argc, argv)) return *code;
    if (data.empty()) data = bench::data_folder();
#ifdef _OPENMP
    omp_set_num_threads(1);
#endif

    const double max_sq_distance = bench::default_max_sq_distance(ism::Sift::sq_length);
    const std::vector<fs::path> asked = {data / "oxford-affine/bikes", data / "oxford-affine/graf",
                                         data / "oxford-affine/boat"};
    const std::vector<fs::path> learnt = {data / "background", data / "msrc/images"};
    const auto queries = bench::descriptors_of(asked, queries_wanted);
    const auto others =
        bench::descriptors_of(learnt, std::max(clustered, *std::max_element(sizes.begin(), sizes.end())));
    const Words clusters = ism::build_codebook(first_rows(others, clustered), max_sq_distance, 2);
    const Words singles = bench::single_words(others, max_sq_distance);
    const auto bytes = bench::as_bytes(queries);
    std::printf(
        "%zu queries; %zu words of %zu descriptors; SIFT, squared distance at most %.3f, one thread\n",
        queries.size(), clusters.size(), std::min(clustered, others.size()), max_sq_distance);

    std::vector<bench::Row> rows;
    for (const std::size_t size : sizes) {
        const bool real = size <= clusters.size();
        const Words words = bench::first_words(real ? clusters : singles, std::min(size, others.size()));
        const std::string name =
            std::to_string(words.size()) + (real ? " words" : " single descriptors as words");
        std::vector<bench::SearchPeer> peers = bench::search_peers(words, !fast_only);
        compare(name + ", float", words, queries, peers, words, queries, isa, rounds, rows);
        std::erase_if(peers, [](const bench::SearchPeer& peer) { return peer.slow; });
        compare(name + ", bytes", bench::in_byte_units(words), bytes, peers, words, queries, isa, rounds,
                rows);
    }
    bench::print(rows);
    if (!json.empty()) bench::write_json(json, rows);
} catch (const std::exception& error) {
    std::fprintf(stderr, "peers_search: %s\n", error.what());
    return 2;
}
