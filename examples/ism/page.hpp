// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "commands.hpp"

#include "ism/show/report_detections.hpp"

namespace program {

/// So much room for each of so many pictures that the page stays below a megabyte; linked ones may be larger.
[[nodiscard]] ism::ReportPictureOptions picture_options(const PageOptions& options, std::size_t pictures);

/// The folder of the pictures of a page: "r.html" has "r-images", "r.htm" has "r.htm-images".
[[nodiscard]] std::filesystem::path pictures_folder(const std::filesystem::path& page);

/// Makes sure, before long work, that a page can be written, as check_output() does, and that nothing is in
/// the folder of its pictures but what an earlier page of its name has written.
void check_page(const std::filesystem::path& file, std::span<const std::filesystem::path> inputs,
                const PageOptions& options);

/// Writes the page and, where they are linked, its pictures; those of an earlier page of its name are
/// removed.
void write_page(const std::filesystem::path& file, const ism::Report& report, const PageOptions& options);

}  // namespace program
