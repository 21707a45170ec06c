#include "engine/text/number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace stereonav {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(TextNumber, WholeTextOrNothing) {
    EXPECT_EQ(numberOf("-1.5e3"), -1500.0);
    EXPECT_EQ(numberOf(".5"), 0.5);
    EXPECT_EQ(numberOf("1."), 1.0);
    EXPECT_EQ(numberOf("inf"), kInf);
    EXPECT_EQ(numberOf("-Infinity"), -kInf);
    ASSERT_TRUE(numberOf("nan"));
    EXPECT_TRUE(std::isnan(*numberOf("nan")));
    for (const char* text : {"", " 1", "1 ", "1,5", "x", "1x", "0x10", "--1", "+-1", "-+1", ".", "e5", "-"}) {
        EXPECT_FALSE(numberOf(text)) << text;
        EXPECT_FALSE(numberOf(text, Plus::Allowed)) << text;
    }
    EXPECT_FALSE(numberOf("+1"));
    EXPECT_EQ(numberOf("+1", Plus::Allowed), 1.0);
}

TEST(TextNumber, BeyondAllDoubles) {
    for (const std::string text : {"1e309", "-1e309", "1e99999999999999999999", "0.001e312"}) {
        EXPECT_FALSE(numberOf(text)) << text;
        std::string_view rest = text;
        EXPECT_EQ(takeNumber(rest), text[0] == '-' ? -kInf : kInf) << text;
        EXPECT_TRUE(rest.empty()) << text;
    }
    EXPECT_FALSE(numberOf(std::string(400, '7')));
    for (const std::string text : {"1e-400", "-1e-400", "1e-99999999999999999999", "1000e-420"}) {
        ASSERT_TRUE(numberOf(text)) << text;
        EXPECT_EQ(*numberOf(text), 0.0) << text;
        EXPECT_EQ(std::signbit(*numberOf(text)), text[0] == '-') << text;
    }
    EXPECT_EQ(numberOf("0." + std::string(400, '0') + "1"), 0.0);
}

TEST(TextNumber, TakesWhatTheTextBeginsWith) {
    std::string_view rest = "1.5\\-2e1mm";
    EXPECT_EQ(takeNumber(rest), 1.5);
    EXPECT_EQ(rest, "\\-2e1mm");
    EXPECT_FALSE(takeNumber(rest));
    EXPECT_EQ(rest, "\\-2e1mm");
    rest.remove_prefix(1);
    EXPECT_EQ(takeNumber(rest), -20.0);
    EXPECT_EQ(rest, "mm");
    rest = "+3 4";
    EXPECT_FALSE(takeNumber(rest));
    EXPECT_EQ(takeNumber(rest, Plus::Allowed), 3.0);
    EXPECT_EQ(rest, " 4");
}

TEST(TextNumber, WholeNumbersOfAType) {
    EXPECT_EQ(wholeOf<int>("-12"), -12);
    EXPECT_EQ(wholeOf<std::uint8_t>("255"), 255);
    EXPECT_FALSE(wholeOf<std::uint8_t>("256"));
    EXPECT_FALSE(wholeOf<std::uint8_t>("-1"));
    EXPECT_EQ(wholeOf<std::int64_t>("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
    EXPECT_FALSE(wholeOf<std::int64_t>("9223372036854775808"));
    for (const char* text : {"", "+", "1.0", "1 ", " 1", "0x1"})
        EXPECT_FALSE(wholeOf<int>(text, Plus::Allowed)) << text;
    EXPECT_FALSE(wholeOf<int>("+1"));
    EXPECT_EQ(wholeOf<int>("+1", Plus::Allowed), 1);
    std::string_view rest = "640 +X 480";
    EXPECT_EQ(takeWhole<int>(rest), 640);
    EXPECT_EQ(rest, " +X 480");
}

}  // namespace
}  // namespace stereonav
