// Where slabs lean against the light's way (V11): the flip of the axis with the light across the view hardly
// shows, the lags of taps, and that no light is made.
#include <random>

#include "sweep_subjects.h"
#include "tests/oracle/sweep_formulas.h"

namespace stereonav {
namespace {

using test::ball;
using test::makeField;
using test::nameOfWay;
using test::pictureOf;
using test::rootMeanSquare;
using test::Slab;
using test::sun;
using test::Uniform;
using test::viewFrom;
using test::Way;

// A light just before and just behind a right angle to the view: other slices, nearly the same picture. Of
// direct light the difference falls with the slices' thickness squared. Scattered light is spread within the
// slices, which lean the other way after the flip: without V11 a part stays, whatever their number.
double flipOf(MediumModel model, int slices, Way way = Way::Plain, double leaning = 1) {
    MediumPicture picture[2];
    for (int side = 0; side < 2; ++side) {
        Slab s = ball(model, slices);
        const glm::dvec3 forward = s.geometry.eyes[0].forward, right = s.geometry.eyes[0].right;
        s.look.light.direction = glm::normalize(right + (side ? -1e-9 : 1e-9) * forward);
        const EyeView view[] = {viewFrom({0.5, -3, 0.7}, {0, 0, 0}, 0.25, 8, 8)};
        s.geometry = makeSweepGeometry(s.medium, s.look, s.setting, view, view[0].eye);
        EXPECT_EQ(s.geometry.forward, side == 0);
        EXPECT_EQ(s.geometry.leaning, 1);
        s.geometry.leaning = leaning;
        picture[side] = pictureOf(s, way);
    }
    return rootMeanSquare(picture[0], picture[1]);
}
TEST(Flip, changesASmoothPictureLittle) {
    const double coarse = flipOf(MediumModel::Direct, 24), fine = flipOf(MediumModel::Direct, 96);
    RecordProperty("direct", std::to_string(fine));
    EXPECT_LT(fine, 1e-3);
    EXPECT_LT(fine, coarse / 6);
    const double indirect = flipOf(MediumModel::Indirect, 64);
    RecordProperty("indirect", std::to_string(indirect));
    EXPECT_LT(indirect, 8e-3);
}
TEST(Flip, ofScatteredLightVanishesWithMoreSlices) {
    double last = 1;
    for (const auto& [slices, most] : {std::pair(64, 2e-3), std::pair(128, 6e-4), std::pair(256, 3e-4)}) {
        const double jump = flipOf(MediumModel::Indirect, slices, Way::Fast),
                     without = flipOf(MediumModel::Indirect, slices, Way::Fast, 0);
        RecordProperty("slices" + std::to_string(slices),
                       std::to_string(jump) + ", without V11 " + std::to_string(without));
        EXPECT_LT(jump, most) << slices;
        EXPECT_LT(jump, 0.6 * last) << slices;
        EXPECT_GT(without, 4e-3) << slices;  // what it is for
        last = jump;
    }
    EXPECT_LT(flipOf(MediumModel::Indirect, 64), 2e-3);
}

// V11 counts from 50 degrees between view and light on, and in full from 75 to a right angle and behind it.
TEST(Leaning, growsWithTheAngleOfViewToLight) {
    const auto leaning = [](double degrees) {
        Slab s = ball(MediumModel::Indirect, 8);
        const glm::dvec3 forward = s.geometry.eyes[0].forward, right = s.geometry.eyes[0].right;
        const double angle = degrees * std::acos(-1.0) / 180;
        s.look.light.direction = glm::normalize(std::cos(angle) * forward + std::sin(angle) * right);
        const EyeView view[] = {viewFrom({0.5, -3, 0.7}, {0, 0, 0}, 0.25, 8, 8)};
        return makeSweepGeometry(s.medium, s.look, s.setting, view, view[0].eye).leaning;
    };
    for (const double degrees : {0.0, 30.0, 49.9, 130.1, 180.0}) EXPECT_EQ(leaning(degrees), 0) << degrees;
    for (const double degrees : {75.1, 90.0, 104.9}) EXPECT_EQ(leaning(degrees), 1) << degrees;
    EXPECT_NEAR(leaning(62.5), 0.5, 1e-6);
    EXPECT_NEAR(leaning(117.5), 0.5, 1e-6);
}

// The lags are the differences between the places where neighbouring rays cross, as far as they are even.
TEST(Leaning, lagsAreWhatNeighboursTravelMore) {
    for (const bool lamp : {false, true}) {
        Slab s = ball(MediumModel::Indirect, 8);
        s.look.light.direction = glm::normalize(glm::dvec3(0.9, 0.2, -0.3));
        if (lamp) s.look.light.kind = MediumLight::Kind::Lamp;
        s.look.light.position = -4.0 * s.look.light.direction;
        const EyeView view[] = {viewFrom({0.5, -3, 0.7}, {0, 0, 0}, 0.25, 8, 8)};
        const SweepGeometry g = makeSweepGeometry(s.medium, s.look, s.setting, view, view[0].eye);
        ASSERT_EQ(g.leaning, 1);
        const double t = 0.5 * (g.faces.front() + g.faces.back());
        const auto way = [&](double x, double y) {
            const glm::dvec3 start = g.light.start(x, y), along = g.light.direction(x, y);
            return (t - glm::dot(start, g.axis)) / glm::dot(along, g.axis);
        };
        for (const double x : {20.5, 48.5, 70.5}) {
            const double y = 44.5;
            const glm::dvec2 lags = tapLags(g, x, y, t);
            EXPECT_GT(glm::length(lags), 0.3 * g.light.perX);
            EXPECT_NEAR(lags.x, 0.5 * (way(x + 1, y) - way(x - 1, y)), 1e-3 * glm::length(lags)) << lamp;
            EXPECT_NEAR(lags.y, 0.5 * (way(x, y + 1) - way(x, y - 1)), 1e-3 * glm::length(lags)) << lamp;
        }
    }
}

// Thick media, coarse texels, wide cones, lights across the view: taps that count more never make more light
// than was put in, nor less than none, and scattered light still fades away in what is dense.
class LeaningWays : public testing::TestWithParam<Way> {};

TEST_P(LeaningWays, makeNoLight) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(0, 1);
    for (int n = 0; n < 24; ++n) {
        Slab s = ball(MediumModel::Indirect, 10 + n, {0.5, -3, 0.7}, 0.2 + 0.1 * n);
        auto field = makeField({6, 7, 5}, 1, {0, 0, 0}, [&](const glm::ivec3&) { return 1024 * u(random); });
        Uniform thin{1e-3}, dense{std::pow(10.0, 4 * u(random))};
        thin.tauIndirect = glm::dvec3(1e-3);
        dense.tauIndirect = {dense.tau, 0.3 * dense.tau, 0};
        const double reference = test::referenceFor(dense.tau);
        s.medium = Medium(field, MediumTransfer({{300, test::materialOf(thin, reference)},
                                                 {1024, test::materialOf(dense, reference)}},
                                                reference, "test"));
        s.setting.lightSize = 8 + n;
        const glm::dvec3 way = glm::normalize(glm::dvec3(1, n % 2 ? 0.1 : -0.1, u(random) - 0.5));
        s.look.light = sun(way);
        if (n % 3 == 0) s.look.light.kind = MediumLight::Kind::Lamp;
        s.look.light.position = -2.0 * way;
        const EyeView view[] = {viewFrom({0.1, -3, 0.2}, {0, 0, 0}, 0.25, 9, 9)};
        s.geometry = makeSweepGeometry(s.medium, s.look, s.setting, view, view[0].eye);
        EXPECT_GT(s.geometry.leaning, 0.9);
        const MediumPicture picture = pictureOf(s, GetParam());
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 9; ++x) {
                const glm::vec4 p = picture.light.at(x, y);
                for (int k = 0; k < 3; ++k) {
                    ASSERT_GE(p[k], 0) << n;
                    ASSERT_LE(p[k], 2 * (1 - p.w) + 2e-5) << n;
                }
            }
    }
}
INSTANTIATE_TEST_SUITE_P(All, LeaningWays, testing::Values(Way::Plain, Way::Fast), nameOfWay);

}  // namespace
}  // namespace stereonav
