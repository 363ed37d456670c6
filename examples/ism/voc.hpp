// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "ism/dataset/image_files.hpp"

namespace program {

/// Labels of Pascal VOC: an XML file an image, in Annotations beside JPEGImages, or beside the images. Boxes
/// begin at 1 and hold their last pixel; objects that are `difficult` are ignored; where SegmentationObject
/// has the image, its n-th colour is the mask of the n-th object. Images are numbered from 1 in the order of
/// the XML files, classes in that of their names. Images without an XML file are left out.
/// @param path  a folder, one XML file, or a list of names in ImageSets
/// @throws ism::FileError where a file cannot be read or makes no sense and there is no list of faults, or
/// this program was built without pugixml.
[[nodiscard]] ism::Dataset read_voc(const std::filesystem::path& path,
                                    const ism::DatasetReadOptions& options);

}  // namespace program
