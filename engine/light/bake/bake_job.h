// Adds samples to all texels of a bake, in passes that double, until there are enough of them, the error is
// small enough, the time is up, or someone cancels: what is done is kept in the sums.
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
// there: a bake to a number of samples that was broken off gives the same bytes as one that was not, and so
// does one that went on from another multiple of 128. Never throws Cancelled: cancelling is an end like
// others. peers: the processes of this run, whose first one this is: it deals out bricks and has the sums of
// all; the same bytes as alone. A failure of another one is an end as by Cancelled; Peers::throwIfFailed
// tells.
BakeEnd runBake(BakeSums& sums, const BakeSource& source, const BakeGoal& goal, Progress& progress,
                const BakeKeeping& keeping = {}, Peers* peers = nullptr);

// Lights, in the other processes, the bricks that the first one's runBake deals. Their sums are of the same
// texels, and of no use afterwards. Throws Error, Cancelled.
void serveBake(BakeSums& sums, const BakeSource& source, Peers& peers);

}  // namespace stereonav
