// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/dataset/any_dataset.hpp"
#include "ism/dataset/read_images.hpp"

using ism::Box;
using ism::FileError;
using ism::Rgb;
using ism::RgbImage;
using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

// An image that is no PNG.
void write_image(const fs::path& path, int width = 24, int height = 18) {
    ism::test::write_pnm(path, width, height);
}

void write_mask(const fs::path& path, const Box& box, std::uint8_t figure = 255, int width = 24) {
    fs::create_directories(path.parent_path());
    ism::Image<std::uint8_t> mask(width, 18);
    for (int y = int(box.y); y < int(box.y + box.height); ++y)
        for (int x = int(box.x); x < int(box.x + box.width); ++x) mask(x, y) = figure;
    ism::write_png(path, mask);
}

void write_depth(const fs::path& path) {
    fs::create_directories(path.parent_path());
    ism::write_png16(path, ism::RawDepth(24, 18, 700));
}

// A PNG of 24 × 18 px whose pixels are transparent outside the box.
void write_cut_out(const fs::path& path, const Box& box) {
    fs::create_directories(path.parent_path());
    std::vector<std::uint8_t> samples;
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 24; ++x) {
            const bool in = x >= box.x && y >= box.y && x < box.x + box.width && y < box.y + box.height;
            samples.insert(samples.end(), {90, 80, 70, std::uint8_t(in ? 255 : 0)});
        }
    ism::write_file(path, ism::detail::stb_png(24, 18, 4, samples.data()));
}

std::string folder_error(const fs::path& folder) {
    return error_message<FileError>([&] { (void)ism::read_any_dataset(folder); });
}

}  // namespace

TEST_CASE("A folder with one folder a class is a data set, with masks beside the images or in them") {
    const TemporaryFolder folder;
    write_image(folder / "car/1.pgm");
    write_mask(folder / "car/1.png", {3, 4, 5, 6}, 1);  // 0 and 1 are a mask as well
    write_image(folder / "car/2.pgm");
    write_mask(folder / "car/2_mask.png", {1, 2, 20, 10});
    write_cut_out(folder / "cow/1.png", {7, 2, 8, 9});
    write_image(folder / "cow/2.pgm");
    write_image(folder / "Background/1.pgm");
    ism::write_file(folder / "readme.txt", std::string("no image"));
    ism::write_file(folder / "car/.hidden.png", std::string("no image"));
    ism::write_file(folder / "car/1.ism.png", std::string("drawn by the program"));
    write_image(folder / "__MACOSX/car/1.pgm");  // of an archive

    const ism::Dataset dataset = ism::read_any_dataset(folder.path());
    CHECK(dataset.class_names == std::vector<std::string>{"car", "cow"});
    CHECK(dataset.category_ids == std::vector<std::int64_t>{1, 2});
    CHECK_FALSE(dataset.classes_listed);
    REQUIRE(dataset.images.size() == 5);
    CHECK(dataset.images[0].objects.empty());
    const std::vector<Box> boxes = {{3, 4, 5, 6}, {1, 2, 20, 10}, {7, 2, 8, 9}, {0, 0, 24, 18}};
    for (std::size_t i = 0; i < 4; ++i) {
        const ism::DatasetImage& image = dataset.images[i + 1];
        CAPTURE(image.file.string());
        REQUIRE(image.objects.size() == 1);
        CHECK(image.id == std::int64_t(i) + 2);
        CHECK(image.objects[0].id == std::int64_t(i) + 1);
        CHECK(image.objects[0].class_index == (i < 2 ? 0 : 1));
        CHECK(image.objects[0].box == boxes[i]);
        const ism::Mask mask = ism::read_mask(image, image.objects[0]);
        CHECK(mask_area(mask) == (i < 3 ? std::size_t(boxes[i].area()) : 0));
        CHECK(ism::read_training_image(image).frame.gray.width() == 24);
    }
    CHECK(ism::relative_to(dataset.images[1].file, dataset.source.parent_path()) == "car/1.pgm");
}

TEST_CASE("Masks are told from images whatever the case of their names") {
    const TemporaryFolder folder;
    write_image(folder / "car/1.pgm");
    write_mask(folder / "car/1.PNG", {3, 4, 5, 6});
    write_image(folder / "car/2.PGM");
    write_mask(folder / "car/2_MASK.PNG", {1, 2, 20, 10});
    write_cut_out(folder / "car/3.PNG", {7, 2, 8, 9});
    const ism::Dataset dataset = ism::read_any_dataset(folder.path());
    REQUIRE(dataset.images.size() == 3);
    const std::vector<Box> boxes = {{3, 4, 5, 6}, {1, 2, 20, 10}, {7, 2, 8, 9}};
    for (std::size_t i = 0; i < 3; ++i) {
        REQUIRE(dataset.images[i].objects.size() == 1);
        CHECK(dataset.images[i].objects[0].box == boxes[i]);
    }
}

TEST_CASE("Images alone have no labels, and a folder with one JSON file is COCO's") {
    const TemporaryFolder folder;
    write_image(folder / "b.pgm");
    write_image(folder / "a.pgm", 30, 20);
    const ism::Dataset dataset = ism::read_any_dataset(folder.path());
    REQUIRE(dataset.images.size() == 2);
    CHECK(dataset.class_names.empty());
    CHECK(dataset.images[0].width == 30);
    ism::write_file(folder / "_annotations.coco.json", std::string(R"({"images":
        [{"id":7,"file_name":"b.pgm","width":24,"height":18}]})"));
    const ism::Dataset coco = ism::read_any_dataset(folder.path());
    REQUIRE(coco.images.size() == 1);
    CHECK(coco.images[0].id == 7);
    CHECK(coco.images[0].file == folder / "b.pgm");

    ism::write_file(folder / "found.json", std::string("[]"));  // results are no labels
    CHECK(ism::read_any_dataset(folder.path()).images.size() == 1);
    fs::create_directories(folder / "annotations");
    fs::rename(folder / "_annotations.coco.json", folder / "annotations/train.json");
    CHECK(ism::read_any_dataset(folder.path()).images.at(0).file == folder / "b.pgm");
    fs::copy_file(folder / "annotations/train.json", folder / "annotations/val.json");
    CHECK(folder_error(folder.path())
              .ends_with("annotations': expected one JSON file of COCO, or those of labelme, got 2 such as "
                         "'train.json': name one"));
}

TEST_CASE("Depth beside the images of a class is left out, and is no mask") {
    const TemporaryFolder folder;
    write_image(folder / "box/0.pgm");
    write_depth(folder / "box/0.png");
    write_image(folder / "box/1-color.pgm");
    write_depth(folder / "box/1-depth.png");
    write_image(folder / "box/2.pgm");
    write_mask(folder / "box/2.png", {3, 4, 5, 6});
    const ism::Dataset dataset = ism::read_any_dataset(folder.path());
    CHECK(dataset.depth_left_out == 2);
    REQUIRE(dataset.images.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(dataset.images[i].file.extension() == ".pgm");
        CHECK(dataset.images[i].id == std::int64_t(i) + 1);
        CHECK(dataset.images[i].objects.at(0).box == (i < 2 ? Box{0, 0, 24, 18} : Box{3, 4, 5, 6}));
    }
    CHECK(ism::detail::image_of_stem(folder / "box", "0") == folder / "box/0.pgm");
    CHECK(ism::detail::image_of_stem(folder / "box", "1-depth") == folder / "box/1-depth.png");
    write_depth(folder / "box/1-color_mask.png");
    CHECK(folder_error(folder.path())
              .ends_with(
                  "1-color_mask.png': expected a mask of 8 bits, got grey of 16 bits, as depth is kept"));
}

TEST_CASE("Where all pictures are grey of 16 bits they are no depth") {
    const TemporaryFolder folder;
    write_depth(folder / "bone/0.png");
    write_depth(folder / "bone/1.png");
    write_mask(folder / "bone/1_mask.png", {3, 4, 5, 6});
    const ism::Dataset dataset = ism::read_any_dataset(folder.path());
    CHECK(dataset.depth_left_out == 0);
    REQUIRE(dataset.images.size() == 2);
    CHECK(dataset.images[1].objects.at(0).box == Box{3, 4, 5, 6});
}

TEST_CASE("Depth in a folder of images alone is left out") {
    const TemporaryFolder folder;
    write_image(folder / "a.pgm");
    write_depth(folder / "a.png");
    write_image(folder / "b.pgm");
    const ism::Dataset dataset = ism::read_any_dataset(folder.path());
    CHECK(dataset.depth_left_out == 1);
    REQUIRE(dataset.images.size() == 2);
    CHECK(dataset.images[1].file.filename() == "b.pgm");
    CHECK(dataset.images[1].id == 2);
}

TEST_CASE("Folders that make no sense are refused in a line, single images may be left out") {
    const TemporaryFolder folder;
    CHECK(folder_error(folder.path()) ==
          "folder '" + folder.path().string() + "': expected a data set, got no image");
    fs::create_directories(folder / "car");
    CHECK(folder_error(folder.path()).ends_with("car': expected images of a class, got none"));
    write_image(folder / "car/1.pgm");
    write_image(folder / "0.pgm");
    CHECK(folder_error(folder.path())
              .ends_with("0.pgm': expected images in the folder of their class, got one beside the folders"));
    fs::remove(folder / "0.pgm");
    write_image(folder / "train/car/1.pgm");
    CHECK(folder_error(folder.path())
              .ends_with("train': expected the images of a class, got a folder of folders; "
                         "give the folder above those of the classes"));
    fs::remove_all(folder / "train");

    write_mask(folder / "car/1_mask.png", {1, 1, 3, 3}, 255, 25);
    CHECK(folder_error(folder.path()).ends_with("expected 25x18 pixels as its labels say, got 24x18"));
    write_mask(folder / "car/1_mask.png", {1, 1, 0, 0});
    CHECK(folder_error(folder.path()).ends_with("1_mask.png': expected a mask with figure, got one without"));
    fs::rename(folder / "car/1_mask.png", folder / "car/5_mask.png");
    CHECK(folder_error(folder.path()).ends_with("5_mask.png': expected an image beside this mask, got none"));
    ism::write_file(folder / "car/2.heic", std::string("no image"));
    ism::write_file(folder / "car/3.jpg", std::string("\xff\xd8\xff, but no image"));
    write_image(folder / "car/9.pgm");
    fs::create_directories(folder / "none");
    ism::Faults faults;
    const ism::Dataset left = ism::read_any_dataset(folder.path(), {.faults = &faults});
    REQUIRE(left.images.size() == 2);
    CHECK(left.images[1].id == 4);  // as it would be without the faults before it
    CHECK(left.class_names == std::vector<std::string>{"car"});
    REQUIRE(faults.size() == 4);
    CHECK(faults[3].ends_with("none': expected images of a class, got none"));
    CHECK(faults[0].ends_with("2.heic': expected a PNG, JPEG, BMP or PNM image, got something else"));
    CHECK(faults[1].ends_with("3.jpg': expected a whole image, got a truncated JPEG"));
    CHECK(faults[2].ends_with("5_mask.png': expected an image beside this mask, got none"));
}
