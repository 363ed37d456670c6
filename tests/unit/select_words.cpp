// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/train/select_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/train/vote_agreement.hpp"

namespace {

ism::Occurrence seen(std::uint32_t object, std::uint32_t class_index, float x, float scale = 1) {
    ism::Occurrence o;
    o.object = object, o.class_index = class_index, o.x = x, o.scale = scale;
    return o;
}

/// Two classes of two objects each. Word 0 is of class 0 and always at one place, word 1 of class 0 and
/// anywhere, word 2 of both classes at one place, word 3 on a single object.
ism::ShapeModel four_words() {
    ism::ShapeModel shapes;
    shapes.class_names = {"a", "b"};
    for (const std::uint32_t c : {0u, 0u, 1u, 1u}) {
        ism::TrainingObject object;
        object.class_index = c;
        shapes.objects.push_back(object);
    }
    shapes.occurrences = {{seen(0, 0, 20), seen(1, 0, 20),                              //
                           seen(0, 0, -90), seen(1, 0, 90),                             //
                           seen(0, 0, 5), seen(1, 0, 5), seen(2, 1, 5), seen(3, 1, 5),  //
                           seen(2, 1, 0), seen(2, 1, 0)},
                          {0, 2, 4, 8, 10}};
    return shapes;
}

ism::Model model_of(const ism::ShapeModel& shapes) {
    ism::Model model;
    model.shapes = shapes;
    model.channels = {{{.detector = "d", .descriptor = "e", .dimension = 1}, ism::Codebook(1, 3)},
                      {{.detector = "d", .descriptor = "f", .dimension = 2}, ism::Codebook(2, 4)}};
    for (std::uint32_t w = 0; w < 3; ++w)
        model.channels[0].codebook.push_back({std::vector{float(w)}, float(w * w), 10 + w});
    model.channels[1].codebook.push_back({std::vector{3.0f, 4.0f}, 25, 13});
    return model;
}

}  // namespace

TEST_CASE("the share of right votes follows from place, scale and class by hand") {
    const auto agreement = [](const std::vector<ism::Occurrence>& word) {
        ism::ShapeModel shapes;
        shapes.class_names = {"a", "b"};
        shapes.occurrences.push_back(word);
        return ism::vote_agreement(shapes, 1).front();
    };
    CHECK(agreement({seen(0, 0, 20), seen(1, 0, 20)}) == Approx(1));
    CHECK(agreement({seen(0, 0, 20)}) == 0);  // only the own object
    CHECK(agreement({seen(0, 0, 20), seen(0, 0, 20)}) == 0);
    // half a bandwidth beside: 1 - 1/4, both ways
    CHECK(agreement({seen(1, 0, 0), seen(0, 0, float(ism::X::bandwidth / 2))}) == Approx(0.75));
    // 1.2 times the scale: the vote is for 24 - 20 * 1.2 = 0, of scale 1.2; and the other way of 1 / 1.2
    const double u = 0.2 / ism::Scale::bandwidth, v = (1 - 1 / 1.2) / ism::Scale::bandwidth;
    CHECK(agreement({seen(1, 0, 20), seen(0, 0, 24, 1.2f)}) == Approx(1 - u * u / 2 - v * v / 2));
    // each of three features has a vote of the right class and one of the other, or both of the other; the
    // class with more occurrences counts less
    const double right = (1.0 / 2) / (1.0 / 2 + 1);
    CHECK(agreement({seen(0, 0, 5), seen(1, 0, 5), seen(2, 1, 5)}) == Approx(right));
}

TEST_CASE("vote agreement is that of comparing all occurrences of a word with all") {
    ism::Random random(3);
    ism::ShapeModel shapes;
    shapes.class_names = {"a", "b", "c"};
    for (const std::uint32_t count : {1u, 0u, 7u, 150u, 1200u}) {
        std::vector<ism::Occurrence> word;
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto object = std::uint32_t(random.index(30));
            ism::Occurrence o =
                seen(object, object % 3, float(40 * random.normal()), float(std::exp(0.4 * random.normal())));
            o.y = float(40 * random.normal());
            if (i % 5 == 4) {  // as another, for another object
                o = word.back();
                o.object = object, o.class_index = object % 3;
            }
            word.push_back(o);
        }
        shapes.occurrences.push_back(word);
    }
    std::vector<double> of_class(3, 0);
    for (const ism::Occurrence& o : shapes.occurrences.values()) of_class[o.class_index] += 1;
    const auto agreement = ism::vote_agreement(shapes, 2);
    REQUIRE(agreement.size() == 5);
    CHECK(agreement[4] > 0);
    for (std::size_t w = 0; w < 5; ++w) {
        double sum = 0;
        for (const ism::Occurrence& f : shapes.occurrences[w]) {
            double all = 0, right = 0;
            for (const ism::Occurrence& o : shapes.occurrences[w]) {
                if (o.object == f.object) continue;
                all += 1 / of_class[o.class_index];
                const double ratio = double(f.scale) / o.scale;
                const double x = (f.x - o.x * ratio) / ism::X::bandwidth;
                const double y = (f.y - o.y * ratio) / ism::Y::bandwidth;
                const double s = (ratio - 1) / ism::Scale::bandwidth;
                if (o.class_index == f.class_index)
                    right += std::max(0.0, 1 - x * x - y * y - s * s) / of_class[o.class_index];
            }
            if (all > 0) sum += right / all / of_class[f.class_index];
        }
        CHECK(agreement[w] == Approx(sum).epsilon(1e-5));
    }
}

TEST_CASE("words whose votes agree are worth most; gain and number do not see the place") {
    const ism::ShapeModel shapes = four_words();
    const auto agreement = ism::vote_agreement(shapes);
    REQUIRE(agreement.size() == 4);
    // class 0 has 6 occurrences, class 1 has 4
    CHECK(agreement[0] == Approx(2.0 / 6));
    CHECK(agreement[1] == 0);
    // a feature of class 0 has one other vote of 1/6 for its class and two of 1/4 against
    const double right_a = (1.0 / 6) / (1.0 / 6 + 2.0 / 4), right_b = (1.0 / 4) / (1.0 / 4 + 2.0 / 6);
    CHECK(agreement[2] == Approx(2.0 / 6 * right_a + 2.0 / 4 * right_b));
    CHECK(agreement[3] == 0);

    CHECK(ism::word_occurrences(shapes) == std::vector<double>{2, 2, 4, 2});
    const auto gain = ism::word_information_gain(shapes);
    CHECK(gain[0] == Approx(gain[1]));
    CHECK(gain[2] < gain[0]);
    CHECK(ism::vote_agreement(shapes, 1) == ism::vote_agreement(shapes, 2));
    CHECK(ism::vote_agreement({}).empty());
}

TEST_CASE("the best words are the most worth, of equal ones the first, in rising order") {
    const std::vector<double> worth = {1, 5, 3, 5, 3};
    CHECK(ism::best_words(worth, 3) == std::vector<std::uint32_t>{1, 2, 3});
    CHECK(ism::best_words(worth, 9).size() == 5);
    CHECK(ism::words_worth(worth, 3) == std::vector<std::uint32_t>{1, 2, 3, 4});
}

TEST_CASE("a model keeps the chosen words of each channel with their occurrences") {
    const ism::Model model = model_of(four_words());
    REQUIRE(model.words() == 4);
    const std::vector<std::uint32_t> chosen = {0, 2, 3};
    const ism::Model kept = ism::keep_words(model, chosen);
    REQUIRE(kept.channels.size() == 2);
    const ism::Codebook& codebook = kept.channels[0].codebook;
    REQUIRE(codebook.size() == 2);
    CHECK(codebook[1].mean[0] == 2);
    CHECK(codebook[1].mean_sq_length == 4);
    CHECK(codebook[1].size == 12);
    CHECK(codebook.max_sq_distance() == 3);
    CHECK(kept.channels[1].codebook[0].mean[1] == 4);
    CHECK(kept.channels[1].features.descriptor == "f");
    REQUIRE(kept.shapes.occurrences.size() == 3);
    CHECK(kept.shapes.occurrences[1].size() == 4);
    CHECK(kept.shapes.occurrences[1][3].object == 3);
    CHECK(kept.shapes.objects.size() == 4);
    for (std::size_t w = 0; w < 3; ++w) {
        double sum = 0;
        for (const ism::Occurrence& o : kept.shapes.occurrences[w]) sum += double(o.weight);
        CHECK(sum == Approx(1));  // also where a feature was at words that are gone
    }
    CHECK_THROWS_WITH(ism::keep_words(model, std::vector<std::uint32_t>{0, 1}),
                      Catch::Contains("words to keep of channel 1"));
    ism::Model judged = model;
    judged.box_classifier.push_back({}, 0);
    CHECK_THROWS_WITH(ism::keep_words(judged, chosen), Catch::Contains("without classifier"));
    ism::Model metric = model;
    metric.shapes.frames.emplace_back();
    CHECK_THROWS_WITH(ism::keep_words(metric, chosen), Catch::Contains("a model of words alone"));
}
