// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "ism/core/processor.hpp"

namespace bench {

/// @brief Adds --isa, the instruction set of our kernels.
inline void add_isa_option(CLI::App& app, ism::InstructionSet& isa) {
    app.add_option("--isa", isa, "instruction set of ours; without, the best there is")
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, ism::InstructionSet>{{"any", ism::InstructionSet::any},
                                                       {"avx2", ism::InstructionSet::avx2},
                                                       {"avx512_vnni", ism::InstructionSet::avx512_vnni}}));
}

}  // namespace bench
