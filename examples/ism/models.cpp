// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "models.hpp"

#include "input.hpp"

#include "ism/model_file/model_file.hpp"

namespace program {

namespace {

template <class M>
struct Parts;
template <class D, class Desc>
struct Parts<ism::Model<D, Desc>> {
    static bool named(std::string_view detector, std::string_view descriptor) {
        return D::name == detector && Desc::name == descriptor;
    }
    static AnyModel learn(const Lessons& lessons) { return program::learn<D, Desc>(lessons); }
    static AnyModel load(const std::filesystem::path& path) { return program::load<D, Desc>(path); }
};

/// Calls make(Parts) of the model with these names, the first that fits.
template <std::size_t I = 0, class Make>
AnyModel make_named(std::string_view detector, std::string_view descriptor, const std::string& place,
                    const Make& make) {
    if constexpr (I == std::variant_size_v<AnyModel>) {
        throw ism::FileError(ism::join_text(place, ": expected detector ", list_text(detector_names),
                                            " and descriptor ", list_text(descriptor_names), ", got ",
                                            detector, " and ", descriptor));
    } else {
        using P = Parts<std::variant_alternative_t<I, AnyModel>>;
        if (P::named(detector, descriptor)) return make(P{});
        return make_named<I + 1>(detector, descriptor, place, make);
    }
}

}  // namespace

AnyModel learn_any(std::string_view detector, std::string_view descriptor, const Lessons& lessons) {
    return make_named(detector, descriptor, "model to train", [&](auto part) { return part.learn(lessons); });
}

AnyModel load_any(const std::filesystem::path& path) {
    const ism::ModelInfo info = ism::read_model_info(path);
    return make_named(info.detector, info.descriptor, ism::file_text(path),
                      [&](auto part) { return part.load(path); });
}

}  // namespace program
