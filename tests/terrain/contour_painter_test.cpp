// Contour lines where they belong, as wide as they are said to be, and nowhere else.
#include "terrain/paint/contour_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/camera/stereo_rig.h"
#include "engine/frame/cast_frames.h"
#include "terrain/cast/terrain_renderer.h"
#include "tests/support/test_grounds.h"
#include "tests/terrain/painted_eyes.h"

namespace stereonav {
namespace {

using ContourGround = double (*)(const glm::dvec2& world);

Heightfield contourGround(ContourGround height, int side, double spacing) {
    std::vector<float> heights;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
            heights.push_back(static_cast<float>(height((glm::dvec2(i, j) - 0.5 * (side - 1)) * spacing)));
    return Heightfield(side, side, glm::dvec2(spacing), std::move(heights), "test");
}

double contourPlane(const glm::dvec2& p) {
    return 0.3 * p.x + 0.15 * p.y;
}
double contourCone(const glm::dvec2& p) {
    return 2000 - 0.5 * glm::length(p);
}
double contourLevel(const glm::dvec2&) {
    return 500;
}

EyeView contourView(const Pose& pose, int width, int height, double fov = 0.8) {
    Lens lens;
    lens.width = width, lens.height = height;
    lens.verticalFov = fov;
    lens.nearDepth = 0.5;
    return makeEyeView(pose, lens);
}

// The eye's depths, all white.
EyeImage contourWhite(const TerrainScene& scene, const EyeView& view) {
    const TerrainRenderer renderer(scene);
    EyeImage image;
    image.resize(view.width, view.height);
    renderEye(renderer, view, image);
    for (int y = 0; y < view.height; ++y)
        std::fill_n(image.color.row(y), view.width, packColor(glm::vec3(1.0f)));
    return image;
}

// How much of a white pixel is ink, 0 to 1.
double contourInkAt(const EyeImage& image, int x, int y) {
    return (1 - unpackColor(image.color.at(x, y)).x) / (1 - kContourInk[0]);
}

class Contours : public testing::Test {
protected:
    EyeImage painted(const TerrainScene& scene, const EyeView& view, const ContourSetting& setting) const {
        EyeImage image = contourWhite(scene, view);
        ContourPainter(scene.ground, mNoFog, setting).paint(view, image);
        return image;
    }
    Fog mNoFog;
};

// On a plane a line of one level is straight in the picture: column by column the middle of the ink is where
// the closed form has it, and there is as much of it as the line is wide, near and far.
TEST_F(Contours, LieOnAPlaneWhereTheyBelongAndAreAsWideAtAnyDistance) {
    const TerrainScene scene = test::makeScene(contourGround(contourPlane, 900, 100));
    double worst = 0;
    int lines = 0;
    for (const double distance : {300.0, 3000.0, 25000.0})
        for (const bool index : {false, true}) {
            // Level 0 goes through the middle of the ground; the interval leaves each line alone.
            const double interval = 0.06 * distance, shift = index ? 0 : interval;
            const glm::dvec3 middle =
                glm::dvec3(0.3, 0.15, 0) * (shift / (0.3 * 0.3 + 0.15 * 0.15)) + glm::dvec3(0, 0, shift);
            const EyeView view =
                contourView(poseFromAngles(middle + distance * glm::dvec3(0.2, -0.8, 0.55), -0.2, -0.6, 0.07),
                            161, 121, 0.5);
            const EyeImage image = painted(scene, view, {interval, 1});
            // Two points of the line.
            const glm::dvec3 along = glm::normalize(glm::dvec3(-0.15, 0.3, 0));
            const glm::dvec3 a = view.project(middle - 0.05 * distance * along),
                             b = view.project(middle + 0.05 * distance * along);
            const glm::dvec2 way = glm::normalize(glm::dvec2(b - a)), across(-way.y, way.x);
            const double width = index ? kIndexContourWidth : kContourWidth,
                         most = index ? kIndexContourShare : kContourShare;
            // Over a stretch of the line: ink by its distance from it.
            double ink = 0, moment = 0;
            const double length = 30;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const glm::dvec2 off = glm::dvec2(x + 0.5, y + 0.5) - 0.5 * glm::dvec2(a + b);
                    const double from = glm::dot(off, across);
                    if (std::abs(glm::dot(off, way)) > length || std::abs(from) > 3) continue;
                    const double share = contourInkAt(image, x, y) / most;
                    if (std::abs(from) > 0.5 * width + 0.55) {
                        EXPECT_NEAR(share, 0, 0.01) << distance << " at " << from;
                    }
                    ink += share, moment += share * from;
                }
            SCOPED_TRACE(std::to_string(distance) + (index ? " index" : ""));
            EXPECT_NEAR(ink / (2 * length), width, 0.06);
            EXPECT_NEAR(moment / ink, 0, 0.03);
            worst = std::max(worst, std::abs(moment / ink));
            ++lines;
        }
    EXPECT_EQ(lines, 6);
    std::printf("middles of lines off by up to %.4f pixels\n", worst);
}

// From straight above a cone's lines are circles.
TEST_F(Contours, OfAConeAreCircles) {
    const TerrainScene scene = test::makeScene(contourGround(contourCone, 801, 10));
    const double height = 9000, interval = 100, fov = 0.6;
    const int size = 401;
    const EyeView view =
        contourView(poseFromAngles({0, 0, height}, 0, -std::numbers::pi / 2, 0), size, size, fov);
    const EyeImage image = painted(scene, view, {interval, 1});
    struct Ring {
        double level, radius, ink = 0, moment = 0;
        bool index;
    };
    std::vector<Ring> rings;
    for (double level = 1900; level >= 600; level -= interval) {
        const double world = (2000 - level) / 0.5;
        rings.push_back({level, world / (height - level) / view.pixelWidth(), 0, 0,
                         std::fmod(level, interval * kIndexContour) == 0});
    }
    ASSERT_GT(rings.size(), 5u);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double r = std::hypot(x + 0.5 - 0.5 * size, y + 0.5 - 0.5 * size);
            auto nearest = std::min_element(rings.begin(), rings.end(), [&](const Ring& a, const Ring& b) {
                return std::abs(a.radius - r) < std::abs(b.radius - r);
            });
            if (r < 10 || r > rings.back().radius + 3) continue;
            const double ink = contourInkAt(image, x, y);
            if (std::abs(r - nearest->radius) > 1.7) {
                ASSERT_NEAR(ink, 0, 0.01) << "at a radius of " << r;
                continue;
            }
            nearest->ink += ink;
            nearest->moment += ink * (r - nearest->radius);
        }
    for (const Ring& ring : rings) {
        SCOPED_TRACE(ring.level);
        if (ring.radius > 0.5 * size - 3) continue;
        const double width =
            (ring.index ? kIndexContourWidth * kIndexContourShare : kContourWidth * kContourShare);
        EXPECT_NEAR(ring.ink / (2 * std::numbers::pi * ring.radius), width, 0.05 * width);
        EXPECT_NEAR(ring.moment / ring.ink, 0, 0.05);
    }
}

// Both eyes of a frame: the right one warped, and cast in full. Painted on white, away from silhouettes and
// holes, so that what differs is the paint alone.
TEST_F(Contours, AreTheSameOnAWarpedEyeAsOnACastOne) {
    const TerrainScene scene = test::makeScene(test::makeGround("smooth", 200, 180, 3));
    const TerrainRenderer renderer(scene);
    CastFrames frames(renderer);
    Lens lens;
    lens.width = 320, lens.height = 200, lens.nearDepth = 0.5;
    double worst = 0, sum = 0, inked = 0;
    long long pixels = 0, off = 0;
    for (int pose = 0; pose < 3; ++pose) {
        const StereoViews views =
            makeStereoViews(poseFromAngles({200.0 * pose, -1500, 420}, 0.3 * pose, -0.3, 0), lens, {30, 900});
        EyePair warped, cast;
        FrameWay way;
        way.method = "linear";
        frames.make(views, 0, way, warped);
        way.method = "full";
        frames.make(views, 0, way, cast);
        const ContourPainter painter(scene.ground, mNoFog, {20, 1});
        for (EyeImage* image : {&warped.right, &cast.right}) {
            for (int y = 0; y < lens.height; ++y)
                std::fill_n(image->color.row(y), lens.width, packColor(glm::vec3(1.0f)));
            painter.paint(views.right, *image);
        }
        const Plane<float>& depth = cast.right.viewDepth;
        for (int y = 2; y + 2 < lens.height; ++y)
            for (int x = 2; x + 2 < lens.width; ++x) {
                if (test::bends(depth, x, y)) continue;
                const double a = test::greyAt(warped.right, x, y), b = test::greyAt(cast.right, x, y);
                off += std::abs(a - b) > 1;
                worst = std::max(worst, std::abs(a - b));
                sum += std::abs(a - b);
                inked += b < 250;
                ++pixels;
            }
    }
    std::printf(
        "%.1f %% inked; off by %.5f grey levels on average, %.2f at most, %lld of %lld by more than one\n",
        100 * inked / static_cast<double>(pixels), sum / static_cast<double>(pixels), worst, off, pixels);
    EXPECT_GT(inked, 0.03 * static_cast<double>(pixels));
    EXPECT_LT(sum, 0.001 * static_cast<double>(pixels));
    // How much lines fade goes by the depths beside, which a warped eye has from one pixel on.
    EXPECT_LE(off, pixels / 10000);
}

TEST_F(Contours, AreNotOnLevelGroundSkyHolesAndThingsThatStandOnIt) {
    const TerrainScene level = test::makeScene(contourGround(contourLevel, 60, 30));
    const EyeView view = contourView(poseFromAngles({0, -500, 700}, 0, -0.2, 0), 90, 70);
    const auto untouched = [](const EyeImage& image) {
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                if (image.color.at(x, y) != packColor(glm::vec3(1.0f))) return false;
        return true;
    };
    for (const double interval : {500.0, 100.0, 0.001, 1e6, 0.0})
        EXPECT_TRUE(untouched(painted(level, view, {interval, 1}))) << interval;
    const TerrainScene hilly = test::makeScene(test::makeGround("holed", 60, 60, 1));
    EXPECT_FALSE(
        untouched(painted(hilly, contourView(poseFromAngles({0, -300, 300}, 0, -0.6, 0), 90, 70), {5, 1})));
    const ContourPainter painter(hilly.ground, mNoFog, {5, 1});
    EyeImage image = contourWhite(hilly, view);
    for (const float share : {0.5f, -1.0f, 0.0f, 3.0f, std::numeric_limits<float>::quiet_NaN(), 1e30f}) {
        EyeImage other = image;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) other.viewDepth.at(x, y) *= share;
        painter.paint(view, other);
        EXPECT_TRUE(untouched(other)) << share;
    }
    EyeImage none;
    painter.paint(view, none);
}

// Lines that would be closer than pixels leave nothing behind, at any distance.
TEST_F(Contours, FadeWhereTheyCrowd) {
    const TerrainScene scene = test::makeScene(contourGround(contourPlane, 900, 100));
    for (const double distance : {300.0, 25000.0}) {
        const EyeView view =
            contourView(poseFromAngles(distance * glm::dvec3(0.2, -0.8, 0.55), -0.2, -0.6, 0), 161, 121, 0.5);
        for (const double share : {0.06, 0.01, 0.003, 0.0002}) {
            const EyeImage image = painted(scene, view, {share * distance, 1});
            double ink = 0;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) ink += contourInkAt(image, x, y);
            ink /= view.width * view.height;
            SCOPED_TRACE(share);
            if (share < 0.001) {
                EXPECT_LT(ink, 1e-3);
            } else {
                EXPECT_GT(ink, 0.005);
            }
            EXPECT_LT(ink, kIndexContourShare * kContourWidth / kContourGone) << "never a grey veil";
        }
    }
}

TEST_F(Contours, CountTheMetresOfTheFile) {
    const TerrainScene scene = test::makeScene(contourGround(contourPlane, 200, 30));
    const EyeView view = contourView(poseFromAngles({0, -900, 500}, 0, -0.4, 0), 120, 90);
    const EyeImage high = painted(scene, view, {30, 2}), low = painted(scene, view, {60, 1});
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) ASSERT_EQ(high.color.at(x, y), low.color.at(x, y));
}

TEST_F(Contours, GoIntoTheFogWithTheGround) {
    const TerrainScene scene = test::makeScene(contourGround(contourPlane, 200, 30));
    const EyeView view = contourView(poseFromAngles({0, -900, 500}, 0, -0.4, 0), 120, 90);
    TerrainLook look;
    look.fogDistance = 300;
    look.fogColor = {1, 1, 1};
    const Fog fog(look);
    EyeImage image = contourWhite(scene, view);  // white in white fog
    ContourPainter(scene.ground, fog, {60, 1}).paint(view, image);
    const EyeImage clear = painted(scene, view, {60, 1});
    double most = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            if (contourInkAt(clear, x, y) < 0.3) continue;
            const double way = image.viewDepth.at(x, y) * glm::length(view.rayDirection(x + 0.5, y + 0.5));
            const double expected = contourInkAt(clear, x, y) * std::exp(-way / 300);
            most = std::max(most, expected);
            ASSERT_NEAR(contourInkAt(image, x, y), expected, 0.006);
        }
    EXPECT_GT(most, 0.05);
}

TEST_F(Contours, DoNotDependOnThreads) {
    const TerrainScene scene = test::makeScene(test::makeGround("rough", 100, 90, 5));
    const EyeView view = contourView(poseFromAngles({0, -900, 300}, 0, -0.4, 0.3), 131, 77);
    const EyeImage many = painted(scene, view, {5, 1});
    const int threads = threadCount();
    setThreadCount(1);
    const EyeImage one = painted(scene, view, {5, 1});
    setThreadCount(threads);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) ASSERT_EQ(many.color.at(x, y), one.color.at(x, y));
}

// Pixels that two ways of painting lines colour differently: by more than a step of 1023, and the most.
struct ContourOff {
    long long pixels = 0, inked = 0;
    int most = 0;
};
ContourOff contourOff(const EyeImage& a, const EyeImage& b) {
    ContourOff off;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const int steps = std::abs(static_cast<int>(a.color.at(x, y) & 1023) -
                                       static_cast<int>(b.color.at(x, y) & 1023));
            off.pixels += steps > 4, off.most = std::max(off.most, steps);
            off.inked += b.color.at(x, y) != packColor(glm::vec3(1.0f));
        }
    return off;
}

// The kernels of each instruction set paint what the plain way does: 4 steps of 1023 are a grey level. Where
// a pixel's ray meets the ground at an edge of a cell rounding says which one it is, so a few may differ
// more.
TEST_F(Contours, OfEachInstructionSetAreThoseOfThePlainWay) {
    TerrainLook foggy;
    foggy.fogDistance = 2000;
    const Fog fog(foggy);
    long long inked = 0, pixels = 0;
    int looks = 0;
    for (const char* kind : {"smooth", "rough", "holed", "lake"})
        for (const glm::dvec3& place : {glm::dvec3(0, -900, 300), glm::dvec3(30, -200, 900),
                                        glm::dvec3(-4000, -9000, 3000), glm::dvec3(12.5, 40, 203)}) {
            const TerrainScene scene = test::makeScene(kind == std::string("lake")
                                                           ? contourGround(
                                                                 [](const glm::dvec2& p) {
                                                                     return 200 + std::max(0.0, 0.001 * p.x) -
                                                                            std::max(0.0, 0.4 * p.y);
                                                                 },
                                                                 90, 20)
                                                           : test::makeGround(kind, 100, 90, 5));
            const EyeView view = contourView(poseFromAngles(place, -0.1, -0.25, 0.2), 203, 77);
            const EyeImage white = contourWhite(scene, view);
            for (const ContourSetting& setting :
                 {ContourSetting{5, 1}, ContourSetting{37.5, 2.5}, ContourSetting{0.4, 1}}) {
                const Fog& air = looks % 2 == 0 ? mNoFog : fog;
                EyeImage plainly = white;
                ContourPainter(scene.ground, air, setting).paintPlainly(view, plainly);
                for (const SimdTarget target : simdTargets()) {
                    EyeImage image = white;
                    ContourPainter(scene.ground, air, setting, target).paint(view, image);
                    const ContourOff off = contourOff(image, plainly);
                    EXPECT_LE(off.pixels, 2 + off.inked / 200)
                        << kind << " " << looks << " " << setting.interval << " " << nameOf(target) << " of "
                        << off.inked << ", most " << off.most;
                    inked += off.inked, pixels += off.pixels;
                }
                ++looks;
            }
        }
    std::printf("%lld of %lld inked pixels off by more than a grey level\n", pixels, inked);
    EXPECT_GT(inked, 30000);
    EXPECT_LT(pixels, inked / 1000);
}

// Where floats have no digits for lines the plain way paints.
TEST_F(Contours, OfTooManyLevelsArePaintedPlainly) {
    const TerrainScene scene =
        test::makeScene(contourGround([](const glm::dvec2& p) { return 8000 + 1e-4 * p.x; }, 60, 30));
    const EyeView view = contourView(poseFromAngles({0, 0, 8400}, 0, -1.2, 0), 90, 70);
    const EyeImage image = painted(scene, view, {0.001, 1});
    EyeImage plainly = contourWhite(scene, view);
    ContourPainter(scene.ground, mNoFog, {0.001, 1}).paintPlainly(view, plainly);
    const ContourOff off = contourOff(image, plainly);
    EXPECT_EQ(off.most, 0);
    EXPECT_GT(off.inked, 0);
}

TEST(ContourInterval, IsNiceForAnyRelief) {
    EXPECT_EQ(contourIntervalFor(0), 0);
    EXPECT_EQ(contourIntervalFor(std::nan("")), 0);
    EXPECT_EQ(contourIntervalFor(2500), 100);
    EXPECT_EQ(contourIntervalFor(90), 5);
    for (double relief = 1e-3; relief < 1e7; relief *= 1.37) {
        const double lines = relief / contourIntervalFor(relief);
        EXPECT_GE(lines, 11);
        EXPECT_LE(lines, 30.001);
    }
}

}  // namespace
}  // namespace stereonav
