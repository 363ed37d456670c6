// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// What the library costs a compiler: seconds and memory of a few small programs, each beside what is asked,
// and the processor seconds of building the program ism with the flags of this build.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/options.hpp"
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

struct Cost {
    double seconds = 0, processor_seconds = 0, peak_mib = 0;
    bool succeeded = false;
};

/// Runs a shell command; the costs are those of all processes it started.
Cost run(const std::string& command) {
    const auto begin = std::chrono::steady_clock::now();
    const pid_t child = fork();
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        _exit(127);
    }
    int status = -1;
    rusage usage{};
    if (child < 0 || wait4(child, &status, 0, &usage) != child) return {};
    const auto seconds = [](const timeval& time) {
        return double(time.tv_sec) + double(time.tv_usec) * 1e-6;
    };
    return {.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
            .processor_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime),
            .peak_mib = double(usage.ru_maxrss) / 1024,  // kilobytes on Linux
            .succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0};
}

struct Program {
    const char *what, *flags, *source;
    double asked_seconds, asked_mib;
};

constexpr Program programs[] = {
    {"ism/ism.hpp alone, -O0", "-O0", "#include \"ism/ism.hpp\"\n", 3, 350},
    {"train and detect, one detector and space, -O2", "-O2",
     R"(#include "ism/detect/detect.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/train.hpp"

ism::Detections find(const std::vector<std::string>& names, const std::vector<ism::TrainingImage>& images,
                     const ism::Frame& frame) {
    const auto model = ism::train<ism::HessianLaplace, ism::RootSift>(names, images);
    return ism::detect<ism::Jism>(model, frame);
}
)",
     15, 550},
    {"detect alone, -O2", "-O2",
     R"(#include "ism/detect/detect.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"

ism::Detections find(const ism::TypedModel<ism::HessianLaplace, ism::RootSift>& model, const ism::Frame& frame) {
    return ism::detect<ism::Jism>(model, frame);
}
)",
     8, 400},
};

/// Compiles all sources of the program ism by the commands of this build, one after another, into nothing.
Cost build_program() {
    const nlohmann::json commands =
        nlohmann::json::parse(std::ifstream(std::filesystem::path(ISM_BUILD) / "compile_commands.json"));
    Cost sum{.succeeded = true};
    for (const auto& entry : commands) {
        const std::string object = entry.value("output", entry.at("command").get<std::string>());
        bool ours = false;
        for (const char* part :
             {"ism_program.dir", "ism_computing.dir", "ism_commands.dir", "ism_toys.dir", "ism_stb.dir"})
            ours = ours || object.find(part) != std::string::npos;
        if (!ours) continue;
        std::string command = entry.at("command");
        command.erase(command.rfind(" -o "));
        const Cost cost = run("cd '" + entry.at("directory").get<std::string>() + "' && " + command +
                              " -o /dev/null -c '" + entry.at("file").get<std::string>() + "'");
        sum.succeeded = sum.succeeded && cost.succeeded;
        sum.seconds += cost.seconds, sum.processor_seconds += cost.processor_seconds;
        sum.peak_mib = std::max(sum.peak_mib, cost.peak_mib);
    }
    return sum;
}

}  // namespace

int main(int argc, char** argv) {
    bench::Options command_line(
        "Seconds and memory that compiling small programs takes, and the processor seconds of the program "
        "ism.");
    if (const auto code = command_line.parse(argc, argv)) return *code;
    const std::filesystem::path source =
        std::filesystem::temp_directory_path() / ("ism_compile_cost_" + std::to_string(getpid()) + ".cpp");
    bool succeeded = true;
    std::printf("%-48s %8s %8s %8s %8s %8s\n", "what (" ISM_COMPILER ")", "s", "asked", "CPU s", "MiB",
                "asked");
    for (const Program& program : programs) {
        std::ofstream(source) << program.source;
        const Cost cost = run(std::string("'" ISM_COMPILER "' -std=c++20 " ISM_INCLUDES " -c -o /dev/null ") +
                              program.flags + " '" + source.string() + "'");
        succeeded = succeeded && cost.succeeded;
        std::printf("%-48s %8.2f %8.0f %8.2f %8.0f %8.0f%s\n", program.what, cost.seconds,
                    program.asked_seconds, cost.processor_seconds, cost.peak_mib, program.asked_mib,
                    cost.succeeded ? "" : "  FAILED");
        std::fflush(stdout);
    }
    std::filesystem::remove(source);
    const Cost cost = build_program();
    std::printf("%-48s %8s %8.0f %8.0f %8.0f%s\n", "the program ism, CPU seconds", "", 150.0,
                cost.processor_seconds, cost.peak_mib,
                cost.succeeded ? "" : "  FAILED (build it once before)");
    return succeeded && cost.succeeded ? 0 : 1;
}
