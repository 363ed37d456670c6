// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/core/random.hpp"
#include "ism/dataset/any_dataset.hpp"

using ism::Box;
using ism::DatasetPart;
using ism::FileError;
using ism::test::error_message;
using ism::test::TemporaryFolder;
using ism::test::write_text;

namespace fs = std::filesystem;

namespace {

void write_40_by_20(const fs::path& path) {
    ism::test::write_pnm(path, 40, 20);
}

}  // namespace

TEST_CASE("The YAML of YOLO data sets is read in its usual forms") {
    const auto texts = [](const std::string& yaml, const std::string& key) {
        std::vector<std::string> list;
        auto lists = ism::detail::read_yaml_lists(yaml);
        for (const auto& item : lists[key])
            list.push_back(item.key.empty() ? item.value : item.key + "=" + item.value);
        return list;
    };
    using Texts = std::vector<std::string>;
    CHECK(texts("train: ../train/images # here\nval:\n", "train") == Texts{"../train/images"});
    CHECK(texts("train: ../train/images\nval:\n", "val").empty());
    CHECK(texts("names: ['a, b', \"c\", d e]\n", "names") == Texts{"a, b", "c", "d e"});
    CHECK(texts("nc: 2\nnames: [\n  a, # first\n  b ]\nx: 1", "names") == Texts{"a", "b"});
    CHECK(texts("names:\r\n- a\r\n- 'b: c'\r\n", "names") == Texts{"a", "b: c"});
    CHECK(texts("names:\n  0: a\n\n  # comment\n  1: dog's\nx: 1", "names") == Texts{"0=a", "1=dog's"});
    CHECK(texts("names: {0: a, 1: 'b'}", "names") == Texts{"0=a", "1=b"});
    CHECK(texts("roboflow:\n  names: x\nnames: [a]", "names") == Texts{"a"});
}

TEST_CASE("YOLO's boxes and outlines are read, of the part that is asked for") {
    const TemporaryFolder folder;
    write_text(folder / "data.yaml",
               "train: ../train/images\nval: ../valid/images\ntest: ../test/images\nnames: [cup, car]\n");
    write_40_by_20(folder / "train/images/a.pgm");
    write_40_by_20(folder / "train/images/b.pgm");
    write_40_by_20(folder / "valid/images/c.pgm");
    write_text(folder / "train/labels/a.txt", "1 0.5 0.5 0.25 0.5\r\n\n0 0.1 0.2 0.3 0.2 0.3 0.8\n");
    for (const char* place : {"data.yaml", "", "train", "train/images"}) {
        CAPTURE(place);
        const ism::Dataset dataset = ism::read_any_dataset(folder.path() / place);
        CHECK(dataset.class_names == std::vector<std::string>{"cup", "car"});
        CHECK(dataset.classes_listed);
        CHECK(dataset.part == (std::string_view(place).starts_with("train") ? "" : "train"));
        REQUIRE(dataset.images.size() == 2);
        REQUIRE(dataset.images[0].objects.size() == 2);
        const auto& [box, outline] = std::pair(dataset.images[0].objects[0], dataset.images[0].objects[1]);
        CHECK(box.class_index == 1);
        CHECK(box.box == Box{15, 5, 10, 10});
        CHECK(read_mask(dataset.images[0], box).empty());
        CHECK(outline.box.width == Approx(8));
        CHECK(mask_area(read_mask(dataset.images[0], outline)) > 30);
        CHECK(dataset.images[1].objects.empty());
    }
    const ism::Dataset test = ism::read_any_dataset(folder / "data.yaml", {.part = DatasetPart::test});
    REQUIRE(test.images.size() == 1);  // there is no test/images
    CHECK(test.images[0].file.filename() == "c.pgm");
    CHECK(test.part == "val");
}

TEST_CASE("YOLO's labels stand beside the images too, and images in a list") {
    const TemporaryFolder folder;
    write_40_by_20(folder / "a.pgm");
    write_text(folder / "a.txt", "0 0.5 0.5 1 1");
    write_text(folder / "classes.txt", "cup\ncar\n");
    REQUIRE(ism::read_any_dataset(folder.path()).images.size() == 1);
    CHECK(ism::read_any_dataset(folder.path()).images[0].objects.at(0).box == Box{0, 0, 40, 20});
    write_text(folder / "some.yaml", "train: list.txt\nnames: {0: cup}");
    write_text(folder / "list.txt", "./a.pgm\n");
    CHECK(ism::read_any_dataset(folder / "some.yaml").images.at(0).objects.size() == 1);
}

TEST_CASE("Depth among YOLO's images is left out, unless it alone has labels") {
    const TemporaryFolder folder;
    write_text(folder / "data.yaml", "names: [cup]\ntrain: images\n");
    write_40_by_20(folder / "images/a.pgm");
    for (const char* depth : {"a.png", "a-depth.png"})
        ism::write_png16(folder / (std::string("images/") + depth), ism::RawDepth(40, 20, 700));
    write_text(folder / "labels/a.txt", "0 0.5 0.5 1 1");
    ism::Dataset dataset = ism::read_any_dataset(folder.path());
    REQUIRE(dataset.images.size() == 1);
    CHECK(dataset.images[0].file.filename() == "a.pgm");
    CHECK(dataset.images[0].id == 1);
    CHECK(dataset.depth_left_out == 2);
    write_text(folder / "labels/a-depth.txt", "0 0.5 0.5 1 1");
    CHECK(ism::read_any_dataset(folder.path()).images.size() == 2);
    fs::remove(folder / "images/a.pgm");  // all are pictures of 16 bits
    dataset = ism::read_any_dataset(folder.path());
    CHECK(dataset.images.size() == 2);
    CHECK(dataset.depth_left_out == 0);
}

TEST_CASE("Labels of YOLO that make no sense are named by file and line, or left out") {
    const TemporaryFolder folder;
    write_40_by_20(folder / "images/a.pgm");
    write_text(folder / "labels/a.txt", "");
    const auto refused = [&](const std::string& line) {
        write_text(folder / "labels/a.txt", "0 0.5 0.5 0.5 0.5\n" + line);
        const std::string message =
            error_message<FileError>([&] { (void)ism::read_any_dataset(folder.path()); });
        const std::size_t at = message.find("a.txt', line 2: ");
        return at == std::string::npos ? message : message.substr(at + 16);
    };
    CHECK(
        refused("").ends_with("expected the names of its classes in data.yaml or classes.txt, got neither"));
    write_text(folder / "data.yaml", "train: images\n");
    CHECK(refused("").ends_with("data.yaml': expected names of classes, got none"));
    write_text(folder / "data.yaml", "names: [cup]");
    CHECK(refused("").ends_with("expected 'train', where images are, got neither"));
    write_text(folder / "data.yaml", "names: {1: cup}\ntrain: images\n");
    CHECK(refused("").ends_with("names: expected classes 0, 1, 2 … in this order, got '1'"));
    write_text(folder / "data.yaml", "names: [cup]\ntrain: images\n");
    CHECK(refused("") == "nothing thrown");
    CHECK(refused("1 0.5 0.5 0.5 0.5") == "class: expected a whole number below 1, got 1");
    CHECK(refused("-1 0.5 0.5 0.5 0.5") == "class: expected a whole number below 1, got -1");
    CHECK(refused("0 0.5 0.5 0.5") ==
          "label: expected 5 numbers of a box, or 7, 9, … of an outline, got 4 numbers");
    CHECK(refused("0 0.5 0.5 0.5 x") == "label: expected numbers, got '0 0.5 0.5 0.5 x'");
    CHECK(refused("0 0.5 0.5 0.5 nan") == "label: expected numbers, got '0 0.5 0.5 0.5 nan'");
    CHECK(refused("0 0.5 0.5 0 0.5").starts_with("box: expected sides of 0.1 to 400 pixels, got 0x10"));
    CHECK(refused("0 3 0.5 0.5 0.5").starts_with("box: expected a part in the image"));
    ism::Faults faults;
    const ism::Dataset dataset = ism::read_any_dataset(folder.path(), {.faults = &faults});
    CHECK(dataset.images.at(0).objects.size() == 1);
    CHECK(dataset.images[0].incomplete);
    CHECK(faults.size() == 1);
}

TEST_CASE("Whatever YOLO's files hold is read or refused in a line") {
    const TemporaryFolder folder;
    write_40_by_20(folder / "images/a.pgm");
    const std::string yaml = "path: .\ntrain: images\nnames:\n  0: cup\n  1: 'car'\nx: [a, 'b', {c: d}]\n";
    const std::string label = "0 0.5 0.5 0.25 0.5\n1 0.1 0.2 0.3 0.2 0.3 0.8\n";
    ism::Random random(11);
    const auto changed = [&](std::string text) {
        static const std::string some = "[]{}:'\"#-, \n\t0e.\xff/";
        for (std::uint64_t edits = random.index(4); edits-- > 0;)
            text[std::size_t(random.index(text.size()))] = some[std::size_t(random.index(some.size()))];
        return text;
    };
    int fine = 0;
    for (int round = 0; round < 200; ++round) {
        write_text(folder / "data.yaml", changed(yaml));
        write_text(folder / "labels/a.txt", changed(label));
        const std::string message =
            error_message<FileError>([&] { (void)ism::read_any_dataset(folder.path()); });
        fine += message == "nothing thrown";
        REQUIRE(message.find('\n') == std::string::npos);
    }
    CHECK(fine > 20);
    CHECK(fine < 180);
}
