// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/feature/extractor.hpp"

namespace ism {

/// @brief An option of a detector or a descriptor by name.
struct Parameter {
    enum class Kind : std::uint8_t { flag, whole, real };
    std::string name;
    Kind kind = Kind::real;
    std::int64_t whole = 0;  ///< of a flag 0 or 1
    double real = 0;
    [[nodiscard]] bool operator==(const Parameter&) const = default;
};

/// @brief How features are found and described, as data: an Extractor whose types are names. Whatever comes
/// after the features needs no more of detector and descriptor than this.
struct FeatureSettings {
    std::string detector, descriptor;  ///< D::name, Desc::name
    std::size_t dimension = 0;         ///< numbers of a descriptor
    double sq_length = 1;              ///< squared length of a typical descriptor, see Descriptor
    std::vector<Parameter> detector_parameters = {}, descriptor_parameters = {};
    ExtractOptions options = {};
};

namespace detail {

/// By name and value, in any order, as floats: files tell 2 and 2.0 alike, and .1 for the float next to it.
[[nodiscard]] inline bool is_same(std::span<const Parameter> a, std::span<const Parameter> b) {
    const auto value = [](const Parameter& one) {
        return one.kind == Parameter::Kind::real ? float(one.real) : float(one.whole);
    };
    return a.size() == b.size() && std::all_of(a.begin(), a.end(), [&](const Parameter& p) {
               return std::any_of(b.begin(), b.end(), [&](const Parameter& q) {
                   return p.name == q.name && value(p) == value(q);
               });
           });
}

}  // namespace detail

/// @brief Whether features are found and described alike, but for how many at most.
[[nodiscard]] inline bool is_same_way(const FeatureSettings& a, const FeatureSettings& b) {
    return a.detector == b.detector && a.descriptor == b.descriptor && a.dimension == b.dimension &&
           detail::is_same(a.detector_parameters, b.detector_parameters) &&
           detail::is_same(a.descriptor_parameters, b.descriptor_parameters) &&
           a.options.scale_space == b.options.scale_space && a.options.upsampling == b.options.upsampling &&
           a.options.oriented == b.options.oriented;
}

namespace detail {

/// Stands for any visitor where a concept asks for one.
struct AnyVisitor {
    template <class T>
    void operator()(const char*, T&) const {}
};

struct ListParameters {
    std::vector<Parameter>& list;

    template <class T>
    requires std::integral<T> || std::floating_point<T>
    void operator()(const char* name, const T& value) const {
        if constexpr (std::same_as<T, bool>)
            list.push_back({name, Parameter::Kind::flag, value});
        else if constexpr (std::integral<T>)
            list.push_back({name, Parameter::Kind::whole, std::int64_t(value)});
        else
            list.push_back({name, Parameter::Kind::real, 0, double(value)});
    }
};

struct SetParameters {
    const std::vector<Parameter>& list;
    const std::string& part;
    std::size_t& count;  // of a visitor that may be copied

    template <class T>
    requires std::integral<T> || std::floating_point<T>
    void operator()(const char* name, T& value) const {
        const bool fits = set(value, next(name));
        expect(fits, lazy_text(part, ": ", name), "a value of its kind", "another");
    }

    /// The parameter of this name, which is counted.
    [[nodiscard]] const Parameter& next(const char* name) const {
        std::size_t i = 0;
        while (i < list.size() && list[i].name != name) ++i;
        expect(i < list.size(), lazy_text(part, ": parameter"), name, "none of this name");
        ++count;
        return list[i];
    }

    /// Whether the parameter fits; a whole number does for a real one too.
    template <class T>
    [[nodiscard]] static bool set(T& value, const Parameter& given) {
        if constexpr (std::same_as<T, bool>) {
            const bool fits = given.kind == Parameter::Kind::flag;
            if (fits) value = given.whole != 0;
            return fits;
        } else if constexpr (std::integral<T>) {
            const bool fits = given.kind == Parameter::Kind::whole && std::in_range<T>(given.whole);
            if (fits) value = static_cast<T>(given.whole);
            return fits;
        } else {
            const double number = given.kind == Parameter::Kind::whole ? double(given.whole) : given.real;
            const bool fits = given.kind != Parameter::Kind::flag &&
                              std::abs(number) <= double(std::numeric_limits<T>::max());
            if (fits) value = static_cast<T>(number);
            return fits;
        }
    }
};

}  // namespace detail

/// @brief A detector or descriptor whose options can be kept as data: it has none (an empty struct), or
/// `static void each_parameter(self, visit)` calls visit(name, member) for each, in a fixed order.
template <class T>
concept HasParameters = std::is_empty_v<T> || requires(T& self) {
    T::each_parameter(self, detail::AnyVisitor{});
};

namespace detail {

template <HasParameters T>
[[nodiscard]] std::vector<Parameter> parameters_of(const T& part) {
    std::vector<Parameter> list;
    if constexpr (!std::is_empty_v<T>) T::each_parameter(part, ListParameters{list});
    return list;
}

template <HasParameters T>
[[nodiscard]] T with_parameters(const std::vector<Parameter>& list, const std::string& name) {
    T part;
    std::size_t count = 0;
    if constexpr (!std::is_empty_v<T>) T::each_parameter(part, SetParameters{list, name, count});
    expect(count == list.size(), lazy_text(name, ": number of parameters"), count, list.size());
    return part;
}

}  // namespace detail

/// @brief An extractor as data.
template <Detector D, Descriptor Desc>
[[nodiscard]] FeatureSettings settings_of(const Extractor<D, Desc>& extractor) {
    static_assert(HasParameters<D>, "a detector with options has a static each_parameter(self, visit)");
    static_assert(HasParameters<Desc>, "a descriptor with options has a static each_parameter(self, visit)");
    return {.detector = std::string(D::name),
            .descriptor = std::string(Desc::name),
            .dimension = Desc::dimension,
            .sq_length = Desc::sq_length,
            .detector_parameters = detail::parameters_of(extractor.detector),
            .descriptor_parameters = detail::parameters_of(extractor.descriptor),
            .options = extractor.options};
}

/// @brief The extractor of these types that settings tell of; the reverse of settings_of().
/// @throws Error where they tell of another detector or descriptor, of other parameters, or of one out of
/// range.
template <Detector D, Descriptor Desc>
[[nodiscard]] Extractor<D, Desc> extractor_from(const FeatureSettings& settings) {
    expect(settings.detector == D::name, "detector", D::name, settings.detector);
    expect(settings.descriptor == Desc::name, "descriptor", Desc::name, settings.descriptor);
    expect(settings.dimension == Desc::dimension, "descriptor dimension", Desc::dimension,
           settings.dimension);
    Extractor<D, Desc> extractor{
        .detector = detail::with_parameters<D>(settings.detector_parameters, settings.detector),
        .descriptor = detail::with_parameters<Desc>(settings.descriptor_parameters, settings.descriptor),
        .options = settings.options};
    check(extractor);
    return extractor;
}

}  // namespace ism
