// What levels of detail save and cost: the left eye's time by share of a pixel, its picture against 16 rays a
// pixel of the ground's own samples and against its own picture without levels, the rings, and what making
// them takes. bench_level_of_detail DEM [WIDTH HEIGHT [FRAMES]]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/metrics/image_difference.h"
#include "engine/metrics/supersampled_picture.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/terrain_loader.h"

namespace stereonav {
namespace {

constexpr int kRounds = 7, kTruthFactor = 4;

struct Way {
    double share;
    std::unique_ptr<TerrainRenderer> renderer;
    std::vector<double> ms = {};  // mean frame, by round
    double truthSquares = 0, exactSquares = 0, changed_ms = 0;
    std::size_t rings = 0;
};

double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// Mean squared difference, 8-bit levels.
double squaresOf(const Plane<PackedColor>& a, const Plane<PackedColor>& b) {
    return 255 * 255 * std::pow(10, -0.1 * std::min(psnrOf(a, b), 200.0));
}

double decibels(double squares) {
    return 20 * std::log10(255 / std::max(1e-7, std::sqrt(squares)));
}

int bench(int argc, char** argv) {
    Progress quiet;
    const TerrainScene terrain = loadTerrain(sceneFileFromName(argc > 1 ? argv[1] : "terrain"), quiet);
    Lens lens = terrain.lens;
    lens.width = argc > 3 ? std::atoi(argv[2]) : 1280;
    lens.height = argc > 3 ? std::atoi(argv[3]) : 720;
    const int frames = argc > 4 ? std::atoi(argv[4]) : 4;
    std::vector<Way> ways;
    const Stopwatch making;
    for (const double share : {0.0, 0.25, 0.5, 1.0, 2.0}) {
        ways.push_back({share, std::make_unique<TerrainRenderer>(terrain)});
        ways.back().renderer->takeCoarser(share);
    }
    fmt::print("{}x{} samples, {} threads, {}; levels made in {:.0f} ms\n", terrain.ground.width(),
               terrain.ground.height(), threadCount(), nameOf(ways[0].renderer->target()),
               making.elapsed_ms() / 4);
    EyeImage exact, image;
    for (const Pose& pose : terrain.path.frames(frames)) {
        const EyeView view = makeEyeView(pose, lens);
        for (EyeImage* const one : {&exact, &image}) one->resize(view.width, view.height);
        const Plane<PackedColor> truth = renderSupersampled(*ways[0].renderer, view, kTruthFactor, quiet);
        for (Way& way : ways) {
            const Stopwatch changing;
            way.renderer->lookFrom(view);
            way.changed_ms += changing.elapsed_ms() / frames;
        }
        renderEye(*ways[0].renderer, view, exact);
        for (int round = 0; round < kRounds; ++round)
            for (Way& way : ways) {
                const Stopwatch watch;
                renderEye(*way.renderer, view, image);
                if (round == 0) way.ms.resize(kRounds);
                way.ms[static_cast<std::size_t>(round)] += watch.elapsed_ms() / frames;
                if (round > 0) continue;
                way.truthSquares += squaresOf(truth, image.color) / frames;
                way.exactSquares += squaresOf(exact.color, image.color) / frames;
                way.rings =
                    std::max(way.rings, way.renderer->rings() ? way.renderer->rings()->rings.size() : 1);
            }
    }
    for (const Way& way : ways)
        fmt::print(
            "share {:4.2f}: {:6.1f} ms ({:.2f}), {:.1f} dB to the truth, {:.1f} dB to no levels, {} rings, "
            "changed in {:.0f} ms\n",
            way.share, medianOf(way.ms), medianOf(way.ms) / medianOf(ways[0].ms), decibels(way.truthSquares),
            decibels(way.exactSquares), way.rings, way.changed_ms);
    return 0;
}

}  // namespace
}  // namespace stereonav

int main(int argc, char** argv) {
    return stereonav::bench(argc, argv);
}
