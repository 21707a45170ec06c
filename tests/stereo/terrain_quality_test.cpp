// The right eye on a real terrain against its full cast: the quality that was promised, with the
// separation at 1/30 of the zero-parallax distance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "engine/base/progress.h"
#include "engine/stereo/right_eye.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/terrain_loader.h"
#include "tests/support/own_cache.h"

namespace stereonav {
namespace {

std::filesystem::path terrainFile() {
    const char* named = std::getenv("STEREONAV_TEST_DATA");
    const std::filesystem::path data = named ? named : STEREONAV_SOURCE_DIR "/../shared/data";
    return data / "terrain/srtm_bigtujunga30m_utm11.tif";
}

double meanSquaredError(const EyeImage& a, const EyeImage& b) {
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

TEST(TerrainQuality, theDefaultIsCloseToTheFullCastAndAheadOfThePaper) {
    if (!std::filesystem::exists(terrainFile())) GTEST_SKIP() << "no real data: set STEREONAV_TEST_DATA";
    Progress progress;
    const TerrainScene scene = loadTerrain(sceneFileFromName(terrainFile().string()), progress);
    const TerrainRenderer renderer(scene);
    Lens lens = scene.lens;
    lens.width = 500;
    lens.height = 400;
    StereoSetting stereo = scene.stereo;
    stereo.separation = stereo.zeroParallax / 30;
    ASSERT_FALSE(scene.path.samples().empty());
    for (const Pose& pose : scene.path.frames(4)) {
        const StereoViews views = makeStereoViews(pose, lens, stereo);
        EyeImage left, full;
        for (EyeImage* image : {&left, &full}) image->resize(500, 400, renderer.viewDependence());
        renderEye(renderer, views.left, left);
        renderEye(renderer, views.right, full);
        const auto decibels = [&](RightEyeMethod method) {
            EyeImage right;
            RightEye eye;
            WarpSetting setting;
            setting.method = method;
            const RightEyeTimings timings = eye.render(renderer, views, left, setting, right);
            if (method == kDefaultRightEyeMethod) {
                EXPECT_LT(timings.holePixels, 500 * 400 / 5);
            }
            return 10 * std::log10(1023.0 * 1023.0 / std::max(meanSquaredError(right, full), 1e-9));
        };
        const double ours = decibels(kDefaultRightEyeMethod), paper = decibels(RightEyeMethod::Paper);
        EXPECT_GE(ours, 38);
        EXPECT_GE(ours, paper + 1);
    }
}

}  // namespace
}  // namespace stereonav
