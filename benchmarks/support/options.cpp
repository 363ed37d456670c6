// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "support/options.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

#include <CLI/CLI.hpp>

namespace bench {

namespace {

void bound(CLI::Option& option, Limits limits) {
    const Limits none;
    if (limits.least > none.least || limits.most < none.most)
        option.check(CLI::Range(limits.least, limits.most));
}

}  // namespace

Options::Options(const std::string& purpose) : app_(std::make_unique<CLI::App>(purpose)) {}
Options::~Options() = default;

void Options::add(const std::string& name, std::filesystem::path& value, const std::string& help) {
    app_->add_option(name, value, help)->capture_default_str();
}
void Options::add(const std::string& name, std::string& value, const std::string& help,
                  const std::vector<std::string>& allowed) {
    CLI::Option* option = app_->add_option(name, value, help)->capture_default_str();
    if (!allowed.empty()) option->check(CLI::IsMember(allowed));
}
void Options::add(const std::string& name, double& value, const std::string& help) {
    app_->add_option(name, value, help)->capture_default_str();
}
void Options::add(const std::string& name, unsigned& value, const std::string& help) {
    app_->add_option(name, value, help)->capture_default_str();
}
void Options::add(const std::string& name, std::size_t& value, const std::string& help, Limits limits) {
    bound(*app_->add_option(name, value, help)->capture_default_str(), limits);
}
void Options::add(const std::string& name, ism::InstructionSet& value, const std::string& help) {
    app_->add_option(name, value, help)
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, ism::InstructionSet>{{"any", ism::InstructionSet::any},
                                                       {"avx2", ism::InstructionSet::avx2},
                                                       {"avx512_vnni", ism::InstructionSet::avx512_vnni}}));
}
void Options::add(const std::string& name, bool& value, const std::string& help) {
    app_->add_flag(name, value, help);
}
void Options::add(const std::string& name, std::vector<std::string>& values, const std::string& help) {
    app_->add_option(name, values, help)->delimiter(',')->capture_default_str();
}
void Options::add(const std::string& name, std::vector<std::size_t>& values, const std::string& help,
                  Limits limits) {
    bound(*app_->add_option(name, values, help)->delimiter(',')->capture_default_str(), limits);
}

std::optional<int> Options::parse(int argc, char** argv) {
    try {
        app_->parse(argc, argv);
    } catch (const CLI::Success& done) {
        return app_->exit(done);  // --help
    } catch (const CLI::ParseError& error) {
        const std::string program = std::filesystem::path(argv[0]).filename().string();
        std::string text = error.what();
        std::replace(text.begin(), text.end(), '\n', ' ');
        std::fprintf(stderr, "%s: %s; --help tells more\n", program.c_str(), text.c_str());
        return 2;
    }
    return std::nullopt;
}

}  // namespace bench
