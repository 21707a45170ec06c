// A transfer function that is being edited: ordered after every change, and defined by its text.
#include "app/view/transfer_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/volume/transfer_text.h"

namespace stereonav {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();

TransferCurve curveOf(const std::string& text) {
    return TransferCurve(transferFromCurve(text, "test"));
}
TransferCurve ramp() {
    return curveOf("curve:0:0:0:0:0,100:1:1:1:1");
}
// Expects a text that --transfer takes, and that is the same after reading.
void expectWhole(const TransferCurve& curve) {
    EXPECT_EQ(curveOf(curve.text()).text(), curve.text());
}

TEST(TransferCurve, KeepsWhatItIsMadeOf) {
    for (const char* text :
         {"curve:reference_mm:2,-300:0.95:0.86:0.55:0,300:1:0.97:0.9:0.95", "curve:5:0.1:0.2:0.3:0.4"})
        EXPECT_EQ(curveOf(text).text(), text);
    EXPECT_TRUE(TransferCurve(TransferFunction()).empty());
}

TEST(TransferCurve, GetsPointsThatLieOnIt) {
    TransferCurve curve = ramp();
    EXPECT_EQ(curve.insert(50, 0.25), 1u);
    EXPECT_EQ(curve.points()[1].value, 50);
    EXPECT_EQ(curve.points()[1].opacity, 0.25);
    EXPECT_NEAR(curve.points()[1].color[0], ramp().at(50).color[0], 1e-6);
    EXPECT_EQ(curve.insert(-10, 0.5), 0u);
    EXPECT_EQ(curve.insert(1e9, 2), 4u);
    EXPECT_EQ(curve.points()[4].opacity, 1) << "at most";
    expectWhole(curve);
}

TEST(TransferCurve, HasOnePointAtAValue) {
    TransferCurve curve = ramp();
    EXPECT_EQ(curve.insert(100, 0.25), 1u);
    EXPECT_EQ(curve.insert(0, 0.5), 0u);
    ASSERT_EQ(curve.points().size(), 2u);
    EXPECT_EQ(curve.points()[0].opacity, 0.5);
    EXPECT_EQ(curve.points()[1].opacity, 0.25);
    expectWhole(curve);
}

TEST(TransferCurve, PointsDoNotPassEachOther) {
    TransferCurve curve = curveOf("curve:0:1:1:1:0,10:1:1:1:0.5,20:1:1:1:1");
    curve.move(1, 1e6, -3);
    EXPECT_LT(curve.points()[1].value, 20);
    EXPECT_NEAR(curve.points()[1].value, 20, 1e-6);
    EXPECT_EQ(curve.points()[1].opacity, 0);
    expectWhole(curve);
    curve.move(1, -1e6, 7);
    EXPECT_GT(curve.points()[1].value, 0);
    EXPECT_EQ(curve.points()[1].opacity, 1);
    expectWhole(curve);
    curve.move(0, 5, 0);
    EXPECT_LT(curve.points()[0].value, curve.points()[1].value);
    curve.move(2, -kEndless, 0);
    EXPECT_GT(curve.points()[2].value, curve.points()[1].value);
    expectWhole(curve);
    curve.move(2, kEndless, 0);
    EXPECT_TRUE(std::isfinite(curve.points()[2].value));
    expectWhole(curve);
    // A point stays where there is no room between its neighbours.
    TransferCurve tight = curveOf("curve:1:1:1:1:0,1.0000000000000002:1:1:1:0.5,1.0000000000000004:1:1:1:1");
    tight.move(1, 5, 0.7);
    EXPECT_EQ(tight.points()[1].value, 1.0000000000000002);
    EXPECT_EQ(tight.points()[1].opacity, 0.7);
    expectWhole(tight);
}

TEST(TransferCurve, TakesNoNumberThatIsNone) {
    TransferCurve curve = ramp();
    const std::string before = curve.text();
    EXPECT_EQ(curve.insert(kNoValue, 0.5), TransferCurve::kNone);
    EXPECT_EQ(curve.insert(kEndless, 0.5), TransferCurve::kNone);
    EXPECT_EQ(curve.insert(50, kNoValue), TransferCurve::kNone);
    curve.move(0, kNoValue, kNoValue);
    curve.move(17, 1, 1);
    curve.recolor(0, {std::nanf(""), 0, 0});
    curve.recolor(17, {1, 1, 1});
    EXPECT_FALSE(curve.remove(17));
    EXPECT_EQ(curve.text(), before);
    curve.recolor(0, {2, -1, 0.5f});
    EXPECT_EQ(curve.points()[0].color, (std::array<float, 3>{1, 0, 0.5f}));
    TransferCurve none{TransferFunction()};
    EXPECT_EQ(none.insert(1, 1), TransferCurve::kNone);
    EXPECT_FALSE(none.remove(0));
}

TEST(TransferCurve, KeepsOnePoint) {
    TransferCurve curve = ramp();
    EXPECT_TRUE(curve.remove(0));
    EXPECT_FALSE(curve.remove(0));
    ASSERT_EQ(curve.points().size(), 1u);
    EXPECT_EQ(curve.points()[0].value, 100);
    EXPECT_EQ(curve.at(-1e9).opacity, 1) << "constant";
    EXPECT_EQ(curve.insert(50, 0), 0u);
    expectWhole(curve);
}

TEST(TransferCurve, HasAsManyPointsAsItsTextMayHave) {
    TransferCurve curve = ramp();
    for (int n = 1; !curve.full(); ++n) ASSERT_NE(curve.insert(100 + n, 0.5), TransferCurve::kNone);
    EXPECT_EQ(curve.points().size(), kMostCurvePoints);
    EXPECT_EQ(curve.insert(5, 0.5), TransferCurve::kNone);
    expectWhole(curve);
    std::vector<TransferPoint> many;
    for (std::size_t n = 0; n <= kMostCurvePoints; ++n)
        many.push_back({static_cast<double>(n), glm::vec3(1), 0.5});
    EXPECT_TRUE(TransferCurve(TransferFunction(many, 0.001, "test")).empty());
}

TEST(TransferCurve, BeginsWithARamp) {
    const TransferCurve ramp = rampBetween(77.5, 255);
    ASSERT_EQ(ramp.points().size(), 2u);
    EXPECT_EQ(ramp.points()[0].value, 77.5);
    EXPECT_EQ(ramp.points()[0].opacity, 0);
    EXPECT_GT(ramp.points()[1].opacity, 0);
    expectWhole(ramp);
    for (const auto& [low, high] : {std::pair{5.0, 5.0}, {6.0, 5.0}, {kNoValue, 5.0}, {-kEndless, kEndless}})
        EXPECT_TRUE(rampBetween(low, high).empty()) << low << " " << high;
}

TEST(ValueView, ShowsTheValuesAndThePointsNearThem) {
    const ValueView view = viewOf(-1000, 3000, curveOf("curve:-1200:1:1:1:0,1e9:1:1:1:1"));
    EXPECT_LT(view.low, -1200);
    EXPECT_GT(view.low, -1500);
    EXPECT_GT(view.high, 3000);
    EXPECT_LT(view.high, 3500) << "a point far away takes no room";
    EXPECT_NEAR(view.valueAt(view.shareOf(17)), 17, 1e-9);
}

TEST(ValueView, IsOneWhateverTheValues) {
    const TransferCurve none{TransferFunction()};
    for (const auto& [low, high] : {std::pair{0.0, 0.0},
                                    {5.0, 5.0},
                                    {-1e30, 1e30},
                                    {-1e308, 1e308},
                                    {1e-300, 2e-300},
                                    {kNoValue, kNoValue},
                                    {3.0, -3.0},
                                    {-kEndless, kEndless}})
        for (const TransferCurve& curve : {none, ramp(), curveOf("curve:1e300:1:1:1:1")}) {
            const ValueView view = viewOf(low, high, curve);
            EXPECT_TRUE(std::isfinite(view.low) && std::isfinite(view.high)) << low << " " << high;
            EXPECT_LT(view.low, view.high) << low << " " << high;
            EXPECT_TRUE(std::isfinite(view.shareOf(kEndless)));
            EXPECT_TRUE(std::isfinite(view.shareOf(kNoValue)));
            EXPECT_GT(view.step(), 0);
            EXPECT_TRUE(std::isfinite(view.rounded(view.low)));
        }
}

TEST(ValueView, RoundsToWhatAPersonWouldWrite) {
    const ValueView ct{-1024, 3071};
    EXPECT_EQ(ct.step(), 2);
    EXPECT_EQ(ct.rounded(-449.3), -450);
    const ValueView bytes{0, 255};
    EXPECT_EQ(bytes.step(), 0.2);
    EXPECT_EQ(bytes.rounded(17.27), 17.2);
    const ValueView shares{0, 1};
    EXPECT_EQ(shares.rounded(0.12345), 0.123);
}

TEST(ValueView, ZoomsAboutAValueAndNotBeyondAll) {
    const ValueView all{-1000, 3000};
    const ValueView near = zoomed(all, 0.5, 0, all);
    EXPECT_NEAR(near.high - near.low, 2000, 1e-9);
    EXPECT_NEAR(near.shareOf(0), all.shareOf(0), 1e-12) << "the value stays where it is";
    EXPECT_EQ(zoomed(near, 100, 0, all), all);
    for (const double factor : {0.0, -1.0, kNoValue, kEndless}) EXPECT_EQ(zoomed(near, factor, 0, all), near);
    EXPECT_EQ(zoomed(near, 0.5, kNoValue, all), near);
    ValueView view = all;
    for (int n = 0; n < 500; ++n) view = zoomed(view, 0.5, 2999, all);
    EXPECT_LT(view.low, view.high);
    EXPECT_GT(view.valueAt(0.5), view.low) << "numbers do not end";
}

}  // namespace
}  // namespace stereonav
