// Documents as text: what a string may hold by RFC 8259, and nothing that a terminal obeys.
#include "engine/text/json_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stereonav {
namespace {

using Json = nlohmann::ordered_json;

TEST(JsonText, IsReadBackAsItWas) {
    const Json json{{"a\u009b", "x\x1b[2J\x7f\u0085\u202e\u2066\u2028\ufeff\U000e0041\U0001f3d4 Höhe\n"},
                    {"list", {1, -2.5, nullptr, true}}};
    for (const int indent : {-1, 0, 2}) {
        const std::string text = jsonText(json, indent);
        EXPECT_EQ(Json::parse(text), json);
        for (const std::string hidden :
             {"\x1b", "\x7f", "\u0085", "\u009b", "\u202e", "\u2066", "\u2028", "\ufeff", "\U000e0041"})
            EXPECT_EQ(text.find(hidden), std::string::npos);
        EXPECT_NE(text.find("\U0001f3d4 Höhe"), std::string::npos) << "text stays text";
    }
    EXPECT_EQ(jsonText(Json("\u009b"), -1), "\"\\u009b\"");
    EXPECT_EQ(jsonText(Json("\U000e0041"), -1), "\"\\udb40\\udc41\"");
    EXPECT_EQ(jsonText(json, 2).substr(0, 4), "{\n  ") << "laid out";
}

TEST(JsonText, OfAnyBytesIsOneDocument) {
    for (const std::string name : {"a\xff.tif", "\xc3", "\xed\xa0\x80", "\x80\x9b"}) {
        const std::string text = jsonText(Json{{"name", name}}, 1);
        const Json read = Json::parse(text, nullptr, false);
        ASSERT_TRUE(read.is_object()) << text;
        EXPECT_NE(read.at("name").get<std::string>().find("\ufffd"), std::string::npos);
    }
}

TEST(JsonText, ReadersProblemsAreInPlainWords) {
    const auto problemOf = [](const std::string& text, auto use) -> std::string {
        try {
            use(Json::parse(text));
        } catch (const Json::exception& error) {
            return jsonProblem(error.what());
        }
        return "none";
    };
    const auto nothing = [](const Json&) {};
    EXPECT_EQ(problemOf("{\"asset\":`", nothing), "is no JSON from line 1, column 10 on");
    EXPECT_EQ(problemOf("{\n\n  \x1b[2J}", nothing), "is no JSON from line 3, column 3 on");
    EXPECT_EQ(problemOf("", nothing), "is no JSON from line 1, column 1 on");
    EXPECT_EQ(problemOf("{\"a\": \"\xff\"}", nothing), "is no JSON from line 1, column 8 on");
    EXPECT_EQ(problemOf("[1e999]", nothing), "is JSON of another shape than expected");
    EXPECT_EQ(problemOf("[1]", [](const Json& json) { (void)json.at("a"); }),
              "is JSON of another shape than expected");
    EXPECT_EQ(problemOf("{}", [](const Json& json) { (void)json.at("a"); }),
              "is JSON of another shape than expected");
    EXPECT_EQ(jsonProblem("[json.exception.parse_error.112] parse error at byte 4: "), "is no JSON");
    EXPECT_EQ(jsonProblem("no buffer"), "no buffer") << "what is not the reader's";
    EXPECT_EQ(jsonProblem(""), "");
}

}  // namespace
}  // namespace stereonav
