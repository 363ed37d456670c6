// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "ism/io/images.hpp"

namespace program {

// As the library's functions of these names, and also WebP and TIFF where this program was built with libwebp
// and libtiff. Transparency is dropped, TIFF is turned as its orientation says where that is no quarter, and
// of its pages the first is read.
[[nodiscard]] ism::Picture read_picture(const std::filesystem::path& path,
                                        std::optional<ism::ImageSize> labelled = {});
[[nodiscard]] ism::ImageFileSize read_image_size(const std::filesystem::path& path);

}  // namespace program
