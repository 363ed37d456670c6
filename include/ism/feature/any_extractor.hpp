// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <utility>

#include "ism/core/frame.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/feature_settings.hpp"

namespace ism {

/// @brief Finds and describes the features of one frame after another, with the same memory: the result
/// stays until the next call.
using ExtractFeatures = std::function<const FeatureSet<float>&(const Frame&)>;

/// @brief An extractor whose types are no longer seen: all that comes after the features is compiled once,
/// whatever the detector and descriptor.
class AnyExtractor {
public:
    template <Detector D, Descriptor Desc>
    AnyExtractor(const Extractor<D, Desc>& extractor)
        : settings_(settings_of(extractor)),
          start_([extractor](const ExtractOptions& options, ThreadPool& pool) {
              Extractor<D, Desc> own = extractor;
              own.options = options;
              return started(std::move(own), pool);
          }) {}

    [[nodiscard]] const FeatureSettings& settings() const { return settings_; }
    /// @brief What is done around detector and descriptor; may be changed.
    [[nodiscard]] ExtractOptions& options() { return settings_.options; }

    /// @brief Makes ready for frame after frame.
    /// @param pool  that works on a frame; it has to stay as long as the result
    [[nodiscard]] ExtractFeatures start(ThreadPool& pool) const { return start_(settings_.options, pool); }

private:
    template <Detector D, Descriptor Desc>
    [[nodiscard]] static ExtractFeatures started(Extractor<D, Desc> extractor, ThreadPool& pool) {
        const auto features = std::make_shared<FeatureExtractor<D, Desc>>(std::move(extractor), pool);
        if constexpr (std::same_as<typename Desc::Scalar, float>) {
            return [features](const Frame& frame) -> const FeatureSet<float>& {
                return features->extract(frame.gray.view());
            };
        } else {
            const auto floats = std::make_shared<FeatureSet<float>>();
            return [features, floats](const Frame& frame) -> const FeatureSet<float>& {
                const auto& found = features->extract(frame.gray.view());
                floats->features = found.features;
                floats->descriptors = Descriptors<float>(Desc::dimension, found.features.size());
                std::copy(found.descriptors.values().begin(), found.descriptors.values().end(),
                          floats->descriptors.values().begin());
                return *floats;
            };
        }
    }

    FeatureSettings settings_;
    std::function<ExtractFeatures(const ExtractOptions&, ThreadPool&)> start_;
};

}  // namespace ism
