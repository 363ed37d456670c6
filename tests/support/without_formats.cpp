// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
//
// without_formats FOLDER: the program's readers, compiled without the libraries that need not be there, say
// what is missing. 0 where they do.
#include <cstdio>
#include <filesystem>
#include <string>

#include "ism/pictures.hpp"
#include "ism/voc.hpp"

namespace {

template <class Read>
bool says(const std::string& text, const Read& read) {
    std::string message = "nothing";
    try {
        read();
    } catch (const ism::FileError& error) {
        message = error.what();
    }
    if (message.find(text) != std::string::npos) return true;
    std::printf("expected '%s', got '%s'\n", text.c_str(), message.c_str());
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const std::filesystem::path file = std::filesystem::path(argv[1]) / "without_formats.image";
    ism::write_file(file, std::string("RIFF1234WEBPVP8 "));
    const bool webp =
        says("expected a program built with libwebp (libwebp-dev) to read WebP, got one without",
             [&] { (void)program::read_picture(file); });
    ism::write_file(file, std::string("MM\0*12345678", 12));
    const bool tiff =
        says("expected a program built with libtiff (libtiff-dev) to read TIFF, got one without",
             [&] { (void)program::read_image_size(file); });
    const bool voc =
        says("expected a program built with pugixml (libpugixml-dev) to read Pascal VOC, got one without",
             [&] { (void)program::read_voc(file, {}); });
    return webp && tiff && voc ? 0 : 1;
}
