// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ism/feature/feature_settings.hpp"
#include "ism/io/json.hpp"
#include "ism/io/paths.hpp"

/// How features are found, as JSON.
namespace ism::detail {

/// Visits all options of extraction. The lists of names are whole: an option that is added to the structs
/// does not compile here until it is kept too.
template <class Options, class Visit>
void each_extract_parameter(Options& options, Visit&& visit) {
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

/// The number with the fewest digits that becomes the same float, where it is one: 0.1 and not
/// 0.100000001490116.
[[nodiscard]] inline double shortest(double value) {
    const auto as_float = static_cast<float>(value);
    if (double(as_float) != value) return value;
    std::array<char, 64> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), as_float).ptr;
    double short_value = 0;
    std::from_chars(digits.data(), end, short_value);
    return short_value;
}

[[nodiscard]] inline Json parameters_to_json(const std::vector<Parameter>& parameters,
                                             const std::string& place) {
    Json object = Json::object();
    for (const Parameter& p : parameters) {
        if (p.kind == Parameter::Kind::real) {
            expect<FileError>(std::isfinite(p.real), lazy_text(place, ": ", p.name), "a finite number",
                              p.real);
            object[p.name] = shortest(p.real);
        } else if (p.kind == Parameter::Kind::flag) {
            object[p.name] = p.whole != 0;
        } else {
            object[p.name] = p.whole;
        }
    }
    return object;
}

[[nodiscard]] inline std::vector<Parameter> parameters_from_json(const Json& object,
                                                                 const std::string& place) {
    if (!object.is_object()) throw FileError(place + ": expected an object, got " + json_text(object));
    std::vector<Parameter> parameters;
    for (const auto& [name, value] : object.items()) {
        if (value.is_boolean())
            parameters.push_back({name, Parameter::Kind::flag, value.get<bool>()});
        else if (value.is_number_integer())
            parameters.push_back({name, Parameter::Kind::whole, to_integer(value, name, place)});
        else
            parameters.push_back({name, Parameter::Kind::real, 0, to_number(value, name, place)});
    }
    return parameters;
}

[[nodiscard]] inline Json settings_to_json(const FeatureSettings& settings, const std::string& place) {
    std::vector<Parameter> extraction;
    each_extract_parameter(settings.options, ListParameters{extraction});
    return {{"detector", settings.detector},
            {"descriptor", settings.descriptor},
            {"dimension", settings.dimension},
            {"sq_length", settings.sq_length},
            {"detector_parameters", parameters_to_json(settings.detector_parameters, place)},
            {"descriptor_parameters", parameters_to_json(settings.descriptor_parameters, place)},
            {"extraction", parameters_to_json(extraction, place)}};
}

[[nodiscard]] inline FeatureSettings settings_from_json(const Json& json, const std::string& place) {
    const std::int64_t dimension = integer_member(json, "dimension", place);
    expect<FileError>(dimension >= 1 && dimension <= 65536, lazy_text(place, ": dimension"), "1 ... 65536",
                      dimension);
    FeatureSettings settings{.detector = text_member(json, "detector", place),
                             .descriptor = text_member(json, "descriptor", place),
                             .dimension = static_cast<std::size_t>(dimension),
                             .sq_length = number_member(json, "sq_length", place),
                             .detector_parameters = parameters_from_json(
                                 member(json, "detector_parameters", place), place + ", detector"),
                             .descriptor_parameters = parameters_from_json(
                                 member(json, "descriptor_parameters", place), place + ", descriptor")};
    expect<FileError>(settings.sq_length > 0, lazy_text(place, ": sq_length"), "above 0", settings.sq_length);
    const std::string part = "extraction";
    const auto extraction = parameters_from_json(member(json, "extraction", place), place + ", extraction");
    std::size_t count = 0;
    at_place(place, [&] {
        each_extract_parameter(settings.options, SetParameters{extraction, part, count});
    });
    expect<FileError>(count == extraction.size(), lazy_text(place, ", extraction: number of parameters"),
                      count, extraction.size());
    at_place(place + ", extraction", [&] { check(settings.options); });
    return settings;
}

}  // namespace ism::detail
