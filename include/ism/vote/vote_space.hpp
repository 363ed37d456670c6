// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "ism/vote/axes.hpp"

namespace ism {

/// @brief What is told of a continuous axis once the types are gone.
struct AxisInfo {
    std::string_view name, unit;
    double bandwidth = 0;
    BandwidthScaling bandwidth_scaling = BandwidthScaling::none;
};

/// @brief A vote space: a list of axes, of which at most one is discrete. Its dimension, the number of
/// continuous axes, is known to the compiler.
template <Axis... Axes>
class VoteSpace {
public:
    static constexpr std::size_t dimension = (std::size_t(ContinuousAxis<Axes>) + ... + 0);
    static constexpr bool has_label = (DiscreteAxis<Axes> || ...);
    static_assert(dimension > 0, "a vote space has at least one continuous axis");
    static_assert(dimension + std::size_t(has_label) == sizeof...(Axes),
                  "a vote space has at most one discrete axis");

    using Position = std::array<float, dimension>;

    /// @brief Whether a feature without depth casts no vote here.
    static constexpr bool needs_depth = [] {
        bool needs = false;
        auto add = [&]<class A>(std::type_identity<A>) {
            if constexpr (ContinuousAxis<A>) needs = needs || A::needs_depth;
        };
        (add(std::type_identity<Axes>{}), ...);
        return needs;
    }();

    /// @brief Whether an axis asks where the object would lie in space (VoteSource::pose): only features with
    /// a local frame vote here.
    static constexpr bool needs_pose = [] {
        bool needs = false;
        auto add = [&]<class A>(std::type_identity<A>) {
            if constexpr (requires { A::needs_pose; }) needs = needs || A::needs_pose;
        };
        (add(std::type_identity<Axes>{}), ...);
        return needs;
    }();

    /// @brief The continuous axes in order.
    [[nodiscard]] static constexpr std::array<AxisInfo, dimension> axes() {
        std::array<AxisInfo, dimension> infos;
        std::size_t k = 0;
        auto add = [&]<class A>(std::type_identity<A>) {
            if constexpr (ContinuousAxis<A>)
                infos[k++] = {A::name, A::unit, A::bandwidth, A::bandwidth_scaling};
        };
        (add(std::type_identity<Axes>{}), ...);
        return infos;
    }

    /// @brief Where in this space a feature votes through an occurrence.
    [[nodiscard]] static Position position(const VoteSource& source) {
        Position at;
        std::size_t k = 0;
        auto add = [&]<class A>(std::type_identity<A>) {
            if constexpr (ContinuousAxis<A>) at[k++] = static_cast<float>(A::vote(source));
        };
        (add(std::type_identity<Axes>{}), ...);
        return at;
    }

    /// @brief The discrete coordinate; 0 for all votes where there is none.
    [[nodiscard]] static std::uint32_t label(const VoteSource& source) {
        std::uint32_t value = 0;
        auto add = [&]<class A>(std::type_identity<A>) {
            if constexpr (!ContinuousAxis<A>) value = A::label(source);
        };
        (add(std::type_identity<Axes>{}), ...);
        return value;
    }
};

namespace detail {
template <class>
inline constexpr bool is_vote_space = false;
template <class... Axes>
inline constexpr bool is_vote_space<VoteSpace<Axes...>> = true;
}  // namespace detail

/// @brief A VoteSpace of any axes.
template <class S>
concept VoteSpaceType = detail::is_vote_space<S>;

/// @brief A vote space for which an image alone is enough: it needs neither depth nor poses.
template <class S>
concept ImageVoteSpace = VoteSpaceType<S> && !S::needs_depth && !S::needs_pose;

using Ism = VoteSpace<X, Y, Scale>;                   ///< Eq 2; classes, if several, are pooled
using Jism = VoteSpace<X, Y, Scale, Class>;           ///< Eq 5
using Ji3sm1 = VoteSpace<X, Y, Scale, Depth, Class>;  ///< Eq 6
using Ji3sm2 = VoteSpace<X, Y, Depth, Class>;         ///< Eq 7
using Ji3sm3 = VoteSpace<X, Y, ScaledDepth, Class>;   ///< Eq 8

}  // namespace ism
