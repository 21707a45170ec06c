// Ground coloured by how it lies, against planes; tracks that are flown.
#include "terrain/scene/slope_color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "terrain/scene/followed_track.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

Heightfield slopePlane(const glm::dvec2& gradient) {
    std::vector<float> heights;
    for (int j = 0; j < 21; ++j)
        for (int i = 0; i < 21; ++i)
            heights.push_back(static_cast<float>(gradient.x * 30 * (i - 10) + gradient.y * 25 * (j - 10)));
    return Heightfield(21, 21, {30, 25}, std::move(heights), "plane");
}

PackedColor middleOf(const ColorTexture& texture) {
    const auto& level = texture.level(0);
    return level.at(level.width() / 2, level.height() / 2);
}

TEST(SlopeColor, OfPlanesIsTheirClass) {
    Progress progress;
    TerrainLook unlit;
    unlit.ambient = 1;
    const Legend legend = legendOfPaint(GroundPaint::Slope);
    ASSERT_EQ(legend.entries.size(), 9u);
    const double middles[] = {2, 7, 12, 17, 22, 27, 32, 40, 60};
    for (std::size_t n = 0; n < 9; ++n)
        for (const double scale : {1.0, 3.0})
            for (const double azimuth : {0.0, 1.0, 4.0}) {
                const double rise = scale * std::tan(middles[n] * kRadians);
                const GroundColor color =
                    paintedGround(slopePlane(rise * glm::dvec2(std::sin(azimuth), std::cos(azimuth))), scale,
                                  GroundPaint::Slope, unlit, progress);
                EXPECT_EQ(middleOf(color.texture), packColor(legend.entries[n].color)) << middles[n];
                EXPECT_FALSE(color.holdsSun);
            }
}

TEST(SlopeColor, OfAspectGoesByWhereTheGroundFalls) {
    const Legend legend = legendOfPaint(GroundPaint::Aspect);
    ASSERT_EQ(legend.entries.size(), 9u);
    EXPECT_EQ(aspectColor({0, 0}), legend.entries[0].color);
    EXPECT_EQ(aspectColor({0.049, 0}), legend.entries[0].color);
    for (int n = 0; n < 8; ++n)
        for (const double off : {-0.35, 0.0, 0.35}) {
            const double falls = n * std::numbers::pi / 4 + off;
            const glm::dvec2 gradient = -0.8 * glm::dvec2(std::sin(falls), std::cos(falls));
            EXPECT_EQ(aspectColor(gradient), legend.entries[static_cast<std::size_t>(n) + 1].color)
                << n << " " << off;
            EXPECT_NE(aspectColor(0.1 * gradient), aspectColor(gradient));
            EXPECT_NE(aspectColor(0.4 * gradient), aspectColor(gradient));
        }
    EXPECT_EQ(legend.entries[1].text, "falls to the north");
}

// Lambert's law on planes in the look's sun; the steeper side of Horn's differences on a plane is the
// plane's.
TEST(SlopeColor, OfAHillshadeIsTheLightOnAPlane) {
    Progress progress;
    TerrainLook look;
    for (const glm::dvec2 gradient :
         {glm::dvec2(0.0), glm::dvec2(0.5, -0.3), glm::dvec2(-2, 1), glm::dvec2(3, -3)}) {
        const Heightfield ground = slopePlane(gradient);
        EXPECT_NEAR(glm::length(hornGradient(ground, 7, 9) - gradient), 0, 1e-5);
        EXPECT_NEAR(hornGradient(ground, 0, 20).x, 0.5 * gradient.x * (1.0), std::abs(gradient.x) + 1e-9);
        const glm::dvec3 sun(std::cos(look.sunElevation) * std::sin(look.sunAzimuth),
                             std::cos(look.sunElevation) * std::cos(look.sunAzimuth),
                             std::sin(look.sunElevation));
        const double light = std::max(0.0, glm::dot(glm::normalize(glm::dvec3(-gradient, 1.0)), sun));
        const GroundColor color = paintedGround(ground, 1, GroundPaint::Hillshade, look, progress);
        const glm::vec3 seen = unpackColor(middleOf(color.texture));
        EXPECT_NEAR(srgbFromLinear(seen.x), light, 0.004);
        EXPECT_EQ(seen.x, seen.z);
        EXPECT_TRUE(color.holdsSun);
    }
    EXPECT_EQ(groundPaintNamed("slopes"), std::nullopt);
    // Holes and what is beside them stay finite.
    const GroundColor holed =
        paintedGround(test::makeGround("holed", 30, 30, 1), 1, GroundPaint::Hillshade, look, progress);
    EXPECT_GT(holed.texture.levelCount(), 0);
}

TEST(FollowedTrack, GoesAlongItAboveTheGroundWithoutJerks) {
    for (const char* kind : {"flat", "smooth", "rough", "spiked", "holed"}) {
        const Heightfield ground = test::makeGround(kind, 150, 140, 4);
        const std::vector<glm::dvec2> places{{-1500, -900}, {-400, -800}, {-350, 200},  {900, 300},
                                             {905, 290},    {900, 300},   {1200, -1100}};
        const double height = 40;
        const RecordedPath path = followTrack(ground, places, height, "walk.gpx");
        double length = 0;
        for (std::size_t n = 1; n < places.size(); ++n) length += glm::length(places[n] - places[n - 1]);
        EXPECT_NEAR(path.duration(), length / height, 1e-6);
        EXPECT_NEAR(glm::length(glm::dvec2(path.at(path.startTime()).position) - places.front()), 0, 1e-6);
        double turned = 0, lowest = 1e9;
        Pose before = path.at(0);
        for (double t = 0; t <= path.duration(); t += 0.02) {
            const Pose pose = path.at(t);
            const glm::dvec3 forward = pose.forward();
            const glm::dvec3 old = before.forward();
            turned = std::max(turned, std::acos(std::clamp(glm::dot(forward, old), -1.0, 1.0)) / 0.02);
            const double under = ground.heightAt(glm::dvec2(pose.position));
            if (std::isfinite(under)) lowest = std::min(lowest, pose.position.z - under);
            before = pose;
        }
        SCOPED_TRACE(kind);
        EXPECT_GE(lowest, height - 1e-6);
        EXPECT_LT(turned, 90 * kRadians) << "a second";
        if (kind == std::string("flat")) {
            EXPECT_NEAR(lowest, height, 1e-6);
        }
    }
    const Heightfield ground = test::makeGround("flat", 20, 20, 1);
    // The middle ray of a level flight meets level ground in the screen.
    const Pose first = followTrack(ground, {{-200, 0}, {200, 0}}, 50, "walk.gpx").at(0);
    const double seen = followedEyes(50).zeroParallax;
    EXPECT_NEAR((first.position + seen * first.forward()).z, 0, 1e-6);
    EXPECT_NEAR(followedEyes(50).separation, seen / 30, 1e-9);
    EXPECT_THROW(followTrack(ground, {{1, 1}, {1, 1}}, 50, "walk.gpx"), Error);
    EXPECT_THROW(followTrack(ground, {{1, 1}}, 50, "walk.gpx"), Error);
    // Long ones go faster, short ones take two steps.
    EXPECT_NEAR(followTrack(ground, {{-200, 0}, {200, 0}}, 1e-3, "walk.gpx").duration(), kLongestFollow,
                1e-6);
    EXPECT_GT(followTrack(ground, {{0, 0}, {0, 1e-3}}, 1e5, "walk.gpx").duration(), 0);
}

}  // namespace
}  // namespace stereonav
