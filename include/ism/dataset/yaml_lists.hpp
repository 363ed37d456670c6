// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ism/config.hpp"

/// The part of YAML in which data sets of YOLO are described.
namespace ism::detail {

/// @brief One item of a list or table: its key is empty in a list.
struct YamlItem {
    std::string key, value;
};

[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
    const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

/// @brief The first of these characters outside of quotes; npos where there is none.
[[nodiscard]] inline std::size_t find_unquoted(std::string_view text, std::string_view characters,
                                               std::size_t from = 0) {
    char quote = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
        if (quote != 0) {
            if (text[i] == quote) quote = 0;
        } else if ((text[i] == '"' || text[i] == '\'') &&
                   (i == 0 || !(text[i - 1] >= 'a' && text[i - 1] <= 'z'))) {
            quote = text[i];
        } else if (characters.find(text[i]) != std::string_view::npos) {
            return i;
        }
    }
    return std::string_view::npos;
}

[[nodiscard]] inline std::string unquoted(std::string_view text) {
    text = trimmed(text);
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front())
        text = text.substr(1, text.size() - 2);
    return std::string(text);
}

/// @brief "key: value", or a value alone.
[[nodiscard]] inline YamlItem yaml_item(std::string_view text) {
    const std::size_t colon = find_unquoted(text, ":");
    if (colon == std::string_view::npos || (colon + 1 < text.size() && text[colon + 1] != ' '))
        return {{}, unquoted(text)};
    return {unquoted(text.substr(0, colon)), unquoted(text.substr(colon + 1))};
}

/// @brief The keys of the first level, each with its values: one, or those of a list or table below it, in
/// brackets or a line each. What is deeper is taken as it stands.
[[nodiscard]] inline std::map<std::string, std::vector<YamlItem>> read_yaml_lists(std::string_view text) {
    std::map<std::string, std::vector<YamlItem>> lists;
    std::vector<YamlItem>* list = nullptr;
    std::string open;  // what stands in brackets and goes on in the next line
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
        const std::size_t comment = find_unquoted(line, "#");
        if (comment != std::string_view::npos && (comment == 0 || line[comment - 1] == ' '))
            line = line.substr(0, comment);
        const bool indented = !line.empty() && (line[0] == ' ' || line[0] == '\t');
        line = trimmed(line);
        if (line.empty() || line == "---") continue;
        if (open.empty()) {
            const bool item = line[0] == '-' && (line.size() == 1 || line[1] == ' ');
            if (indented || item) {
                if (list != nullptr)
                    list->push_back(item ? YamlItem{{}, unquoted(line.substr(1))} : yaml_item(line));
                continue;
            }
            const YamlItem head = yaml_item(line);
            const std::size_t colon = find_unquoted(line, ":");
            list = &lists[head.key.empty() ? head.value : head.key];
            if (colon == std::string_view::npos) continue;
            line = trimmed(line.substr(colon + 1));
            if (line.empty()) continue;
            if (line[0] != '[' && line[0] != '{') {
                list->push_back({{}, unquoted(line)});
                continue;
            }
        }
        open += std::string(line) + " ";
        if (find_unquoted(open, "]}") == std::string::npos) continue;
        std::string_view inside(open);
        inside = inside.substr(1, find_unquoted(open, "]}") - 1);
        for (std::size_t comma = 0; comma != std::string_view::npos;) {
            comma = find_unquoted(inside, ",");
            const std::string_view part = trimmed(inside.substr(0, comma));
            if (!part.empty())
                list->push_back(open[0] == '{' ? yaml_item(part) : YamlItem{{}, unquoted(part)});
            if (comma != std::string_view::npos) inside = inside.substr(comma + 1);
        }
        open.clear();
    }
    return lists;
}

}  // namespace ism::detail
