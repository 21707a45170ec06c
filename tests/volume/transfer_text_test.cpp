// Transfer functions as one word: the same as their file, back and forth, and what is refused.
#include "engine/volume/transfer_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_of.h"

namespace stereonav {
namespace {

using test::errorOf;
using testing::AllOf;
using testing::HasSubstr;

std::string problemOf(const std::string& text) {
    return errorOf([&] { transferFromCurve(text, "--transfer"); });
}

TEST(TransferText, IsTheFileInOneWord) {
    const TransferFunction file = parseTransferFunction(
        "reference_mm 2 # a comment\n-300 0.95 0.86 0.55 0\n-120.5 0.95 0.86 0.55 0.15\n1e3 1 0.5 0 1\n",
        "file");
    const TransferFunction curve = transferFromCurve(
        "curve:reference_mm:2,-300:0.95:0.86:0.55:0,-120.5:0.95:0.86:0.55:0.15,1e3:1:0.5:0:1", "text");
    EXPECT_EQ(file, curve) << "to the last bit";
    EXPECT_EQ(transferFromCurve("curve:0:1:1:1:0.5", "text").referenceLength(), 0.001);
}

TEST(TransferText, ComesBackAsItWasWritten) {
    for (const char* text : {"curve:0:1:1:1:0.5", "curve:-1000:0:0:0:0,3071:0.1234:0.9999:1:1",
                             "curve:reference_mm:0.333333333,1e-300:0.5:0.5:0.5:0.123456789,1e+300:1:0:1:1"})
        EXPECT_EQ(curveTextOf(transferFromCurve(text, "text")), text);
}

TEST(TransferText, KnowsItsOwn) {
    EXPECT_TRUE(isCurveText("curve:"));
    for (const char* text : {"", "curve", "tissue", "./curve:x", "curves.txt"})
        EXPECT_FALSE(isCurveText(text)) << text;
}

TEST(TransferText, SaysWhatIsWrongAndWhere) {
    EXPECT_THAT(problemOf("curve:"),
                AllOf(HasSubstr("--transfer"), HasSubstr("part 1"), HasSubstr("5 numbers")));
    EXPECT_THAT(problemOf("curve:0:1:1:1"), HasSubstr("expected 5 numbers, got 4"));
    EXPECT_THAT(problemOf("curve:0:1:1:1:0:0"), HasSubstr("expected 5 numbers, got 6"));
    EXPECT_THAT(problemOf("curve:0:1:1:1:0,"), AllOf(HasSubstr("part 2"), HasSubstr("got 1")));
    EXPECT_THAT(problemOf("curve:0:1:1:x:0"), HasSubstr("expected a number, got \"x\""));
    EXPECT_THAT(problemOf("curve:nan:1:1:1:0"), HasSubstr("finite"));
    EXPECT_THAT(problemOf("curve:inf:1:1:1:0"), HasSubstr("finite"));
    EXPECT_THAT(problemOf("curve:0:1:1:1:nan"), HasSubstr("an opacity in 0 to 1, got nan"));
    EXPECT_THAT(problemOf("curve:0:1:1:1:1.01"), HasSubstr("an opacity in 0 to 1, got 1.01"));
    EXPECT_THAT(problemOf("curve:0:1:-0.1:1:1"), HasSubstr("a colour in 0 to 1, got -0.1"));
    EXPECT_THAT(problemOf("curve:5:1:1:1:0,5:1:1:1:1"),
                AllOf(HasSubstr("part 2"), HasSubstr("above 5, got 5")));
    EXPECT_THAT(problemOf("curve:5:1:1:1:0,4:1:1:1:1"), HasSubstr("above 5, got 4"));
    EXPECT_THAT(problemOf("curve:reference_mm:1"), HasSubstr("at least one point"));
    for (const char* length : {"0", "-1", "nan", "inf"})
        EXPECT_THAT(problemOf(std::string("curve:reference_mm:") + length + ",0:1:1:1:0"),
                    HasSubstr("positive reference length"))
            << length;
    EXPECT_THAT(problemOf("curve:reference_mm,0:1:1:1:0"), HasSubstr("1 number"));
    EXPECT_THAT(problemOf("curve:reference_mm:1,reference_mm:2,0:1:1:1:0"), HasSubstr("given twice"));
}

TEST(TransferText, HasALargestLength) {
    std::string text = "curve:0:1:1:1:0";
    for (std::size_t n = 1; n < kMostCurvePoints; ++n) text += "," + std::to_string(n) + ":1:1:1:0";
    EXPECT_EQ(transferFromCurve(text, "text").points().size(), kMostCurvePoints);
    EXPECT_THAT(problemOf(text + ",1000:1:1:1:0"), AllOf(HasSubstr("at most 256"), HasSubstr("file")));
}

}  // namespace
}  // namespace stereonav
