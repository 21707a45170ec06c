// Bricks of a bake as they go from one process to another and back (engine/peers): what has been added up,
// and how far it is to go.
#pragma once

#include <span>
#include <vector>

#include "engine/light/bake/brick_work.h"
#include "engine/peers/peer_bytes.h"

namespace stereonav {

// Bricks by runs, a piece of work each: many for each process, so that all are done at about the same time.
class BrickRuns {
public:
    // bricks must outlive the object.
    BrickRuns(const std::vector<std::size_t>& bricks, int processes);

    std::size_t count() const { return (mBricks.size() + mEach - 1) / mEach; }
    std::span<const std::size_t> at(std::size_t run) const;

private:
    std::span<const std::size_t> mBricks;
    std::size_t mEach;
};

// Returns the order to bring these bricks to `target` samples within `seconds`.
PeerBytes orderOf(const BakeSums& sums, std::span<const std::size_t> bricks, std::uint32_t target,
                  double seconds);
// Does what the order says, on all threads. Ends early where a stop is wished. sums: of the same texels.
// Throws Error.
PeerBytes resultOf(BakeSums& sums, const BrickWork& work, std::span<const std::byte> order);
// Takes in what came back. Throws Error.
void takeResult(BakeSums& sums, std::span<const std::size_t> bricks, std::span<const std::byte> result);

}  // namespace stereonav
