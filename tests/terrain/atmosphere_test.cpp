// The air of a physical sky: its formula against the plain integral, what must hold at the ends, and what the
// kernels and the right eye make of it.
#include "terrain/light/atmosphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <vector>

#include "engine/math/constants.h"
#include "engine/math/luminance.h"
#include "engine/stereo/right_eye.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/light/fog.h"
#include "tests/support/test_grounds.h"

namespace stereonav::atmosphere_test {
namespace {

TerrainLook lookOf(double visibility, double sunElevation_deg, double seenFrom = 1000) {
    TerrainLook look;
    look.physicalSky = true;
    look.visibility = visibility;
    look.sunAzimuth = 1;
    look.sunElevation = sunElevation_deg * kRadians;
    look.skySeenFrom = seenFrom;
    return look;
}

// Returns a direction up or down with an angle from the sun's azimuth.
glm::dvec3 directionOf(double sine, double beside) {
    const double across = std::sqrt(1 - sine * sine);
    return {across * std::sin(1 + beside), across * std::cos(1 + beside), sine};
}

// Returns the level of 255 for a root of linear light, behind which a third of white lies.
double shown(const AirSeen& air, int c) {
    return 255 * std::sqrt(std::clamp(air.light[c] + 0.3 * air.through[c], 0.0, 1.0));
}

// Returns what along() does, by adding up many steps.
AirSeen plainAlong(const AirData& air, const glm::dvec3& eye, const glm::dvec3& direction, double way) {
    constexpr int kSteps = 500;
    constexpr double kHazeAlbedo = 0.9, kForward = 0.76;
    const glm::dvec3 powers(1, kGreenOfRed, kBlueOfRed);
    const double cosine = glm::dot(direction, glm::dvec3(air.toSun[0], air.toSun[1], air.toSun[2]));
    const double both = 1 + cosine * cosine, g = kForward;
    const double molecules = 3 / (16 * kPi) * both,
                 haze = 3 / (8 * kPi) * (1 - g * g) * both /
                        ((2 + g * g) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
    glm::dvec3 tau(0.0);
    AirSeen seen;
    for (int n = 0; n < kSteps; ++n) {
        const double step = way / kSteps, height = eye.z - air.seaLevel + direction.z * step * (n + 0.5);
        const double thin = std::exp(-height / 8000), dense = std::exp(-height / 1200);
        const glm::dvec3 own = double(air.molecules) * thin * powers;
        const double grey = air.haze * dense;
        for (int c = 0; c < 3; ++c) {
            const double depth = step * (own[c] + grey);
            const double sun =
                air.sunlight[c] * std::exp(-(powers[c] * air.sunDepth[0] * thin + air.sunDepth[1] * dense));
            const double source = sun * (own[c] * molecules + grey * kHazeAlbedo * haze) +
                                  air.ambient[c] * (own[c] + grey * kHazeAlbedo);
            if (own[c] + grey > 0)
                seen.light[c] += std::exp(-tau[c]) * -std::expm1(-depth) * source / (own[c] + grey);
            tau[c] += depth;
        }
    }
    for (int c = 0; c < 3; ++c) seen.through[c] = std::exp(-tau[c]);
    return seen;
}

struct Errors {
    double rms = 0, most = 0;
};
Errors errorsOf(const Atmosphere& air) {
    Errors errors;
    int count = 0;
    for (const double height : {10.0, 2000.0, 12000.0})
        for (const double way : {300.0, 1e4, 1e5})
            for (const double end : {0.0, 300.0, 4000.0}) {
                const double sine = (end - height) / way;
                if (std::abs(sine) > 1) continue;
                for (const double beside : {0.0, 1.0, 3.1}) {
                    const glm::dvec3 eye(0, 0, height), d = directionOf(sine, beside);
                    const AirSeen fast = air.along(eye, d, way), plain = plainAlong(air.data(), eye, d, way);
                    for (int c = 0; c < 3; ++c) {
                        const double apart = std::abs(shown(fast, c) - shown(plain, c));
                        errors.rms += apart * apart, ++count;
                        errors.most = std::max(errors.most, apart);
                        EXPECT_NEAR(fast.through[c], plain.through[c], 2e-3);
                    }
                }
            }
    errors.rms = std::sqrt(errors.rms / count);
    return errors;
}

// Grey levels of 255. Towards the setting sun haze turns from bright to dark within a few hundred metres.
TEST(Atmosphere, LightIsThatOfThePlainIntegral) {
    struct Case {
        double visibility, sun, rms, most;
    };
    for (const Case& c :
         {Case{5e3, 60, 0.5, 2}, Case{5e3, 4, 0.9, 5}, Case{60e3, 60, 0.2, 1}, Case{60e3, 20, 0.3, 2},
          Case{60e3, 4, 0.5, 3}, Case{60e3, 0.5, 3, 25}, Case{200e3, 20, 0.1, 1},
          Case{kInfinity, 60, 0.01, 0.05}, Case{kInfinity, 0.5, 0.01, 0.05}}) {
        const Errors errors = errorsOf(Atmosphere(lookOf(c.visibility, c.sun)));
        EXPECT_LT(errors.rms, c.rms) << c.visibility << " m, sun " << c.sun;
        EXPECT_LT(errors.most, c.most) << c.visibility << " m, sun " << c.sun;
    }
}

// Koschmieder: of a contrast 2 % are left over the visibility.
TEST(Atmosphere, VisibilityIsTheMeteorologicalRange) {
    for (const double visibility : {500.0, 2e4, 1e5})
        EXPECT_NEAR(Atmosphere(lookOf(visibility, 40)).along({0, 0, 0}, {0, 1, 0}, visibility).through.y,
                    0.02, 1e-4);
}

TEST(Atmosphere, HoldsAtTheEnds) {
    for (const double visibility : {0.0, 10.0, 6e4, kInfinity})
        for (const double sun : {-90.0, -5.0, -0.2, 0.0, 0.1, 45.0, 90.0}) {
            const Atmosphere air(lookOf(visibility, sun));
            for (const double height : {-1e5, -400.0, 0.0, 8000.0, 1e5, 1e9})
                for (const double sine : {-1.0, -1e-3, -1e-9, 0.0, 1e-9, 1.0})
                    for (const double way : {0.0, 1e-3, 1.0, 1e6}) {
                        const AirSeen seen = air.along({1e6, 0, height}, directionOf(sine, 0.3), way);
                        for (int c = 0; c < 3; ++c) {
                            ASSERT_TRUE(std::isfinite(seen.light[c]) && seen.light[c] >= 0)
                                << seen.light[c] << " visibility " << visibility << " sun " << sun
                                << " height " << height << " sine " << sine << " way " << way;
                            ASSERT_TRUE(seen.through[c] >= 0 && seen.through[c] <= 1 + 1e-9);
                            if (way == 0) {
                                ASSERT_EQ(seen.light[c], 0);
                                ASSERT_EQ(seen.through[c], 1);
                            }
                        }
                    }
        }
}

// A level ray is between those that rise and fall a little, however long it is.
TEST(Atmosphere, LevelRaysAreAsTheirNeighbours) {
    const Atmosphere air(lookOf(6e4, 30));
    for (const double way : {1.0, 1e3, 1e5, 1e6})
        for (double rise = 1e-12; rise < 1e-3; rise *= 10)
            for (const double sign : {-1.0, 1.0}) {
                const AirSeen a = air.along({0, 0, 900}, directionOf(0, 1), way),
                              b = air.along({0, 0, 900}, directionOf(sign * rise, 1), way);
                const double bound = 1e-9 + 3 * rise * way / 1200;
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(a.light[c], b.light[c], std::min(0.05 + bound, bound));
            }
}

// Far away at sea is what the sky is above it.
TEST(Atmosphere, TheAirEndsInTheSky) {
    for (const double sun : {60.0, 10.0}) {
        const Atmosphere air(lookOf(3e4, sun, 300));
        for (const double beside : {0.5, 1.5, 3.0}) {
            const AirSeen far = air.along({0, 0, 300}, directionOf(0, beside), 2e5);
            const glm::vec3 sky = air.sky(glm::vec3(directionOf(0.001, beside)));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(std::sqrt(far.light[c]), std::sqrt(sky[c]), 0.03);
        }
    }
}

TEST(Atmosphere, SkiesAreBlueAboveAndRedTowardsTheSettingSunAndDarkAtNight) {
    const Atmosphere day(lookOf(6e4, 50)), evening(lookOf(6e4, 1)), night(lookOf(6e4, -20));
    const glm::vec3 up = day.sky({0, 0, 1}), low = evening.sky(glm::vec3(directionOf(0.03, 0.15)));
    EXPECT_GT(up.z, 1.5f * up.x);
    EXPECT_GT(low.x, 1.5f * low.z);
    EXPECT_GT(luminance(day.sky(glm::vec3(directionOf(0.05, 1.5)))), luminance(up));
    EXPECT_LT(luminance(night.sky({0, 0, 1})), 0.05f);
    EXPECT_GT(luminance(day.sky(glm::vec3(directionOf(std::sin(50 * kRadians), 0)))), 1.0f);  // the disc
}

TerrainScene wavesIn(double visibility, double sun) {
    TerrainScene scene = test::makeScene(test::makeGround("smooth", 97, 83, 7));
    Plane<PackedColor> image(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) image.at(x, y) = packColor({0.02f, 0.3f, 0.6f});
    scene.color = ColorTexture(image, {0.0, 0.0}, {12.0, 82.0 / 8});
    scene.look = lookOf(visibility, sun);
    return scene;
}

int channel(PackedColor color, int c) {
    return static_cast<int>(color >> 10 * c & 1023u);
}

TEST(Atmosphere, BelowTheHorizonIsTheSkyAtItWhereGroundEndsInHaze) {
    TerrainLook look;
    look.physicalSky = true;
    look.visibility = 100e3;
    look.skySeenFrom = 3000;
    const Atmosphere plain(look);
    look.hazyBelow = true;
    const Atmosphere hazy(look);
    const auto at = [](double degrees) {
        const double e = degrees * kPi / 180;
        return glm::vec3(std::cos(e), 0, std::sin(e));
    };
    for (const double above : {0.0, 0.5, 20.0, 90.0}) EXPECT_EQ(hazy.sky(at(above)), plain.sky(at(above)));
    // No darker band within some degrees of the horizon, where a plain is.
    const double horizon = luminance(hazy.sky(at(0)));
    for (const double below : {-1.0, -3.0, -6.0}) {
        EXPECT_NEAR(luminance(hazy.sky(at(below))), horizon, 0.1 * horizon) << below;
    }
    EXPECT_LT(luminance(plain.sky(at(-6))), 0.8 * horizon);
    EXPECT_EQ(hazy.sky({0, 0, -1}), plain.sky({0, 0, -1}));
}

TEST(Atmosphere, KernelsShowIt) {
    const glm::vec3 own = unpackColor(packColor({0.02f, 0.3f, 0.6f}));
    for (const double sun : {40.0, 3.0})
        for (const double visibility : {1500.0, 20e3}) {
            const TerrainScene scene = wavesIn(visibility, sun);
            const Fog air(scene.look);
            for (const double up : {0.0, 3000.0})
                for (const SimdTarget target : simdTargets()) {
                    const TerrainRenderer renderer(scene, target);
                    const EyeView view =
                        makeEyeView(poseFromAngles({-900, -700, 500 + up}, 0.9, up > 0 ? -1.1 : -0.3, 0.2),
                                    {90, 70, 0.9, 1.0, 0.1});
                    EyeImage image;
                    image.resize(view.width, view.height);
                    renderEye(renderer, view, image);
                    int checked = 0;
                    for (int y = 0; y < view.height; ++y)
                        for (int x = 0; x < view.width; ++x) {
                            const float depth = image.viewDepth.at(x, y);
                            if (!std::isfinite(depth)) continue;
                            const glm::vec3 seen =
                                air.seen(own, view.eye, view.rayDirection(x + 0.5, y + 0.5), depth);
                            for (int c = 0; c < 3; ++c)
                                ASSERT_NEAR(channel(image.color.at(x, y), c),
                                            1023 * std::sqrt(std::min(seen[c], 1.0f)), 1.8)
                                    << x << "," << y << " channel " << c << " visibility " << visibility;
                            ++checked;
                        }
                    EXPECT_GT(checked, 500);
                }
        }
}

// How far warped pixels are from a full cast: the root mean square over channels of ground, steps of 255.
double warpError(const TerrainScene& scene, double separation) {
    const TerrainRenderer renderer(scene);
    const Pose pose = poseFromAngles({-400, -1100, 420}, 0.2, -0.35, 0.05);
    const StereoViews views = makeStereoViews(pose, {203, 150, 1.2, 1.0, 1.0}, {separation, 1200});
    EyeImage left, right, full;
    left.resize(203, 150);
    full.resize(203, 150);
    renderEye(renderer, views.left, left);
    renderEye(renderer, views.right, full);
    RightEye eye;
    eye.render(renderer, views, left, {}, right);
    double squares = 0;
    int ground = 0;
    for (int y = 0; y < 150; ++y)
        for (int x = 0; x < 203; ++x) {
            if (full.viewDepth.at(x, y) == kMissDepth) continue;
            ++ground;
            for (int c = 0; c < 3; ++c)
                squares += std::pow(channel(full.color.at(x, y), c) - channel(right.color.at(x, y), c), 2);
        }
    EXPECT_GT(ground, 10000);
    return std::sqrt(squares / (3 * ground)) * 255 / 1023;
}

// Warped pixels keep the left eye's air. The eyes are 1/30 of the distance apart.
TEST(Atmosphere, TheRightEyesAirIsTheLeftOnesWithinAGreyLevel) {
    TerrainScene scene = wavesIn(20e3, 30);
    const double in = warpError(scene, 40);
    scene.look.physicalSky = false;
    const double without = warpError(scene, 40);
    EXPECT_LT(without, 0.1);
    EXPECT_LT(in, 1);
}

// The sun may move: sky and air follow.
TEST(Atmosphere, FollowsTheSun) {
    TerrainScene scene = wavesIn(20e3, 40);
    TerrainRenderer moved(scene);
    scene.look.sunElevation = 3 * kRadians;
    scene.look.sunAzimuth = 0.9;
    moved.sunMoved();
    scene.sky = skyMapOf(Atmosphere(scene.look));
    const TerrainRenderer fresh(scene);
    const EyeView view = makeEyeView(poseFromAngles({-900, -700, 500}, 0.9, 0, 0), {90, 70, 0.9, 1.0, 0.1});
    EyeImage a, b;
    a.resize(view.width, view.height);
    b.resize(view.width, view.height);
    renderEye(moved, view, a);
    renderEye(fresh, view, b);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) ASSERT_EQ(a.color.at(x, y), b.color.at(x, y));
}

}  // namespace
}  // namespace stereonav::atmosphere_test
