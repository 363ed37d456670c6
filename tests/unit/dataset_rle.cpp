// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/core/geometry.hpp"
#include "ism/core/random.hpp"
#include "ism/dataset/rle.hpp"

using ism::CompressedRle;
using ism::Mask;
using ism::Random;
using ism::Rle;
using ism::test::error_message;

namespace {

// The pixels one by one, down the columns.
Rle naive_rle(const Mask& mask) {
    std::vector<bool> column_major;
    for (int x = 0; x < mask.width(); ++x)
        for (int y = 0; y < mask.height(); ++y) column_major.push_back(mask(x, y) != 0);
    Rle rle{mask.width(), mask.height(), {0}};
    bool value = false;
    for (const bool pixel : column_major) {
        if (pixel != value) rle.counts.push_back(0);
        value = pixel;
        ++rle.counts.back();
    }
    return rle;
}

Mask random_mask(Random& random) {
    Mask mask(1 + int(random.index(40)), 1 + int(random.index(40)));
    const double stay = random.uniform();  // long runs and short ones
    std::uint8_t value = random.uniform() < 0.5;
    for (std::uint8_t& pixel : mask.pixels()) {
        if (random.uniform() > stay) value = std::uint8_t(1 - value);
        pixel = value;
    }
    return mask;
}

}  // namespace

TEST_CASE("Run lengths agree with a count pixel by pixel, and masks come back whole") {
    Random random(1);
    for (int round = 0; round < 500; ++round) {
        const Mask mask = random_mask(random);
        const Rle rle = ism::encode_rle(mask);
        REQUIRE(rle == naive_rle(mask));
        REQUIRE(ism::decode_rle(rle) == mask);
        const CompressedRle packed = ism::compress(rle);
        REQUIRE(ism::decompress(packed) == rle);
        REQUIRE(ism::decompress_mask(ism::compress_mask(mask)) == mask);
    }
}

TEST_CASE("Run lengths are packed as COCO says") {
    // By hand: 100 = 4 + 3·32; 200 = 8 + 6·32; 600 = 24 + 18·32, and a 0 as 18 looks negative in 5 bits;
    // the fourth is the difference 124 - 200 = -76 = 20 - 3·32.
    CHECK(ism::compress({32, 32, {100, 200, 600, 124}}).counts == "T3X6hb0dM");
    CHECK(ism::decompress({32, 32, "T3X6hb0dM"}).counts == std::vector<std::uint32_t>{100, 200, 600, 124});
    CHECK(ism::compress({3, 3, {0, 9}}).counts == "09");
}

TEST_CASE("Run lengths go down the columns and begin with ground") {
    const Mask mask = ism::decode_rle({3, 2, {1, 2, 3}});
    CHECK(mask == Mask(3, 2, std::vector<std::uint8_t>{0, 1, 0, 1, 0, 0}));
}

TEST_CASE("Every value but 0 is figure") {
    CHECK(ism::encode_rle(Mask(3, 2, std::vector<std::uint8_t>{0, 255, 1, 2, 0, 1})).counts ==
          std::vector<std::uint32_t>{1, 2, 1, 2});
}

TEST_CASE("A run may be as long as the largest mask") {
    const Rle rle{16384, 8192, {134217728}};
    CHECK(ism::decompress(ism::compress(rle)) == rle);
    const Rle longer{16384, 8192, {134217729}};
    CHECK(error_message([&] { (void)ism::decompress(ism::compress(longer)); }) ==
          "packed run lengths: expected runs of 0 to 134217728, got 134217729");
}

TEST_CASE("Run lengths far apart survive packing") {
    const Rle rle{4096, 4096, {0, 16000000, 1, 3, 0, 0, 777212}};
    CHECK(ism::decompress(ism::compress(rle)) == rle);
    CHECK(ism::mask_area(ism::decode_rle(rle)) == 16000003);
}

TEST_CASE("Run lengths that do not fit the mask are refused") {
    CHECK(error_message([] {
              (void)ism::decode_rle({4, 3, {5, 6}});
          }) == "run lengths of a 4x3 mask: expected a sum of 12, got 11");
    CHECK(error_message([] {
              (void)ism::decode_rle({4, 3, {}});
          }) == "run lengths of a 4x3 mask: expected a sum of 12, got 0");
    CHECK(error_message([] {
              (void)ism::decode_rle({4, 3, {4294967295u, 4294967295u, 14}});
          }) == "run lengths of a 4x3 mask: expected a sum of 12, got 8589934604");
    CHECK(error_message([] {
              (void)ism::decode_rle({0, 3, {}});
          }) == "mask size: expected 1 to 134217728 pixels, sides up to 1048576, got 0x3");
    CHECK(error_message([] {
              (void)ism::decode_rle({1000000, 1000000, {}});
          }) == "mask size: expected 1 to 134217728 pixels, sides up to 1048576, got 1000000x1000000");
    CHECK(error_message([] { (void)ism::encode_rle(Mask()); }) ==
          "mask size: expected 1 to 134217728 pixels, sides up to 1048576, got 0x0");
}

TEST_CASE("Packed run lengths that are none are refused") {
    const std::string good = ism::compress({30, 30, {100, 200, 600}}).counts;
    CHECK(ism::decompress({30, 30, good}).counts == std::vector<std::uint32_t>{100, 200, 600});
    CHECK(error_message([&] {
              (void)ism::decompress({30, 30, good.substr(0, good.size() - 1)});
          }) == "packed run lengths: expected a whole last number, got a part of it");
    CHECK(error_message([&] {
              (void)ism::decompress({30, 30, "!" + good});
          }) ==
          "packed run lengths: expected numbers in the characters '0' to 'o', got character 33 at place 0");
    CHECK(error_message([&] {
              (void)ism::decompress({30, 30, std::string(20, 'o')});
          }) ==
          "packed run lengths: expected numbers in the characters '0' to 'o', got character 111 at place 8");
    CHECK(
        error_message([&] {
            (void)ism::decompress({30, 30, good + "p"});
        }) ==
        ism::join_text("packed run lengths: expected numbers in the characters '0' to 'o', got character 112 "
                       "at place ",
                       good.size()));
    CHECK(error_message([&] {
              (void)ism::decompress({30, 30, "O"});
          }) == "packed run lengths: expected runs of 0 to 134217728, got -1");
    CHECK(error_message([&] {
              (void)ism::decompress({30, 29, good});
          }) == "run lengths of a 30x29 mask: expected a sum of 870, got 900");
}

TEST_CASE("Any text at all is either run lengths or refused") {
    Random random(2);
    int accepted = 0;
    for (int round = 0; round < 20000; ++round) {
        CompressedRle packed{3, 3, std::string(random.index(6), ' ')};
        for (char& c : packed.counts)
            c = char(random.uniform() < 0.9 ? 48 + random.index(64) : random.index(256));
        try {
            const Mask mask = ism::decompress_mask(packed);
            ++accepted;
            REQUIRE(mask.pixels().size() == 9);
        } catch (const ism::Error&) {
        }
    }
    CHECK(accepted > 0);
}
