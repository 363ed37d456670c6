// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "support/catch.hpp"

#include "ism/evaluate/confusion_plot.hpp"
#include "ism/evaluate/plot.hpp"
#include "ism/show/mask_path.hpp"
#include "ism/show/report.hpp"
#include "ism/show/report_detections.hpp"
#include "ism/show/svg.hpp"

namespace {

// "" where every tag is closed in its turn, quotes are closed and no <, > or bare & stands in text
std::string markup_fault(std::string_view page) {
    std::vector<std::string> open;
    for (std::size_t i = 0; i < page.size();) {
        if (page[i] == '&') {
            const std::size_t end = page.find(';', i);
            if (end == page.npos || end - i > 6) return "bare &";
        }
        if (page[i] == '>') return "bare >";
        if (page[i] != '<') {
            ++i;
            continue;
        }
        std::size_t end = i + 1;
        for (char quote = 0; end < page.size() && (quote != 0 || page[end] != '>'); ++end) {
            if (quote != 0 && page[end] == quote)
                quote = 0;
            else if (quote == 0 && page[end] == '"')
                quote = '"';
            if (page[end] == '<') return "< in a tag";
        }
        if (end >= page.size()) return "open tag or quote";
        const std::string_view tag = page.substr(i + 1, end - i - 1);
        i = end + 1;
        if (tag.empty()) return "empty tag";
        std::size_t length = tag[0] == '/' ? 1 : 0;
        while (length < tag.size() && std::isalnum(static_cast<unsigned char>(tag[length])) != 0) ++length;
        const std::string name(tag.substr(0, length));
        if (tag[0] == '!' || name == "meta" || name == "link" || name == "input" || tag.back() == '/')
            continue;
        if (tag[0] == '/') {
            if (open.empty() || "/" + open.back() != name) return "<" + name + "> not in its turn";
            open.pop_back();
        } else if (name.empty()) {
            return "tag without a name";
        } else {
            open.push_back(name);
            if (name == "style") i = page.find("</style>", i);
        }
    }
    return open.empty() ? "" : "<" + open.back() + "> not closed";
}

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != text.npos;
}

const std::string nasty = "<script>\"a\" & 'b'</script>\x01\xff";

}  // namespace

TEST_CASE("The checker of markup finds faults") {
    CHECK(markup_fault("<p class=\"a\">x &amp; y<br/></p>").empty());
    for (const char* bad :
         {"<p>", "<p></q>", "</p>", "<p>a < b</p>", "<p>a > b</p>", "<p>a & b</p>", "<p x=\"></p>"})
        CHECK_FALSE(markup_fault(bad).empty());
}

TEST_CASE("Escaped text has no markup and no broken bytes") {
    CHECK(ism::escape_markup("<a href=\"x\">'&'\n") == "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;\n");
    CHECK(ism::escape_markup("Gr\xC3\xB6\xC3\x9F"
                             "e \xE2\x82\xAC \xF0\x9F\x98\x80") ==
          "Gr\xC3\xB6\xC3\x9F"
          "e \xE2\x82\xAC \xF0\x9F\x98\x80");
    CHECK(ism::escape_markup(std::string_view("a\0b\x1b", 4)) == "a b ");
    const std::string mark = "\xEF\xBF\xBD";
    CHECK(ism::escape_markup("\xff<") == mark + "&lt;");
    CHECK(ism::escape_markup("\xC3") == mark);                        // breaks off
    CHECK(ism::escape_markup("\xC0\xBC") == mark + mark);             // a < written too long
    CHECK(ism::escape_markup("\xED\xA0\x80") == mark + mark + mark);  // half of a pair
    CHECK(ism::escape_markup("\xC3<") == mark + "&lt;");
}

TEST_CASE("A plot puts points where its axes say and is well-formed") {
    const ism::Plot plot{.title = nasty,
                         .x_label = nasty,
                         .y_label = nasty,
                         .curves = {{.name = nasty, .x = {0, 1}, .y = {0, 1}, .color = {255, 0, 16}},
                                    {.name = "gap", .x = {0, NAN, 0.5, 1}, .y = {1, 1, 0.5, 0.5}},
                                    {.name = "empty"}},
                         .width_px = 472,
                         .height_px = 382};
    const std::string svg = ism::to_svg(plot);
    CHECK(markup_fault(svg).empty());
    CHECK_FALSE(contains(svg, "<script"));
    CHECK(contains(svg, "d=\"M58 334h0L458 34\""));            // axes 400×300 at (58, 34)
    CHECK(contains(svg, "d=\"M58 34h0M258 184h0L458 184\""));  // not joined over the gap
    CHECK(contains(svg, "stroke=\"#ff0010\""));
    CHECK(contains(svg, ">0.2</text>"));
    CHECK(contains(svg, ">0</text>"));
    CHECK_FALSE(contains(svg, "nan"));
}

TEST_CASE("Ticks are round numbers within the axis") {
    CHECK(ism::detail::axis_ticks({0, 1}).size() == 6);
    CHECK(ism::detail::axis_ticks({1e16, 1e16 + 2}).size() <=
          11);  // where numbers lie farther apart than ticks
    CHECK(ism::detail::axis_ticks({0, 50}) == std::vector<double>{0, 10, 20, 30, 40, 50});
    CHECK(ism::detail::axis_ticks({-3, 4}) == std::vector<double>{-2, 0, 2, 4});
    for (const double span : {1e-7, 0.3, 1.7, 23.0, 4e6}) {
        const auto ticks = ism::detail::axis_ticks({0.1 * span, 1.1 * span});
        CHECK(ticks.size() >= 2);
        CHECK(ticks.size() <= 7);
        CHECK(ticks.front() >= 0.0999 * span);
        CHECK(ticks.back() <= 1.1001 * span);
    }
}

TEST_CASE("Plots with impossible axes or curves are refused") {
    ism::Plot plot{};
    CHECK(markup_fault(ism::to_svg(plot)).empty());
    plot.x_range = {1, 1};
    CHECK_THROWS_AS(ism::to_svg(plot), ism::Error);
    plot.x_range = {0, std::numeric_limits<double>::infinity()};
    CHECK_THROWS_AS(ism::to_svg(plot), ism::Error);
    plot.x_range = {}, plot.width_px = 10;
    CHECK_THROWS_AS(ism::to_svg(plot), ism::Error);
    plot.width_px = 480, plot.curves = {{.name = "a", .x = {0, 1}, .y = {0}}};
    CHECK_THROWS_AS(ism::to_svg(plot), ism::Error);
}

TEST_CASE("Precision-recall curves begin at recall 0 and leave out classes without objects") {
    const ism::Box box{0, 0, 10, 10};
    const std::vector<std::string> names{"cup", "pot"};
    const std::vector<ism::TruthObject> truth{{0, 0, box}, {1, 0, box}};
    const std::vector<ism::FoundObject> found{{0, 0, box, 0.9}};
    const ism::Plot plot = ism::precision_recall_plot(ism::evaluate(truth, found, 2, names, ism::IouRule{}));
    REQUIRE(plot.curves.size() == 1);
    CHECK(plot.curves[0].x == std::vector<double>{0, 0.5});
    CHECK(plot.curves[0].y == std::vector<double>{1, 1});
    CHECK(plot.curves[0].name == "AP 50.0 %, cup");
    const ism::Rgb color{1, 2, 3};
    const auto colored = ism::precision_recall_plot(
        ism::evaluate(truth, found, 2, std::vector<std::string>{std::string(100, 'n'), "pot"},
                      ism::IouRule{}),
        "t", std::span(&color, 1));
    CHECK(colored.curves[0].color == color);
    CHECK(colored.curves[0].name.size() < 45);
}

TEST_CASE("Of many classes the plot shows the mean and the worst") {
    const ism::Box box{0, 0, 10, 10};
    std::vector<std::string> names;
    std::vector<ism::TruthObject> truth;
    std::vector<ism::FoundObject> found;
    for (std::uint32_t c = 0; c < 20; ++c) {
        names.push_back("c" + std::to_string(c));
        truth.push_back({c, c, box}), truth.push_back({c + 20, c, box});
        found.push_back({c, c, box, 0.9});
        if (c != 7) found.push_back({c + 20, c, box, 0.8});
    }
    const ism::Plot plot = ism::precision_recall_plot(ism::evaluate(truth, found, 40, names, ism::IouRule{}));
    REQUIRE(plot.curves.size() == 6);
    CHECK(plot.curves[0].name == "AP 97.5 %, mean of 20 classes");
    CHECK(plot.curves[0].y[50] == 1);
    CHECK(plot.curves[0].y[51] == Approx(0.95));
    CHECK(plot.curves[1].name == "AP 50.0 %, c7");
    CHECK(plot.curves[1].color == ism::class_color(7));
    CHECK(plot.curves[2].name == "AP 100.0 %, c0");
}

TEST_CASE("A confusion matrix is darkest where all images of a class are") {
    const ism::Confusion matrix{.class_count = 2, .counts = {0, 7, 0, 1, 2, 1}};
    const std::vector<std::string> names{nasty, "pot"};
    const std::string svg = ism::to_svg(matrix, names, nasty);
    CHECK(markup_fault(svg).empty());
    const std::string dark = "fill=\"" + ism::hex_color({20, 60, 130}) + "\"";
    const std::size_t first = svg.find(dark);
    REQUIRE(first != svg.npos);
    CHECK(svg.find(dark, first + 1) == svg.npos);
    CHECK(svg.find(">7</text>", first) < svg.find("<rect", first));  // it tells the seven images
    CHECK(contains(svg, "fill=\"" + ism::hex_color(ism::mix(ism::white, {20, 60, 130}, 0.25)) + "\""));
    CHECK_THROWS_AS(ism::to_svg(matrix, std::vector<std::string>{"cup"}, ""), ism::Error);
}

TEST_CASE("A report is one well-formed page whose text cannot become markup") {
    const auto picture = std::make_shared<ism::ReportPicture>(
        ism::ReportPicture{.file = {'f', 'o', 'o'}, .width = 40, .height = 20});
    ism::ReportFigure figure = ism::picture_figure(picture, nasty);
    figure.labels = {{{1, 2, 3, 4}, nasty, {255, 0, 0}}}, figure.link = nasty;
    const ism::Report report{
        .title = nasty,
        .summary = {{nasty, nasty}},
        .legend = {{nasty, ism::black}, {"labels", ism::white, true}},
        .layers = {{"mask", nasty}},
        .sections = {
            {.title = nasty,
             .parts = {ism::ReportText{nasty}, ism::ReportTable{nasty, {nasty, "b"}, {{nasty, "2"}, {}}},
                       figure, ism::ReportGallery{{figure, figure}},
                       ism::ReportPlot{ism::to_svg(ism::Plot{})}},
             .sections = {
                 {.title = "inner", .parts = {ism::ReportText{"b"}}, .folded = true, .id = nasty}}}}};
    const std::string html = ism::to_html(report);
    CHECK(markup_fault(html).empty());
    CHECK_FALSE(contains(html, "<script"));
    CHECK_FALSE(contains(html, "href=\"http"));
    CHECK(contains(html, "href=\"data:image/jpeg;base64,Zm9v\""));
    CHECK(html.find("Zm9v") == html.rfind("Zm9v"));  // three figures, one picture
    CHECK(contains(html, "<summary><h3>inner</h3></summary>"));
    CHECK(contains(html, "name=\"viewport\""));
    CHECK(contains(html, "prefers-color-scheme: dark"));
    CHECK(markup_fault(ism::to_html(ism::Report{})).empty());

    ism::LinkedPictures linked{.folder = "r-images"};
    const std::string page = ism::to_html(report, &linked);
    REQUIRE(linked.files.size() == 1);
    CHECK(linked.files[0].bytes == picture->file);
    CHECK(contains(page, "href=\"r-images/1.jpg\""));
    linked.folder.clear();  // a second page, with pictures beside it
    CHECK(contains(ism::to_html(report, &linked), "href=\"2.jpg\""));
    CHECK(linked.files.size() == 2);
    CHECK_FALSE(contains(page, "base64"));
    CHECK_THROWS_AS(ism::to_html({.title = "", .sections = {{.parts = {ism::ReportFigure{}}}}}), ism::Error);
}

TEST_CASE("Words on a figure evade each other on a small screen, in any script") {
    std::vector<ism::ReportLabel> labels(5, {{100, 100, 80, 90}, "\xE6\x9D\xAF 83 %", {}});
    labels.push_back({{-50, -20, 80, 90}, "cup", {}});
    const ism::Box part{0, 0, 640, 480};
    const auto places = ism::detail::place_labels(part, labels, 330);
    REQUIRE(places.size() == labels.size());
    std::vector<ism::Box> taken;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double y = places[i].top / 100 * 330 * 480 / 640 - (places[i].above ? 20 : 0);
        taken.push_back({places[i].left / 100 * 330, y, ism::detail::words_width_px(labels[i].text), 20});
        CHECK(taken[i].x >= 0);
        CHECK(taken[i].y >= 0);
        CHECK(taken[i].x + taken[i].width <= 330);
    }
    for (const std::size_t a : {0, 1, 2, 5})  // there are but four places at a box
        for (std::size_t b = 0; b < a; ++b) CHECK(ism::intersection(taken[a], taken[b]).area() == 0);
    CHECK(ism::detail::words_width_px("\xE6\x9D\xAF") > ism::detail::words_width_px("c"));
}

TEST_CASE("Pictures of a report stay small") {
    ism::RgbImage noise(900, 600);
    std::uint32_t state = 1;
    for (ism::Rgb& pixel : noise.pixels()) {
        state = state * 1664525u + 1013904223u;
        pixel = {std::uint8_t(state >> 24), std::uint8_t(state >> 16), std::uint8_t(state >> 8)};
    }
    const auto picture = ism::report_picture(noise, {.side_px = 720, .most_bytes = 30000});
    CHECK(picture->file.size() <= 30000);
    CHECK(picture->width == 900);
    CHECK(ism::report_picture(noise, {.most_bytes = 0})->file.size() > 100000);
    CHECK_THROWS_AS(ism::report_picture(ism::RgbImage{}), ism::Error);
    CHECK_THROWS_AS(ism::report_picture(noise, {.side_px = 2}), ism::Error);
    CHECK_THROWS_AS(ism::encode_jpeg(noise, 0), ism::Error);
}

TEST_CASE("Outlines of a mask enclose its pixels and leave out its holes") {
    ism::Mask mask(6, 5);
    for (int y = 1; y < 4; ++y)
        for (int x = 1; x < 5; ++x) mask(x, y) = 1;
    CHECK(ism::mask_path(mask) == "M1 1l4 0 0 3 -4 0z");
    CHECK(ism::mask_path(mask, 10, 20) == "M11 21l4 0 0 3 -4 0z");
    mask(2, 2) = 0;
    CHECK(ism::mask_path(mask, 0, 0, 0) == "M1 1l4 0 0 3 -4 0zM2 2l0 1 1 0 0 -1z");
    mask(0, 0) = 1;  // touches at a corner alone
    CHECK(ism::mask_outlines(mask).size() == 3);
    CHECK(ism::mask_path(ism::Mask(3, 3)).empty());
    CHECK(ism::mask_path(ism::Mask{}).empty());
    // the area of the rings is that of the figure, whatever the mask
    std::uint32_t state = 7;
    for (int round = 0; round < 50; ++round) {
        ism::Mask random(9, 7);
        int pixels = 0;
        for (auto& pixel : random.pixels())
            state = state * 1664525u + 1013904223u, pixel = state >> 31, pixels += pixel;
        int area = 0;
        for (const auto& ring : ism::mask_outlines(random))
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
                area += a.x * b.y - a.y * b.x;
            }
        CHECK(area == 2 * pixels);
    }
}

TEST_CASE("Columns of words may break, those of numbers stand to the right") {
    const std::string html = ism::to_html(
        {.sections = {
             {.parts = {ism::ReportTable{.header = {"class", "objects", "most like", "AP %"},
                                         .rows = {{"7 up", "12", "", "-"}, {"x", "3", "Cup 7", "98.2"}}}}}}});
    CHECK(contains(html,
                   "<th scope=\"col\" class=\"text\">class</th><th scope=\"col\">objects</th>"
                   "<th scope=\"col\" class=\"text\">most like</th><th scope=\"col\">AP %</th>"));
    CHECK(contains(html, "<td class=\"text\">7 up</td><td>12</td><td class=\"text\"></td><td>-</td>"));
}

TEST_CASE("Words on the colour of any class have a contrast of 4.5 or more") {
    for (std::size_t c = 0; c < 200; ++c) {
        const double ground = ism::luminance(ism::class_color(c));
        const double ink = ism::luminance(ism::ink_on(ism::class_color(c)));
        CHECK((std::max(ground, ink) + 0.05) / (std::min(ground, ink) + 0.05) >= 4.5);
    }
    CHECK(ism::luminance(ism::white) == Approx(1));
}

TEST_CASE("What is found on a crowd is shown as ignored, and alternative text tells what labels tell") {
    ism::Detections detections;
    detections.objects.resize(3);
    for (ism::Detection& one : detections.objects) one.box = {10, 4, 12, 8};
    const std::vector<std::string> names{"cup"};
    const std::vector<ism::ShownLabel> labels{{.box = {2, 2, 5, 5}, .missed = true},
                                              {.box = {8, 2, 30, 15}, .ignored = true}};
    const std::vector<ism::Judged> judged{ism::Judged::right, ism::Judged::wrong, ism::Judged::ignored};
    const ism::DetectionPages pages = ism::detection_pages("a.png", ism::RgbImage(40, 20), detections, names,
                                                           {.labels = labels, .judged = judged});
    REQUIRE(pages.mistakes.size() == 2);  // what is missed, and what is wrong
    const std::string html =
        ism::to_html({.legend = ism::detection_legend(names, true, true), .sections = {pages.section}});
    CHECK(
        contains(html, "aria-label=\"a.png, 3 detections: ✓ cup 0, ✗ cup 0, cup 0, ignored, missed: cup\""));
    CHECK(contains(html, ">cup 0, ignored</span>"));
    CHECK(contains(html, "class=\"truth ignored\""));
    CHECK(contains(html, "></i>ignored: a crowd, or difficult</li>"));
    CHECK_FALSE(contains(ism::to_html({.legend = ism::detection_legend(names, true)}), "ignored:"));
}

TEST_CASE("The section on an image tells why each detection was found") {
    ism::Detections detections;
    detections.features = {{.x = 12, .y = 8, .scale = 2, .depth_m = 0.75f}, {.x = 20, .y = 9, .scale = 1}};
    ism::Detection object;
    object.score = 0.625, object.centre = {16, 8}, object.box = {10, 4, 12, 8};
    object.depth_m = 0.75, object.position_m = ism::Point3{0.1, -0.2, 0.75};
    object.support = {{.feature = 0, .word = 41, .weight = 0.5f},
                      {.feature = 1, .word = 7, .weight = 0.3f},
                      {.feature = 0, .word = 7, .weight = 0.3f},
                      {.feature = 1, .word = 9, .weight = 0.1f}};
    detections.objects = {object, object, object};

    const ism::ReportTable words = ism::word_table(object, 2);
    REQUIRE(words.rows.size() == 2);
    CHECK(words.rows[0] == std::vector<std::string>{"7", "2", "0.6", "50 %"});
    CHECK(words.rows[1][0] == "41");
    const ism::ReportTable features = ism::feature_table(detections, object, 5);
    REQUIRE(features.rows.size() == 2);
    CHECK(features.rows[0] == std::vector<std::string>{"12, 8", "2", "0.75", "0.8"});
    CHECK(features.rows[1][2] == "\u2013");
    const ism::ReportTable facts = ism::fact_table(object);
    CHECK(facts.rows[1][1] == "4 by 2 features through 3 words");
    CHECK(facts.rows[2][1] == "0.1, -0.2, 0.75 m");

    const std::vector<std::string> names{nasty};
    ism::Mask mask(40, 20);
    for (int y = 5; y < 12; ++y)
        for (int x = 25; x < 35; ++x) mask(x, y) = 1;
    const std::vector<ism::ShownLabel> labels = {
        {.class_index = 0, .box = {25, 5, 10, 7}, .mask = mask, .missed = true},
        {.class_index = 0, .box = object.box}};
    const std::vector<ism::Judged> judged = {ism::Judged::right, ism::Judged::wrong, ism::Judged::wrong};
    const auto pages_of = [&] {
        return ism::detection_pages("a.png", ism::RgbImage(40, 20), detections, names,
                                    {.rows = 2, .labels = labels, .judged = judged, .id = "image-1"});
    };
    ism::DetectionPages pages = pages_of();
    CHECK(pages.section.sections.size() == 2);
    CHECK(contains(pages.section.sections[0].title, "✗"));  // wrong ones first
    REQUIRE(pages.mistakes.size() == 3);
    CHECK(contains(pages.mistakes[0].caption, "missed: "));
    CHECK(pages.mistakes[0].link == "#image-1");
    const auto html_of = [](const ism::DetectionPages& shown) {
        return ism::to_html(
            {.title = "t", .sections = {shown.section, {.parts = {ism::ReportGallery{shown.mistakes}}}}});
    };
    const std::string html = html_of(pages);
    CHECK(markup_fault(html).empty());
    CHECK(contains(html, "3 detections"));
    CHECK(contains(html, "Explained below: 2 of 3"));
    CHECK(contains(html, "d=\"M25 5l10 0 0 7 -10 0z\""));
    CHECK(contains(html, "aria-label=\"a.png, 3 detections"));
    CHECK_FALSE(contains(html, "against"));
    for (ism::Detection& one : detections.objects) one.cells = {{2, 1, false}, one.box, {0.5f, -0.25f}};
    const std::string with_cells = html_of(pages_of());
    CHECK(markup_fault(with_cells).empty());
    CHECK(contains(with_cells, "template, score 0.25"));
    CHECK(contains(with_cells, ism::hex_color(ism::detail::for_color)));
    CHECK(contains(with_cells, ism::hex_color(ism::detail::against_color)));
    const auto picture = ism::report_picture(ism::RgbImage(40, 20));
    CHECK_THROWS_WITH(ism::cells_figure(picture, {0, 0, 40, 20}, object),
                      Catch::Contains("cells of a detection"));
    CHECK(markup_fault(
              ism::to_html({.title = "",
                            .summary = {},
                            .sections = {ism::detection_pages("", ism::RgbImage(4, 4), {}, names).section}}))
              .empty());
}

TEST_CASE("A label of a class without a name is refused") {
    const std::vector<std::string> names{"cup"};
    const std::vector<ism::ShownLabel> labels{{.class_index = 1, .box = {2, 2, 5, 5}, .missed = true}};
    CHECK_THROWS_WITH(ism::detection_pages("a.png", ism::RgbImage(40, 20), {}, names, {.labels = labels}),
                      "class of a label: expected below 1, got 1");
}
