// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cctype>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "support/catch.hpp"

#include "ism/evaluate/confusion_plot.hpp"
#include "ism/evaluate/plot.hpp"
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
        if (tag[0] == '!' || name == "meta" || name == "img" || tag.back() == '/') continue;
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

std::string base64_of(std::string_view text) {
    return ism::base64(std::vector<std::uint8_t>(text.begin(), text.end()));
}

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

TEST_CASE("Base64 of RFC 4648's examples") {
    CHECK(base64_of("").empty());
    CHECK(base64_of("f") == "Zg==");
    CHECK(base64_of("fo") == "Zm8=");
    CHECK(base64_of("foo") == "Zm9v");
    CHECK(base64_of("foob") == "Zm9vYg==");
    CHECK(base64_of("fooba") == "Zm9vYmE=");
    CHECK(base64_of("foobar") == "Zm9vYmFy");
    CHECK(base64_of("\xfb\xff\xbf") == "+/+/");
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
    CHECK(plot.curves[0].name == "cup, AP 50.0 %");
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
    const ism::Report report{
        .title = nasty,
        .summary = {{nasty, nasty}},
        .sections = {
            {.title = nasty,
             .parts = {ism::ReportText{nasty}, ism::ReportTable{nasty, {nasty, "b"}, {{nasty, "2"}, {}}},
                       ism::ReportImage{nasty, {'f', 'o', 'o'}}, ism::ReportPlot{ism::to_svg(ism::Plot{})}},
             .sections = {{.title = "inner", .parts = {ism::ReportText{"b"}}, .folded = true}}}}};
    const std::string html = ism::to_html(report);
    CHECK(markup_fault(html).empty());
    CHECK_FALSE(contains(html, "<script"));
    CHECK_FALSE(contains(html, "src=\"http"));
    CHECK(contains(html, "src=\"data:image/png;base64,Zm9v\""));
    CHECK(contains(html, "<details><summary><h3>inner</h3></summary>"));
    CHECK(contains(html, "name=\"viewport\""));
    CHECK(markup_fault(ism::to_html(ism::Report{})).empty());
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
    const ism::ReportSection section =
        ism::detection_section("a.png", ism::RgbImage(40, 20), detections, names, {.rows = 2});
    CHECK(section.sections.size() == 2);
    const std::string html = ism::to_html({.title = "t", .sections = {section}});
    CHECK(markup_fault(html).empty());
    CHECK(contains(html, "3 detections"));
    CHECK(contains(html, "the strongest 2 of 3"));
    CHECK_FALSE(contains(html, "against"));
    detections.objects[0].cells = {{2, 1, false}, {0.5f, -0.25f}};
    const std::string with_cells =
        ism::to_html({.title = "t",
                      .sections = {ism::detection_section("a.png", ism::RgbImage(40, 20), detections, names,
                                                          {.rows = 2})}});
    CHECK(markup_fault(with_cells).empty());
    CHECK(contains(with_cells, "<title>0.5</title>"));
    CHECK(contains(with_cells, "<title>-0.25</title>"));
    CHECK(contains(with_cells, ">against</text>"));
    CHECK(contains(with_cells, "together 0.25"));
    CHECK_THROWS_WITH(ism::cells_plot(ism::RgbImage(40, 20), object),
                      Catch::Contains("cells of a detection"));
    CHECK(
        markup_fault(ism::to_html({.title = "",
                                   .summary = {},
                                   .sections = {ism::detection_section("", ism::RgbImage(4, 4), {}, names)}}))
            .empty());
}
