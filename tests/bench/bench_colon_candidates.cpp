// Candidates on generated colons: how many polyps of each size are among them, and how many of them are none,
// by the least score, over many seeds:
//   bench_colon_candidates [SEEDS [LARGEST_SIDE]]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "colon/instruments/candidates.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/stopwatch.h"

namespace {

using namespace stereonav;

struct Found {
    double score;
    int truth;  // number of the polyp's size class, -1: none
};

int classOf(const Polyp& polyp) {
    const double mm = 1e3 * polyp.diameter;
    return mm >= 10 ? 2 : mm >= 6 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 5, side = argc > 2 ? std::atoi(argv[2]) : 512;
    std::vector<Found> found;
    int all[3] = {};
    double seconds = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        Progress progress;
        ColonOptions options;
        options.builtIn.seed = static_cast<std::uint64_t>(seed);
        options.builtIn.size = {side, side, side * 411 / 512};
        const ColonScene colon = loadColon(options, progress);
        const Stopwatch watch;
        const WallMesh wall = wallMesh(colon.volume.field, colon.volume.cells, colon.lumen.lumen, progress);
        const WallNeighbours neighbours = neighboursOf(wall);
        CandidateSetting setting;
        setting.polyp = polypSettingOf(colon.volume.field.frame);
        setting.leastScore = 0;
        std::vector<std::uint8_t> known(colon.polyps.size(), 0);
        for (const Polyp& polyp : colon.polyps) ++all[classOf(polyp)];
        for (const Candidate& candidate : polypCandidates(wall, neighbours, setting)) {
            Found one{candidate.score, -1};
            for (std::size_t n = 0; n < colon.polyps.size(); ++n) {
                const Polyp& polyp = colon.polyps[n];
                const glm::dvec3 tip(wall.places[candidate.polyp.tip]);
                if (glm::distance(tip, polyp.position) > 0.5 * polyp.diameter + 0.002) continue;
                one.truth = known[n] ? -2 : classOf(polyp);  // -2: again, neither one nor the other
                known[n] = 1;
            }
            found.push_back(one);
        }
        seconds += watch.elapsed_ms() / 1000;
    }
    fmt::print("{} colons, {} polyps under 6 mm, {} of 6 to 9 mm, {} of 10 mm and more; {:.1f} s a colon\n",
               seeds, all[0], all[1], all[2], seconds / seeds);
    for (const double least : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 2.0, 2.5, 3.0}) {
        int hits[3] = {}, wrong = 0;
        for (const Found& one : found) {
            if (one.score < 1e-3 * least) continue;
            if (one.truth >= 0) ++hits[one.truth];
            wrong += one.truth == -1;
        }
        fmt::print("score {:.1f} mm and more: {:.1f} % {:.1f} % {:.1f} %, {:.2f} false a colon\n", least,
                   100.0 * hits[0] / std::max(all[0], 1), 100.0 * hits[1] / std::max(all[1], 1),
                   100.0 * hits[2] / std::max(all[2], 1), static_cast<double>(wrong) / seeds);
    }
    return 0;
}
