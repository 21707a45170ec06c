// Paint on ground whose samples are smaller than pixels, as far ground's are: a warped eye's depth is that of
// a pixel beside, and its ray meets the ground in another cell. Every pixel that shows ground is painted, as
// on a cast eye.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/camera/stereo_rig.h"
#include "engine/frame/cast_frames.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/paint/contour_painter.h"
#include "terrain/paint/raster_painter.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

// Hills of 600 m with 80 m from sample to sample on top of them.
TerrainScene roughHills() {
    constexpr int kSide = 400;
    std::vector<float> heights;
    unsigned state = 7;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            state = state * 1664525u + 1013904223u;
            const double noise = static_cast<double>(state >> 8) / 16777216.0;
            heights.push_back(
                static_cast<float>(300 * std::sin(0.05 * i) * std::cos(0.07 * j) + 300 + 80 * noise));
        }
    return test::makeScene(Heightfield(kSide, kSide, glm::dvec2(90), std::move(heights), "rough hills"));
}

struct BothWays {
    StereoViews views;
    EyePair warped, cast;
};

BothWays overHills(const TerrainScene& scene, int pose) {
    const TerrainRenderer renderer(scene);
    CastFrames frames(renderer);
    Lens lens;
    lens.width = 240, lens.height = 130, lens.nearDepth = 1, lens.verticalFov = 0.6;
    BothWays both;
    both.views = makeStereoViews(poseFromAngles({900.0 * pose, -14000, 1500}, 0.15 * pose - 0.2, -0.09, 0.02),
                                 lens, {250, 7000});
    FrameWay way;
    way.method = "linear";
    frames.make(both.views, 0, way, both.warped);
    way.method = "full";
    frames.make(both.views, 0, way, both.cast);
    for (EyeImage* image : {&both.warped.left, &both.warped.right, &both.cast.right})
        for (int y = 0; y < lens.height; ++y)
            std::fill_n(image->color.row(y), lens.width, packColor(glm::vec3(1.0f)));
    return both;
}

TEST(PaintOnRoughGround, IsOnEveryPixelThatShowsGround) {
    const TerrainScene scene = roughHills();
    const Fog none;
    Plane<float> values(400, 400);
    for (int j = 0; j < 400; ++j) std::fill_n(values.row(j), 400, 0.5f);
    const glm::vec3 red(1, 0, 0);
    const RasterPainter painter(scene.ground, none, std::move(values), {{red, 1.0f}, {red, 1.0f}});
    for (int pose = 0; pose < 3; ++pose) {
        BothWays both = overHills(scene, pose);
        int ground = 0;
        for (auto [view, image] : {std::pair(&both.views.left, &both.warped.left),
                                   std::pair(&both.views.right, &both.warped.right),
                                   std::pair(&both.views.right, &both.cast.right)}) {
            painter.paint(*view, *image);
            for (int y = 0; y < image->height(); ++y)
                for (int x = 0; x < image->width(); ++x) {
                    const bool shows = image->viewDepth.at(x, y) < kMissDepth;
                    ground += shows;
                    ASSERT_EQ(image->color.at(x, y), packColor(shows ? red : glm::vec3(1.0f)))
                        << pose << ": " << x << " " << y << " at " << image->viewDepth.at(x, y);
                }
        }
        EXPECT_GT(ground, 3 * 240 * 130 / 2);
    }
}

// Values that are smooth over many samples look alike on both.
TEST(PaintOnRoughGround, IsWhatACastEyeHas) {
    const TerrainScene scene = roughHills();
    const Fog none;
    Plane<float> values(400, 400);
    for (int j = 0; j < 400; ++j)
        for (int i = 0; i < 400; ++i)
            values.at(i, j) = static_cast<float>(0.5 + 0.5 * std::sin(0.06 * i) * std::cos(0.06 * j));
    const RasterPainter painter(scene.ground, none, std::move(values),
                                {{glm::vec3(0, 0, 1), 1.0f}, {glm::vec3(1, 0, 0), 1.0f}});
    double sum = 0;
    long long pixels = 0;
    for (int pose = 0; pose < 3; ++pose) {
        BothWays both = overHills(scene, pose);
        for (EyeImage* image : {&both.warped.right, &both.cast.right})
            painter.paint(both.views.right, *image);
        for (int y = 0; y < 130; ++y)
            for (int x = 0; x < 240; ++x) {
                const float a = both.warped.right.viewDepth.at(x, y), b = both.cast.right.viewDepth.at(x, y);
                // Not where the eyes show different ground: at crests.
                if (!(a < kMissDepth && b < kMissDepth) || std::abs(a - b) > 0.02f * b) continue;
                const glm::vec3 off = unpackColor(both.warped.right.color.at(x, y)) -
                                      unpackColor(both.cast.right.color.at(x, y));
                sum += std::abs(off.x), ++pixels;
                ASSERT_LT(std::abs(off.x), 0.35f) << pose << ": " << x << " " << y << " at " << b;
            }
    }
    ASSERT_GT(pixels, 3 * 240 * 130 / 2);
    EXPECT_LT(sum / static_cast<double>(pixels), 0.004);
}

// Lines that cross such ground are there on both.
TEST(PaintOnRoughGround, HasItsLines) {
    const TerrainScene scene = roughHills();
    const Fog none;
    const ContourPainter painter(scene.ground, none, {150, 1});
    for (int pose = 0; pose < 3; ++pose) {
        BothWays both = overHills(scene, pose);
        double ink[2] = {0, 0};
        for (const int n : {0, 1}) {
            EyeImage& image = n ? both.cast.right : both.warped.right;
            painter.paint(both.views.right, image);
            for (int y = 0; y < 130; ++y)
                for (int x = 0; x < 240; ++x) ink[n] += 1 - unpackColor(image.color.at(x, y)).x;
        }
        EXPECT_GT(ink[1], 50);
        EXPECT_NEAR(ink[0] / ink[1], 1, 0.03) << pose;
    }
}

}  // namespace
}  // namespace stereonav
