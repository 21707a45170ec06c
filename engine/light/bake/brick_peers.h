// Messages between the processes of a bake (engine/peers): orders to light bricks, and the sums that come
// back.
#pragma once

#include <span>
#include <vector>

#include "engine/light/bake/brick_work.h"
#include "engine/peers/peer_bytes.h"

namespace stereonav {

// Groups bricks into runs, each a piece of work: many for each process, so that all processes finish at about
// the same time.
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

// Returns the order to add samples to these bricks up to `target`, within `seconds`.
PeerBytes orderOf(const BakeSums& sums, std::span<const std::size_t> bricks, std::uint32_t target,
                  double seconds);
// Executes an order on all threads; stops early where a stop is wished. sums: of the same texels. Throws
// Error.
PeerBytes resultOf(BakeSums& sums, const BrickWork& work, std::span<const std::byte> order);
// Adds a result that came back. Throws Error.
void takeResult(BakeSums& sums, std::span<const std::size_t> bricks, std::span<const std::byte> result);

}  // namespace stereonav
