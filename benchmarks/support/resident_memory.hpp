// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace bench {

/// @brief How many MiB of memory a call takes at its worst, beyond what is taken before; nothing where the
/// system does not tell (Linux does).
[[nodiscard]] inline std::optional<double> peak_mib(const std::function<void()>& call) {
    const auto status = [](const std::string& name) -> std::optional<double> {
        std::ifstream file("/proc/self/status");
        for (std::string line; std::getline(file, line);)
            if (line.rfind(name + ":", 0) == 0) return std::stod(line.substr(name.size() + 1)) / 1024;
        return std::nullopt;
    };
#if defined(__GLIBC__)
    malloc_trim(0);  // what was freed before is not to serve this call unseen
#endif
    if (!(std::ofstream("/proc/self/clear_refs") << "5" << std::flush)) return std::nullopt;
    const auto before = status("VmRSS");
    call();
    const auto most = status("VmHWM");
    if (!before || !most) return std::nullopt;
    return std::max(0.0, *most - *before);
}

}  // namespace bench
