// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>

#include "commands.hpp"

#include "ism/show/report_detections.hpp"

namespace program {

/// So much room for each of so many pictures that the page stays below a megabyte; linked ones may be larger.
[[nodiscard]] ism::ReportPictureOptions picture_options(const PageOptions& options, std::size_t pictures);

/// The folder of the pictures of a page: "r.html" has "r-images".
[[nodiscard]] std::filesystem::path pictures_folder(const std::filesystem::path& page);

/// Writes the page and, where they are linked, its pictures.
void write_page(const std::filesystem::path& file, const ism::Report& report, const PageOptions& options);

}  // namespace program
