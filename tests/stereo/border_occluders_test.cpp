// Region V on terrain: where the renderer says that nothing lies before what the left eye saw, a full cast of
// the right eye finds nothing there.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "engine/camera/stereo_rig.h"
#include "terrain/cast/terrain_renderer.h"

namespace stereonav {
namespace {

TerrainScene hills(std::mt19937& random) {
    constexpr int kSize = 65;
    std::uniform_real_distribution<double> unit(0, 1);
    const double a = 0.1 + 0.4 * unit(random), b = 0.1 + 0.4 * unit(random);
    std::vector<float> heights;
    for (int j = 0; j < kSize; ++j)
        for (int i = 0; i < kSize; ++i)
            heights.push_back(static_cast<float>(40 * std::sin(a * i) * std::cos(b * j) + 5 * unit(random)));
    TerrainScene scene;
    scene.ground = Heightfield(kSize, kSize, glm::dvec2(10), heights, "hills");
    scene.color = ColorTexture(Plane<PackedColor>(8, 8), {0.0, 0.0}, glm::dvec2(8));
    scene.sky = SkyMap(16, gradientSky);
    return scene;
}

TEST(RegionV, terrainBeyondTheLeftEyesEdgeIsNotMissed) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(0, 1);
    int free = 0, taken = 0;
    for (int n = 0; n < 40; ++n) {
        const TerrainScene scene = hills(random);
        const TerrainRenderer renderer(scene);
        const glm::dvec2 at = 500.0 * (glm::dvec2(unit(random), unit(random)) - 0.5);
        const double z = scene.ground.heightAt(at) + 2 + 60 * unit(random);
        const Pose pose = poseFromAngles({at, z}, 2 * std::numbers::pi * unit(random),
                                         0.8 * (unit(random) - 0.5), 0.8 * (unit(random) - 0.5));
        Lens lens;
        lens.width = 96;
        lens.height = 64;
        const StereoViews views = makeStereoViews(pose, lens, {3, 60});
        EyeImage image;
        image.resize(lens.width, lens.height);
        renderEye(renderer, views.right, image);
        const double column = lens.width + views.shiftAtInfinity;
        for (int y = 0; y < lens.height; y += 4)
            for (int x = 0; x < lens.width; x += 8) {
                if (renderer.mayHitBeyondEdge(views.right, {x, y, x + 8, y + 4}, column,
                                              views.parallaxScale)) {
                    ++taken;
                    continue;
                }
                ++free;
                for (int v = y; v < y + 4; ++v)
                    for (int u = x; u < x + 8; ++u)
                        ASSERT_GE(image.viewDepth.at(u, v),
                                  views.parallaxScale / (column - (u + 1)) * (1 - 1e-6))
                            << "view " << n << " pixel " << u << "," << v;
            }
    }
    EXPECT_GT(free, 1000);
    EXPECT_GT(taken, 100);
}

}  // namespace
}  // namespace stereonav
