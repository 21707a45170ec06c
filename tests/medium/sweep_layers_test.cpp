// The fast sweep against the plain one over layers as terrains have them: without holes, some the same
// everywhere, sampled through one level of the mip or several at once.
#include <glm/geometric.hpp>
#include <string>

#include "engine/math/simd_target.h"
#include "engine/medium/medium_sweep.h"
#include "sweep_scenes.h"

namespace stereonav {
namespace {

constexpr double kLayerTolerance = 5e-4;  // as of grids: medium_sweep_test.cpp

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
    } media[] = {{"uniform", {hills(45, 38, false, true)}},
                 {"varying", {hills(45, 38, false, false)}},
                 {"under a flat one", {hills(45, 38, false, false), hills(2, 2, true, true)}},
                 {"narrow", {hills(9, 60, false, false)}}};
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
                        EXPECT_LE(worst, kLayerTolerance);
                        EXPECT_GT(brightest, 1e-3);
                    }
                }
}

}  // namespace
}  // namespace stereonav
