// What contour lines cost an eye beside its cast, one thread, and by how much what the kernels paint differs
// from what the plain way does.
//   bench_contours [WIDTH HEIGHT]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/camera/stereo_rig.h"
#include "terrain/built_in/built_in_terrain.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/paint/contour_painter.h"

namespace {

using namespace stereonav;

constexpr int kRuns = 15;
constexpr double kInterval = 50;  // metres

// Returns the processor's time, independent of other programs.
double processor_ms() {
    return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

template <typename Job>
double time_ms(const Job& job) {
    const double before = processor_ms();
    job();
    return processor_ms() - before;
}

double middleOf(std::vector<double> times) {
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    return times[times.size() / 2];
}

void measure(const TerrainScene& scene, const EyeView& view, const char* name) {
    const TerrainRenderer renderer(scene);
    EyeImage cast, painted, plainly;
    cast.resize(view.width, view.height);
    const Fog noFog;
    const ContourPainter painter(scene.ground, noFog, {kInterval, 1});
    std::vector<double> castTimes, paintTimes, plainTimes;
    for (int run = 0; run < kRuns; ++run) {
        castTimes.push_back(time_ms([&] { renderEye(renderer, view, cast); }));
        painted = cast, plainly = cast;
        paintTimes.push_back(time_ms([&] { painter.paint(view, painted); }));
        plainTimes.push_back(time_ms([&] { painter.paintPlainly(view, plainly); }));
    }
    long long inked = 0, off = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            inked += plainly.color.at(x, y) != cast.color.at(x, y);
            const auto channel = [&](const EyeImage& image) {
                return static_cast<int>(image.color.at(x, y) >> 10 & 1023);
            };
            off += std::abs(channel(painted) - channel(plainly)) > 4;
        }
    fmt::print(
        "{}: cast {:.2f} ms, lines {:.2f} ms, plainly {:.2f} ms; {:.1f} % of {} pixels inked, {} off by "
        "more than a grey level\n",
        name, middleOf(castTimes), middleOf(paintTimes), middleOf(plainTimes),
        100.0 * static_cast<double>(inked) / (view.width * view.height), view.width * view.height, off);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        Progress progress;
        BuiltInTerrain built = builtInTerrain(1, 512, progress);
        TerrainScene scene;
        scene.ground =
            Heightfield(built.size, built.size, glm::dvec2(built.spacing), built.heights, "built-in");
        const glm::dvec2 texels(built.color.width(), built.color.height());
        scene.color = ColorTexture(built.color, {0.0, 0.0}, glm::dvec2(built.size - 1) / texels);
        scene.sky = SkyMap(256, gradientSky);
        setThreadCount(1);
        Lens lens;
        lens.width = argc > 2 ? std::atoi(argv[1]) : 1280, lens.height = argc > 2 ? std::atoi(argv[2]) : 720;
        const double top = scene.ground.maxHeight();
        measure(scene, makeEyeView(poseFromAngles({0, -6000, top + 300}, 0, -0.15, 0), lens),
                "over the tops");
        measure(scene, makeEyeView(poseFromAngles({0, -2000, 0.7 * top}, 0.4, -0.1, 0), lens), "among them");
        measure(scene, makeEyeView(poseFromAngles({0, 0, top + 3000}, 0, -1.2, 0), lens), "from above");
    } catch (const stereonav::Error& error) {
        fmt::print(stderr, "bench_contours: {}\n", error.what());
        return 1;
    }
    return 0;
}
