// The right eye of translucent scenes: rays that start where the left eye's depths say, against the full
// cast. The glass meets only what lies at or behind the given depth, so a start too far is seen.
#include "engine/stereo/depth_splat.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <vector>

#include "engine/stereo/right_eye.h"
#include "tests/support/analytic_scene.h"

namespace stereonav {
namespace {

using namespace test;

StereoViews viewsOf(int width, int height, double separation, double zeroParallax = 6) {
    Lens lens;
    lens.width = width;
    lens.height = height;
    return makeStereoViews(Pose{}, lens, {separation, zeroParallax});
}

GlassScene shellBeforeWall() {
    return GlassScene({sphere({-0.6, 0.3, -5}, 1.2), sphereFromInside({-0.6, 0.3, -5}, 1.2),
                       sphere({1.4, -0.4, -3.5}, 0.5), sphereFromInside({1.4, -0.4, -3.5}, 0.5)},
                      plane({0, 0, -12}, {0.2, 0.3, 1}), 3.0);
}

GlassScene shellBeforeSky() {
    return GlassScene(
        {sphere({0, 0, -5}, 1.4), sphereFromInside({0, 0, -5}, 1.4)},
        [](const glm::dvec3&, const glm::dvec3&) { return SurfacePoint{}; }, 3.0);
}

struct Splatted {
    EyeImage left, right, full;
    RightEyeTimings timings;
    Plane<std::uint8_t> unknown;
};

Splatted splat(const EyeRenderer& scene, const StereoViews& views, WarpSetting setting = {}) {
    Splatted result;
    result.left = castEye(scene, views.left);
    result.full = castEye(scene, views.right);
    RightEye eye;
    setting.method = RightEyeMethod::DepthSplat;
    result.timings = eye.render(scene, views, result.left, setting, result.right);
    result.unknown = eye.holeMask();
    return result;
}

int differing(const EyeImage& a, const EyeImage& b) {
    int count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            count += a.color.at(x, y) != b.color.at(x, y) || a.viewDepth.at(x, y) != b.viewDepth.at(x, y);
    return count;
}

TEST(DepthSplat, isTheFullCastWhereverTheLeftEyeSawTheNearest) {
    for (const double separation : {0.02, 0.2, 0.6})
        for (const bool wall : {true, false}) {
            const GlassScene scene = wall ? shellBeforeWall() : shellBeforeSky();
            const Splatted r = splat(scene, viewsOf(320, 240, separation));
            EXPECT_EQ(differing(r.right, r.full), 0) << separation << " " << wall;
            EXPECT_LT(r.timings.holePixels, 320 * 240 / 5) << "most rays know where to start";
            EXPECT_GT(r.timings.holePixels, 0) << "not what only the right eye sees";
        }
}

// Keeps the starts that it was given.
class StartScene final : public EyeRenderer {
public:
    explicit StartScene(const AnalyticScene& scene) : mScene(scene) {}
    int tileCount(const EyeView& view) const override { return mScene.tileCount(view); }
    void renderTile(const EyeView& view, int tile, EyeImage& image) const override {
        mScene.renderTile(view, tile, image);
    }
    void renderPixels(const EyeView&, PixelRect, std::span<const PixelIndex>, EyeImage&) const override {
        throw std::logic_error("pixels cast one by one");
    }
    bool mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column, double scale) const override {
        return mScene.mayHitBeyondEdge(view, rect, column, scale);
    }
    bool translucent() const override { return true; }
    void renderTileFromDepth(const EyeView&, int, EyeImage&) const override { ++mTiles; }
    int tiles() const { return mTiles; }

private:
    const AnalyticScene& mScene;
    mutable std::atomic<int> mTiles = 0;
};

TEST(DepthSplat, startsLieInFrontOfEverythingAndNotFar) {
    const AnalyticScene scene({plane({0, 0, -12}, {0.2, 0.3, 1}), sphere({-0.6, 0.3, -5}, 1.2)});
    const StartScene starts(scene);
    const StereoViews views = viewsOf(320, 240, 0.3);
    WarpSetting setting;
    const Splatted r = splat(starts, views, setting);
    EXPECT_EQ(starts.tiles(), 240) << "each tile once";
    long long known = 0, close = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
            const float start = r.right.viewDepth.at(x, y), truth = r.full.viewDepth.at(x, y);
            ASSERT_EQ(r.unknown.at(x, y) != 0, start == 0) << x << "," << y;
            ASSERT_LE(start, truth) << x << "," << y;
            known += start > 0;
            close += start > 0.9f * truth;
        }
    EXPECT_EQ(320 * 240 - known, r.timings.holePixels);
    EXPECT_GT(known, 320 * 240 * 8 / 10);
    EXPECT_GT(close, known * 9 / 10);
}

TEST(DepthSplat, knowsWhereNothingIs) {
    const AnalyticScene scene({sphere({0, 0, -5}, 1.0)});
    const StartScene starts(scene);
    const Splatted r = splat(starts, viewsOf(160, 120, 0.2));
    int nothing = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
            const float start = r.right.viewDepth.at(x, y);
            ASSERT_LE(start, r.full.viewDepth.at(x, y)) << x << "," << y;
            if (start == kMissDepth && x > 0 && x < 159) {
                ++nothing;
                ASSERT_EQ(r.full.viewDepth.at(x - 1, y), kMissDepth) << "the sphere is not next to it";
                ASSERT_EQ(r.full.viewDepth.at(x + 1, y), kMissDepth) << "the sphere is not next to it";
            }
        }
    EXPECT_GT(nothing, 160 * 120 / 2);
}

TEST(DepthSplat, withoutAMarginSomethingIsMissed) {
    // What the margin is for: a sphere's front lies nearer than the samples around it.
    WarpSetting none;
    none.depthMargin = none.depthRangeMargin = 0;
    const GlassScene scene = shellBeforeWall();
    const StereoViews views = viewsOf(320, 240, 0.2);
    const Splatted without = splat(scene, views, none), with = splat(scene, views);
    EXPECT_GT(differing(without.right, without.full), 50);
    EXPECT_EQ(differing(with.right, with.full), 0);
}

TEST(DepthSplat, anySizeAndSeparation) {
    const GlassScene scene = shellBeforeWall();
    for (const int width : {1, 2, 15, 16, 17, 33, 200})
        for (const double separation : {0.0, 1e-9, 0.1, 5.0, 50.0}) {
            const Splatted r = splat(scene, viewsOf(width, 24, separation));
            EXPECT_EQ(differing(r.right, r.full), separation > 0 ? 0 : differing(r.left, r.full))
                << width << " " << separation;
            if (separation == 0) {
                EXPECT_EQ(differing(r.right, r.left), 0) << width;
                EXPECT_EQ(r.timings.holePixels, 0);
            }
        }
}

TEST(DepthSplat, threadsAndSchedulesDoNotMatter) {
    const GlassScene scene = shellBeforeWall();
    const StereoViews views = viewsOf(211, 100, 0.35);
    setThreadCount(1);
    const Splatted one = splat(scene, views);
    for (const int threads : {2, 5})
        for (const Schedule schedule : {Schedule::Dynamic, Schedule::Interleaved, Schedule::Contiguous}) {
            setThreadCount(threads);
            WarpSetting setting;
            setting.warpSchedule = setting.fillSchedule = schedule;
            const Splatted other = splat(scene, views, setting);
            EXPECT_EQ(differing(one.right, other.right), 0) << threads;
            EXPECT_EQ(one.timings.holePixels, other.timings.holePixels) << threads;
        }
    setThreadCount(2);
}

TEST(DepthSplat, anOpaqueSceneIsTheFullCastToo) {
    const AnalyticScene scene({plane({0, 0, -12}, {0.1, 0.2, 1}), sphere({-1, 0.3, -6}, 1.2)}, 2.0, true);
    const Splatted r = splat(scene, viewsOf(120, 80, 0.3));
    EXPECT_EQ(differing(r.right, r.full), 0);
}

// Mean squared difference of the packed channels.
double meanSquare(const EyeImage& a, const EyeImage& b) {
    double sum = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            for (int shift = 0; shift < 30; shift += 10) {
                const double d = static_cast<double>(a.color.at(x, y) >> shift & 1023u) -
                                 static_cast<double>(b.color.at(x, y) >> shift & 1023u);
                sum += d * d;
            }
    return sum / (3.0 * a.width() * a.height());
}

TEST(DepthSplat, warpingColorsServesDenseGlassOnly) {
    const StereoViews views = viewsOf(320, 240, 0.3);
    const auto errorOf = [&](double opacity, RightEyeMethod method) {
        const GlassScene scene({sphere({-0.6, 0.3, -5}, 1.2), sphereFromInside({-0.6, 0.3, -5}, 1.2)},
                               plane({0, 0, -12}, {0.2, 0.3, 1}), 3.0, opacity);
        const EyeImage left = castEye(scene, views.left), full = castEye(scene, views.right);
        EyeImage right;
        RightEye eye;
        WarpSetting setting;
        setting.method = method;
        eye.render(scene, views, left, setting, right);
        return meanSquare(right, full);
    };
    EXPECT_LT(errorOf(0.999, RightEyeMethod::Linear), 10);
    EXPECT_GT(errorOf(0.35, RightEyeMethod::Linear), 100);
    EXPECT_EQ(errorOf(0.999, RightEyeMethod::DepthSplat), 0);
    EXPECT_EQ(errorOf(0.35, RightEyeMethod::DepthSplat), 0);
}

// Where layers are seen through each other every ray is cast, and is right; the rest is warped.
TEST(Selective, castsWhereDepthsShiftApart) {
    const StereoViews views = viewsOf(320, 240, 0.3);
    const GlassScene scene({sphere({-0.6, 0.3, -5}, 1.2), sphereFromInside({-0.6, 0.3, -5}, 1.2)},
                           plane({0, 0, -12}, {0.2, 0.3, 1}), 3.0, 0.35);
    const EyeImage left = castEye(scene, views.left), full = castEye(scene, views.right);
    const auto render = [&](RightEyeMethod method, float most) {
        WarpSetting setting;
        setting.method = method;
        setting.mostSpread = most;
        EyeImage right;
        RightEye eye;
        const RightEyeTimings timings = eye.render(scene, views, left, setting, right);
        return std::pair{meanSquare(right, full), timings.holePixels};
    };
    const auto [linearError, linearRays] = render(RightEyeMethod::Linear, 0);
    const auto [error, rays] = render(RightEyeMethod::Selective, 0.7f);
    EXPECT_LT(error, linearError / 20);
    EXPECT_GT(rays, linearRays);
    EXPECT_LT(rays, 320 * 240 / 3);  // the sphere covers about a quarter
    // No spread counts: linear. Any counts: at the sphere nothing is warped.
    EXPECT_EQ(render(RightEyeMethod::Selective, 1e9f).first, linearError);
    EXPECT_LE(render(RightEyeMethod::Selective, 0).first, error);
}

TEST(Selective, isTheDefaultOfTranslucentScenes) {
    EXPECT_EQ(defaultMethodFor(shellBeforeWall()), RightEyeMethod::Selective);
    EXPECT_EQ(methodsFor(shellBeforeWall()),
              (std::vector{RightEyeMethod::Full, RightEyeMethod::Linear, RightEyeMethod::Selective,
                           RightEyeMethod::DepthSplat}));
    const AnalyticScene opaque({});
    EXPECT_EQ(defaultMethodFor(opaque), kDefaultRightEyeMethod);
    const std::vector<RightEyeMethod> methods = methodsFor(opaque);
    EXPECT_EQ(methods.size(), kRightEyeMethods.size() - 2);
    for (const RightEyeMethod method : methods) {
        EXPECT_NE(method, RightEyeMethod::DepthSplat);
        EXPECT_NE(method, RightEyeMethod::Selective);
    }
}

std::vector<float> shortened(std::vector<float> depth, float share, float rangeShare) {
    std::vector<std::uint8_t> holes(depth.size(), 7);
    std::vector<float> scratch(depth.size() + 2);
    shortenDepths(
        {depth.data(), holes.data(), static_cast<int>(depth.size()), share, rangeShare, scratch.data()});
    for (std::size_t k = 0; k < depth.size(); ++k) EXPECT_EQ(holes[k], depth[k] == 0 ? 255 : 0);
    return depth;
}

TEST(ShortenDepths, takesTheNearestAndTheMargins) {
    const float far = kMissDepth;
    EXPECT_EQ(shortened({8, 8, 8}, 0.25f, 1), (std::vector<float>{6, 6, 6}));
    EXPECT_EQ(shortened({8, 10, 8}, 0, 1), (std::vector<float>{6, 6, 6}));
    EXPECT_EQ(shortened({8, 0, 8}, 0, 1), (std::vector<float>{8, 0, 8}))
        << "unknown stays, and is no neighbour";
    EXPECT_EQ(shortened({8, 30, 30, 30}, 0, 1), (std::vector<float>{0, 0, 30, 30})) << "too uneven";
    EXPECT_EQ(shortened({far, far, far, far}, 0.1f, 1), (std::vector<float>{0, far, far, 0}));
    EXPECT_EQ(shortened({far, far, far, 9, 9}, 0, 1), (std::vector<float>{0, far, 0, 0, 9}));
    EXPECT_EQ(shortened({far, far, far, 9, 9}, 0, 0)[3], 0) << "no NaN beside nothing";
    EXPECT_EQ(shortened({5}, 0, 1), (std::vector<float>{5}));
    EXPECT_EQ(shortened({far}, 0, 1), (std::vector<float>{0}));
    EXPECT_EQ(shortened({0, 0}, 0, 1), (std::vector<float>{0, 0}));
}

}  // namespace
}  // namespace stereonav
