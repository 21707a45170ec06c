// Facts of a scene in each print: lines, rows, JSON.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/scene/type/held_facts.h"
#include "engine/scene/facts_json.h"

namespace stereonav {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(Facts, AreSaidToPeopleAsTheyAreWithoutWords) {
    const Facts facts{factForAll("a", std::int64_t{-3}, "whole", "", "mm"),
                      factForAll("b", 0.25, "half of half"),
                      factForAll("c", true, "on"),
                      factForAll("d", "word", "said"),
                      factForAll("e", FactIntegers{3, 4, 5}, "size"),
                      factForAll("f", FactNumbers{0.5, 2}, "", "", "m"),
                      factForAll("g", FactWords{"x", "y"}, "names"),
                      factForAll("h", 1.0, "own words", "about one", "m"),
                      factForAll("i", "", "nothing")};
    EXPECT_EQ(linesOf(facts),
              "  whole       -3 mm\n"
              "  half of half0.25\n"
              "  on          yes\n"
              "  said        word\n"
              "  size        3 x 4 x 5\n"
              "              0.5 x 2 m\n"
              "  names       x, y\n"
              "  own words   about one\n"
              "  nothing     \n");
}

TEST(Facts, StandInOnePrintOrBoth) {
    const Facts facts{factForJson("hidden", 2.0, "m"), factForText("words", "for people"),
                      factForAll("both", std::int64_t{1}, "both")};
    EXPECT_EQ(linesOf(facts), "  words       for people\n  both        1\n");
    EXPECT_THAT(rowsOf(facts), ElementsAre(Pair("words", "for people"), Pair("both", "1")));
    EXPECT_EQ(jsonOf(facts).dump(), R"({"hidden":2.0,"both":1})");
}

TEST(Facts, OfGroupsFollowTheirHeadingAndLists) {
    const Facts facts{
        factForJson("plain", Facts{factForAll("n", std::int64_t{1}, "in plain")}),
        factForAll("medium", Facts{factForAll("n", std::int64_t{2}, "in medium")}, "medium"),
        factForAll("parts",
                   std::vector<Facts>{{factForAll("n", std::int64_t{3}, "")}, {factForText("", "four")}},
                   "parts")};
    EXPECT_EQ(linesOf(facts),
              "  in plain    1\n"
              "medium\n"
              "  in medium   2\n"
              "  parts       2\n"
              "              3\n"
              "              four\n");
    EXPECT_THAT(rowsOf(facts), ElementsAre(Pair("in plain", "1"), Pair("in medium", "2"), Pair("parts", "2"),
                                           Pair("", "3"), Pair("", "four")));
    EXPECT_EQ(jsonOf(facts).dump(), R"({"plain":{"n":1},"medium":{"n":2},"parts":[{"n":3},{}]})");
}

TEST(Facts, KeepTheirKindInJson) {
    const Facts facts{factForJson("none", {}),
                      factForJson("flag", false),
                      factForJson("sizes", FactIntegers{}),
                      factForJson("lengths", FactNumbers{1, 0.5}),
                      factForJson("words", FactWords{"\"a\""}),
                      factForJson("group", Facts{}),
                      factForJson("groups", std::vector<Facts>{})};
    EXPECT_EQ(jsonOf(facts).dump(), R"({"none":null,"flag":false,"sizes":[],"lengths":[1.0,0.5],)"
                                    R"("words":["\"a\""],"group":{},"groups":[]})");
    EXPECT_EQ(jsonOf(Facts{}).dump(), "{}");
}

TEST(Facts, SayWhatHoldsMemoryOnce) {
    Facts facts;
    EXPECT_EQ(addHeld(facts, {{"values", 20'000'000}, {"cells", 12'100'000}}),
              "32.1 MB: values 20.0, cells 12.1");
    EXPECT_EQ(jsonOf(facts).dump(), R"({"bytes":32100000,"held":{"values":20000000,"cells":12100000}})");
    EXPECT_EQ(linesOf(facts), "");
}

}  // namespace
}  // namespace stereonav
