// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/core/rotation.hpp"

namespace {

bool near(ism::Vec3f a, ism::Vec3f b) {
    return length(a - b) < 2e-6f * (1 + length(a));
}

ism::Rotation any_rotation(ism::Random& random) {
    return normalized(ism::Rotation{float(random.normal()), float(random.normal()), float(random.normal()),
                                    float(random.normal())});
}

}  // namespace

TEST_CASE("vectors: products, lengths and directions") {
    const ism::Vec3f a{1, 2, 3}, b{-2, 0.5f, 4};
    CHECK(dot(a, b) == 11);
    CHECK(ism::cross({1, 0, 0}, {0, 1, 0}) == ism::Vec3f{0, 0, 1});
    CHECK(dot(cross(a, b), a) == 0);
    CHECK(length(ism::Vec3f{2, 3, 6}) == 7);
    CHECK(a + b - b == a);
    CHECK(2 * a == ism::Vec3f{2, 4, 6});
    CHECK(near(7 * normalized(ism::Vec3f{2, 3, 6}), {2, 3, 6}));
    CHECK(normalized(ism::Vec3f{}) == ism::Vec3f{});
    CHECK(to_vec3f(to_point3(b)) == b);
}

TEST_CASE("a rotation around an axis is right-handed") {
    const ism::Rotation quarter = ism::rotation_around({0, 0, 5}, std::numbers::pi / 2);
    CHECK(near(rotate(quarter, {1, 0, 0}), {0, 1, 0}));
    CHECK(near(rotate(quarter, {0, 1, 0}), {-1, 0, 0}));
    CHECK(near(rotate(quarter, {0, 0, 1}), {0, 0, 1}));
    CHECK(near(rotate(ism::Rotation{}, {1, 2, 3}), {1, 2, 3}));
}

TEST_CASE("rotations: products, inverses, columns and back") {
    ism::Random random(5);
    for (int round = 0; round < 200; ++round) {
        const ism::Rotation a = any_rotation(random), b = any_rotation(random);
        const ism::Vec3f v{float(random.normal()), float(random.normal()), float(random.normal())};
        CHECK(near(rotate(a * b, v), rotate(a, rotate(b, v))));
        CHECK(near(rotate(inverse(a), rotate(a, v)), v));
        const auto [x, y, z] = columns(a);
        CHECK(near(cross(x, y), z));
        CHECK(near(v.x * x + v.y * y + v.z * z, rotate(a, v)));
        CHECK(near(rotate(ism::rotation_of_columns(x, y, z), v), rotate(a, v)));
    }
}

TEST_CASE("columns of half turns, where a quaternion's w is 0, become rotations") {
    for (const ism::Vec3f axis : {ism::Vec3f{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {-1, 2, 3}}) {
        const ism::Rotation half = ism::rotation_around(axis, std::numbers::pi);
        const auto [x, y, z] = columns(half);
        const ism::Rotation again = ism::rotation_of_columns(x, y, z);
        for (const ism::Vec3f v : {ism::Vec3f{1, 2, 3}, {-3, 1, 0.5f}})
            CHECK(near(rotate(again, v), rotate(half, v)));
    }
}
