// Adds samples to all texels of a bake, in passes that double, until there are enough of them, the error is
// small enough, the time is up, or someone cancels: what is done is kept in the sums.
#pragma once

#include <functional>
#include <span>

#include "engine/base/progress.h"
#include "engine/light/bake/bake_sums.h"

namespace stereonav {

// Where samples come from; as the functions of TexelLighter with the same names.
struct BakeSource {
    std::function<void(std::span<const glm::ivec3> texels, int count, std::span<TexelSum> sums)>
        addIrradiance;
    std::function<void(std::span<const glm::ivec3> texels, int firstSample, int count, int order,
                       int channels, std::span<float> sums, std::span<std::uint8_t> alive)>
        addTransfer;
};
BakeSource sourceOf(const TexelLighter& lighter);  // which must outlive it

// The first that is reached ends the bake; 0: no such limit.
struct BakeGoal {
    int samples = 0;     // of each texel
    double error = 0;    // estimated relative RMSE
    double minutes = 0;  // of this run
};

struct BakeKeeping {
    std::function<void(const BakeSums&)> keep;  // may be empty; called by one thread while nothing is added
    double everySeconds = 120;
};

enum class BakeEnd { Reached, TimeUp, Cancelled };

// Several processes at one bake: this one has bricks index, index + count, ... of the sums.
struct BakeShare {
    std::size_t index = 0, count = 1;
    // After each pass, by all: gives everyone the samples and estimates of all bricks (their sums stay where
    // they are), and how the pass ended: Reached unless it ended otherwise for one of them. Empty for one
    // process. So all agree on the next pass, which is that of a single process.
    std::function<BakeEnd(BakeSums& sums, BakeEnd own)> meet;
};

// Runs on all threads; the result does not depend on their number. Sums that already have samples go on from
// there: a bake to a number of samples that was broken off gives the same bytes as one that was not, and so
// does one that went on from another multiple of 128. Never throws Cancelled: cancelling is an end like
// others.
BakeEnd runBake(BakeSums& sums, const BakeSource& source, const BakeGoal& goal, Progress& progress,
                const BakeKeeping& keeping = {}, const BakeShare& share = {});

// The end of the batch that sample `first` is in: fixed, so that sums do not depend on breaks.
std::uint32_t batchEnd(std::uint32_t first);

}  // namespace stereonav
