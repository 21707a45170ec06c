// Real mountains under baked light: the picture, pixel by pixel, against path tracing at what each pixel
// shows.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "engine/base/parallel.h"
#include "engine/math/luminance.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/light/terrain_path_light.h"
#include "terrain/scene/terrain_illumination.h"
#include "terrain/scene/terrain_loader.h"
#include "tests/support/own_cache.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

// Pixels that are compared, and pixels cast for each: far ground is then not averaged over its hidden sides.
constexpr int kRealWidth = 60, kHeight = 40, kFine = 16;

// The scene in a colour that no light drives out of range.
TerrainScene greyScene(const std::filesystem::path& file) {
    Progress quiet;
    TerrainScene scene = loadTerrain(sceneFileFromName(file.string()), quiet);
    Plane<PackedColor> grey(2 * scene.ground.width(), 2 * scene.ground.height());
    for (int y = 0; y < grey.height(); ++y)
        for (int x = 0; x < grey.width(); ++x) grey.at(x, y) = packColor(glm::vec3(0.2f));
    scene.color = ColorTexture(grey, glm::dvec2(-0.5), glm::dvec2(0.5));
    scene.look.sunAzimuth = 4.6;
    scene.look.sunElevation = 0.35;
    return scene;
}

struct Found {
    double rms, bias;  // shares of the mean
    int pixels = 0;
};

Found compare(const TerrainScene& scene, const EyeView& view, const EyeImage& image) {
    const SkyRadiance shape = skyRadiance(scene.sky);
    const SunAndSky now = sunAndSky(scene.look, shape);
    const double scale = luminance(glm::dvec3(now.sky.level)) / luminance(glm::dvec3(shape.level));
    const GroundRays rays(scene.ground);
    const PathLightSetting base{0.3, 2, 256, 1};
    std::vector<double> seen(kRealWidth * kHeight, -1), truth(seen), noise(seen);
    parallelFor(kRealWidth * kHeight, [&](int k) {
        const int x = k % kRealWidth * kFine + kFine / 2, y = k / kRealWidth * kFine + kFine / 2;
        const float depth = image.viewDepth.at(x, y);
        if (!std::isfinite(depth)) return;
        const glm::dvec2 place(view.pointAt(x + 0.5, y + 0.5, depth));
        PathLightSetting setting = base;
        setting.seed = static_cast<std::uint64_t>(k) * 104729 + 7;
        const PathLight path = tracePathLight(
            rays, place, now,
            [&](const glm::dvec3& d) { return static_cast<float>(scale) * gradientSky(glm::vec3(d)); },
            setting);
        seen[k] = luminance(glm::dvec3(unpackColor(image.color.at(x, y)))) / 0.2 / exposureOf(now);
        truth[k] = luminance(path.mean);
        noise[k] = path.variance;
    });
    Found found{0, 0, 0};
    double mean = 0, square = 0;
    for (int k = 0; k < kRealWidth * kHeight; ++k) {
        if (seen[k] < 0) continue;
        ++found.pixels;
        mean += truth[k];
        found.bias += seen[k] - truth[k];
        square += std::pow(seen[k] - truth[k], 2) - noise[k];
    }
    found.rms = std::sqrt(std::max(0.0, square / found.pixels)) * found.pixels / mean;
    found.bias /= mean;
    return found;
}

void expectTrue(const char* name, int stride, double rms, double bias) {
    const std::filesystem::path folder = test::realData();
    if (folder.empty() || !std::filesystem::exists(folder / "terrain" / name))
        GTEST_SKIP() << "no real data: " << name;
    TerrainScene scene = greyScene(folder / "terrain" / name);
    TerrainLightSettings settings;
    settings.stride = stride;
    Progress quiet;
    scene.illumination = std::make_unique<TerrainIllumination>(
        scene.ground, scene.color, scene.sky, bakeTerrainLight(scene.ground, settings, quiet), 1.0f);
    scene.illumination->apply(scene.look, scene.color);
    Lens lens = scene.lens;
    lens.width = kRealWidth * kFine;
    lens.height = kHeight * kFine;
    const EyeView view = makeEyeView(scene.startPose, lens);
    EyeImage image;
    image.resize(kRealWidth * kFine, kHeight * kFine);
    renderEye(TerrainRenderer(scene), view, image);
    const Found found = compare(scene, view, image);
    std::printf("%s, every %d. sample: %d pixels, rms %.3f, bias %.3f of the mean\n", name, stride,
                found.pixels, found.rms, found.bias);
    EXPECT_GT(found.pixels, 500);
    EXPECT_LT(found.rms, rms);
    EXPECT_LT(std::abs(found.bias), bias);
}

// Bounds: half as much again as measured (0.094 and 0.002; 0.139 and -0.038, where samples are 120 m apart
// and small ridges fall between them).
TEST(TerrainLightNightly, SaintHelensIsLitAsByPathTracing) {
    expectTrue("SainteHelens.dem", 2, 0.14, 0.01);
}
TEST(TerrainLightFullSize, BigTujungaIsLitAsByPathTracing) {
    expectTrue("srtm_bigtujunga30m_utm11.tif", 4, 0.21, 0.06);
}

}  // namespace
}  // namespace stereonav
