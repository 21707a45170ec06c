// Transfer functions: values, what is refused and how, and the file.
#include "engine/volume/transfer_function.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "tests/support/error_of.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TransferFunction ramp() {
    return TransferFunction({{-100, {0, 0, 0}, 0}, {0, {1, 0.5f, 0}, 0.8}, {50, {1, 1, 1}, 1}}, 0.002,
                            "test");
}

using test::errorOf;

// A file in a folder of its own, removed with it.
class TransferFile {
public:
    explicit TransferFile(const std::string& text) {
        std::filesystem::create_directories(mFolder);
        std::ofstream(path(), std::ios::binary) << text;
    }
    ~TransferFile() { std::filesystem::remove_all(mFolder); }
    std::filesystem::path path() const { return mFolder / "wall.transfer"; }

private:
    std::filesystem::path mFolder =
        std::filesystem::temp_directory_path() / ("stereonav_transfer_" + std::to_string(getpid()));
};

std::string errorOfText(const std::string& text) {
    const TransferFile file(text);
    return errorOf([&] { readTransferFunction(file.path()); });
}

TEST(TransferFunction, IsLinearBetweenPointsAndConstantBeyond) {
    const TransferFunction function = ramp();
    EXPECT_DOUBLE_EQ(function.at(-1e9).opacity, 0);
    EXPECT_DOUBLE_EQ(function.at(-100).opacity, 0);
    EXPECT_DOUBLE_EQ(function.at(-50).opacity, 0.4);
    EXPECT_FLOAT_EQ(function.at(-50).color.x, 0.5f);
    EXPECT_FLOAT_EQ(function.at(-50).color.y, 0.25f);
    EXPECT_DOUBLE_EQ(function.at(0).opacity, 0.8);
    EXPECT_DOUBLE_EQ(function.at(25).opacity, 0.9);
    EXPECT_FLOAT_EQ(function.at(25).color.z, 0.5f);
    EXPECT_DOUBLE_EQ(function.at(kInfinity).opacity, 1);
    EXPECT_DOUBLE_EQ(function.at(-kInfinity).opacity, 0);
    EXPECT_TRUE(TransferFunction().empty());
    EXPECT_DOUBLE_EQ(TransferFunction().at(3).opacity, 0);
}

TEST(TransferFunction, KeepsLargeValuesFinite) {
    const TransferFunction wide({{-1e308, {0, 0, 0}, 0}, {1e308, {1, 1, 1}, 1}}, 1, "test");
    EXPECT_NEAR(wide.at(0).opacity, 0.5, 1e-12);
    EXPECT_NEAR(wide.at(5e307).opacity, 0.75, 1e-12);
}

TEST(TransferFunction, ALayerOfTheReferenceLengthTakesItsOpacity) {
    const TransferFunction function = ramp();
    for (const double value : {-100.0, -80.0, -50.0, 0.0, 10.0, 40.0})
        EXPECT_NEAR(1 - std::exp(-function.extinction(value) * 0.002), function.at(value).opacity, 1e-12)
            << value;
    EXPECT_NEAR(function.extinction(60), -std::log(1e-6) / 0.002, 1e-3);  // opacity 1 stays finite
    EXPECT_EQ(function.extinction(-200), 0.0);
}

TEST(TransferFunction, KnowsWhereSomethingIsVisible) {
    const auto range = [](std::vector<double> opacities) {
        std::vector<TransferPoint> points;
        for (const double o : opacities) points.push_back({10.0 * points.size(), glm::vec3(1.0f), o});
        const auto r = TransferFunction(points, 1, "test").visibleRange();
        return std::pair(r.lowest, r.highest);
    };
    EXPECT_EQ(range({0, 0, 0.5, 0, 0}), std::pair(10.0, 30.0));
    EXPECT_EQ(range({0, 0, 0.5}), std::pair(10.0, kInfinity));
    EXPECT_EQ(range({0.1, 0, 0, 0}), std::pair(-kInfinity, 10.0));
    EXPECT_EQ(range({0.1}), std::pair(-kInfinity, kInfinity));
    EXPECT_GT(range({0, 0}).first, range({0, 0}).second);
    EXPECT_GT(TransferFunction().visibleRange().lowest, TransferFunction().visibleRange().highest);
}

TEST(TransferFunction, RefusesBadPoints) {
    const auto error = [](std::vector<TransferPoint> points, double length = 0.001) {
        return errorOf([&] { TransferFunction(points, length, "wall.transfer"); });
    };
    const glm::vec3 white(1.0f);
    EXPECT_EQ(error({{0, white, 0}, {1, white, 1}}), "no error");
    EXPECT_THAT(
        error({{5, white, 0}, {5, white, 1}}),
        AllOf(HasSubstr("wall.transfer:point 2: expected a value above 5, got 5"), Not(HasSubstr("\n"))));
    EXPECT_THAT(error({{5, white, 0}, {4, white, 1}}), HasSubstr("point 2: expected a value above 5, got 4"));
    EXPECT_THAT(error({{kNaN, white, 0}}), HasSubstr("point 1: expected a finite value, got nan"));
    EXPECT_THAT(error({{kInfinity, white, 0}}), HasSubstr("point 1: expected a finite value, got inf"));
    EXPECT_THAT(error({{0, white, 1.5}}), HasSubstr("point 1: expected an opacity in 0 to 1, got 1.5"));
    EXPECT_THAT(error({{0, white, kNaN}}), HasSubstr("expected an opacity in 0 to 1, got nan"));
    EXPECT_THAT(error({{0, {1, -0.5f, 1}, 1}}), HasSubstr("expected a colour in 0 to 1, got -0.5"));
    for (const double length : {0.0, -1.0, kNaN, kInfinity})
        EXPECT_THAT(error({{0, white, 1}}, length), HasSubstr("expected a positive reference length"))
            << length;
}

TEST(TransferFunction, ReadsCommentsBlankLinesAndSrgb) {
    const TransferFile file(
        "# a wall\r\n\nreference_mm 2.5 # of tissue\n -10 0 0 0 0\n\t40 1 0.5 0 1e-1#end");
    const TransferFunction function = readTransferFunction(file.path());
    EXPECT_DOUBLE_EQ(function.referenceLength(), 0.0025);
    ASSERT_EQ(function.points().size(), 2u);
    EXPECT_DOUBLE_EQ(function.points()[1].value, 40);
    EXPECT_DOUBLE_EQ(function.points()[1].opacity, 0.1);
    EXPECT_NEAR(function.points()[1].color.y, 0.2140411f, 1e-6);  // IEC 61966-2-1 of a half
    const TransferFile plain("0 1 1 1 1");
    EXPECT_DOUBLE_EQ(readTransferFunction(plain.path()).referenceLength(), 0.001);
}

TEST(TransferFunction, RefusesBadFilesInOneLine) {
    const auto expectError = [](const std::string& text, const std::string& what) {
        EXPECT_THAT(errorOfText(text),
                    AllOf(HasSubstr("wall.transfer:"), HasSubstr(what), Not(HasSubstr("\n"))));
    };
    expectError("", "expected at least one point, found none");
    expectError("# nothing\n\n", "expected at least one point, found none");
    expectError("reference_mm 1\n", "expected at least one point, found none");
    expectError("0 1 1 1 0\n0 1 1 1 1\n", ":2: expected a value above 0, got 0");
    expectError("\n\n0 1 1 1\n", ":3: expected 5 numbers, got 4");
    expectError("0 1 1 1 1 1\n", ":1: expected 5 numbers, got 6");
    expectError("nan 1 1 1 1\n", ":1: expected a finite value, got nan");
    expectError("0 1 1 1 nan\n", ":1: expected an opacity in 0 to 1, got nan");
    expectError("0 1 2 1 1\n", ":1: expected a colour in 0 to 1, got 2");
    expectError("0 1 1e300 1 1\n", ":1: expected a colour in 0 to 1");
    expectError("0 1 1 1 -0.1\n", ":1: expected an opacity in 0 to 1, got -0.1");
    expectError("1e999 1 1 1 1\n", ":1: expected a number, got \"1e999\"");
    expectError("0 1 1 1 0.5x\n", ":1: expected a number, got \"0.5x\"");
    expectError("0,1,1,1,1\n", ":1: expected 5 numbers, got 1");
    expectError("reference_mm 0\n0 1 1 1 1\n", ":1: expected a positive reference length, got 0 mm");
    expectError("reference_mm\n0 1 1 1 1\n", ":1: expected 1 number after \"reference_mm\", got 0");
    expectError("reference_mm 1\nreference_mm 1\n0 1 1 1 1\n", ":2: \"reference_mm\" is given twice");
    EXPECT_THAT(errorOf([] { readTransferFunction("/nonexistent/wall.transfer"); }),
                HasSubstr("can not be opened"));
}

}  // namespace
}  // namespace stereonav
