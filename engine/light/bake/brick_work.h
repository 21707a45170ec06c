// Adds samples to one brick of a bake, batch by batch.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/light/bake/bake_job.h"
#include "engine/light/bake/bake_sums.h"

namespace stereonav {

// Samples that a texel gets at once. TexelLighter gave 0.5, 0.9 and 1.2 million samples a second for 16, 64
// and 128 at once (160 texels of the engine under Grace, one thread of a busy machine).
constexpr std::uint32_t kBakeBatch = 128;

// Returns the end of the batch that sample `first` is in: fixed, so that sums do not depend on breaks.
std::uint32_t batchEnd(std::uint32_t first);

// Advances bricks; different ones may be advanced at once.
class BrickWork {
public:
    // sums and source must outlive the object.
    BrickWork(BakeSums& sums, const BakeSource& source) : mSums(sums), mSource(source) {}

    // Brings each texel to `target` samples, with what they tell of the error. added: samples of texels,
    // after each batch; true ends it there, with the samples that it has.
    void advance(std::size_t brick, std::uint32_t target,
                 const std::function<bool(double samples)>& added) const;

private:
    void addIrradiance(std::size_t brick, std::uint32_t count) const;
    void addTransfer(std::size_t brick, std::uint32_t first, std::uint32_t count) const;

    BakeSums& mSums;
    const BakeSource& mSource;
};

}  // namespace stereonav
