// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// The nearest of many single descriptors: ours beside products by Eigen and OpenBLAS with a selection, and
// beside the flat index of faiss. One thread, oriented RootSIFT of photographs of OSD: the first are the
// words, those of other photographs ask.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "support/data_sets.hpp"
#include "support/options.hpp"
#include "support/peer_search.hpp"
#include "support/rows.hpp"
#include "support/search_data.hpp"

#include "ism/codebook/nearest_words.hpp"

namespace {

namespace fs = std::filesystem;
using bench::Rows;
using bench::Words;

/// Row after row the nearest words.
using Lists = std::vector<std::uint32_t>;

struct NearestPeer {
    std::string name;
    std::function<void(const Rows&, Lists&)> search;
};

/// By the definition of the distance, in double, one pair after another.
Lists exact_lists(const Words& words, const Rows& queries, std::size_t count) {
    Lists lists;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        std::vector<std::pair<double, std::uint32_t>> order;
        for (std::uint32_t w = 0; w < words.size(); ++w) {
            double square = 0, dot = 0;
            for (std::size_t k = 0; k < bench::sift_size; ++k) {
                const double d = queries.row(i)[k];
                square += d * d, dot += d * double(words.means().row(w)[k]);
            }
            order.emplace_back(square + double(words.mean_sq_lengths()[w]) - 2 * dot, w);
        }
        std::partial_sort(order.begin(), order.begin() + std::ptrdiff_t(count), order.end());
        for (std::size_t k = 0; k < count; ++k) lists.push_back(order[k].second);
    }
    return lists;
}

/// Blocks of 96 × 2048 dot products by `product`; a strip of 16 words is looked at where one of them is
/// nearer than the last of the nearest so far.
template <class Product>
void select_by_products(const Words& words, const Rows& queries, std::size_t count, Lists& lists,
                        const Product& product) {
    constexpr std::size_t rows = 96, columns = 2048, strip = 16;
    static thread_local std::vector<float> dots(rows * columns);
    std::vector<std::pair<float, std::uint32_t>> near;
    for (std::size_t first = 0; first < queries.size(); first += rows) {
        const std::size_t height = std::min(rows, queries.size() - first);
        near.assign(height * count, {std::numeric_limits<float>::infinity(), 0});
        bench::each_product_row(
            words, queries, first, height, columns, dots, product,
            [&](std::size_t i, std::size_t left, const float* lengths, const float* dot, std::size_t width) {
                auto* own = near.data() + i * count;
                for (std::size_t j = 0; j < width; j += strip) {
                    const std::size_t end = std::min(width, j + strip);
                    const float far = own[count - 1].first;
                    int any = 0;
                    for (std::size_t k = j; k < end; ++k) any |= lengths[k] - 2 * dot[k] < far;
                    if (!any) continue;
                    for (std::size_t k = j; k < end; ++k) {
                        const float distance = lengths[k] - 2 * dot[k];
                        if (!(distance < own[count - 1].first)) continue;
                        std::size_t at = count - 1;
                        for (; at > 0 && distance < own[at - 1].first; --at) own[at] = own[at - 1];
                        own[at] = {distance, std::uint32_t(left + k)};
                    }
                }
            });
        for (const auto& [distance, word] : near) lists.push_back(word);
    }
}

std::vector<NearestPeer> nearest_peers(const Words& words, std::size_t count) {
    std::vector<NearestPeer> peers;
#ifdef ISM_HAVE_OPENBLAS
    openblas_set_num_threads(1);
    peers.push_back({std::string("OpenBLAS sgemm, ") + openblas_get_corename(),
                     [&words, count](const Rows& queries, Lists& lists) {
                         select_by_products(words, queries, count, lists, bench::openblas_product);
                     }});
#endif
    peers.push_back({"Eigen gemm", [&words, count](const Rows& queries, Lists& lists) {
                         select_by_products(words, queries, count, lists, bench::eigen_product);
                     }});
#ifdef ISM_HAVE_FAISS
    const auto index = std::make_shared<faiss::IndexFlatL2>(faiss::Index::idx_t(bench::sift_size));
    index->add(faiss::Index::idx_t(words.size()), words.means().values().data());
    peers.push_back({"faiss flat", [index, count](const Rows& queries, Lists& lists) {
                         std::vector<float> distances(queries.size() * count);
                         std::vector<faiss::Index::idx_t> found(distances.size());
                         index->search(faiss::Index::idx_t(queries.size()), queries.values().data(),
                                       faiss::Index::idx_t(count), distances.data(), found.data());
                         lists.assign(found.begin(), found.end());
                     }});
#endif
    return peers;
}

/// Share of the entries that are the same.
double agreement(const Lists& lists, const Lists& exact) {
    std::size_t same = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) same += i < lists.size() && lists[i] == exact[i];
    return double(same) / double(exact.size());
}

}  // namespace

int main(int argc, char** argv) try {
    fs::path json, data;
    std::size_t rounds = 9, wanted = 36500, queries_wanted = 1000;
    std::vector<std::size_t> counts = {1, 9, 64};
    ism::InstructionSet isa = ism::best_instruction_set();
    bench::Options command_line(
        "Time to find the nearest of many single descriptors, ours beside other libraries.");
    command_line.add("--data", data, "folder of the real images");
    command_line.add("--words", wanted, "number of words", {1000, 40000});
    command_line.add("--queries", queries_wanted, "number of descriptors to look up", {12, 100000});
    command_line.add("--nearest", counts, "how many neighbours of each", {1, 1000});
    command_line.add("--rounds", rounds, "measurements, their median counts", {1, 1000});
    command_line.add("--isa", isa, "instruction set of ours; without, the best there is");
    command_line.add("--json", json, "write the rows to this file");
    if (const auto code = command_line.parse(argc, argv)) return *code;
    if (data.empty()) data = bench::data_folder();
#ifdef _OPENMP
    omp_set_num_threads(1);
#endif

    const std::vector<fs::path> folders = {data / "osd/images"};
    const Rows all = bench::descriptors_of<ism::RootSift>(folders, std::numeric_limits<std::uint32_t>::max());
    ism::expect(all.size() > wanted, "descriptors", ism::lazy_text("more than ", wanted), all.size());
    const std::size_t rest = all.size() - wanted, asked = std::min(queries_wanted, rest);
    const Words words =
        bench::first_words(bench::single_words(all, std::numeric_limits<double>::infinity()), wanted);
    Rows queries(bench::sift_size);
    for (std::size_t i = 0; i < asked; ++i) queries.push_back(all.row(wanted + i * rest / asked));
    std::printf("%zu RootSIFT of %zu others, one thread\n", queries.size(), words.size());

    const ism::WordIndex index(words, isa);
    ism::ThreadPool pool(1);
    std::vector<bench::Row> rows;
    for (const std::size_t count : counts) {
        const Lists exact = exact_lists(words, queries, count);
        const std::vector<NearestPeer> peers = nearest_peers(words, count);
        std::vector<ism::Neighbour> neighbours;
        std::vector<Lists> found(peers.size());
        std::vector<std::function<void()>> timed = {
            [&] { neighbours = ism::nearest_words(index, queries, count, pool); }};
        for (std::size_t p = 0; p < peers.size(); ++p)
            timed.emplace_back([&, p] { found[p].clear(), peers[p].search(queries, found[p]); });
        const std::vector<double> ms = bench::interleaved_ms(timed, rounds);
        Lists ours;
        for (const ism::Neighbour& near : neighbours) ours.push_back(near.word);
        for (std::size_t p = 0; p < peers.size(); ++p)
            rows.push_back({std::to_string(count) + " nearest", ms[0], ms[1 + p], peers[p].name, "ms",
                            ours == exact,
                            "the same: ours " + bench::number(agreement(ours, exact), 5) + ", peer " +
                                bench::number(agreement(found[p], exact), 5)});
    }
    bench::print(rows);
    if (!json.empty()) bench::write_json(json, rows);
} catch (const std::exception& error) {
    std::fprintf(stderr, "peers_nearest: %s\n", error.what());
    return 2;
}
