// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/evaluate/evaluate.hpp"
#include "ism/evaluate/table.hpp"

using ism::ScoredVerdict;

namespace {

// the definitions word for word: cut at each score in turn and count
struct Oracle {
    double ap = 0, best_f1 = 0;
};
Oracle oracle(const std::vector<ScoredVerdict>& verdicts, std::size_t objects) {
    std::set<double> cuts;
    for (const ScoredVerdict& v : verdicts) cuts.insert(v.score);
    std::vector<std::pair<double, double>> recall_precision;
    Oracle result;
    for (const double cut : cuts) {
        double kept = 0, right = 0;
        for (const ScoredVerdict& v : verdicts)
            if (v.score >= cut) kept += 1, right += v.right;
        recall_precision.emplace_back(right / double(objects), right / kept);
        const double p = right / kept, r = right / double(objects);
        if (p + r > 0) result.best_f1 = std::max(result.best_f1, 2 * p * r / (p + r));
    }
    // each of the `objects` steps of recall counts its best precision at that recall or beyond
    for (std::size_t i = 1; i <= objects; ++i) {
        double best = 0;
        for (const auto& [recall, precision] : recall_precision)
            if (recall > (double(i) - 0.5) / double(objects)) best = std::max(best, precision);
        result.ap += best / double(objects);
    }
    return result;
}

std::vector<ScoredVerdict> falling(const std::string& verdicts) {
    std::vector<ScoredVerdict> result;
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        result.push_back({1.0 - double(i) / 100, verdicts[i] == '+'});
    return result;
}

}  // namespace

TEST_CASE("Average precision, equal error rate and F1 of curves counted by hand") {
    // + − + over two objects: precision 1 up to recall ½, then 2/3
    const auto curve = ism::precision_recall(falling("+-+"), 2);
    REQUIRE(curve.points.size() == 3);
    CHECK(curve.points[1].precision == 0.5);
    CHECK(curve.points[2].recall == 1.0);
    CHECK(ism::average_precision(curve) == Approx(0.5 * 1 + 0.5 * 2 / 3));
    CHECK(ism::precision_at_equal_recall(curve) == 0.5);
    CHECK(ism::best_f1(curve).f1 == Approx(0.8));
    CHECK(ism::best_f1(curve).score == Approx(0.98));

    // − + over two objects: the second is never found
    const auto late = ism::precision_recall(falling("-+"), 2);
    CHECK(ism::average_precision(late) == Approx(0.25));
    CHECK(ism::precision_at_equal_recall(late) == 0.5);
    CHECK(ism::best_f1(late).f1 == 0.5);

    const auto all = ism::precision_recall(falling("+++--"), 3);
    CHECK(ism::average_precision(all) == 1.0);
    CHECK(ism::precision_at_equal_recall(all) == 1.0);
    CHECK(ism::best_f1(all).f1 == 1.0);
}

TEST_CASE("With fewer detections than objects the equal error rate is the recall of all of them") {
    CHECK(ism::precision_at_equal_recall(ism::precision_recall(falling("+-+"), 8)) == 0.25);
}

TEST_CASE("Figures do not depend on the order of detections of one score") {
    std::vector<ScoredVerdict> verdicts{{0.9, true}, {0.5, true}, {0.5, false}, {0.5, false}, {0.1, true}};
    std::set<double> ap, eer;
    const auto before = [](const ScoredVerdict& a, const ScoredVerdict& b) { return a.right < b.right; };
    std::sort(verdicts.begin(), verdicts.end(), before);
    do {
        const auto curve = ism::precision_recall(verdicts, 3);
        ap.insert(ism::average_precision(curve)), eer.insert(ism::precision_at_equal_recall(curve));
    } while (std::next_permutation(verdicts.begin(), verdicts.end(), before));
    CHECK(ap.size() == 1);
    REQUIRE(eer.size() == 1);
    // three are kept: the first and two of the three of score 0.5, of which 2/3 are right on average
    CHECK(*eer.begin() == Approx((1 + 2.0 / 3) / 3));
    CHECK(*ap.begin() == Approx((1 + 0.6 + 0.6) / 3));
}

TEST_CASE("Figures agree with their definitions on random detections, with and without ties") {
    ism::Random random(11);
    for (int round = 0; round < 300; ++round) {
        const std::size_t objects = 1 + random.index(20);
        const double levels = round % 2 == 0 ? 1e9 : 6;
        std::vector<ScoredVerdict> verdicts;
        std::size_t right = 0;
        for (std::uint64_t i = random.index(40); i > 0; --i) {
            const bool hit = right < objects && random.uniform() < 0.5;
            right += hit;
            verdicts.push_back({std::floor(random.uniform() * levels) / levels, hit});
        }
        const auto curve = ism::precision_recall(verdicts, objects);
        const Oracle expected = oracle(verdicts, objects);
        REQUIRE(ism::average_precision(curve) == Approx(expected.ap).margin(1e-12));
        REQUIRE(ism::best_f1(curve).f1 == Approx(expected.best_f1).margin(1e-12));
        if (levels > 6 && verdicts.size() >= objects) {  // no ties: count the first `objects` of them
            std::sort(verdicts.begin(), verdicts.end(), [](auto a, auto b) { return a.score > b.score; });
            double hits = 0;
            for (std::size_t i = 0; i < objects; ++i) hits += verdicts[i].right;
            REQUIRE(ism::precision_at_equal_recall(curve) == Approx(hits / double(objects)).margin(1e-12));
        }
    }
}

TEST_CASE("Of cuts with the same F1 the best one is that with the highest score") {
    const auto curve = ism::precision_recall(falling("+--+"), 2);  // F1 2/3 at 1 and at 4 detections
    CHECK(ism::best_f1(curve).f1 == Approx(2.0 / 3));
    CHECK(ism::best_f1(curve).score == 1.0);
}

TEST_CASE("Scores that are not numbers have no curve") {
    CHECK_THROWS_AS(ism::precision_recall(std::vector<ScoredVerdict>{{std::nan(""), true}}, 1), ism::Error);
}

TEST_CASE("Nothing found scores zero, nothing to find scores nothing") {
    const auto none_found = ism::precision_recall({}, 5);
    CHECK(ism::average_precision(none_found) == 0);
    CHECK(ism::precision_at_equal_recall(none_found) == 0);
    CHECK(ism::best_f1(none_found).f1 == 0);
    CHECK(std::isnan(ism::best_f1(none_found).score));

    const auto none_there = ism::precision_recall(falling("--"), 0);
    CHECK(std::isnan(ism::average_precision(none_there)));
    CHECK(std::isnan(ism::precision_at_equal_recall(none_there)));
    CHECK(std::isnan(ism::best_f1(none_there).f1));
    CHECK_THROWS_AS(ism::precision_recall(falling("+"), 0), ism::Error);
}

TEST_CASE("A confusion matrix counts the class of each image's most confident detection") {
    const ism::Box box{0, 0, 10, 10};
    const std::vector<ism::TruthObject> truth{{0, 0, box}, {1, 0, box}, {2, 1, box}, {3, 1, box}};
    const std::vector<ism::FoundObject> found{
        {0, 1, box, 0.2}, {0, 0, box, 0.3}, {1, 1, box, 0.9}, {2, 1, {500, 0, 1, 1}, 0.1}, {2, 0, box, 0.05}};
    const ism::Confusion matrix = ism::confusion(truth, found, 4, 2);
    CHECK(matrix.counts == std::vector<std::size_t>{1, 1, 0, 0, 1, 1});
    CHECK(matrix.count(1, 2) == 1);
    CHECK(matrix.images(1) == 2);
    CHECK(matrix.accuracy() == 0.5);
    std::vector<ism::FoundObject> equal{
        {0, 0, box, 0.5}, {0, 1, box, 0.5}, {0, 1, box, 0.5}, {1, 0, box, 0.5}};
    for (int order = 0; order < 2; ++order) {  // of equal scores, that which is wrong
        CHECK(ism::confusion(truth, equal, 4, 2).counts == std::vector<std::size_t>{1, 1, 0, 0, 0, 2});
        std::reverse(equal.begin(), equal.end());
    }
    CHECK_THROWS_AS(ism::confusion(truth, found, 5, 2), ism::Error);
    CHECK_THROWS_AS(ism::confusion(truth, found, 4, 1), ism::Error);
    CHECK(ism::one_object_each(truth, 4));
    std::vector<ism::TruthObject> crowded = truth;
    crowded[2].ignore = true;  // an image of a crowd is of no class
    CHECK_FALSE(ism::one_object_each(crowded, 4));
}

TEST_CASE("An evaluation of two classes counted by hand, with masks and a class without objects") {
    const ism::Box box{0, 0, 10, 10}, far{100, 0, 10, 10};
    const std::vector<std::string> names{"cup", "bowl", "pot"};
    const std::vector<ism::TruthObject> truth{{0, 0, box}, {0, 0, far}, {1, 1, box}, {1, 1, far, true}};
    const std::vector<ism::FoundObject> found{{0, 0, box, 0.9},   // right
                                              {0, 0, box, 0.8},   // again: wrong
                                              {1, 1, far, 0.7},   // ignored
                                              {1, 1, box, 0.6},   // right
                                              {1, 2, box, 0.5},   // no pot anywhere
                                              {0, 0, far, 0.4}};  // right
    std::vector<std::size_t> asked;
    const auto overlap = [&](std::size_t f, std::size_t t) {
        asked.push_back(f * 10 + t);
        return f == 0 ? 0.8 : f == 5 ? 0.6 : std::nan("");
    };
    const ism::Evaluation result = ism::evaluate(truth, found, 2, names, ism::IouRule{}, overlap);
    REQUIRE(result.classes.size() == 3);
    CHECK(result.classes[0].figures.ap == Approx((1 + 2.0 / 3) / 2));
    CHECK(result.classes[0].figures.eer == 0.5);
    CHECK(result.classes[0].figures.mask_iou == Approx(0.7));
    CHECK(result.classes[1].figures.ap == 1);
    CHECK(result.classes[1].detections == 1);
    CHECK(std::isnan(result.classes[1].figures.mask_iou));
    CHECK(std::isnan(result.classes[2].figures.ap));
    CHECK(result.mean.ap == Approx((result.classes[0].figures.ap + 1) / 2));
    CHECK(result.mean.mask_iou == Approx(0.7));
    CHECK_FALSE(result.confusion.has_value());
    CHECK(asked == std::vector<std::size_t>{0, 51, 32});
    CHECK(result.judgements[2].verdict == ism::Verdict::ignored);

    CHECK_THROWS_AS(ism::evaluate(truth, found, 1, names, ism::IouRule{}), ism::Error);
    CHECK_THROWS_AS(ism::evaluate(truth, found, 2, std::span(names).first(2), ism::IouRule{}), ism::Error);
}

TEST_CASE("The table has aligned columns, percentages and a dash where nothing was measured") {
    const ism::Box box{0, 0, 10, 10};
    const std::vector<std::string> names{"cup", "tea_box"};
    const std::vector<ism::TruthObject> truth{{0, 0, box}};
    const std::vector<ism::FoundObject> found{{0, 0, box, 0.9}};
    const std::string table = ism::to_table(ism::evaluate(truth, found, 1, names, ism::IouRule{}));
    CHECK(table ==
          "class    objects  detections  right   AP %  EER %   F1 %  mask IoU %\n"
          "cup            1           1      1  100.0  100.0  100.0           -\n"
          "tea_box        0           0      0      -      -      -           -\n"
          "mean           1           1      1  100.0  100.0  100.0           -\n"
          "\n"
          "accuracy 100.0 %: images whose best detection is of the right class, wherever it lies\n"
          "\n"
          "true \\ detected as  cup  tea_box  none\n"
          "cup                   1        0     0\n"
          "tea_box               0        0     0\n");
}

TEST_CASE("Long names and control characters leave the table readable") {
    const ism::Box box{0, 0, 10, 10};
    const std::string longest(200, 'n');
    const std::vector<std::string> names{longest + "1", "a\nb\x1b[31m", longest + "2"};
    const std::vector<ism::TruthObject> truth{{0, 0, box}, {1, 1, box}};
    const std::string table = ism::to_table(ism::evaluate(truth, {}, 2, names, ism::IouRule{}));
    CHECK(table.find("a\\x0ab\\x1b[31m ") != std::string::npos);
    CHECK(table.find('\x1b') == std::string::npos);
    std::size_t longest_line = 0;
    for (std::size_t begin = 0, end = 0; (end = table.find('\n', begin)) != std::string::npos;
         begin = end + 1)
        longest_line = std::max(longest_line, end - begin);
    CHECK(longest_line < 120);
    CHECK(ism::shortened("abcdefghij", 6) == "abc…ij");
    CHECK(ism::shortened("abcdef", 6) == "abcdef");
    CHECK(ism::shortened("ääääöö", 4) == "ää…ö");
    CHECK(ism::shortened(names[0], 32) != ism::shortened(names[2], 32));
}

TEST_CASE("Of many classes only the confusions that happened are told, the worst first") {
    const ism::Box box{0, 0, 10, 10};
    std::vector<std::string> names;
    std::vector<ism::TruthObject> truth;
    std::vector<ism::FoundObject> found;
    for (std::uint32_t c = 0; c < 30; ++c) {
        names.push_back("c" + std::to_string(c));
        for (int k = 0; k < 2; ++k) truth.push_back({truth.size(), c, box});
    }
    const auto table = [&] {
        return ism::to_table(ism::evaluate(truth, found, truth.size(), names, ism::IouRule{}));
    };
    for (const ism::TruthObject& t : truth) found.push_back({t.image, t.class_index, box, 0.5});
    CHECK(table().ends_with("\nno class was taken for another\n"));
    found[0].class_index = 7;                         // an image of c0
    found[2].class_index = found[3].class_index = 9;  // both of c1
    CHECK(
        table().ends_with("\n\n"
                          "true -> detected as  images\n"
                          "c1 -> c9                  2\n"
                          "c0 -> c7                  1\n"));
    found.resize(2);
    CHECK(table().ends_with("... and 10 more\n"));  // 29 classes of none and c0 -> c7
}
