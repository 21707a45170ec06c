// Light of a tinted ground that is worked out behind the window.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>

#include "app/scene/terrain/daylight.h"
#include "app/scene/terrain/shown_terrain.h"
#include "engine/base/lone_loops.h"
#include "engine/base/parallel.h"
#include "engine/camera/stereo_rig.h"
#include "terrain/light/sky_source.h"
#include "terrain/light/terrain_light.h"
#include "terrain/scene/ground_color.h"
#include "tests/support/wait_for.h"

namespace stereonav {
namespace {

// A ridge along the middle, 40 m a sample, under the plain sun.
TerrainScene ridge(int side) {
    std::vector<float> heights;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
            heights.push_back(static_cast<float>(800 * std::exp(-0.02 * (i - side / 2.0) * (i - side / 2.0)) +
                                                 20 * std::sin(0.7 * j)));
    TerrainScene terrain;
    terrain.ground = Heightfield(side, side, glm::dvec2(40), std::move(heights), "ridge");
    terrain.tint = TintPlace{};
    terrain.look.sunAzimuth = 4.7;
    terrain.look.sunElevation = 0.35;
    Progress progress;
    terrain.color = tintedGround(terrain.ground, terrain.look, *terrain.tint, progress).texture;
    terrain.lens = {80, 60, 0.8, 1.0, 1.0};
    terrain.startPose = poseFromAngles({-700, -500, 900}, 0.9, -0.5, 0);
    terrain.sky = readSky({}).map;
    return terrain;
}

Lens smallLens() {
    Lens lens;
    lens.width = 80;
    lens.height = 60;
    lens.nearDepth = 1;
    return lens;
}

EyeImage castBy(const Scene& scene, const Pose& pose) {
    EyePair pair;
    scene.frames().makeOne(makeEyeView(pose, smallLens()), 0, pair);
    return std::move(pair.left);
}

bool sameColors(const EyeImage& a, const EyeImage& b) {
    for (int y = 0; y < a.color.height(); ++y)
        for (int x = 0; x < a.color.width(); ++x)
            if (a.color.at(x, y) != b.color.at(x, y)) return false;
    return true;
}

// The same ground with light that was baked as it is here, before.
TerrainScene litBefore(int side, const SunPlace& sun) {
    TerrainScene terrain = ridge(side);
    terrain.look.sunAzimuth = sun.azimuth;
    terrain.look.sunElevation = sun.elevation;
    TerrainLook unlit = terrain.look;
    unlit.ambient = 1;
    Progress progress;
    const ColorTexture albedo = tintedGround(terrain.ground, unlit, *terrain.tint, progress).texture;
    TerrainLightSettings settings;
    settings.order = 3;
    settings.bounces = 1;
    settings.rays = 16;
    terrain.illumination = std::make_unique<TerrainIllumination>(
        terrain.ground, albedo, terrain.sky, bakeTerrainLight(terrain.ground, settings, progress), 1.0f);
    terrain.illumination->apply(terrain.look, terrain.color);
    return terrain;
}

TEST(TerrainDaylight, ComesAfterTheFirstFrameAndIsThatOfABake) {
    const Pose pose = ridge(40).startPose;
    ShownTerrain scene(ridge(40), SimdTarget::Auto, true);
    auto* const seen = scene.offered<SeenLight>();
    auto* const turning = scene.offered<TurningLight>();
    ASSERT_NE(seen, nullptr);
    ASSERT_NE(turning, nullptr);
    EXPECT_FALSE(seen->beginsDark());
    const SunPlace sun = turning->place();
    turning->turnTo(sun);
    const EyeImage plain = castBy(scene, pose);
    EXPECT_TRUE(sameColors(plain, castBy(ShownTerrain(ridge(40), SimdTarget::Auto), pose)));
    EXPECT_EQ(seen->changes(), 0u);  // nobody has shown a frame
    seen->seen(makeEyeView(pose, smallLens()), plain);
    ASSERT_TRUE(test::waitFor([&] { return seen->changes() == 1; }));
    EXPECT_TRUE(sameColors(plain, castBy(scene, pose)));  // until the next frame begins
    turning->turnTo(sun);
    const EyeImage lit = castBy(scene, pose);
    EXPECT_FALSE(sameColors(plain, lit));
    EXPECT_TRUE(sameColors(lit, castBy(ShownTerrain(litBefore(40, sun), SimdTarget::Auto), pose)));
    // And turns.
    const SunPlace noon{3.1, 1.2};
    turning->turnTo(noon);
    EXPECT_EQ(turning->place(), noon);
    EXPECT_TRUE(
        sameColors(castBy(scene, pose), castBy(ShownTerrain(litBefore(40, noon), SimdTarget::Auto), pose)));
}

TEST(TerrainDaylight, ASunThatWasTurnedBeforeIsFollowed) {
    const Pose pose = ridge(40).startPose;
    ShownTerrain scene(ridge(40), SimdTarget::Auto, true);
    auto* const seen = scene.offered<SeenLight>();
    auto* const turning = scene.offered<TurningLight>();
    const SunPlace evening{4.0, 0.2};
    turning->turnTo(evening);
    seen->seen(makeEyeView(pose, smallLens()), EyeImage());
    ASSERT_TRUE(test::waitFor([&] { return seen->changes() == 1; }));
    turning->turnTo(evening);
    EXPECT_TRUE(sameColors(castBy(scene, pose),
                           castBy(ShownTerrain(litBefore(40, evening), SimdTarget::Auto), pose)));
}

TEST(TerrainDaylight, ComesCoarseFirst) {
    const TerrainScene terrain = ridge(90);
    TerrainDaylight baker(terrain, SimdTarget::Auto);
    const std::shared_ptr<const ColorTexture> plain(std::shared_ptr<void>(), &terrain.color);
    baker.begin(plain);
    baker.begin(plain);
    std::vector<int> widths;
    std::vector<ColorTexture> colors;
    ASSERT_TRUE(test::waitFor([&] {
        if (const auto lit = baker.take()) {
            widths.push_back(lit->light->light().grid.width);
            colors.push_back(lit->color);
            EXPECT_EQ(lit->color.level(0).width(), terrain.color.level(0).width());
        }
        return baker.done() && widths.size() > 0 && widths.back() == 90;
    }));
    EXPECT_EQ(baker.count(), 2u);  // 8,100 samples: every second one, then all
    EXPECT_TRUE(std::is_sorted(widths.begin(), widths.end()));
    // What comes first is nearer to what comes last than the plain sun.
    const auto apart = [&](const ColorTexture& a) {
        double sum = 0;
        for (int y = 0; y < a.level(0).height(); ++y)
            for (int x = 0; x < a.level(0).width(); ++x) {
                const glm::vec3 d =
                    unpackColor(a.level(0).at(x, y)) - unpackColor(colors.back().level(0).at(x, y));
                sum += glm::dot(d, d);
            }
        return sum;
    };
    if (colors.size() == 2) {
        EXPECT_LT(apart(colors.front()), 0.3 * apart(terrain.color));
    }
}

// In the processor time of this process, which others on the machine do not take: one of a hundred times as
// many samples is ended in the middle of its work, before it has taken ten times as long as the small one in
// whole.
TEST(TerrainDaylight, EndsWithItsSceneAtOnce) {
    const auto used = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
    const TerrainScene small = ridge(40), large = ridge(400);
    const auto plainOf = [](const TerrainScene& terrain) {
        return std::shared_ptr<const ColorTexture>(std::shared_ptr<void>(), &terrain.color);
    };
    double begun = used();
    {
        TerrainDaylight baker(small, SimdTarget::Auto);
        baker.begin(plainOf(small));
        ASSERT_TRUE(test::waitFor([&] { return baker.done(); }));
    }
    const double whole = used() - begun;
    begun = used();
    {
        TerrainDaylight baker(large, SimdTarget::Auto);
        baker.begin(plainOf(large));
        ASSERT_TRUE(test::waitFor([&] { return used() - begun > 2 * whole; }));
        EXPECT_FALSE(baker.done());
    }
    EXPECT_LT(used() - begun, 10 * whole);
}

TEST(TerrainDaylight, IsOfferedToTintsUnderThePlainSunAlone) {
    TerrainScene colored = ridge(20);
    colored.tint.reset();
    EXPECT_EQ(ShownTerrain(std::move(colored), SimdTarget::Auto, true).offered<SeenLight>(), nullptr);
    const ShownTerrain plain(ridge(20), SimdTarget::Auto);
    EXPECT_EQ(plain.offered<SeenLight>(), nullptr);
    EXPECT_FALSE(plain.whyLightStays().empty());
}

TEST(LoneLoops, RunOnTheirThreadAlone) {
    std::vector<std::thread::id> ids(200);
    std::thread worker([&] {
        loopOnThisThreadAlone();
        parallelFor(200, [&](int i) { ids[i] = std::this_thread::get_id(); });
        for (const auto& id : ids) EXPECT_EQ(id, std::this_thread::get_id());
    });
    worker.join();
}

}  // namespace
}  // namespace stereonav
