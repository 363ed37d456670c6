// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "commands.hpp"
#include "input.hpp"

#include "ism/model_file/model_file.hpp"

namespace program {

void run_info(const std::filesystem::path& model) {
    const ism::ModelInfo info = ism::read_model_info(model);
    std::printf("format          ism model, version %lld\n", static_cast<long long>(info.format_version));
    std::printf("detector        %s\n", info.detector.c_str());
    std::printf("descriptor      %s, %zu x %s\n", info.descriptor.c_str(), info.dimension,
                info.scalar.c_str());
    std::printf("classes         %s\n", list_text(info.class_names).c_str());
    std::printf("objects         %zu\n", info.objects);
    std::printf("words           %zu\n", info.words);
    std::printf("occurrences     %zu\n", info.occurrences);
    std::printf("upsampling      %g\n", info.upsampling);
    std::printf("match within    %g (squared distance)\n", info.max_sq_distance);
    std::printf("reference size  %g px\n", info.reference_size_px);
    std::printf("parameters      %s\n", info.parameters.c_str());
}

}  // namespace program
