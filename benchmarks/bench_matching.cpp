// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Time of matching 960 descriptors by number of words and by vector isa, one thread; and of making an index.
#include <cmath>
#include <cstddef>
#include <string>

#include "support/catch.hpp"

#include "ism/codebook/match.hpp"
#include "ism/core/random.hpp"

namespace {

/// Rows of length 1 with few large numbers, somewhat as SIFT has them (synthetic).
ism::Descriptors<float> random_rows(std::size_t count, ism::Random& random) {
    ism::Descriptors<float> rows(128, count);
    for (std::size_t i = 0; i < count; ++i) {
        double sq_length = 0;
        for (float& v : rows.row(i)) {
            v = float(std::exp(1.2 * random.normal()));
            sq_length += double(v) * v;
        }
        for (float& v : rows.row(i)) v = float(v / std::sqrt(sq_length));
    }
    return rows;
}

}  // namespace

TEST_CASE("matching by number of words", "[benchmark]") {
    ism::Random random(1);
    const auto descriptors = random_rows(960, random);
    ism::ThreadPool pool(1);
    for (const std::size_t size : {1000u, 7000u, 50000u}) {
        ism::Codebook codebook(128, 0.36);
        const auto means = random_rows(size, random);
        for (std::size_t i = 0; i < size; ++i)
            codebook.push_back({.mean = means.row(i), .mean_sq_length = 1});
        const std::string words = ism::join_text(", ", size, " words");
        const auto bench = [&](const std::string& name, ism::InstructionSet isa) {
            if (!ism::has_instruction_set(isa)) return;
            const ism::WordIndex index(codebook, isa);
            BENCHMARK(name + words) {
                return ism::match(index, descriptors, pool).size();
            };
        };
        bench("any isa", ism::InstructionSet::any);
        bench("AVX2", ism::InstructionSet::avx2);
        bench("AVX-512 VNNI", ism::InstructionSet::avx512_vnni);
        BENCHMARK("making the index" + words) {
            return ism::WordIndex(codebook).size();
        };
    }
}
