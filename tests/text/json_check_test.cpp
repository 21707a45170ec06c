// JSON is looked at before a parser takes stack and memory for it.
#include "engine/text/json_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/error_of.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string nested(int depth, const std::string& open, const std::string& close) {
    std::string text;
    for (int n = 0; n < depth; ++n) text += open;
    for (int n = 0; n < depth; ++n) text += close;
    return text;
}

std::string errorFor(const std::string& text) {
    return test::errorOf([&] { checkJson(text, "a.json", "save it again"); });
}

TEST(JsonCheck, DepthIsBoundedWhateverIsNested) {
    for (const auto& [open, close] :
         {std::pair("[", "]"), {"{\"a\":", "}"}, {"[{\"\\\"\":", "}]"}, {" [ 1 , ", "]"}}) {
        const int each = open[0] == '[' && open[1] == '{' ? 2 : 1;
        EXPECT_EQ(errorFor(nested(kDeepestJson / each, open, close)), "no error") << open;
        EXPECT_THAT(
            errorFor(nested(kDeepestJson / each + 1, open, close)),
            AllOf(HasSubstr("a.json:byte "), HasSubstr("at most 100 deep"), HasSubstr("save it again")))
            << open;
        EXPECT_THAT(errorFor(nested(200000, open, "")), HasSubstr("at most 100 deep")) << open;
    }
}

// What has ended counts no more, nor does what stands in texts.
TEST(JsonCheck, WideIsNotDeep) {
    std::string wide = "[";
    for (int n = 0; n < 1000; ++n) wide += "[[1],{\"a\":[2]}],";
    EXPECT_EQ(errorFor(wide + "3]"), "no error");
    EXPECT_EQ(errorFor("[\"" + std::string(1000, '[') + "\\\"" + std::string(1000, '{') + "\"]"), "no error");
    EXPECT_EQ(errorFor("[\"\\\\\",[]]"), "no error");
    // A text that ends behind its backslashes: what follows is no text.
    EXPECT_THAT(errorFor("[\"\\\\\"," + std::string(1000, '[')), HasSubstr("at most 100 deep"));
}

TEST(JsonCheck, DamagedTextsAreLeftToTheParser) {
    for (const char* text : {"", "\"", "\"\\", "]]]]", "}{", "[\"a"}) EXPECT_EQ(errorFor(text), "no error");
}

TEST(JsonCheck, ValuesAreHeldAgainstTheMemory) {
    std::string many = "[";
    for (int n = 0; n < 1000000; ++n) many += "0,";
    many += "0]";
    EXPECT_EQ(errorFor(many), "no error");
    setenv("STEREONAV_MEMORY", "100e6", 1);
    const std::string error = errorFor(many), few = errorFor("[1,2,3]");
    unsetenv("STEREONAV_MEMORY");
    EXPECT_THAT(error, AllOf(HasSubstr("a.json: needs 130 MB of memory"), HasSubstr("save it again")));
    EXPECT_EQ(few, "no error");
}

}  // namespace
}  // namespace stereonav
