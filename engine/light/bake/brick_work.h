// Adds samples to one brick of a bake, batch by batch.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/light/bake/bake_job.h"
#include "engine/light/bake/bake_sums.h"

namespace stereonav {

// Number of samples that a texel gets per call. TexelLighter reached 0.5, 0.9 and 1.2 million samples per
// second with 16, 64 and 128 per call (160 texels of the engine under Grace, one thread of a busy machine).
constexpr std::uint32_t kBakeBatch = 128;

// Returns the end of the batch that contains sample `first`. Batches are fixed, so that sums do not depend on
// where a bake was broken off.
std::uint32_t batchEnd(std::uint32_t first);

// Adds samples to bricks; different bricks may be handled at the same time.
class BrickWork {
public:
    // sums and source must outlive the object.
    BrickWork(BakeSums& sums, const BakeSource& source) : mSums(sums), mSource(source) {}

    // Brings each texel to `target` samples, and updates the estimate of the error. added: called after each
    // batch with the number of added samples; where it returns true the work ends there.
    void advance(std::size_t brick, std::uint32_t target,
                 const std::function<bool(double samples)>& added) const;

private:
    void addIrradiance(std::size_t brick, std::uint32_t count) const;
    void addTransfer(std::size_t brick, std::uint32_t first, std::uint32_t count) const;

    BakeSums& mSums;
    const BakeSource& mSource;
};

}  // namespace stereonav
