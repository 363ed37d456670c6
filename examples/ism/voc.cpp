// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "voc.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ism/core/box_check.hpp"
#include "ism/dataset/mask_files.hpp"
#include "ism/dataset/yolo.hpp"

#ifdef ISM_WITH_PUGIXML
#include <charconv>

#include <pugixml.hpp>
#endif

namespace program {

namespace fs = std::filesystem;

#ifdef ISM_WITH_PUGIXML

namespace {

/// Where the files of a data set are.
struct Places {
    fs::path images, masks;
    std::set<fs::path> labels;
};

Places find_places(const fs::path& path) {
    if (path.extension() == ".txt") {  // ImageSets/Main/train.txt
        const fs::path root = path.parent_path().parent_path().parent_path();
        Places places{root / "JPEGImages", root / "SegmentationObject", {}};
        for (const std::string& line : ism::detail::lines_of(path)) {
            const std::string name = line.substr(0, line.find_first_of(" \t"));
            places.labels.insert(root / "Annotations" / ism::path_from_utf8(name + ".xml"));
        }
        return places;
    }
    const bool folder = fs::is_directory(path);
    const bool parts = folder && fs::is_directory(path / "Annotations");
    const fs::path labels = parts ? path / "Annotations" : folder ? path : path.parent_path();
    const fs::path root = (labels / "..").lexically_normal();
    Places places{labels, {}, {}};
    if (fs::is_directory(root / "JPEGImages"))
        places.images = root / "JPEGImages", places.masks = root / "SegmentationObject";
    if (!folder) places.labels = {path};
    if (folder)
        for (const fs::path& file : ism::detail::folder_entries(labels))
            if (ism::detail::lower(file.extension().string()) == ".xml") places.labels.insert(file);
    return places;
}

double number_of(const pugi::xml_node& node, const char* name) {
    const std::string_view text = ism::detail::trimmed(node.child_value(name));
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    ism::expect(error == std::errc() && end == text.data() + text.size() && std::abs(number) <= 1e9, name,
                "a number", ism::lazy_text("'", ism::one_line(text.substr(0, 40)), "'"));
    return number;
}

fs::path image_of(const pugi::xml_node& root, const fs::path& label, const Places& places) {
    const fs::path named = places.images / ism::path_from_utf8(root.child_value("filename")).filename();
    if (fs::is_regular_file(named)) return named;
    const fs::path beside = ism::detail::image_of_stem(places.images, label.stem().string());
    if (beside.empty())
        throw ism::FileError("filename: expected an image in '" + ism::one_line(places.images.string()) +
                             "', got none");
    return beside;
}

/// The numbers of the objects whose pixels they are. Where the file tells colours, number n is the n-th of
/// the palette that VOC's development kit makes: the lowest three bits of n are the highest of red, green and
/// blue, and so on.
ism::Image<std::uint8_t> read_object_numbers(const fs::path& path) {
    const ism::detail::ImageFile file = ism::detail::open_image(path);
    if (file.deep) file.refuse("numbers or colours of 8 bits", "16 bits");
    const int channels = file.channels >= 3 ? 3 : 1;
    const auto samples = ism::detail::decode(file, channels, stbi_load_from_memory);
    ism::Image<std::uint8_t> numbers(file.width, file.height);
    const std::uint8_t* at = samples.get();
    for (std::uint8_t& number : numbers.pixels()) {
        if (channels == 1) {
            number = *at++;
            continue;
        }
        int bits = 0;
        for (int level = 0; level < 3; ++level)
            for (int channel = 0; channel < 3; ++channel)
                bits |= (at[channel] >> (7 - level) & 1) << (3 * level + channel);
        number = std::uint8_t(bits), at += 3;
    }
    return numbers;
}

ism::MaskSource mask_of(const ism::Image<std::uint8_t>& numbers, std::size_t number, const ism::Box& box) {
    if (numbers.empty() || number >= 255) return {};  // 255 is the edge between objects
    ism::Mask mask(numbers.width(), numbers.height());
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) mask.pixels()[i] = numbers.pixels()[i] == number;
    const ism::Box own = mask_box(mask);
    if (!(own.area() > 0)) return {};
    const double width = std::min(own.x + own.width, box.x + box.width) - std::max(own.x, box.x);
    const double height = std::min(own.y + own.height, box.y + box.height) - std::max(own.y, box.y);
    ism::expect(width > 0 && height > 0 && width * height > 0.5 * own.area(), "mask in SegmentationObject",
                "most of it in the box of the object", "another place");
    return ism::compress_mask(mask);
}

void add_image(const fs::path& label, std::int64_t id, const Places& places,
               const ism::DatasetReadOptions& options, std::map<std::string, std::uint32_t>& classes,
               ism::Dataset& dataset) {
    const std::string place = ism::file_text(label), text = ism::read_text(label, 1 << 26);
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
    if (!parsed)
        throw ism::FileError(ism::join_text(place, ": expected well-formed XML, got, at byte ", parsed.offset,
                                            ": ", parsed.description()));
    const pugi::xml_node root = document.child("annotation");
    if (!root) throw ism::FileError(place + ": expected Pascal VOC's <annotation>, got another XML");
    ism::DatasetImage image = ism::at_place(place, [&] {
        const pugi::xml_node size = root.child("size");
        const ism::ImageSize labelled{size ? int(number_of(size, "width")) : 0,
                                      size ? int(number_of(size, "height")) : 0};
        const bool known = labelled.width > 0 && labelled.height > 0;  // some tools write 0
        return ism::detail::labelled_image(id, image_of(root, label, places), options,
                                           known ? &labelled : nullptr);
    });
    image.label_file = label;
    ism::Image<std::uint8_t> numbers;
    const fs::path masks = places.masks / label.stem().concat(".png");
    if (!places.masks.empty() && fs::is_regular_file(masks)) {
        numbers = read_object_numbers(masks);
        if (numbers.width() != image.width || numbers.height() != image.height)
            throw ism::FileError(ism::join_text(ism::file_text(masks), ": expected ", image.width, "x",
                                                image.height, " pixels as of its image, got ",
                                                ism::size_text(numbers)));
    }
    std::size_t number = 0;
    for (const pugi::xml_node& node : root.children("object")) {
        ++number;
        const bool read = ism::read_or_tell(options.faults, [&] {
            ism::at_place(ism::join_text(place, ", object ", number), [&] {
                const pugi::xml_node bounds = node.child("bndbox");
                const double left = number_of(bounds, "xmin") - 1, top = number_of(bounds, "ymin") - 1;
                ism::DatasetAnnotation object{
                    .class_index = 0,
                    .box = {left, top, number_of(bounds, "xmax") - left, number_of(bounds, "ymax") - top},
                    .crowd = node.child("difficult") && number_of(node, "difficult") != 0};
                const std::string name(ism::detail::trimmed(node.child_value("name")));
                ism::expect(!name.empty(), "name", "a text", "none");
                check_labelled_box(object.box, image.width, image.height);
                object.segmentation = mask_of(numbers, number, object.box);
                object.class_index = classes.emplace(name, std::uint32_t(classes.size())).first->second;
                image.objects.push_back(std::move(object));
            });
        });
        if (!read) image.incomplete = true;
    }
    dataset.images.push_back(std::move(image));
}

}  // namespace

ism::Dataset read_voc(const fs::path& path, const ism::DatasetReadOptions& options) {
    const Places places = find_places(path);
    ism::Dataset dataset =
        fs::is_directory(path) ? ism::detail::folder_dataset(path) : ism::Dataset{.source = path};
    std::map<std::string, std::uint32_t> classes;
    std::int64_t id = 0;
    for (const fs::path& label : places.labels) {
        ++id;
        ism::read_or_tell(options.faults, [&] { add_image(label, id, places, options, classes, dataset); });
    }
    ism::detail::name_classes(dataset, classes);
    return dataset;
}

#else

ism::Dataset read_voc(const fs::path& path, const ism::DatasetReadOptions&) {
    throw ism::FileError(
        ism::file_text(path) +
        ": expected a program built with pugixml (libpugixml-dev) to read Pascal VOC, got one without");
}

#endif

}  // namespace program
