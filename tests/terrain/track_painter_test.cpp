// Tracks on the ground: where they belong, hidden where a hill hides them, the same on a warped eye.
#include "terrain/paint/track_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/camera/stereo_rig.h"
#include "engine/frame/cast_frames.h"
#include "terrain/cast/plain_caster.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/paint/raster_painter.h"
#include "tests/support/test_grounds.h"
#include "tests/terrain/painted_eyes.h"

namespace stereonav {
namespace {

EyeView trackView(const Pose& pose) {
    Lens lens;
    lens.width = 240, lens.height = 180, lens.nearDepth = 0.5;
    return makeEyeView(pose, lens);
}

void whiten(EyeImage& image) {
    for (int y = 0; y < image.height(); ++y)
        std::fill_n(image.color.row(y), image.width(), packColor(glm::vec3(1.0f)));
}

EyeImage trackWhite(const TerrainScene& scene, const EyeView& view) {
    const TerrainRenderer renderer(scene);
    EyeImage image;
    image.resize(view.width, view.height);
    renderEye(renderer, view, image);
    whiten(image);
    return image;
}

bool isPainted(const EyeImage& image, int x, int y) {
    return unpackColor(image.color.at(x, y)).y < 0.6f;
}

class Tracks : public testing::Test {
protected:
    Fog mNoFog;
};

// Places of the line whose view nothing hides are painted, hidden ones and all that is far from the line on
// the screen are not.
TEST_F(Tracks, AreSeenWhereTheGroundIsAndNowhereElse) {
    long long seen = 0, hidden = 0, wrong = 0, stray = 0;
    for (const char* kind : {"flat", "tilted", "smooth", "holed"}) {
        const TerrainScene scene = test::makeScene(test::makeGround(kind, 120, 110, 2));
        const std::vector<glm::dvec2> line{{-1500, -700}, {-200, 300}, {900, -200}, {1400, 1000}};
        const TrackPainter painter(scene.ground, mNoFog, {line}, {});
        for (int pose = 0; pose < 4; ++pose) {
            const EyeView view = trackView(
                poseFromAngles({-600.0 + 300 * pose, -1300, 500.0 + 60 * pose}, 0.2 * pose, -0.35, 0));
            EyeImage image = trackWhite(scene, view);
            painter.paint(view, image);
            Plane<std::uint8_t> near(view.width, view.height);
            for (std::size_t n = 0; n + 1 < line.size(); ++n)
                for (int k = 0; k <= 4000; ++k) {
                    const glm::dvec2 at = glm::mix(line[n], line[n + 1], k / 4000.0);
                    const double height = scene.ground.heightAt(at);
                    if (!std::isfinite(height)) continue;
                    const glm::dvec3 p = view.project({at, height});
                    if (!(p.z > 0.5) || !(std::abs(p.x) < 1e4 && std::abs(p.y) < 1e4)) continue;
                    const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
                    for (int j = std::max(0, y - 4); j <= std::min(view.height - 1, y + 4); ++j)
                        for (int i = std::max(0, x - 4); i <= std::min(view.width - 1, x + 4); ++i)
                            near.at(i, j) = 1;
                    if (x < 4 || y < 4 || x >= view.width - 4 || y >= view.height - 4) continue;
                    const GroundHit hit =
                        castPlain(scene.ground, view.eye, glm::dvec3(at, height) - view.eye, 1e-6);
                    if (hit.t > 0.999) {
                        ++seen;
                        wrong += !isPainted(image, x, y);
                    } else if (hit.t < 0.9) {
                        ++hidden;
                    }
                }
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const bool ink = image.color.at(x, y) != packColor(glm::vec3(1.0f));
                    if (ink && !near.at(x, y)) ++stray;
                }
        }
    }
    std::printf("%lld places seen, %lld of them not painted; %lld hidden\n", seen, wrong, hidden);
    EXPECT_GT(seen, 20000);
    EXPECT_GT(hidden, 500);
    EXPECT_EQ(stray, 0);
    EXPECT_LT(wrong, 0.01 * seen);
}

// A ridge before a line that runs behind it, and beside that in the open.
TEST_F(Tracks, AreHiddenByARidge) {
    std::vector<float> heights(100 * 100, 0.0f);
    for (int i = 0; i < 50; ++i)
        for (int j = 40; j < 43; ++j) heights[static_cast<std::size_t>(j * 100 + i)] = 400;
    TerrainScene scene = test::makeScene(Heightfield(100, 100, glm::dvec2(20), std::move(heights), "ridge"));
    const EyeView view = trackView(poseFromAngles({0, -900, 120}, 0, -0.12, 0));
    EyeImage image = trackWhite(scene, view);
    TrackPainter(scene.ground, mNoFog, {{{-300, 200}, {300, 200}}}, {{-100, 200}, {200, 100}})
        .paint(view, image);
    int left = 0, right = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            if (image.color.at(x, y) != packColor(glm::vec3(1.0f))) ++(x < view.width / 2 - 6 ? left : right);
    EXPECT_EQ(left, 0);
    EXPECT_GT(right, 100);
    const glm::dvec3 mark = view.project({200, 100, 0});
    EXPECT_TRUE(isPainted(image, static_cast<int>(mark.x), static_cast<int>(mark.y)));
}

TEST_F(Tracks, AreTheSameOnAWarpedEyeAsOnACastOne) {
    const TerrainScene scene = test::makeScene(test::makeGround("smooth", 200, 180, 3));
    const TerrainRenderer renderer(scene);
    CastFrames frames(renderer);
    Lens lens;
    lens.width = 320, lens.height = 200, lens.nearDepth = 0.5;
    const TrackPainter painter(scene.ground, mNoFog, {{{-900, -800}, {0, -300}, {500, 400}, {-600, 900}}},
                               {});
    Plane<float> values(200, 180);
    for (int j = 0; j < 180; ++j)
        for (int i = 0; i < 200; ++i)
            values.at(i, j) =
                0.5f + 0.5f * std::sin(0.3f * static_cast<float>(i)) * std::cos(0.2f * static_cast<float>(j));
    const RasterPainter coat(scene.ground, mNoFog, std::move(values),
                             {{glm::vec3(0.1f), 0}, {glm::vec3(0.1f), 0.6f}});
    double sum = 0, worstCoat = 0;
    long long pixels = 0, inked = 0, off = 0;
    for (int pose = 0; pose < 3; ++pose) {
        const StereoViews views = makeStereoViews(
            poseFromAngles({200.0 * pose, -1500, 420}, -0.1 * pose, -0.3, 0), lens, {30, 900});
        EyePair warped, cast;
        FrameWay way;
        way.method = "linear";
        frames.make(views, 0, way, warped);
        way.method = "full";
        frames.make(views, 0, way, cast);
        const Plane<float>& depth = cast.right.viewDepth;
        for (const EyePainter* const which :
             {static_cast<const EyePainter*>(&painter), static_cast<const EyePainter*>(&coat)}) {
            for (EyeImage* image : {&warped.right, &cast.right}) {
                whiten(*image);
                which->paint(views.right, *image);
            }
            for (int y = 2; y + 2 < lens.height; ++y)
                for (int x = 2; x + 2 < lens.width; ++x) {
                    if (test::bends(depth, x, y)) continue;
                    const double a = test::greyAt(warped.right, x, y), b = test::greyAt(cast.right, x, y);
                    if (which == &coat) {
                        worstCoat = std::max(worstCoat, std::abs(a - b));
                        continue;
                    }
                    sum += std::abs(a - b);
                    off += std::abs(a - b) > 1;
                    inked += b < 250;
                    ++pixels;
                }
        }
    }
    std::printf("%lld of %lld pixels inked, %lld off by more than a grey level, mean %.5f; a coat by %.3f\n",
                inked, pixels, off, sum / static_cast<double>(pixels), worstCoat);
    EXPECT_GT(inked, 500);
    EXPECT_LT(off, 0.02 * static_cast<double>(inked));
    EXPECT_LT(worstCoat, 1);
}

TEST_F(Tracks, TellHowMuchLiesOutside) {
    const Heightfield ground = test::makeGround("flat", 11, 11, 1);  // 300 x 250 m
    const TrackPainter across(ground, mNoFog, {{{-250, 0}, {250, 0}}}, {});
    EXPECT_NEAR(across.length(), 500, 1e-9);
    EXPECT_NEAR(across.lengthOutside(), 200, 1e-9);
    const TrackPainter beside(ground, mNoFog, {{{-250, 200}, {250, 200}}}, {{1000, 0}});
    EXPECT_NEAR(beside.lengthOutside(), 500, 1e-9);
    const TrackPainter within(ground, mNoFog, {{{-150, -125}, {150, 125}, {150, 125}}}, {});
    EXPECT_NEAR(within.lengthOutside(), 0, 1e-9);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const TrackPainter none(ground, mNoFog, {{{nan, 0}, {1, 1}}, {{5, 5}}, {}}, {{nan, nan}});
    const TerrainScene scene = test::makeScene(test::makeGround("flat", 11, 11, 1));
    const EyeView view = trackView(poseFromAngles({0, -100, 40}, 0, -0.3, 0));
    EyeImage image = trackWhite(scene, view), before = image;
    none.paint(view, image);
    beside.paint(view, image);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) ASSERT_EQ(image.color.at(x, y), before.color.at(x, y));
    EyeImage empty;
    within.paint(view, empty);
}

// Lines under the eye, behind it and across its near plane.
TEST_F(Tracks, PassUnderTheEye) {
    const TerrainScene scene = test::makeScene(test::makeGround("flat", 60, 60, 1));
    const EyeView view = trackView(poseFromAngles({0, 0, 2}, 0, -0.3, 0));
    EyeImage image = trackWhite(scene, view);
    TrackPainter(scene.ground, mNoFog, {{{0, -500}, {0, 500}}}, {{0, -100}}).paint(view, image);
    int inked = 0;
    for (int y = view.height / 2; y < view.height; ++y) inked += isPainted(image, view.width / 2, y);
    EXPECT_EQ(inked, view.height - view.height / 2);
}

}  // namespace
}  // namespace stereonav
