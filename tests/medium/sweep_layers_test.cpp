// The fast sweep against the plain one over layers as terrains have them: without holes, some the same
// everywhere, sampled through one level of the mip or several at once.
#include <glm/geometric.hpp>
#include <string>

#include "engine/medium/sweep/medium_sweep.h"
#include "engine/simd/simd_target.h"
#include "sweep_scenes.h"

namespace stereonav {
namespace {

constexpr double kLayerTolerance = 5e-4;  // the same as for grids: medium_sweep_test.cpp
// Texels are mixed in 14 bits of the root: three steps, twice as much in white.
constexpr double kColorTolerance = kLayerTolerance + 6.0 / 16384;

MediumMaterial materialOf(float color, double opacity) {
    MediumMaterial m;
    m.color = {color, 1 - color, 0.5f};
    m.opacity = opacity;
    m.transport = {0.4f, 0.6f, 0.8f};
    return m;
}

HeightLayer hills(int width, int height, bool flat, bool uniform) {
    HeightLayer layer;
    layer.spacing = 0.08;
    layer.originX = -0.5 * (width - 1) * layer.spacing;
    layer.originY = -0.5 * (height - 1) * layer.spacing;
    layer.below = 0.4;
    layer.taper = 0.2;
    layer.levels.emplace_back(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            layer.levels[0].at(x, y) =
                flat ? 0.25f : static_cast<float>(0.3 * std::sin(0.31 * x) * std::cos(0.23 * y) + 0.01 * x);
    makeMipLevels(layer);
    std::vector<MediumPoint> points{{-1, materialOf(0.9f, 0.5)}};
    if (!uniform) points.push_back({1, materialOf(0.1f, 0.3)});
    layer.table = makeMediumTable(MediumTransfer(points, 0.3, "test"), -1, 1);
    return layer;
}

// Returns the layer with colours of its own, finer than its samples and uneven along the axes.
HeightLayer paintedHills(HeightLayer layer) {
    const int width = 3 * layer.levels[0].width(), height = 2 * layer.levels[0].height();
    Plane<PackedColor> picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            picture.at(x, y) = packColor({0.5 + 0.5 * std::sin(0.9 * x), 0.5 + 0.5 * std::cos(0.7 * y),
                                          (x / 9 + y / 7) % 2 ? 0.9 : 0.1});
    layer.color = std::make_shared<ColorTexture>(picture, glm::dvec2(-0.5), glm::dvec2(1.0 / 3, 0.5));
    layer.colorSpacing = glm::dvec2(layer.spacing);
    return layer;
}

// From so near that packets are of one level, and so flat and far that they are of several.
TEST(SweepLayers, AgreeWithThePlainSweep) {
    const struct {
        const char* name;
        glm::dvec3 eye;
        double fov;
    } views[] = {
        {"near", {0.2, -1.6, 0.9}, 0.5}, {"grazing", {0, -4, 0.9}, 0.6}, {"coarse", {0, -9, 5}, 1.2}};
    const struct {
        const char* name;
        std::vector<HeightLayer> layers;
        double tolerance = kLayerTolerance;
    } media[] = {{"uniform", {hills(45, 38, false, true)}},
                 {"varying", {hills(45, 38, false, false)}},
                 {"under a flat one", {hills(45, 38, false, false), hills(2, 2, true, true)}},
                 {"narrow", {hills(9, 60, false, false)}},
                 {"painted", {paintedHills(hills(45, 38, false, true))}, kColorTolerance},
                 {"painted, varying, under a flat one",
                  {paintedHills(hills(45, 38, false, false)), hills(2, 2, true, true)},
                  kColorTolerance}};
    for (const auto& medium : media)
        for (const auto& view : views)
            for (const MediumModel model :
                 {MediumModel::Emission, MediumModel::Direct, MediumModel::Indirect})
                for (const double side : {1.0, -1.0}) {
                    const Medium shown(medium.layers);
                    MediumLook look;
                    look.model = model;
                    look.light = test::sun(glm::normalize(glm::dvec3(0.3, side, -0.7)));
                    SweepSetting setting;
                    setting.slices = 30;
                    setting.lightSize = 24;
                    const std::vector<EyeView> eyes{test::viewFrom(view.eye, {0, 0, 0}, view.fov, 21, 18)};
                    const auto truth = plainSweep(
                        shown, look, setting, makeSweepGeometry(shown, look, setting, eyes, eyes[0].head), 0);
                    for (const SimdTarget target : simdTargets()) {
                        SCOPED_TRACE(std::string(medium.name) + ", " + view.name + ", model " +
                                     std::to_string(static_cast<int>(model)) + ", side " +
                                     std::to_string(side) + ", target " +
                                     std::to_string(static_cast<int>(target)));
                        MediumSweep sweep(shown, target);
                        std::vector<MediumPicture> pictures(1);
                        sweep.render(look, setting, eyes, eyes[0].head, 0, pictures);
                        double worst = 0, brightest = 0;
                        for (int y = 0; y < 18; ++y)
                            for (int x = 0; x < 21; ++x) {
                                const glm::vec4 a = pictures[0].light.at(x, y), b = truth[0].light.at(x, y);
                                for (int k = 0; k < 4; ++k) {
                                    const double away = std::abs(a[k] - b[k]);
                                    worst = away <= worst ? worst : away;  // NaN is kept
                                }
                                brightest = std::max<double>(brightest, b.x);
                            }
                        EXPECT_LE(worst, medium.tolerance);
                        EXPECT_GT(brightest, 1e-3);
                    }
                }
}

// An opaque ground sends what its own colours are, where they are: seen from above, by either eye.
TEST(SweepLayers, ShowTheColourOfThePlace) {
    HeightLayer ground = paintedHills(hills(45, 38, true, true));
    MediumMaterial white;
    white.color = glm::vec3(1.0f);
    white.opacity = 0.999;
    ground.taper = 0;
    ground.table = makeMediumTable(MediumTransfer({{0.25, white}}, 0.02, "test"), -1, 1);
    const Medium shown({ground});
    MediumLook look;
    look.model = MediumModel::Emission;
    look.light = test::sun({0, 0, -1});
    SweepSetting setting;
    setting.slices = 40;
    setting.lightSize = 8;
    const std::vector<EyeView> eyes{test::viewFrom({0, -0.001, 3}, {0, 0, 0}, 0.05, 21, 18),
                                    test::viewFrom({0.05, -0.001, 3}, {0.05, 0, 0}, 0.05, 21, 18)};
    for (const SimdTarget target : simdTargets()) {
        MediumSweep sweep(shown, target);
        std::vector<MediumPicture> pictures(2);
        sweep.render(look, setting, eyes, eyes[0].head, 0, pictures);
        for (int eye = 0; eye < 2; ++eye)
            for (int y = 0; y < 18; ++y)
                for (int x = 0; x < 21; ++x) {
                    const double depth = pictures[eye].viewDepth.at(x, y);
                    ASSERT_TRUE(std::isfinite(depth));
                    const glm::dvec3 p = eyes[eye].eye + depth * eyes[eye].rayDirection(x + 0.5, y + 0.5);
                    const glm::vec3 there = ground.colorAt(p.x, p.y, 0);
                    // The eye looks into the ground by a slab or two, aside by a part of that.
                    for (int c = 0; c < 3; ++c)
                        EXPECT_NEAR(pictures[eye].light.at(x, y)[c], there[c], 0.06) << x << " " << y;
                }
    }
}

}  // namespace
}  // namespace stereonav
