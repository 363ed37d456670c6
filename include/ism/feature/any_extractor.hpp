// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>

#include "ism/core/frame.hpp"
#include "ism/core/function.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/feature_settings.hpp"

namespace ism {

/// @brief Finds and describes the features of one frame after another, with the same memory: the result
/// stays until the next call.
using ExtractFeatures = Function<const FeatureSet<float>&(const Frame&)>;

namespace detail {

/// Descriptors of any scalar as floats.
template <Detector D, Descriptor Desc>
struct FloatFeatures {
    FloatFeatures(const Extractor<D, Desc>& features, ThreadPool& pool) : extractor(features, pool) {}

    FeatureExtractor<D, Desc> extractor;
    FeatureSet<float> floats = {};  // where descriptors are no floats

    const FeatureSet<float>& operator()(const Frame& frame) {
        const auto& found = extractor.extract(frame.gray.view());
        if constexpr (std::same_as<typename Desc::Scalar, float>) {
            return found;
        } else {
            floats.features = found.features;
            floats.descriptors = Descriptors<float>(Desc::dimension, found.features.size());
            std::copy(found.descriptors.values().begin(), found.descriptors.values().end(),
                      floats.descriptors.values().begin());
            return floats;
        }
    }
};

}  // namespace detail

/// @brief An extractor whose types are no longer seen: all that comes after the features is compiled once,
/// whatever the detector and descriptor.
class AnyExtractor {
public:
    template <Detector D, Descriptor Desc>
    AnyExtractor(const Extractor<D, Desc>& extractor) : AnyExtractor(extractor, settings_of(extractor)) {}
    /// @brief The same where its settings are known, as those of a model are.
    /// @param settings  as settings_of(extractor) gives them
    template <Detector D, Descriptor Desc>
    AnyExtractor(const Extractor<D, Desc>& extractor, const FeatureSettings& settings)
        : settings_(settings),
          start_([extractor](const ExtractOptions& options, ThreadPool& pool) -> ExtractFeatures {
              return ExtractFeatures::make<detail::FloatFeatures<D, Desc>>(
                  Extractor<D, Desc>{extractor.detector, extractor.descriptor, options}, pool);
          }) {}

    [[nodiscard]] const FeatureSettings& settings() const { return settings_; }
    /// @brief What is done around detector and descriptor; may be changed.
    [[nodiscard]] ExtractOptions& options() { return settings_.options; }

    /// @brief Makes ready for frame after frame.
    /// @param pool  that works on a frame; it has to stay as long as the result
    [[nodiscard]] ExtractFeatures start(ThreadPool& pool) const { return start_(settings_.options, pool); }

private:
    FeatureSettings settings_;
    Function<ExtractFeatures(const ExtractOptions&, ThreadPool&)> start_;
};

}  // namespace ism
