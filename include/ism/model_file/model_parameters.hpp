// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "ism/feature/extract.hpp"
#include "ism/io/json.hpp"

namespace ism {

namespace detail {

/// Stands for any visitor where a concept asks for one.
struct ParameterVisitor {
    template <class T>
    void operator()(const char*, T&) const {}
};

}  // namespace detail

/// @brief A detector or descriptor whose options can be kept in files: `static void each_parameter(self,
/// visit)` calls visit(name, value) for each. Of others nothing is kept, and loading gives their defaults.
template <class T>
concept HasParameters = requires(T& self) {
    T::each_parameter(self, detail::ParameterVisitor{});
};

namespace detail {

/// Visits all options of extraction. The lists of names are whole: an option that is added to the structs
/// does not compile here until it is kept too.
template <class Visit>
void each_extract_parameter(ExtractOptions& options, Visit&& visit) {
    auto& [scale_space, upsampling, oriented, max_features] = options;
    auto& [levels, base_sigma, input_sigma, doubled, max_octaves, smallest_side] = scale_space;
    visit("upsampling", upsampling);
    visit("oriented", oriented);
    visit("max_features", max_features);
    visit("levels_per_octave", levels);
    visit("base_sigma", base_sigma);
    visit("input_sigma", input_sigma);
    visit("double_first_octave", doubled);
    visit("max_octaves", max_octaves);
    visit("smallest_side", smallest_side);
}

/// Writes options as members of a JSON object.
class WriteParameter {
public:
    WriteParameter(Json& target, const std::string& where) : object(target), place(where) {}

    template <class T>
    requires std::integral<T> || std::floating_point<T>
    void operator()(const char* name, const T& value) const {
        if constexpr (std::floating_point<T>) {
            expect<FileError>(std::isfinite(value), lazy_text(place, ": ", name), "a finite number", value);
            object[name] = readable(value);
        } else {
            object[name] = value;
        }
    }

private:
    Json& object;
    const std::string& place;

    /// The number with the fewest digits that becomes `value` again: 0.1 and not 0.100000001490116.
    template <std::floating_point T>
    [[nodiscard]] static double readable(T value) {
        std::array<char, 64> digits;
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
        double short_value = 0;
        std::from_chars(digits.data(), end, short_value);
        return static_cast<T>(short_value) == value ? short_value : double(value);
    }
};

/// Reads options from members of a JSON object.
struct ReadParameter {
    const Json& object;
    const std::string& place;
    std::size_t& count;

    template <class T>
    requires std::integral<T> || std::floating_point<T>
    void operator()(const char* name, T& value) const {
        const Json& found = member(object, name, place);
        if constexpr (std::same_as<T, bool>) {
            if (!found.is_boolean()) refuse_json(place, name, "true or false", json_text(found));
            value = found.get<bool>();
        } else if constexpr (std::integral<T>) {
            const std::int64_t number = to_integer(found, name, place);
            if (!std::in_range<T>(number)) refuse_json(place, name, "a number of its kind", json_text(found));
            value = static_cast<T>(number);
        } else {
            const double number = to_number(found, name, place);
            if (std::abs(number) > double(std::numeric_limits<T>::max()))
                refuse_json(place, name, "a number of its kind", json_text(found));
            value = static_cast<T>(number);
        }
        ++count;
    }
};

/// Calls `read` with a visitor that reads every member of the object; members nobody asks for are refused.
template <std::invocable<const ReadParameter&> Read>
void read_parameters(const Json& object, const std::string& place, Read&& read) {
    std::size_t count = 0;
    read(ReadParameter{object, place, count});
    expect<FileError>(object.is_object() && object.size() == count,
                      lazy_text(place, ": number of parameters"), count, object.size());
}

/// The options of a detector or descriptor as a JSON object.
template <class T>
[[nodiscard]] Json parameters_to_json(const T& part, const std::string& place) {
    Json object = Json::object();
    if constexpr (HasParameters<const T>) T::each_parameter(part, WriteParameter{object, place});
    return object;
}

/// Reads what parameters_to_json() wrote.
template <class T>
void parameters_from_json(const Json& object, const std::string& place, T& part) {
    read_parameters(object, place, [&](const ReadParameter& read) {
        if constexpr (HasParameters<T>) T::each_parameter(part, read);
    });
}

}  // namespace detail

}  // namespace ism
