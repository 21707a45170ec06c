#include "engine/light/bake/brick_peers.h"

#include <algorithm>
#include <atomic>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/stop.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostInRun = 32;  // bricks
constexpr std::size_t kRunsEach = 8;    // runs for each process, where there are so many bricks

void putBrick(ByteWriter& to, const BakeSums& sums, std::size_t brick) {
    to.put(sums.samples[brick]).put(sums.estimates[brick]);
    if (sums.shape().kind == BakeKind::Transfer)
        to.putAll(sums.transfer(brick)).putAll(sums.alive(brick));
    else
        to.putAll(sums.light(brick));
}

void takeBrick(ByteReader& from, BakeSums& sums, std::size_t brick) {
    sums.samples[brick] = from.get<std::uint32_t>();
    sums.estimates[brick] = from.get<BrickEstimate>();
    if (sums.shape().kind == BakeKind::Transfer) {
        from.getAll(sums.transfer(brick));
        from.getAll(sums.alive(brick));
    } else {
        from.getAll(sums.light(brick));
    }
}

}  // namespace

BrickRuns::BrickRuns(const std::vector<std::size_t>& bricks, int processes)
    : mBricks(bricks),
      mEach(std::clamp<std::size_t>(bricks.size() / (kRunsEach * static_cast<std::size_t>(processes)), 1,
                                    kMostInRun)) {}

std::span<const std::size_t> BrickRuns::at(std::size_t run) const {
    const std::size_t first = run * mEach;
    return mBricks.subspan(first, std::min(mEach, mBricks.size() - first));
}

PeerBytes orderOf(const BakeSums& sums, std::span<const std::size_t> bricks, std::uint32_t target,
                  double seconds) {
    ByteWriter to;
    to.put(sums.texels()).put(target).put(seconds).putArray(bricks);
    for (const std::size_t brick : bricks) putBrick(to, sums, brick);
    return to.take();
}

PeerBytes resultOf(BakeSums& sums, const BrickWork& work, std::span<const std::byte> order) {
    ByteReader from(order);
    if (from.get<std::size_t>() != sums.texels())
        throw Error("", "bake", "the processes do not find the same texels", "give all the same files");
    const auto target = from.get<std::uint32_t>();
    const auto seconds = from.get<double>();
    const auto bricks = from.getArray<std::size_t>();
    for (const std::size_t brick : bricks) takeBrick(from, sums, brick);
    const Stopwatch watch;
    std::atomic<bool> over = false;
    parallelFor(static_cast<int>(bricks.size()), [&](int n) {
        if (over) return;
        work.advance(bricks[static_cast<std::size_t>(n)], target, [&](double) {
            if (stopWished() || watch.elapsed_ms() >= 1000 * seconds) over = true;
            return over.load();
        });
    });
    ByteWriter to;
    for (const std::size_t brick : bricks) putBrick(to, sums, brick);
    return to.take();
}

void takeResult(BakeSums& sums, std::span<const std::size_t> bricks, std::span<const std::byte> result) {
    ByteReader from(result);
    for (const std::size_t brick : bricks) takeBrick(from, sums, brick);
}

}  // namespace stereonav
