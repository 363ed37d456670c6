// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <tuple>

#include "support/catch.hpp"
#include "support/skipped.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/harris_laplace.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"

// The sanitizers bring an operator new of their own.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)  // clang
#define ISM_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define ISM_SANITIZED
#endif
#ifndef ISM_SANITIZED
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"  // new and delete are both replaced here

namespace {
std::atomic<std::size_t> allocations = 0, allocated_bytes = 0;
}

void* operator new(std::size_t size) {
    ++allocations, allocated_bytes += size;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    ++allocations, allocated_bytes += size;
    const auto step = static_cast<std::size_t>(alignment);
    if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

TEMPLATE_TEST_CASE("after the first frames of a size nothing is allocated", "", ism::DifferenceOfGaussians,
                   ism::HessianLaplace, ism::HarrisLaplace) {
    ism::Random random(2);
    ism::Image<std::uint8_t> image(320, 240);
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x)
            image(x, y) = std::uint8_t(128 + ((x / 17 + y / 23) % 2 == 0 ? 40 : -40) + random.uniform(-9, 9));
    const std::size_t all_at_once = ism::default_space_bytes, in_bands = 1 << 20;
    for (const unsigned threads : {1u, 2u})
        for (const auto& [upsampling, space_bytes, region] :
             {std::tuple{1.0, all_at_once, std::optional<ism::Region>{}},
              {1.5, all_at_once, ism::Region{33, 20, 250, 190}},
              {1.5, in_bands, ism::Region{33, 20, 250, 190}}}) {
            CAPTURE(threads, upsampling, space_bytes, region.has_value());
            ism::Extractor<TestType, ism::RootSift> settings;
            settings.options = {.upsampling = upsampling, .oriented = true, .max_features = 300};
            ism::FeatureExtractor<TestType, ism::RootSift> extractor(settings, threads, space_bytes);
            std::size_t found = 0;
            for (int frame = 0; frame < 3; ++frame)
                found = extractor.extract(image.view(), region).features.size();
            // which worker finds how many features is open: lists may still grow where there are two
            std::size_t least = SIZE_MAX;
            for (int frame = 0; frame < 10 && least > 0; ++frame) {
                const std::size_t before = allocations;
                (void)extractor.extract(image.view(), region);
                least = std::min<std::size_t>(least, allocations - before);
            }
            CHECK(found > 100);
            CHECK(least == 0);
        }
}

TEST_CASE("a large image in bands takes a small part of the memory") {
    ism::Random random(4);
    ism::GrayImage image(300, 3000);
    for (float& value : image.pixels()) value = float(random.uniform(0.4, 0.6));
    const auto bytes_of = [&](std::size_t space_bytes) {
        const std::size_t before = allocated_bytes;
        ism::FeatureExtractor<ism::DifferenceOfGaussians, ism::RootSift> extractor({}, 1, space_bytes);
        const std::size_t features = extractor.extract(image.view()).features.size();
        CHECK(features > 100);
        return double(allocated_bytes - before) - double(features * 128 * sizeof(float));
    };
    const double whole = bytes_of(ism::default_space_bytes), bands = bytes_of(16 << 20);
    CAPTURE(whole, bands);
    CHECK(whole > 900000.0 * 150);
    CHECK(bands < 0.4 * whole);
}

#else

TEST_CASE("after the first frames of a size nothing is allocated (not with sanitizers)") {
    WARN("skipped: the sanitizer brings an operator new of its own, so allocations are not counted");
    ++ism::test::skipped_tests();
}

#endif
