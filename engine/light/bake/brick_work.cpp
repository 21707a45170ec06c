#include "engine/light/bake/brick_work.h"

#include <algorithm>
#include <vector>

namespace stereonav {

std::uint32_t batchEnd(std::uint32_t first) {
    return (first / kBakeBatch + 1) * kBakeBatch;
}

void BrickWork::advance(std::size_t brick, std::uint32_t target,
                        const std::function<bool(double samples)>& added) const {
    const bool transfer = mSums.shape().kind == BakeKind::Transfer;
    std::uint32_t countBefore = mSums.samples[brick];
    std::vector<float> before;
    const auto remember = [&] {
        countBefore = mSums.samples[brick];
        if (transfer) before.assign(mSums.transfer(brick).begin(), mSums.transfer(brick).end());
    };
    remember();
    for (bool enough = false; mSums.samples[brick] < target && !enough;) {
        const std::uint32_t now = mSums.samples[brick];
        std::uint32_t end = std::min(batchEnd(now), target);
        // Two parts tell how much they differ.
        if (transfer && now == 0) end = (end + 1) / 2;

        transfer ? addTransfer(brick, now, end - now) : addIrradiance(brick, end - now);
        mSums.samples[brick] = end;
        if (now == 0 && end < target) remember();  // so that the first pass tells its error, too
        enough = added(static_cast<double>((end - now) * mSums.texelsOf(brick)));
    }
    if (mSums.samples[brick] < target && transfer) return;
    mSums.estimates[brick] =
        transfer ? estimateOf(before, countBefore, mSums.transfer(brick), mSums.samples[brick])
                 : estimateOf(mSums.light(brick));
}

// Texels on no surface are left out: they are known after the first batch.
void BrickWork::addIrradiance(std::size_t brick, std::uint32_t count) const {
    const std::vector<glm::ivec3> all = texelsIn(mSums.layout(), mSums.bricks()[brick]);
    const std::span<TexelSum> sums = mSums.light(brick);
    std::vector<glm::ivec3> texels;
    std::vector<TexelSum> some;
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (sums[n].samples < 0) continue;
        texels.push_back(all[n]);
        some.push_back(sums[n]);
    }
    if (texels.empty()) return;
    mSource.addIrradiance(texels, static_cast<int>(count), some);
    std::size_t from = 0;
    for (TexelSum& sum : sums)
        if (!(sum.samples < 0)) sum = some[from++];
}

void BrickWork::addTransfer(std::size_t brick, std::uint32_t first, std::uint32_t count) const {
    const std::vector<glm::ivec3> all = texelsIn(mSums.layout(), mSums.bricks()[brick]);
    const std::span<float> sums = mSums.transfer(brick);
    const std::span<std::uint8_t> alive = mSums.alive(brick);
    const auto each = static_cast<std::ptrdiff_t>(mSums.shape().numbersPerTexel());
    std::vector<glm::ivec3> texels;
    std::vector<float> some;
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (!alive[n]) continue;
        texels.push_back(all[n]);
        const auto from = sums.begin() + static_cast<std::ptrdiff_t>(n) * each;
        some.insert(some.end(), from, from + each);
    }
    if (texels.empty()) return;
    std::vector<std::uint8_t> someAlive(texels.size(), 1);
    mSource.addTransfer(texels, static_cast<int>(first), static_cast<int>(count), mSums.shape().order,
                        mSums.shape().channels, some, someAlive);
    std::ptrdiff_t from = 0;
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (!alive[n]) continue;
        alive[n] = someAlive[static_cast<std::size_t>(from)];
        std::copy_n(some.begin() + from * each, each, sums.begin() + static_cast<std::ptrdiff_t>(n) * each);
        ++from;
    }
}

}  // namespace stereonav
