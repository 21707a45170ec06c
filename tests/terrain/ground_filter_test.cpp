// How the ground's colour is read where it is asked to be otherwise: the finest level alone, by the
// definition of bilinear lookup at the place that was hit; levels far coarser; and as ever where nothing is
// asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "terrain/cast/terrain_renderer.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

using namespace test;

const TerrainScene& scene() {
    static const TerrainScene kScene = makeScene(makeGround("flat", 65, 65, 1));
    return kScene;
}

// Returns a view from so high that a pixel is some texels wide.
EyeView viewFromAbove() {
    return makeEyeView(poseFromAngles({-454, -1074, 3000}, 0.4, -1.2, 0), {64, 48, 0.4, 1.0, 0.1});
}

EyeImage cast(const GroundFilter& filter, SimdTarget target = SimdTarget::Auto) {
    EyeImage image;
    const EyeView view = viewFromAbove();
    image.resize(view.width, view.height);
    renderEye(TerrainRenderer(scene(), target, filter), view, image);
    return image;
}

double bilinearAt(const glm::dvec2& grid, int shift) {
    const ColorTexture::Level level = scene().color.level(0);
    const glm::dvec2 at = (grid - scene().color.gridOrigin()) / scene().color.gridPerTexel() - 0.5;
    const double i = std::clamp(std::floor(at.x), 0.0, level.width() - 1.0),
                 j = std::clamp(std::floor(at.y), 0.0, level.height() - 1.0);
    const double fx = std::clamp(at.x - i, 0.0, 1.0), fy = std::clamp(at.y - j, 0.0, 1.0);
    const auto texel = [&](double x, double y) {
        const int tx = std::min(static_cast<int>(x), level.width() - 1),
                  ty = std::min(static_cast<int>(y), level.height() - 1);
        return static_cast<double>(level.at(tx, ty) >> shift & 1023u);
    };
    return (1 - fy) * ((1 - fx) * texel(i, j) + fx * texel(i + 1, j)) +
           fy * ((1 - fx) * texel(i, j + 1) + fx * texel(i + 1, j + 1));
}

TEST(GroundFilter, TheFinestLevelAloneIsBilinearLookup) {
    const EyeView view = viewFromAbove();
    const EyeImage image = cast({false, 0});
    int checked = 0;
    double mips = 0;
    const EyeImage usual = cast({});
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double t = image.viewDepth.at(x, y);
            if (!std::isfinite(t)) continue;
            const glm::dvec3 hit = view.eye + t * view.rayDirection(x + 0.5, y + 0.5);
            const glm::dvec2 grid = scene().ground.gridFromWorld({hit.x, hit.y});
            for (const int shift : {0, 10, 20}) {
                // hits are floats: some thousandths of a texel, between texels up to 400 apart
                ASSERT_NEAR(image.color.at(x, y) >> shift & 1023u, bilinearAt(grid, shift), 3)
                    << x << "," << y;
                mips = std::max(mips, std::abs(bilinearAt(grid, shift) -
                                               static_cast<double>(usual.color.at(x, y) >> shift & 1023u)));
            }
            ++checked;
        }
    EXPECT_GT(checked, 1000);
    EXPECT_GT(mips, 30);  // mip levels do something here
}

TEST(GroundFilter, FarCoarserLevelsAreOneColour) {
    const ColorTexture& color = scene().color;
    const PackedColor mean = color.level(color.levelCount() - 1).at(0, 0);
    const EyeImage image = cast({true, 8});
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            if (!std::isfinite(image.viewDepth.at(x, y))) continue;
            for (const int shift : {0, 10, 20})
                ASSERT_NEAR(static_cast<double>(image.color.at(x, y) >> shift & 1023u),
                            static_cast<double>(mean >> shift & 1023u), 1)
                    << x << "," << y;
        }
}

TEST(GroundFilter, WithoutABiasNothingChanges) {
    EyeImage usual;
    const EyeView view = viewFromAbove();
    usual.resize(view.width, view.height);
    renderEye(TerrainRenderer(scene()), view, usual);
    const EyeImage image = cast({true, 0});
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) ASSERT_EQ(image.color.at(x, y), usual.color.at(x, y));
}

}  // namespace
}  // namespace stereonav
