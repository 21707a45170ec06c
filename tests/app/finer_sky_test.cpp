// Openness of ground whose light was worked out quickly, made finer behind the window.
#include "app/scene/terrain/finer_sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/scene/terrain/shown_terrain.h"
#include "engine/base/cache.h"
#include "engine/camera/stereo_rig.h"
#include "terrain/light/quick_light.h"
#include "terrain/light/sky_source.h"
#include "terrain/scene/ground_color.h"
#include "terrain/scene/terrain_illumination.h"
#include "tests/support/own_cache.h"
#include "tests/support/wait_for.h"

namespace stereonav {
namespace {

constexpr int kSide = 150;  // more samples than are looked at at once

Heightfield groundUnderSky(double phase) {
    std::vector<float> heights;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i)
            heights.push_back(static_cast<float>(300 * std::sin(0.11 * i + phase) * std::cos(0.13 * j) +
                                                 40 * std::sin(0.7 * i) * std::sin(0.9 * j)));
    return Heightfield(kSide, kSide, glm::dvec2(40), std::move(heights), "waves");
}

// Light as the loader works it out, from openness at so many samples.
TerrainScene litFrom(double phase, double skySamples) {
    TerrainScene terrain;
    terrain.ground = groundUnderSky(phase);
    terrain.look.sunAzimuth = 4.7;
    terrain.look.sunElevation = 0.5;
    TerrainLook unlit = terrain.look;
    unlit.ambient = 1;
    Progress progress;
    terrain.color = tintedGround(terrain.ground, unlit, TintPlace{}, progress).texture;
    terrain.lens = {80, 60, 0.8, 1.0, 1.0};
    terrain.startPose = poseFromAngles({-2000, -2000, 1200}, 0.9, -0.5, 0);
    terrain.sky = readSky({}).map;
    terrain.illumination = std::make_unique<TerrainIllumination>(
        terrain.ground, terrain.color, terrain.sky,
        spreadOpenness(terrain.ground, sparseOpenness(terrain.ground, skySamples, progress)), 1.0f);
    terrain.illumination->castShadowsOf(terrain.ground);
    terrain.illumination->apply(terrain.look, terrain.color);
    return terrain;
}

EyeImage seenFrom(const Scene& scene) {
    EyePair pair;
    scene.frames().makeOne(makeEyeView(scene.startPose, scene.lens), 0, pair);
    return std::move(pair.left);
}

int differing(const EyeImage& a, const EyeImage& b) {
    int count = 0;
    for (int y = 0; y < a.color.height(); ++y)
        for (int x = 0; x < a.color.width(); ++x) count += a.color.at(x, y) != b.color.at(x, y);
    return count;
}

TEST(FinerSky, IsThatOfAllSamplesWhenItHasCome) {
    ShownTerrain scene(litFrom(0.2, kQuickSkySamples), SimdTarget::Auto, true);
    auto* const seen = scene.offered<SeenLight>();
    auto* const turning = scene.offered<TurningLight>();
    ASSERT_NE(seen, nullptr);
    ASSERT_NE(turning, nullptr);
    EXPECT_FALSE(seen->beginsDark());
    const SunPlace sun = turning->place();
    turning->turnTo(sun);
    const EyeImage quick = seenFrom(scene);
    EXPECT_EQ(seen->changes(), 0u) << "nobody has shown a frame";
    seen->seen(makeEyeView(scene.startPose, scene.lens), quick);
    ASSERT_TRUE(test::waitFor([&] { return seen->changes() == 1; }));
    EXPECT_EQ(differing(quick, seenFrom(scene)), 0) << "before the next frame begins";
    turning->turnTo(sun);
    const EyeImage fine = seenFrom(scene);
    EXPECT_GT(differing(quick, fine), 0);
    const ShownTerrain whole(litFrom(0.2, kSide * kSide), SimdTarget::Auto);
    EXPECT_EQ(differing(fine, seenFrom(whole)), 0);
}

TEST(FinerSky, IsKeptForTheNextTime) {
    const Heightfield ground = groundUnderSky(0.9);
    std::filesystem::path kept;
    for (int time = 0; time < 2; ++time) {
        FinerSky sky(ground);
        sky.begin();
        ASSERT_TRUE(test::waitFor([&] { return sky.done(); }));
        EXPECT_EQ(sky.count(), 1u);
        const std::optional<FinerSky::Openness> made = sky.take();
        ASSERT_TRUE(made);
        EXPECT_EQ(made->width, kSide);
        EXPECT_EQ(made->samples.size(), std::size_t(kSide) * kSide);
        EXPECT_FALSE(sky.take());
        const std::vector<Kept> all = allKept(keptFile("x").parent_path());  // the last one used first
        const auto last = std::find_if(all.begin(), all.end(), [](const Kept& file) {
            return file.file.filename().string().starts_with("terrain-sky-");
        });
        ASSERT_NE(last, all.end());
        kept = last->file;
        // A damaged one is made anew.
        if (time == 0) std::filesystem::resize_file(kept, 100);
    }
    EXPECT_GT(std::filesystem::file_size(kept), 100u);
}

TEST(FinerSky, EndsPromptlyWithItsScene) {
    const Heightfield ground = groundUnderSky(1.7);
    FinerSky sky(ground);
    sky.begin();
}

}  // namespace
}  // namespace stereonav
