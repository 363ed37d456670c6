// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/dataset/dataset.hpp"

namespace program {

/// "a, b, c".
template <class Texts>
[[nodiscard]] std::string list_text(const Texts& texts) {
    std::string list;
    for (const auto& text : texts) {
        if (!list.empty()) list += ", ";
        list += text;
    }
    return list;
}

/// A text as a shell takes it as one word.
[[nodiscard]] std::string shell_word(const std::string& text);

/// The name of an image as seen from its data set's folder.
[[nodiscard]] std::string short_name(const ism::Dataset& dataset, const ism::DatasetImage& image);
/// The names of all its images.
[[nodiscard]] std::vector<std::string> short_names(const ism::Dataset& dataset);
/// Takes the folder that all names have in common off them.
/// @return that folder; empty where there is none, or one name
[[nodiscard]] std::string take_folder(std::vector<std::string>& names);

/// Names what is wrong on stderr, up to 20 lines and a count.
/// @throws ism::Error where there is something and `skip_bad` is not given; what is alone wrong is its
/// message.
void tell_faults(std::span<const std::string> faults, const std::string& of_what, bool skip_bad);

/// Tells on stderr how many of the images were left out as depth, where there are any.
void tell_depth_left_out(std::size_t count);

/// What is doubtful about files, told as one line: the first of them by name, and how many there are. May be
/// added to from several threads.
class Doubts {
public:
    void add(const std::filesystem::path& file, const std::string& text);
    /// Tells it on stderr, where there is something.
    void tell() const;

private:
    std::mutex mutex_;
    std::set<std::string> texts_;
};

/// Reads every image once by `read`, and throws or leaves out those for which it throws.
/// With `skip_bad` the bad ones are named on stderr and removed; else they are named and ism::Error is
/// thrown.
/// @return how many were left out
std::size_t check_images(ism::Dataset& dataset, unsigned threads, bool skip_bad,
                         const std::function<void(ism::DatasetImage&)>& read);

/// Whether an output is standard output.
[[nodiscard]] bool is_standard_output(const std::filesystem::path& file);

/// Throws ism::FileError unless a file can be written there: its folder exists and can be written to, and the
/// file is none of `inputs` and no picture but one of the program's own (NAME.ism.png).
void check_output(const std::filesystem::path& file, std::span<const std::filesystem::path> inputs);

/// Throws ism::FileError where an output is the labels of an image.
void check_not_labels(const ism::Dataset& dataset, std::span<const std::filesystem::path> outputs);

/// Makes a folder where there is none yet, and throws ism::FileError unless files can be written there.
void make_folder(const std::filesystem::path& folder);

}  // namespace program
