// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#ifdef ISM_HAVE_OPENBLAS
#include <cblas.h>
#endif
#ifdef ISM_HAVE_FAISS
#include <faiss/IndexFlat.h>
#include <faiss/impl/AuxIndexStructures.h>
#endif
#ifdef ISM_HAVE_FLANN
#include <flann/flann.hpp>
#endif
#ifdef ISM_HAVE_HNSWLIB
#include <hnswlib/hnswlib.h>
#endif
#include "support/search_data.hpp"
#include <nanoflann.hpp>

namespace bench {

/// @brief Descriptor and word within the threshold.
using Hit = std::pair<std::uint32_t, std::uint32_t>;

/// @brief How another library finds the words within the threshold; one thread.
struct SearchPeer {
    std::string name;
    bool slow = false;  ///< only few queries are worth the wait
    std::function<void(const Rows&, std::vector<Hit>&)> search;
};

/// Dot products of all words with some queries by `product`, `columns` words at a time: calls
/// visit(query, first word, lengths of the words, their products, their number) for each query of a block.
template <class Product, class Visit>
void each_product_row(const Words& words, const Rows& queries, std::size_t first, std::size_t height,
                      std::size_t columns, std::vector<float>& dots, const Product& product,
                      const Visit& visit) {
    for (std::size_t left = 0; left < words.size(); left += columns) {
        const std::size_t width = std::min(columns, words.size() - left);
        product(words.means().row(left).data(), width, queries.row(first).data(), height, dots.data());
        for (std::size_t i = 0; i < height; ++i)
            visit(i, left, words.mean_sq_lengths().data() + left, dots.data() + i * width, width);
    }
}

/// Blocks of 64 × 512 dot products by `product`, then norms and threshold: as one writes it with a BLAS.
template <class Product>
void search_by_products(const Words& words, const Rows& queries, std::vector<Hit>& hits,
                        const Product& product) {
    constexpr std::size_t rows = 64, columns = 512;
    static thread_local std::vector<float> dots(rows * columns);
    const auto threshold = float(words.max_sq_distance());
    for (std::size_t first = 0; first < queries.size(); first += rows) {
        const std::size_t height = std::min(rows, queries.size() - first);
        std::vector<float> square(height, 0);
        for (std::size_t i = 0; i < height; ++i)
            square[i] =
                Eigen::Map<const Eigen::VectorXf>(queries.row(first + i).data(), sift_size).squaredNorm();
        each_product_row(
            words, queries, first, height, columns, dots, product,
            [&](std::size_t i, std::size_t left, const float* lengths, const float* dot, std::size_t width) {
                // in strips, so that the compiler compares many at once
                constexpr std::size_t strip = 16;
                for (std::size_t j = 0; j < width; j += strip) {
                    const std::size_t end = std::min(width, j + strip);
                    int any = 0;
                    for (std::size_t k = j; k < end; ++k)
                        any |= square[i] + lengths[k] - 2 * dot[k] <= threshold;
                    if (!any) continue;
                    for (std::size_t k = j; k < end; ++k)
                        if (square[i] + lengths[k] - 2 * dot[k] <= threshold)
                            hits.emplace_back(first + i, left + k);
                }
            });
    }
}

/// The distance to a word as a plain Euclidean one: the words get the root of their variance as a last
/// number, the descriptors 0.
constexpr std::size_t euclidean_size = sift_size + 1;
[[nodiscard]] inline std::vector<float> euclidean(const Words& words) {
    std::vector<float> rows(words.size() * euclidean_size);
    for (std::size_t w = 0; w < words.size(); ++w) {
        double square = 0;
        for (std::size_t k = 0; k < sift_size; ++k) {
            rows[w * euclidean_size + k] = words.means().row(w)[k];
            square += double(words.means().row(w)[k]) * words.means().row(w)[k];
        }
        rows[w * euclidean_size + sift_size] =
            float(std::sqrt(std::max(0.0, double(words.mean_sq_lengths()[w]) - square)));
    }
    return rows;
}
[[nodiscard]] inline std::vector<float> euclidean(const Rows& queries) {
    std::vector<float> rows(queries.size() * euclidean_size, 0);
    for (std::size_t i = 0; i < queries.size(); ++i)
        std::copy_n(queries.row(i).data(), sift_size, rows.data() + i * euclidean_size);
    return rows;
}

/// Dot products of all of some words with all of some queries, `width` for a query.
inline void eigen_product(const float* w, std::size_t width, const float* q, std::size_t height,
                          float* dots) {
    using Columns = Eigen::Map<const Eigen::MatrixXf>;
    Eigen::Map<Eigen::MatrixXf>(dots, Eigen::Index(width), Eigen::Index(height)).noalias() =
        Columns(w, sift_size, Eigen::Index(width)).transpose() * Columns(q, sift_size, Eigen::Index(height));
}

[[nodiscard]] inline SearchPeer eigen_search(const Words& words) {
    return {"Eigen gemm", false, [&words](const Rows& queries, std::vector<Hit>& hits) {
                search_by_products(words, queries, hits, eigen_product);
            }};
}

#ifdef ISM_HAVE_OPENBLAS
inline void openblas_product(const float* w, std::size_t width, const float* q, std::size_t height,
                             float* dots) {
    constexpr int size = int(sift_size);
    cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasTrans, int(height), int(width), size, 1.0f, q, size, w,
                size, 0.0f, dots, int(width));
}

[[nodiscard]] inline SearchPeer openblas_search(const Words& words) {
    return {"OpenBLAS sgemm", false, [&words](const Rows& queries, std::vector<Hit>& hits) {
                openblas_set_num_threads(1);
                search_by_products(words, queries, hits, openblas_product);
            }};
}
#endif

#ifdef ISM_HAVE_FAISS
[[nodiscard]] inline SearchPeer faiss_search(const Words& words) {
    const auto index = std::make_shared<faiss::IndexFlatL2>(faiss::Index::idx_t(euclidean_size));
    index->add(faiss::Index::idx_t(words.size()), euclidean(words).data());
    return {"faiss flat", false,
            [index, threshold = float(words.max_sq_distance())](const Rows& queries, std::vector<Hit>& hits) {
                const std::vector<float> rows = euclidean(queries);
                faiss::RangeSearchResult result(queries.size());
                index->range_search(faiss::Index::idx_t(queries.size()), rows.data(), threshold, &result);
                for (std::size_t i = 0; i < queries.size(); ++i)
                    for (std::size_t k = result.lims[i]; k < result.lims[i + 1]; ++k)
                        hits.emplace_back(i, result.labels[k]);
            }};
}
#endif

#ifdef ISM_HAVE_HNSWLIB
[[nodiscard]] inline SearchPeer hnswlib_search(const Words& words) {
    const auto space = std::make_shared<hnswlib::L2Space>(euclidean_size);
    const auto index =
        std::make_shared<hnswlib::HierarchicalNSW<float>>(space.get(), words.size(), 16, 200, 1);
    const std::vector<float> rows = euclidean(words);
    for (std::size_t w = 0; w < words.size(); ++w) index->addPoint(rows.data() + w * euclidean_size, w);
    index->setEf(256);
    return {"hnswlib, ef 256", true,
            [space, index, threshold = float(words.max_sq_distance())](const Rows& queries,
                                                                       std::vector<Hit>& hits) {
                const std::vector<float> asked = euclidean(queries);
                for (std::size_t i = 0; i < queries.size(); ++i)
                    for (auto near = index->searchKnn(asked.data() + i * euclidean_size, 256); !near.empty();
                         near.pop())
                        if (near.top().first <= threshold) hits.emplace_back(i, near.top().second);
            }};
}
#endif

#ifdef ISM_HAVE_FLANN
[[nodiscard]] inline SearchPeer flann_search(const Words& words) {
    using Index = flann::Index<flann::L2<float>>;
    const auto rows = std::make_shared<std::vector<float>>(euclidean(words));
    const auto index = std::make_shared<Index>(
        flann::Matrix<float>(rows->data(), words.size(), euclidean_size), flann::KDTreeIndexParams(4));
    index->buildIndex();
    return {"FLANN, 4 trees, 256 checks", true,
            [rows, index, threshold = float(words.max_sq_distance())](const Rows& queries,
                                                                      std::vector<Hit>& hits) {
                std::vector<float> asked = euclidean(queries);
                std::vector<std::vector<int>> found;
                std::vector<std::vector<float>> distances;
                flann::SearchParams search(256);
                search.max_neighbors = -1;
                index->radiusSearch(flann::Matrix<float>(asked.data(), queries.size(), euclidean_size), found,
                                    distances, threshold, search);
                for (std::size_t i = 0; i < found.size(); ++i)
                    for (const int w : found[i]) hits.emplace_back(i, w);
            }};
}
#endif

/// The words as nanoflann wants them.
struct NanoflannWords {
    std::vector<float> rows;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return rows.size() / euclidean_size; }
    [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t k) const {
        return rows[i * euclidean_size + k];
    }
    template <class Box>
    [[nodiscard]] bool kdtree_get_bbox(Box& /*box*/) const {
        return false;
    }
};

[[nodiscard]] inline SearchPeer nanoflann_search(const Words& words) {
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Adaptor<float, NanoflannWords>,
                                                     NanoflannWords, int(euclidean_size)>;
    const auto points = std::make_shared<NanoflannWords>(NanoflannWords{euclidean(words)});
    const auto tree = std::make_shared<Tree>(int(euclidean_size), *points);
    tree->buildIndex();
    return {"nanoflann", true,
            [points, tree, threshold = float(words.max_sq_distance())](const Rows& queries,
                                                                       std::vector<Hit>& hits) {
                const std::vector<float> asked = euclidean(queries);
                for (std::size_t i = 0; i < queries.size(); ++i) {
#if NANOFLANN_VERSION >= 0x150
                    std::vector<nanoflann::ResultItem<std::uint32_t, float>> found;
                    nanoflann::SearchParameters search;
#else
                    std::vector<std::pair<std::uint32_t, float>> found;
                    nanoflann::SearchParams search;
#endif
                    search.sorted = false;
                    tree->radiusSearch(asked.data() + i * euclidean_size, threshold, found, search);
                    for (const auto& near : found) hits.emplace_back(i, near.first);
                }
            }};
}

/// @brief All peers there are, made ready for a codebook that must outlive them.
[[nodiscard]] inline std::vector<SearchPeer> search_peers(const Words& words, bool slow_too) {
    std::vector<SearchPeer> peers;
#ifdef ISM_HAVE_OPENBLAS
    peers.push_back(openblas_search(words));
#endif
    peers.push_back(eigen_search(words));
#ifdef ISM_HAVE_FAISS
    peers.push_back(faiss_search(words));
#endif
    if (!slow_too) return peers;
#ifdef ISM_HAVE_HNSWLIB
    peers.push_back(hnswlib_search(words));
#endif
#ifdef ISM_HAVE_FLANN
    peers.push_back(flann_search(words));
#endif
    peers.push_back(nanoflann_search(words));
    return peers;
}

}  // namespace bench
