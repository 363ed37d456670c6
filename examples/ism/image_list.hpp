// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace program {

/// How the command line names the image that comes in at standard input.
inline constexpr const char* standard_input = "-";

/// A picture of the command line.
struct NamedImage {
    std::filesystem::path file;  ///< that of standard input is kept in a temporary file
    std::string name;            ///< as it is told
};

/// The pictures that a command line names: files, folders, patterns ("*.jpg", where the shell left them), and
/// standard input. Each once, in the order of the command line, those of a folder or pattern by name. Left
/// out are what --show wrote for another one, and depth (grey PNG of 16 bits) beside other pictures.
class ImageList {
public:
    /// @throws ism::FileError where there is no such file, or a folder or pattern has no picture.
    explicit ImageList(std::span<const std::string> arguments);
    ~ImageList();
    ImageList(const ImageList&) = delete;
    ImageList& operator=(const ImageList&) = delete;

    [[nodiscard]] const std::vector<NamedImage>& images() const { return images_; }
    /// A message with "standard input" in place of the temporary file.
    [[nodiscard]] std::string told(std::string message) const;
    /// Removes the temporary file, which nobody reads any more.
    void drop_temporary();

private:
    void add(const std::filesystem::path& file);
    void add_standard_input();
    void add_found(std::vector<std::filesystem::path> files, const std::string& place, const char* none);
    void leave_out_overlays();
    void leave_out_depth();

    std::vector<NamedImage> images_;
    std::set<std::filesystem::path> known_;  // files, in normal form
    std::filesystem::path temporary_;
};

/// The file that --show writes beside each image: photo.ism.png, where two images would share that
/// photo.jpg.ism.png.
/// @throws ism::FileError where that is one of the images, or cannot be written.
[[nodiscard]] std::vector<std::filesystem::path> overlay_files(std::span<const NamedImage> images);

}  // namespace program
