// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
//
// other_formats COCO.json FOLDER N: the first N images of each class with one masked object as four other
// data sets: FOLDER/folders (masks beside images), FOLDER/voc, FOLDER/yolo, FOLDER/labelme. They say the
// same, as far as they can.
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

#ifdef ISM_WITH_WEBP
#include <webp/encode.h>
#endif
#ifdef ISM_WITH_TIFF
#include <tiffio.h>
#endif

#include "ism/dataset/coco.hpp"
#include "ism/io/images.hpp"
#include "ism/io/json.hpp"
#include "ism/io/png.hpp"

namespace fs = std::filesystem;

namespace {

struct Sample {
    std::string stem, ending, name;  ///< without and with which ending its file is called, its class
    std::size_t class_index;
    ism::Box box;
    ism::ImageSize size;
};

void copy_to(const fs::path& from, const fs::path& to) {
    fs::create_directories(to.parent_path());
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
    fs::permissions(to, fs::perms::owner_write, fs::perm_options::add);  // data may be for reading alone
}

void write_text(const fs::path& to, const std::string& text) {
    fs::create_directories(to.parent_path());
    ism::write_file(to, text);
}

void write_voc(const fs::path& root, const Sample& s) {
    const auto tag = [](const std::string& name, const std::string& value) {
        return "<" + name + ">" + value + "</" + name + ">";
    };
    const auto number = [](double value) { return ism::join_text(value); };
    const ism::Box& b = s.box;
    write_text(
        root / "Annotations" / (s.stem + ".xml"),
        tag("annotation",
            tag("filename", s.stem + s.ending) +
                tag("size", tag("width", number(s.size.width)) + tag("height", number(s.size.height))) +
                tag("object", tag("name", s.name) + tag("difficult", "0") +
                                  tag("bndbox", tag("xmin", number(b.x + 1)) + tag("ymin", number(b.y + 1)) +
                                                    tag("xmax", number(b.x + b.width)) +
                                                    tag("ymax", number(b.y + b.height))))));
}

// Outlines that cover just the pixels of the mask: one for each run of a row.
std::vector<ism::Polygon> runs(const ism::Mask& mask) {
    std::vector<ism::Polygon> outlines;
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) {
            if (mask(x, y) == 0) continue;
            const int begin = x;
            while (x < mask.width() && mask(x, y) != 0) ++x;
            outlines.push_back({{double(begin), double(y)},
                                {double(x), double(y)},
                                {double(x), y + 1.0},
                                {double(begin), y + 1.0}});
        }
    return outlines;
}

void write_labelme(const fs::path& root, const Sample& s, const ism::Mask& mask) {
    ism::detail::Json shapes = ism::detail::Json::array();
    for (const ism::Polygon& outline : runs(mask)) {
        ism::detail::Json points = ism::detail::Json::array();
        for (const ism::Point2& corner : outline) points.push_back({corner.x, corner.y});
        shapes.push_back({{"label", s.name}, {"points", points}, {"group_id", 1}, {"shape_type", "polygon"}});
    }
    const ism::detail::Json root_json = {{"shapes", shapes},
                                         {"imagePath", s.stem + s.ending},
                                         {"imageData", nullptr},
                                         {"imageWidth", s.size.width},
                                         {"imageHeight", s.size.height}};
    write_text(root / (s.stem + ".json"), root_json.dump());
}

void write_yolo(const fs::path& root, const Sample& s) {
    const ism::Box& b = s.box;
    char line[200];
    std::snprintf(line, sizeof(line), "%zu %.17g %.17g %.17g %.17g\n", s.class_index,
                  (b.x + b.width / 2) / s.size.width, (b.y + b.height / 2) / s.size.height,
                  b.width / s.size.width, b.height / s.size.height);
    write_text(root / "labels/train" / (s.stem + ".txt"), line);
}

void write_first(const fs::path& to, const ism::RgbImage& image) {
    ism::write_png(to / "first.png", image);
    [[maybe_unused]] const int width = image.width(), height = image.height();
#ifdef ISM_WITH_WEBP
    std::uint8_t* bytes = nullptr;
    const std::size_t size =
        WebPEncodeLosslessRGB(&image.pixels().data()->r, width, height, 3 * width, &bytes);
    ism::write_file(to / "first.webp", std::span<const std::uint8_t>(bytes, size));
    WebPFree(bytes);
#endif
#ifdef ISM_WITH_TIFF
    TIFF* file = TIFFOpen((to / "first.tif").string().c_str(), "w");
    TIFFSetField(file, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(file, TIFFTAG_IMAGELENGTH, height);
    TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, 3);
    TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(file, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
    for (int y = 0; y < height; ++y) {
        std::vector<ism::Rgb> row(image.row(y).begin(), image.row(y).end());
        TIFFWriteScanline(file, row.data(), std::uint32_t(y), 0);
    }
    TIFFClose(file);
#endif
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    const fs::path to = argv[2];
    const ism::Dataset dataset = ism::read_dataset(argv[1]);
    std::map<std::size_t, int> count;
    for (const ism::DatasetImage& image : dataset.images) {
        if (image.objects.size() != 1 || ++count[image.objects[0].class_index] > std::stoi(argv[3])) continue;
        const ism::DatasetAnnotation& object = image.objects[0];
        const ism::Mask mask = read_mask(image, object);
        const std::string name = dataset.class_names[object.class_index];
        const Sample s{.stem = ism::join_text(name, "-", count[object.class_index]),
                       .ending = image.file.extension().string(),
                       .name = name,
                       .class_index = object.class_index,
                       .box = mask_box(mask),
                       .size = {image.width, image.height}};
        ism::Image<std::uint8_t> white(mask.width(), mask.height()), first(mask.width(), mask.height());
        for (std::size_t i = 0; i < mask.pixels().size(); ++i)
            white.pixels()[i] = mask.pixels()[i] ? 255 : 0, first.pixels()[i] = mask.pixels()[i] ? 1 : 0;
        const std::string file = s.stem + s.ending;
        if (!fs::exists(to / "folders")) {
            fs::create_directories(to);
            write_first(to, ism::read_rgb(image.file));
        }
        copy_to(image.file, to / "folders" / name / file);
        ism::write_png(to / "folders" / name / (s.stem + (s.ending == ".png" ? "_mask.png" : ".png")), white);
        copy_to(image.file, to / "voc/JPEGImages" / file);
        fs::create_directories(to / "voc/SegmentationObject");
        // the number 1, or its colour
        ism::RgbImage red(mask.width(), mask.height());
        for (std::size_t i = 0; i < mask.pixels().size(); ++i) red.pixels()[i].r = mask.pixels()[i] ? 128 : 0;
        const fs::path numbers = to / "voc/SegmentationObject" / (s.stem + ".png");
        if (count[object.class_index] % 2 == 0)
            ism::write_png(numbers, red);
        else
            ism::write_png(numbers, first);
        write_voc(to / "voc", s);
        copy_to(image.file, to / "yolo/images/train" / file);
        write_yolo(to / "yolo", s);
        copy_to(image.file, to / "labelme" / file);
        write_labelme(to / "labelme", s, mask);
    }
    std::string names;
    for (const std::string& name : dataset.class_names) names += "  - " + name + "\n";
    write_text(
        to / "yolo/data.yaml",
        "# as Ultralytics writes it\npath: .\ntrain: images/train\nval: images/train\nnames:\n" + names);
}
