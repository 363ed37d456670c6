// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/toys.hpp"

#include <array>

#include "toy/car.hpp"
#include "toy/duck.hpp"
#include "toy/mug.hpp"
#include "toy/noise.hpp"
#include "toy/robot.hpp"

#include "ism/core/error.hpp"
#include "ism/core/random.hpp"

namespace toy {

std::vector<std::string> class_names() {
    return {"car", "mug", "duck", "robot"};
}

double largest_turn_deg(std::size_t class_index) {
    static constexpr std::array<double, 4> turns{20, 30, 22, 20};
    return turns[class_index % turns.size()];
}

Model make_toy(std::size_t class_index, int instance, std::uint64_t seed) {
    ism::expect(class_index < class_names().size(), "toy class index",
                ism::lazy_text("below ", class_names().size()), class_index);
    ism::expect(instance >= 0, "toy instance", "0 or more", instance);
    const std::uint64_t own = derived_seed(derived_seed(seed, 17 + class_index), std::uint64_t(instance));
    switch (class_index) {
        case 0:
            return make_car(instance, own);
        case 1:
            return make_mug(instance, own);
        case 2:
            return make_duck(instance, own);
        default:
            return make_robot(instance, own);
    }
}

}  // namespace toy
