// How polyps of generated colons are shown in the unfolded wall, bent and not, over many seeds:
//   bench_colon_unfold [SEEDS [LARGEST_SIDE [FIRST_SEED]]]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "colon/instruments/unfolding.h"
#include "colon/scene/colon_scene.h"

int main(int argc, char** argv) {
    using namespace stereonav;
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 5, side = argc > 2 ? std::atoi(argv[2]) : 512,
              first = argc > 3 ? std::atoi(argv[3]) : 1;
    int polyps = 0, once = 0;
    for (int seed = first; seed < first + seeds; ++seed)
        for (const double bend : {0.0, 0.012}) {
            Progress progress;
            ColonOptions options;
            options.builtIn.seed = static_cast<std::uint64_t>(seed);
            options.builtIn.size = {side, side, side * 411 / 512};
            options.builtIn.bend = bend;
            options.cache = false;
            const ColonScene colon = loadColon(options, progress);
            const WallMesh wall =
                wallMesh(colon.volume.field, colon.volume.cells, colon.lumen.lumen, progress);
            const WallNeighbours neighbours = neighboursOf(wall);
            const LineOfSight sight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue);
            const UnfoldedWall flat(wall, neighbours, colon.centreline, sight, {}, progress);
            const UnfoldedWall::AreaError error = flat.areaError();
            fmt::print(
                "seed {} bend {:g} mm: {}x{}, area off {:.1f} %, 95 of 100 {:.1f} %, hidden {:.2f} %\n", seed,
                1e3 * bend, flat.width(), flat.height(), 100 * error.mean, 100 * error.most95,
                100 * flat.hiddenShare(0.002));
            for (const Polyp& truth : colon.polyps) {
                if (truth.diameter < 0.00499) continue;
                ++polyps;
                std::string why;
                const auto polyp =
                    polypAt(wall, neighbours, truth.position, polypSettingOf(colon.volume.field.frame), why);
                if (!polyp) {
                    fmt::print("  {:.0f} mm: not measured, {}\n", 1e3 * truth.diameter, why);
                    continue;
                }
                const UnfoldedWall::Shown shown = flat.shown(*polyp);
                const bool right = shown.share >= 0.5 && shown.pieces == 1;
                once += right;
                if (!right)
                    fmt::print("  {:.0f} mm, shape {}: {:.0f} % shown, {:.0f} % of its area, {} pieces\n",
                               1e3 * truth.diameter, static_cast<int>(truth.shape), 100 * shown.share,
                               100 * shown.area, shown.pieces);
            }
            std::fflush(stdout);
        }
    fmt::print("{} of {} polyps of 5 mm and more are shown once, by half of their heads at least\n", once,
               polyps);
    return once == polyps ? 0 : 1;
}
