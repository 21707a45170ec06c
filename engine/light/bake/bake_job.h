// Adds samples to all texels of a bake, in passes that double, until the wished number of samples or error is
// reached, the time is up, or the bake is cancelled. The sums keep all that was done.
#pragma once

#include <functional>
#include <span>

#include "engine/base/progress.h"
#include "engine/light/bake/bake_sums.h"

namespace stereonav {

class Peers;

// The source of samples: functions of TexelLighter with the same names.
struct BakeSource {
    std::function<void(std::span<const glm::ivec3> texels, int count, std::span<TexelSum> sums)>
        addIrradiance;
    std::function<void(std::span<const glm::ivec3> texels, int firstSample, int count, int order,
                       int channels, std::span<float> sums, std::span<std::uint8_t> alive)>
        addTransfer;
};
BakeSource sourceOf(const TexelLighter& lighter);  // the lighter must outlive the result

// Limits of a bake: the first that is reached ends it; 0: no such limit.
struct BakeGoal {
    int samples = 0;     // samples of each texel
    double error = 0;    // estimated relative RMSE, 0.01: 1 %
    double minutes = 0;  // minutes of this run
};

// How often, and by which function, the sums are saved while a bake runs.
struct BakeKeeping {
    std::function<void(const BakeSums&)> keep;  // may be empty; called by one thread while nothing is added
    double everySeconds = 120;
};

enum class BakeEnd { Reached, TimeUp, Cancelled };

// Bakes on all threads; the result does not depend on their number. Sums that already have samples go on from
// there. A bake to a number of samples gives the same bytes whether it runs in one go, is broken off and
// continued, or goes on from a finished bake of fewer samples, a multiple of 128. Never throws Cancelled: a
// cancelled bake returns BakeEnd::Cancelled.
// peers: the processes that share this bake; null: this one alone. runBake is called in the first of them: it
// deals out the bricks, collects the sums of all, and gets the same bytes as a process alone. When another
// process fails, the bake ends as Cancelled, and Peers::throwIfFailed throws.
BakeEnd runBake(BakeSums& sums, const BakeSource& source, const BakeGoal& goal, Progress& progress,
                const BakeKeeping& keeping = {}, Peers* peers = nullptr);

// Lights bricks for runBake of the first process; called in each of the other processes. sums: of the same
// texels as in the first process; of no use afterwards, since the results are sent there. Throws Error,
// Cancelled.
void serveBake(BakeSums& sums, const BakeSource& source, Peers& peers);

}  // namespace stereonav
