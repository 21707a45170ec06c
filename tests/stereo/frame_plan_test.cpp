// The frame plan: which right eye is cheaper.
#include "engine/stereo/frame_plan.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "tests/support/analytic_scene.h"

namespace stereonav {
namespace {

// Casting costs nothing: there is nothing to cast.
class InstantScene final : public EyeRenderer {
public:
    int tileCount(const EyeView&) const override { return 1; }
    void renderTile(const EyeView&, int, EyeImage& image) const override {
        if (image.viewDepth.at(0, 0) == 0.0f)
            for (int y = 0; y < image.height(); ++y)
                for (int x = 0; x < image.width(); ++x) image.viewDepth.at(x, y) = 10.0f;
    }
    void renderPixels(const EyeView&, PixelRect, std::span<const PixelIndex>, EyeImage&) const override {}
    bool mayHitBeyondEdge(const EyeView&, PixelRect, double, double) const override { return false; }
};

StereoViews viewsOf(int width, int height) {
    return makeStereoViews(poseFromAngles({0, 0, 0}, 0, 0, 0), {width, height, 0.8, 1.0, 0.1}, {0.3, 10.0});
}

TEST(FramePlan, PredictsFromCostsInClosedForm) {
    // 1 Mpixel: cast 10 ms; warp 1 ms and 2 % holes at 50 ns = 1 ms
    const FrameCosts costs{10.0, 1.0, 50.0, 0.02};
    const FramePlan plan = planFromCosts(costs, 1000, 1000, ViewDependence::None);
    EXPECT_NEAR(plan.castRight_ms, 10.0, 1e-9);
    EXPECT_NEAR(plan.warpRight_ms, 2.0, 1e-9);
    EXPECT_EQ(plan.method, kDefaultRightEyeMethod);
    EXPECT_TRUE(plan.warps());
    EXPECT_NE(plan.reason.find("2.00 ms"), std::string::npos) << plan.reason;
    EXPECT_NE(plan.reason.find("10.00 ms"), std::string::npos) << plan.reason;
}

TEST(FramePlan, CastsWhereHolesCostMoreThanTheyAreWorth) {
    const FramePlan plan = planFromCosts({10.0, 1.0, 50.0, 0.2}, 1000, 1000, ViewDependence::None);
    EXPECT_EQ(plan.method, RightEyeMethod::Full);
    EXPECT_FALSE(plan.warps());
    // exactly at the break-even, 9 ns of holes a pixel, nothing is won by the warp
    EXPECT_FALSE(planFromCosts({10.0, 1.0, 90.0, 0.1}, 1000, 1000, ViewDependence::None).warps());
    EXPECT_TRUE(planFromCosts({10.0, 1.0, 89.0, 0.1}, 1000, 1000, ViewDependence::None).warps());
}

TEST(FramePlan, BytesAreThoseOfThePlanes) {
    for (const ViewDependence dependence :
         {ViewDependence::None, ViewDependence::Highlight, ViewDependence::Normal}) {
        EyeImage image;
        image.resize(333, 77, dependence);
        Plane<std::uint8_t> mask(333, 77);
        const std::size_t eye = image.color.byteCount() + image.viewDepth.byteCount() +
                                image.baseColor.byteCount() + image.normal.byteCount();
        EXPECT_EQ(frameBytes(333, 77, dependence), 2 * eye + mask.byteCount());
    }
}

// Casts everything ten times: so slow that neither sanitizers nor other work on the machine turn the balance.
// What the warp asks of a scene beside rays is as fast as ever.
class SlowScene : public test::AnalyticScene {
public:
    using AnalyticScene::AnalyticScene;

protected:
    void renderPixel(const EyeView& view, int x, int y, EyeImage& image) const override {
        for (int n = 0; n < 10; ++n) AnalyticScene::renderPixel(view, x, y, image);
    }
};

TEST(FramePlan, MeasuresThatASlowSceneIsWarpedAndAnInstantOneCast) {
    const std::vector<StereoViews> views(3, viewsOf(160, 120));
    std::vector<test::Shape> shapes{test::plane({0, 30, 0}, {0, -1, 0})};
    for (int k = 0; k < 30; ++k) shapes.push_back(test::sphere({k - 15.0, 15.0, 0}, 0.3));
    const FramePlan slow = planFrame(SlowScene(shapes), views);
    EXPECT_EQ(slow.method, kDefaultRightEyeMethod) << slow.reason;
    EXPECT_GT(slow.costs.cast_ns, slow.costs.warp_ns);
    EXPECT_GT(slow.costs.holeShare, 0.0);
    EXPECT_LT(slow.costs.holeShare, 0.5);
    EXPECT_GT(slow.costs.hole_ns, 0.0);
    const FramePlan instant = planFrame(InstantScene(), views);
    EXPECT_EQ(instant.method, RightEyeMethod::Full) << instant.reason;
    EXPECT_EQ(instant.width, 160);
    EXPECT_FALSE(instant.viewDependent);
    EXPECT_THROW(planFrame(InstantScene(), {}), Error);
}

// One frame that is unlike all others, the first, does not stand for them, however slow the scene is.
TEST(FramePlan, MeasuresMoreThanOneFrame) {
    std::vector<test::Shape> shapes{test::plane({0, 30, 0}, {0, -1, 0})};
    const SlowScene scene(shapes);
    const StereoViews usual = viewsOf(160, 120);
    // Eyes so far apart that nothing of what one sees is seen by the other.
    const StereoViews apart =
        makeStereoViews(poseFromAngles({0, 0, 0}, 0, 0, 0), {160, 120, 0.8, 1.0, 0.1}, {60, 10.0});
    const std::vector<StereoViews> alone{apart}, among{apart, usual, usual, usual, usual};
    const double share = planFrame(scene, alone, std::nullopt, 0).costs.holeShare;
    ASSERT_GT(share, 0.9);
    // Three frames are measured at least, whatever they take.
    const double mean = planFrame(scene, among, std::nullopt, 0).costs.holeShare;
    EXPECT_NEAR(mean, share / 3 + planFrame(scene, {&usual, 1}, std::nullopt, 0).costs.holeShare * 2 / 3,
                1e-9);
}

TEST(FramePlan, ATranslucentSceneIsWeighedByItsOwnMethod) {
    const std::vector<StereoViews> views(2, viewsOf(160, 120));
    const test::GlassScene scene({test::sphere({0, 6, 0}, 1.0)}, test::plane({0, 20, 0}, {0, -1, 0}));
    const FramePlan usual = planFrame(scene, views);
    EXPECT_NE(usual.reason.find("selective takes"), std::string::npos) << usual.reason;
    EXPECT_LT(usual.costs.holeShare, 1.0);
    EXPECT_EQ(usual.bytes, frameBytes(160, 120, ViewDependence::Depths));
    const FramePlan plan = planFrame(scene, views, RightEyeMethod::DepthSplat);
    EXPECT_NE(plan.reason.find("depthsplat takes"), std::string::npos) << plan.reason;
    EXPECT_EQ(plan.costs.holeShare, 1.0) << "every pixel is cast";
    EXPECT_NEAR(plan.warpRight_ms, (plan.costs.warp_ns + plan.costs.hole_ns) * 160 * 120 * 1e-6, 1e-9);
    EXPECT_TRUE(plan.method == RightEyeMethod::DepthSplat || plan.method == RightEyeMethod::Full);
}

}  // namespace
}  // namespace stereonav
