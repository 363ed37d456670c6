// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
//
// Whatever a file of labels or results holds, it is read or refused by an exception of ours with a message of
// one line.
#include <filesystem>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/core/random.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/coco_results.hpp"
#include "ism/dataset/coco_write.hpp"
#include "ism/evaluate/coco.hpp"
#include "ism/evaluate/table.hpp"

using ism::Dataset;
using ism::FileError;
using ism::Random;
using ism::Result;
using ism::detail::Json;
using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

const std::string labels = R"({"info":{"a":[1,2.5,null,true]},
"images":[{"id":1,"file_name":"a/b.png","width":24,"height":18,"depth_file_name":"d.png","depth_scale":0.001,
           "camera":{"fx":525.0,"fy":525,"cx":12,"cy":9}},
          {"id":2,"file_name":"c.png","width":20,"height":16}],
"annotations":[{"id":1,"image_id":1,"category_id":3,"bbox":[2,3,4,5.5],"iscrowd":0,
                "segmentation":{"size":[18,24],"counts":[40,5,13,5,369]}},
               {"id":2,"image_id":1,"category_id":1,"bbox":[0,0,6,7],
                "segmentation":[[1,1,5,1,5.5,6],[2,2,3,2,3,9]]},
               {"id":3,"image_id":2,"category_id":1,"segmentation":{"size":[16,20],"counts":"X15;0h7"}},
               {"id":4,"image_id":2,"category_id":1,"bbox":[1,1,6,7],"iscrowd":1}],
"categories":[{"id":1,"name":"cup"},{"id":3,"name":"b\u00e4r"}]})";

const std::string findings = R"([{"image_id":1,"category_id":3,"bbox":[2,3,4,5],"score":0.9,"scale":1.5,
"depth_m":null,"position_m":[1,2,3.5],"segmentation":{"size":[18,24],"counts":[40,5,13,5,369]}},
{"image_id":2,"category_id":1,"score":1,"segmentation":{"size":[16,20],"counts":[3,4,313]}},
{"image_id":2,"category_id":1,"bbox":[2,3,4,5],"score":0.2}])";

// Bytes changed, added, taken away and doubled.
std::string with_changed_bytes(std::string text, Random& random) {
    static constexpr std::string_view pieces[] = {"[",
                                                  "]",
                                                  "{",
                                                  "}",
                                                  "\"",
                                                  ",",
                                                  ":",
                                                  "null",
                                                  "-",
                                                  "1e308",
                                                  "1e999",
                                                  "-0",
                                                  "18446744073709551615",
                                                  "-9223372036854775809",
                                                  "\\u0000",
                                                  "\\ud800",
                                                  "\xff",
                                                  "[[[[",
                                                  "NaN",
                                                  "4294967296",
                                                  "e",
                                                  "1e-320"};
    for (std::uint64_t edits = 1 + random.index(3); edits-- > 0;) {
        const auto at = std::size_t(random.index(text.size()));
        switch (random.index(5)) {
            case 0:
                text[at] = char(random.index(256));
                break;
            case 1:
                text.erase(at, 1 + std::size_t(random.index(6)));
                break;
            case 2:
                text.insert(at, pieces[random.index(std::size(pieces))]);
                break;
            case 3:
                text.insert(at, text.substr(std::size_t(random.index(text.size())), 30));
                break;
            default:
                text.insert(at, 1, char(32 + random.index(96)));
        }
    }
    return text;
}

// One or two values replaced by others.
std::string with_changed_values(const std::string& text, Random& random) {
    static const std::vector<std::string> values = {"null",
                                                    "0",
                                                    "-1",
                                                    "1e300",
                                                    "1e-300",
                                                    "18446744073709551615",
                                                    "-9223372036854775808",
                                                    "4294967297",
                                                    R"("")",
                                                    R"("a\u0000b")",
                                                    R"("\n")",
                                                    "[]",
                                                    "{}",
                                                    "[1]",
                                                    "[[1,2,3,4,5,6]]",
                                                    "true",
                                                    "0.1",
                                                    "-0.0",
                                                    R"("..")",
                                                    "[1e9,1e9,1e9,1e9]",
                                                    "[[0,0,1e9,1e9,-1e9,1e9]]",
                                                    "[2,2,1e-5,3]",
                                                    R"({"size":[18,24],"counts":"ooooooooo"})",
                                                    R"({"size":[18,24],"counts":"`1"})",
                                                    R"({"size":[18,24],"counts":[0,0,0,0,432]})",
                                                    R"({"size":[1048576,128],"counts":[]})"};
    Json root = Json::parse(text);
    for (std::uint64_t edits = 1 + random.index(2); edits-- > 0;) {
        const Json flat = root.flatten();
        Json::json_pointer place(std::next(flat.begin(), std::ptrdiff_t(random.index(flat.size()))).key());
        if (random.index(3) == 0 && !place.empty()) place = place.parent_pointer();
        if (place.empty() || !root.contains(place)) continue;  // what was an empty array or object is none
        root[place] = Json::parse(values[std::size_t(random.index(values.size()))]);
    }
    return root.dump(-1, ' ', false, Json::error_handler_t::replace);
}

struct Outcome {
    std::size_t accepted = 0, refused = 0;
    std::string fault;  // the first exception that is not ours, or message of several lines
};

// Feeds `read` with changed copies of a text.
template <class Read>
Outcome feed(const std::string& text, std::uint64_t seed, const Read& read) {
    Random random(seed);
    Outcome outcome;
    for (int round = 0; round < 3000; ++round) {
        const std::string changed =
            round % 3 == 0 ? with_changed_bytes(text, random) : with_changed_values(text, random);
        try {
            read(changed);
            ++outcome.accepted;
        } catch (const ism::Error& error) {
            ++outcome.refused;
            const std::string message = error.what();
            if (message.find('\n') != std::string::npos && outcome.fault.empty())
                outcome.fault = "several lines: " + message;
        } catch (const std::exception& error) {
            if (outcome.fault.empty())
                outcome.fault = std::string(typeid(error).name()) + ": " + error.what() + " for " + changed;
        }
    }
    return outcome;
}

Dataset dataset_of(const std::string& text) {
    return ism::detail::dataset_from_json(ism::detail::parse_json(text, "file 'a.json'"), "a.json");
}

std::vector<Result> results_of(const std::string& text) {
    std::vector<Result> results;
    for (const Json& record : ism::detail::parse_json(text, "file 'r.json'"))
        results.push_back(ism::detail::result_from_json(record, "result"));
    return results;
}

}  // namespace

TEST_CASE("Labels with anything changed are read, and written again, or refused in one line") {
    const TemporaryFolder folder;
    const Outcome outcome = feed(labels, 1, [&](const std::string& text) {
        const Dataset set = dataset_of(text);
        for (const ism::DatasetImage& image : set.images)
            for (const ism::DatasetAnnotation& object : image.objects) (void)ism::read_mask(image, object);
        (void)ism::to_json(ism::evaluate(set, std::span<const Result>()));
        ism::write_dataset(folder / "b.json", set);
        if (ism::read_dataset(folder / "b.json").images.size() != set.images.size())
            throw std::runtime_error("other images after writing");
    });
    CHECK(outcome.fault == "");
    CHECK(outcome.accepted > 50);
    CHECK(outcome.refused > 1000);
}

TEST_CASE("Results with anything changed are measured or refused in one line") {
    const Dataset set = dataset_of(labels);
    const Outcome outcome = feed(findings, 2, [&](const std::string& text) {
        (void)ism::to_table(ism::evaluate(set, results_of(text)));
    });
    CHECK(outcome.fault == "");
    CHECK(outcome.accepted > 50);
    CHECK(outcome.refused > 1000);
}

TEST_CASE("JSON nested 200000 deep is refused or read, without the stack") {
    const std::string deep(200000, '[');
    CHECK(
        error_message<FileError>([&] {
            (void)dataset_of(deep);
        }).starts_with("file 'a.json': expected well-formed JSON, got parse error at line 1, column 200001"));
    CHECK(error_message<FileError>([&] { (void)dataset_of(deep + std::string(200000, ']')); }) ==
          "file 'a.json': expected an object, got an array of 1");
}

TEST_CASE("Files that are none are refused in one line") {
    const TemporaryFolder folder;
    fs::create_symlink(folder / "two", folder / "one");
    fs::create_symlink(folder / "one", folder / "two");
    const fs::path long_name = folder / std::string(5000, 'x');
    for (const fs::path& path : {fs::path(), fs::path("/dev/null/x"), folder / "one", long_name,
                                 folder.path(), folder / "no\nne", folder / "\xff\xfe"}) {
        CAPTURE(path.native().substr(0, 200));
        for (const auto& message : {error_message<FileError>([&] { (void)ism::read_dataset(path); }),
                                    error_message<FileError>([&] { (void)ism::read_results(path); })}) {
            CHECK(message.starts_with("file '"));
            CHECK(message.find('\n') == std::string::npos);
        }
    }
    for (const fs::path& path : {fs::path(), fs::path("/dev/null/x"), folder / "one", long_name,
                                 folder.path(), folder / "none/x.json"}) {
        CAPTURE(path.native().substr(0, 200));
        CHECK(error_message<FileError>([&] { ism::write_dataset(path, {}); }).starts_with("file '"));
        CHECK(error_message<FileError>([&] { ism::write_results(path, {}); }).starts_with("file '"));
    }
}

TEST_CASE("Names that JSON cannot hold are refused before anything is written") {
    const TemporaryFolder folder;
    Dataset set{.class_names = {"cup"}, .category_ids = {1}};
    set.images.resize(1);
    set.images[0].file = folder / "\xff\xfe.png";
    set.images[0].width = 20, set.images[0].height = 16;
    CHECK(error_message<FileError>([&] {
              ism::write_dataset(folder / "a.json", set);
          }).ends_with("expected names in UTF-8, got other bytes"));
    set.images[0].file = folder / "a.png";
    set.class_names[0] = "\xc3";
    CHECK(error_message<FileError>([&] {
              ism::write_dataset(folder / "a.json", set);
          }).ends_with("expected names in UTF-8, got other bytes"));
    CHECK_FALSE(fs::exists(folder / "a.json"));
    set.category_ids.clear();
    CHECK(error_message([&] { (void)ism::select_classes(set, set.class_names); }) ==
          "category ids of the data set: expected 1, got 0");
}

TEST_CASE("A file name with a zero or line breaks gives messages of one line") {
    const std::string head = R"({"categories":[],"annotations":[],"images":[{"id":1,"width":20,"height":16,)";
    CHECK(error_message<FileError>([&] { (void)dataset_of(head + R"("file_name":"a\u0000b"}]})"); }) ==
          "file 'a.json', image with id 1: file name: expected no NUL character, got 'a\\x00b'");
    CHECK(ism::file_text("a\nb") == "file 'a\\x0ab'");
}
