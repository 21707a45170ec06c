// Where slices lie: the axis, the faces, the buffers' rays.
#include "engine/medium/sweep/sweep_geometry.h"

#include <glm/gtc/constants.hpp>
#include <limits>
#include <random>

#include "engine/base/error.h"
#include "sweep_scenes.h"
#include "tests/oracle/sweep_formulas.h"

namespace stereonav {
namespace {

using test::makeField;
using test::sun;
using test::viewFrom;

constexpr double kDegree = glm::pi<double>() / 180;

Medium boxAt(const glm::dvec3& center, const glm::ivec3& size = {5, 5, 5}, double length = 2) {
    std::vector<MediumPoint> points(1);
    points[0].value = 100;
    points[0].material = test::materialOf({});
    return Medium(makeField(size, length, center, [](const glm::ivec3&) { return 100; }),
                  MediumTransfer(points, 1.0, "test"));
}

MediumLook lookWith(const MediumLight& light, MediumModel model = MediumModel::Indirect) {
    MediumLook look;
    look.light = light;
    look.model = model;
    return look;
}

SweepGeometry geometryOf(const Medium& medium, const MediumLook& look, const std::vector<EyeView>& eyes,
                         const SweepSetting& setting = {}) {
    return makeSweepGeometry(medium, look, setting, eyes, eyes.empty() ? glm::dvec3(0) : eyes[0].head);
}

double angle(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

glm::dvec3 randomDirection(std::mt19937& random) {
    std::normal_distribution<double> n;
    return glm::normalize(glm::dvec3(n(random), n(random), n(random)));
}

TEST(SweepAxis, isHalfwayForNarrowViewsAndParallelLight) {
    const Medium medium = boxAt({0, 0, 0});
    for (const double degrees : {5.0, 30.0, 60.0, 89.0}) {
        const glm::dvec3 way(std::sin(degrees * kDegree), std::cos(degrees * kDegree), 0);
        const SweepGeometry g =
            geometryOf(medium, lookWith(sun(way)), {viewFrom({0, -5, 0}, {0, 0, 0}, 1e-6, 8, 8)});
        EXPECT_TRUE(g.forward) << degrees;
        EXPECT_NEAR(angle(g.axis, {0, 1, 0}), 0.5 * degrees * kDegree, 1e-5) << degrees;
        EXPECT_NEAR(angle(g.axis, way), 0.5 * degrees * kDegree, 1e-5) << degrees;
        const SweepGeometry back =
            geometryOf(medium, lookWith(sun(-way)), {viewFrom({0, -5, 0}, {0, 0, 0}, 1e-6, 8, 8)});
        EXPECT_FALSE(back.forward) << degrees;
        EXPECT_NEAR(angle(back.axis, {0, -1, 0}), 0.5 * degrees * kDegree, 1e-5) << degrees;
    }
}

TEST(SweepAxis, isTheViewAlongTheLightAndItsOppositeAgainstIt) {
    const Medium medium = boxAt({0, 0, 0});
    const std::vector<EyeView> eyes{viewFrom({3, 4, 5}, {0, 0, 0}, 0.7, 8, 8)};
    const SweepGeometry along = geometryOf(medium, lookWith(sun(eyes[0].forward)), eyes);
    EXPECT_TRUE(along.forward);
    EXPECT_LT(angle(along.axis, eyes[0].forward), 1e-7);
    const SweepGeometry against = geometryOf(medium, lookWith(sun(-eyes[0].forward)), eyes);
    EXPECT_FALSE(against.forward);
    EXPECT_LT(angle(against.axis, -eyes[0].forward), 1e-7);
}

TEST(SweepAxis, countsAnExactRightAngleAsForward) {
    const SweepGeometry g =
        geometryOf(boxAt({0, 0, 0}), lookWith(sun({0, 0, -1})), {viewFrom({0, -5, 0}, {0, 0, 0}, 0.5, 8, 8)});
    EXPECT_TRUE(g.forward);
    for (int x = 0; x <= 8; x += 8)
        EXPECT_GT(glm::dot(g.eyes[0].direction(x, 0), g.axis), std::cos(85 * kDegree));
}

// Both kinds of light, every turn: eye rays up to 85 degrees for frusta of 100 degrees, light going up.
TEST(SweepAxis, keepsEyeRaysWithin85Degrees) {
    std::mt19937 random(1);
    const Medium medium = boxAt({0, 0, 0});
    const double half = std::tan(50 * kDegree) / std::sqrt(2.0);  // to the corners
    for (int n = 0; n < 400; ++n) {
        MediumLight light = sun(randomDirection(random));
        if (n % 2) {
            light.kind = MediumLight::Kind::Lamp;
            light.position = randomDirection(random) * 3.0;
            light.coneAngle = 0.1 + 2.6 * (n % 7) / 6.0;
        }
        const std::vector<EyeView> eyes{viewFrom(randomDirection(random) * 4.0, {0, 0, 0}, half, 8, 8)};
        const SweepGeometry g = geometryOf(medium, lookWith(light), eyes);
        EXPECT_NEAR(glm::length(g.axis), 1, 1e-12);
        EXPECT_GT(glm::dot(g.axis, light.direction), std::cos(85 * kDegree)) << n;
        for (int corner = 0; corner < 4; ++corner) {
            const glm::dvec3 way = g.eyes[0].direction(corner & 1 ? 8 : 0, corner & 2 ? 8 : 0);
            EXPECT_LT(angle(way, g.forward ? g.axis : -g.axis), 85.0001 * kDegree) << n << " " << corner;
        }
    }
}

TEST(SweepAxis, givesVeryWideViewsAsMuchAsThereIs) {
    const Medium medium = boxAt({0, 0, 0});
    for (const double half : {10.0, 100.0}) {
        const SweepGeometry g =
            geometryOf(medium, lookWith(sun({0, 0, -1})), {viewFrom({0, -5, 0}, {0, 0, 0}, half, 8, 8)});
        EXPECT_GT(glm::dot(g.axis, glm::dvec3(0, 0, -1)), 0);
        for (int corner = 0; corner < 4; ++corner)
            EXPECT_GT(glm::dot(g.eyes[0].direction(corner & 1 ? 8 : 0, corner & 2 ? 8 : 0), g.axis), 0);
    }
}

// A small turn of the view turns the axis by no more (but for the flip), a wide lamp's too.
TEST(SweepAxis, turnsEvenlyWithTheView) {
    const Medium medium = boxAt({0, 0, 0});
    MediumLight lamp = sun({0.3, -0.2, -1});
    lamp.kind = MediumLight::Kind::Lamp;
    lamp.position = {0, 0, 3};
    int flips = 0;
    for (const MediumLight& light : {sun({0.3, -0.2, -1}), lamp}) {
        SweepGeometry before;
        for (int n = 0; n <= 3600; ++n) {
            const double a = 0.1 * kDegree * n;
            const glm::dvec3 eye(5 * std::sin(a), -5 * std::cos(a), 3 * std::sin(2 * a));
            const std::vector<EyeView> eyes{viewFrom(eye, {0, 0, 0}, 0.6, 8, 8)};
            const SweepGeometry g = geometryOf(medium, lookWith(light), eyes);
            if (n > 0 && g.forward == before.forward) {
                EXPECT_LT(angle(g.axis, before.axis), 0.6 * kDegree) << n;
            } else if (n > 0) {
                ++flips;
            }
            before = g;
        }
    }
    EXPECT_EQ(flips, 8);  // the way around rises and falls twice
}

TEST(SweepFaces, areEvenOverTheBoxAndAscend) {
    const Medium medium = boxAt({10, 20, 30}, {5, 9, 17});
    std::mt19937 random(2);
    SweepSetting setting;
    for (const int slices : {1, 2, 64, 1000}) {
        setting.slices = slices;
        const std::vector<EyeView> eyes{
            viewFrom(glm::dvec3(10, 20, 30) + 50.0 * randomDirection(random), {10, 20, 30}, 0.5, 8, 8)};
        const SweepGeometry g = geometryOf(medium, lookWith(sun(randomDirection(random))), eyes, setting);
        ASSERT_EQ(g.slabs(), slices);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (int n = 0; n < 8; ++n) {
            const WorldBox& b = medium.bounds();
            const glm::dvec3 corner(n & 1 ? b.high.x : b.low.x, n & 2 ? b.high.y : b.low.y,
                                    n & 4 ? b.high.z : b.low.z);
            low = std::min(low, glm::dot(g.axis, corner - g.anchor));
            high = std::max(high, glm::dot(g.axis, corner - g.anchor));
        }
        EXPECT_NEAR(g.faces.front(), low, 1e-9);
        EXPECT_NEAR(g.faces.back(), high, 1e-9);
        for (int k = 0; k < slices; ++k)
            EXPECT_NEAR(g.faces[k + 1] - g.faces[k], (high - low) / slices, 1e-9) << k;
    }
}

// In the world the slices stay where they are while the eye moves along.
TEST(SweepFaces, stayInTheMediumAsOneFlies) {
    const Medium medium = boxAt({0, 0, 0});
    std::vector<double> first;
    for (int n = 0; n < 15; ++n) {
        EyeView eye = viewFrom({0, -4, 0}, {0, 0, 0}, 0.5, 8, 8);
        eye.eye += glm::dvec3(0.1 * n, 0.13 * n, -0.05 * n);
        eye.head = eye.eye;
        const SweepGeometry g = geometryOf(medium, lookWith(sun({1, 1, -1})), {eye});
        std::vector<double> faces;
        for (const double f : g.faces) faces.push_back(f + glm::dot(g.axis, g.anchor));
        if (n == 0) first = faces;
        ASSERT_EQ(faces.size(), first.size()) << n;
        for (std::size_t k = 0; k < faces.size(); ++k)
            ASSERT_NEAR(faces[k], first[k], 1e-12) << n << " " << k;
    }
}

TEST(SweepFaces, areAddedAtEyesAndLampInside) {
    const Medium medium = boxAt({0, 0, 0});
    SweepSetting setting;
    setting.slices = 10;
    EyeView left = viewFrom({0.03, 0.11, 0}, {0, 5, 0}, 0.5, 8, 8), right = left;
    right.eye.y = 0.33;
    right.eye.x = 0.1;
    MediumLight lamp = sun({0, 1, 0});
    lamp.kind = MediumLight::Kind::Lamp;
    lamp.position = {0, -0.55, 0};
    const SweepGeometry g = geometryOf(medium, lookWith(lamp), {left, right}, setting);
    ASSERT_TRUE(g.forward);
    EXPECT_THAT(g.axis.y, testing::DoubleNear(1, 1e-12));
    // The lamp's slab is the first that anything needs.
    EXPECT_NEAR(g.faces.front(), g.lightStart, 1e-12);
    for (const RayFan& eye : g.eyes) {
        const double t = glm::dot(eye.origin, g.axis);
        EXPECT_THAT(g.faces, testing::Contains(testing::DoubleNear(t, 1e-12)));
    }
    EXPECT_EQ(g.slabs(),
              4 + 10 + 1);  // even ones up to the first eye, graded ones from it on, one cut by the other
}

// Ahead of an eye inside: thin where it looks at things near it, to the end of the box, either way.
TEST(SweepFaces, growWithTheDistanceFromAnEyeInside) {
    const Medium medium = boxAt({0, 0, 0});
    SweepSetting setting;
    for (const int slices : {1, 2, 100}) {
        setting.slices = slices;
        for (const double way : {1.0, -1.0}) {
            const SweepGeometry g = geometryOf(medium, lookWith(sun({0, way, 0}), MediumModel::Emission),
                                               {viewFrom({0, -0.4, 0}, {0, 5, 0}, 0.1, 8, 8)}, setting);
            ASSERT_EQ(g.slabs(), slices);
            std::vector<double> steps;
            for (int k = 0; k < slices; ++k) steps.push_back(g.faces[k + 1] - g.faces[k]);
            EXPECT_NEAR(g.faces.back() - g.faces.front(), 1.4, 1e-12);
            if (!g.forward) std::reverse(steps.begin(), steps.end());
            for (std::size_t k = 1; k < steps.size(); ++k) EXPECT_GT(steps[k], steps[k - 1]);
            if (slices == 100) {
                EXPECT_LT(steps.front(), 1.4 / 1000);
            }
            EXPECT_EQ(g.forward, way > 0);
        }
    }
}

TEST(SweepFaces, leaveOutWhatNothingNeeds) {
    const Medium medium = boxAt({0, 0, 0});
    SweepSetting setting;
    setting.slices = 10;
    const std::vector<EyeView> inside{viewFrom({0, 0.5, 0}, {0, 5, 0}, 0.1, 8, 8)};
    const auto slabs = [&](const MediumLight& light, MediumModel model) {
        return geometryOf(medium, lookWith(light, model), inside, setting).slabs();
    };
    EXPECT_EQ(slabs(sun({0, 1, 0}), MediumModel::Direct), 8 + 10);  // light comes through what is behind
    EXPECT_EQ(slabs(sun({0, 1, 0}), MediumModel::Emission), 10);
    EXPECT_EQ(slabs(sun({0, -1, 0}), MediumModel::Direct), 10);  // light comes from before
    const std::vector<EyeView> away{viewFrom({0, 5, 0}, {0, 9, 0}, 0.1, 8, 8)};
    EXPECT_EQ(geometryOf(medium, lookWith(sun({0, 1, 0})), away, setting).slabs(), 0);
    EXPECT_EQ(geometryOf(medium, lookWith(sun({0, -1, 0})), away, setting).slabs(), 0);
}

TEST(SweepFaces, areNoneWhereThereIsNothing) {
    const std::vector<EyeView> eyes{viewFrom({0, -5, 0}, {0, 0, 0}, 0.5, 8, 8)};
    EXPECT_EQ(geometryOf(Medium(), lookWith(sun({0, 0, -1})), eyes).slabs(), 0);
    EXPECT_EQ(geometryOf(boxAt({0, 0, 0}, {1, 1, 1}), lookWith(sun({0, 0, -1})), eyes).slabs(), 0);
    EXPECT_EQ(geometryOf(boxAt({0, 0, 0}), lookWith(sun({0, 0, -1})), {}).slabs(), 0);
}

TEST(SweepGeometry, isTheSameFarFromTheOrigin) {
    const glm::dvec3 away(1e7, -1e7, 1e7);
    const auto at = [&](const glm::dvec3& offset) {
        return geometryOf(boxAt(offset), lookWith(sun({1, 2, -2})),
                          {viewFrom(offset + glm::dvec3(1, -5, 1), offset, 0.5, 8, 8)});
    };
    const SweepGeometry here = at({0, 0, 0}), there = at(away);
    ASSERT_EQ(here.faces.size(), there.faces.size());
    for (std::size_t k = 0; k < here.faces.size(); ++k) ASSERT_NEAR(here.faces[k], there.faces[k], 1e-7);
    EXPECT_LT(glm::length(here.eyes[0].origin - there.eyes[0].origin), 1e-7);
    EXPECT_NEAR(here.light.xMin, there.light.xMin, 1e-7);
    EXPECT_NEAR(here.light.perX, there.light.perX, 1e-9);
}

TEST(SweepGeometry, sharesAxisAndFacesBetweenEyesThatAreFarApart) {
    EyeView left = viewFrom({-5, -5, 0}, {-5, 0, 0}, 0.5, 8, 8), right = left;
    right.eye.x = 5;
    const SweepGeometry g = geometryOf(boxAt({0, 0, 0}), lookWith(sun({1, 0.2, 0})), {left, right});
    ASSERT_EQ(g.eyes.size(), 2u);
    EXPECT_NEAR(g.eyes[1].origin.x - g.eyes[0].origin.x, 10, 1e-12);
    EXPECT_GT(g.slabs(), 0);
}

// Eyes: the same pixels as EyeView's; project undoes the rays. Light: the same for both kinds.
TEST(RayFans, projectBackToThePixel) {
    const Medium medium = boxAt({0, 0, 0});
    const EyeView view = viewFrom({1, -5, 2}, {0, 0, 0}, 0.5, 12, 9);
    MediumLight lamp = sun({0.2, 0.4, -1});
    lamp.kind = MediumLight::Kind::Lamp;
    lamp.position = {0, 0, 3};
    for (const MediumLight& light : {sun({0.2, 0.4, -1}), lamp, sun({0, 0, 1}), sun({0, 0, -1})}) {
        const SweepGeometry g = geometryOf(medium, lookWith(light), {view});
        for (const RayFan* fan : {&g.eyes[0], &g.light})
            for (int n = 0; n < 20; ++n) {
                const double x = 0.37 * n, y = 0.21 * n;
                const glm::dvec3 place = fan->start(x, y) + (1.5 + n) * fan->direction(x, y);
                EXPECT_NEAR(fan->project(place).x, x, 1e-9);
                EXPECT_NEAR(fan->project(place).y, y, 1e-9);
            }
        EXPECT_NEAR(glm::dot(glm::cross(g.light.right, g.light.up), g.light.forward), -1, 1e-12);
        EXPECT_NEAR(glm::length(g.light.right), 1, 1e-12);
        const glm::dvec3 way = g.eyes[0].direction(3.5, 2.5);
        EXPECT_LT(angle(way, view.rayDirection(3.5, 2.5)), 1e-12);
    }
    const SweepGeometry g = geometryOf(medium, lookWith(lamp), {view});
    EXPECT_TRUE(std::isnan(g.light.project(g.light.origin - g.light.forward).x));
}

TEST(LightFan, holdsTheBoxWithSquareTexels) {
    const Medium medium = boxAt({4, 5, 6}, {9, 5, 3});
    std::mt19937 random(3);
    for (int n = 0; n < 50; ++n) {
        MediumLight light = sun(randomDirection(random));
        if (n % 2) {
            light.kind = MediumLight::Kind::Lamp;
            light.position = glm::dvec3(4, 5, 6) - 20.0 * light.direction;
            light.coneAngle = 0.5;
        }
        SweepSetting setting;
        setting.lightSize = 64;
        const SweepGeometry g =
            geometryOf(medium, lookWith(light), {viewFrom({4, -5, 6}, {4, 5, 6}, 0.5, 8, 8)}, setting);
        EXPECT_EQ(g.light.perX, g.light.perY);
        EXPECT_EQ(std::max(g.light.width, g.light.height), 64);
        for (int corner = 0; corner < 8; ++corner) {
            const WorldBox& b = medium.bounds();
            const glm::dvec3 place(corner & 1 ? b.high.x : b.low.x, corner & 2 ? b.high.y : b.low.y,
                                   corner & 4 ? b.high.z : b.low.z);
            const glm::dvec2 texel = g.light.project(place - g.anchor);
            EXPECT_GT(texel.x, 0.9);  // a texel inside the border
            EXPECT_GT(texel.y, 0.9);
            EXPECT_LT(texel.x, g.light.width - 0.9);
            EXPECT_LT(texel.y, g.light.height - 0.9);
        }
    }
}

TEST(LightFan, ofALampInsideIsItsCone) {
    MediumLight lamp = sun({0, 1, 0});
    lamp.kind = MediumLight::Kind::Lamp;
    lamp.atHead = true;
    lamp.coneAngle = 2.0;
    const EyeView view = viewFrom({0, 0.2, 0}, {0, 5, 0}, 0.5, 8, 8);
    const SweepGeometry g = geometryOf(boxAt({0, 0, 0}), lookWith(lamp), {view});
    EXPECT_LT(glm::length(g.light.origin - g.eyes[0].origin), 1e-12);
    EXPECT_NEAR(g.light.xMin + g.light.perX, -std::tan(1.0), 1e-9);
    EXPECT_NEAR(g.light.yMax - g.light.perY, std::tan(1.0), 1e-9);
    EXPECT_NEAR(g.lampCosine, std::cos(1.0), 1e-12);
    EXPECT_NEAR(g.lightStart, glm::dot(g.axis, g.eyes[0].origin), 1e-12);
}

// A narrow lamp's buffer holds what light may spread to: with texels of 1 cm at a metre, V9's random walk
// from depth 2 to 4 is 3 sqrt(blurLength / 2 (1 / 2 - 1 / 4)) tan(theta / 2) wide; and light sets out in the
// cone.
TEST(LightFan, ofANarrowLampHasRoomForScatteredLight) {
    MediumLight lamp = sun({0, 0, -1});
    lamp.kind = MediumLight::Kind::Lamp;
    lamp.position = {0, 0, 3};
    lamp.coneAngle = 0.4;
    const EyeView view = viewFrom({0, 0, 3}, {0, 0, 0}, 0.5, 8, 8);
    MediumLook look = lookWith(lamp);
    SweepSetting setting;
    setting.lightSize = 64;
    setting.blurLength = 0.02;
    const Medium box = boxAt({0, 0, 0});
    look.model = MediumModel::Direct;
    const SweepGeometry direct = geometryOf(box, look, {view}, setting);
    EXPECT_NEAR(direct.light.xMin + direct.light.perX, -std::tan(0.2), 1e-9);
    look.model = MediumModel::Indirect;
    const SweepGeometry g = geometryOf(box, look, {view}, setting);
    const double half = 0.5 * (box.bounds().high.z - box.bounds().low.z);
    const double spread =
        3 * std::tan(0.3) * std::sqrt(0.5 * setting.blurLength * (1 / (3 - half) - 1 / (3 + half)));
    EXPECT_NEAR(g.light.xMin + g.light.perX, -std::tan(0.2) - spread, 1e-9);
    const std::vector<float> start = scatteredAtStart(g);
    ASSERT_EQ(start.size(), static_cast<std::size_t>(g.light.width + 2) * (g.light.height + 2));
    double area = 0;
    for (const float s : start) {
        EXPECT_GE(s, 0.0f);
        EXPECT_LE(s, 1.0f);
        area += s * g.light.perX * g.light.perY;
    }
    const double disc = 3.14159265 * std::pow(std::tan(0.2), 2);
    EXPECT_NEAR(area, disc, 0.01 * disc);
    setting.coneAngle = 0;  // nothing spreads
    EXPECT_NEAR(geometryOf(box, look, {view}, setting).light.xMin, direct.light.xMin, 1e-9);
    look.light.coneAngle = 1.9;  // beyond 45 degrees: texels stay small
    setting.coneAngle = 0.6;
    EXPECT_GT(geometryOf(box, look, {view}, setting).light.xMin, -std::tan(0.95) - 0.1);
}

TEST(SweepGeometry, refusesSettingsOutOfRangeInOneLine) {
    const Medium medium = boxAt({0, 0, 0});
    const auto errorOf = [&](const SweepSetting& setting, const MediumLight& light) -> std::string {
        try {
            geometryOf(medium, lookWith(light), {viewFrom({0, -5, 0}, {0, 0, 0}, 0.5, 8, 8)}, setting);
        } catch (const Error& e) {
            return e.what();
        }
        return "none";
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    SweepSetting s;
    s.slices = 0;
    EXPECT_THAT(errorOf(s, sun({0, 0, 1})), testing::HasSubstr("slices: expected 1 to 65536, got 0"));
    s = {};
    s.lightSize = 4097;
    EXPECT_THAT(errorOf(s, sun({0, 0, 1})), testing::HasSubstr("8 to 4096"));
    s = {};
    s.coneAngle = nan;
    EXPECT_THAT(errorOf(s, sun({0, 0, 1})), testing::HasSubstr("cone angle"));
    s = {};
    s.blurLength = -1;
    EXPECT_THAT(errorOf(s, sun({0, 0, 1})), testing::HasSubstr("blur length"));
    MediumLight light;
    light.direction = {0, 0, 2};
    EXPECT_THAT(errorOf({}, light), testing::HasSubstr("unit vector"));
    light = sun({0, 0, 1});
    light.kind = MediumLight::Kind::Lamp;
    light.coneAngle = 2.8;
    EXPECT_THAT(errorOf({}, light), testing::HasSubstr("below 2.8"));
    EXPECT_EQ(errorOf({}, sun({0, 0, 1})), "none");
}

// (V5), (V6) against the integral itself, by Simpson's rule: light that enters a slab of depth x along the
// eye's ray and y along the light's.
double integralOf(double x, double y, bool forward) {
    constexpr int kSteps = 2000;
    double sum = 0;
    for (int n = 0; n <= kSteps; ++n) {
        const double s = static_cast<double>(n) / kSteps;  // along the eye's ray, from the eye
        const double value = x * std::exp(-x * s - y * (forward ? s : 1 - s));
        sum += value * (n == 0 || n == kSteps ? 1 : n % 2 ? 4 : 2);
    }
    return sum / (3 * kSteps);
}

TEST(SlabShare, isTheIntegralOverTheSlab) {
    for (const bool forward : {true, false})
        for (const double x : {0.0, 1e-6, 0.01, 0.7, 1.0, 5.0, 20.0})
            for (const double y : {0.0, 1e-6, 0.01, 0.7, 1.0, 5.0, 20.0})
                EXPECT_NEAR(slabShare(x, y, forward), integralOf(x, y, forward), 1e-9) << x << " " << y;
}

TEST(SlabShare, staysBetween0And1ForAnyDepth) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const bool forward : {true, false})
        for (const double x : {0.0, 1e-300, 1e-12, 1.0, 1e6, 1e30, infinity})
            for (const double y : {0.0, 1e-300, 1e-12, 1.0, 1e6, 1e30, infinity}) {
                const double share = slabShare(x, y, forward);
                EXPECT_GE(share, 0) << x << " " << y;
                EXPECT_LE(share, 1) << x << " " << y;
                EXPECT_LE(share, x) << x << " " << y;
            }
    EXPECT_EQ(slabShare(0, 5, true), 0);
    EXPECT_NEAR(slabShare(1e6, 0, true), 1, 1e-6);
    EXPECT_EQ(meanTransmittance(0), 1);
    EXPECT_EQ(meanTransmittance(infinity), 0);
}

TEST(BlurTaps, spreadAsFarAsTheOffset) {
    for (const double offset : {0.0, 1e-6, 0.1, 0.5, 0.99, 1.0}) {
        const BlurTaps taps = blurTaps(offset);
        EXPECT_EQ(taps.radius, 1);
        EXPECT_NEAR(0.5 * taps.share, 0.5 * offset * offset, 1e-12) << offset;
    }
    for (const double offset : {2.0, 5.0, 100.0, 1e9, std::numeric_limits<double>::infinity()}) {
        const BlurTaps taps = blurTaps(offset);
        EXPECT_EQ(taps.share, 1) << offset;
        EXPECT_LE(taps.radius, 1e6);
        if (offset < 1e3) {
            EXPECT_NEAR(0.5 * taps.radius * taps.radius + 1.0 / 6, 0.5 * offset * offset, 1e-9);
        }
    }
}

TEST(TapTurn, isEvenOverAQuarterTurn) {
    int bins[8] = {};
    for (int slab = 0; slab < 16; ++slab)
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                const double turn = tapTurn(x, y, slab);
                ASSERT_GE(turn, 0);
                ASSERT_LT(turn, glm::half_pi<double>());
                ++bins[static_cast<int>(turn / glm::half_pi<double>() * 8)];
            }
    double chi = 0;
    for (const int n : bins) chi += (n - 512.0) * (n - 512.0) / 512;
    EXPECT_LT(chi, 24.3);  // 7 degrees of freedom, 0.1 %
}

}  // namespace
}  // namespace stereonav
