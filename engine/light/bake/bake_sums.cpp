#include "engine/light/bake/bake_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "engine/math/half_float.h"
#include "engine/math/luminance.h"

namespace stereonav {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

// Texels lie along surfaces: they grow with the square of the resolution. What paths take beside them does
// not: measured, 10 to 23 MB.
void checkTexelMemory(std::size_t texels, const BakeShape& shape, double besides) {
    constexpr double kPaths = 24e6;
    const double beside = kPaths + besides;
    const double held = static_cast<double>(texels) * static_cast<double>(shape.bytesPerTexel());
    const double bytes = held + beside;
    const double there = availableMemoryFor(bytes);
    if (bytes <= there) return;
    throw Error(
        "", "bake",
        fmt::format("{} texels need {} of memory, and {} is available", texels, memoryText(bytes),
                    memoryText(there)),
        fmt::format("{:.0f} % of this --resolution would fit, or fewer isovalues",
                    std::floor(100 * std::sqrt(std::max(0.0, there - beside) / std::max(held, 1.0)))));
}

template <typename T>
std::span<T> part(LazyArray<T>& array, std::size_t first, std::size_t count) {
    if (array.empty()) return {};
    return {array.data() + first, count};
}
template <typename T>
std::span<const T> part(const LazyArray<T>& array, std::size_t first, std::size_t count) {
    if (array.empty()) return {};
    return {array.data() + first, count};
}

}  // namespace

std::string_view nameOf(BakeKind kind) {
    switch (kind) {
        case BakeKind::Irradiance:
            return "irradiance";
        case BakeKind::Transfer:
            return "transfer";
        case BakeKind::Openness:
            return "openness";
    }
    return "";
}

BakeSums::BakeSums(const VolumeFrame& texels, std::vector<TexelBrick> bricks, const BakeShape& shape,
                   std::size_t beside)
    : samples(bricks.size(), 0),
      estimates(bricks.size(), BrickEstimate{kUnknown, 0}),
      mFrame(texels),
      mLayout(texels.size),
      mShape(shape),
      mBricks(std::move(bricks)) {
    mFirst.reserve(mBricks.size() + 1);
    std::size_t count = 0;
    for (const TexelBrick& brick : mBricks) {
        mFirst.push_back(count);
        count += static_cast<std::size_t>(countTexels(brick.wanted));
    }
    mFirst.push_back(count);
    checkTexelMemory(count, shape, static_cast<double>(beside));
    if (shape.kind == BakeKind::Transfer) {
        mTransfer = LazyArray<float>(count * static_cast<std::size_t>(shape.numbersPerTexel()));
        mAlive = LazyArray<std::uint8_t>(count);
        std::fill_n(mAlive.data(), count, std::uint8_t{1});
    } else {
        mLight = LazyArray<TexelSum>(count);
    }
}

std::span<TexelSum> BakeSums::light(std::size_t brick) {
    return part(mLight, mFirst[brick], texelsOf(brick));
}
std::span<const TexelSum> BakeSums::light(std::size_t brick) const {
    return part(mLight, mFirst[brick], texelsOf(brick));
}
std::span<float> BakeSums::transfer(std::size_t brick) {
    const auto each = static_cast<std::size_t>(mShape.numbersPerTexel());
    return part(mTransfer, mFirst[brick] * each, texelsOf(brick) * each);
}
std::span<const float> BakeSums::transfer(std::size_t brick) const {
    const auto each = static_cast<std::size_t>(mShape.numbersPerTexel());
    return part(mTransfer, mFirst[brick] * each, texelsOf(brick) * each);
}
std::span<std::uint8_t> BakeSums::alive(std::size_t brick) {
    return part(mAlive, mFirst[brick], texelsOf(brick));
}
std::span<const std::uint8_t> BakeSums::alive(std::size_t brick) const {
    return part(mAlive, mFirst[brick], texelsOf(brick));
}

std::uint32_t BakeSums::fewestSamples() const {
    return samples.empty() ? 0 : *std::min_element(samples.begin(), samples.end());
}

// Adds in the order of the bricks, so that the result does not depend on which process lit which brick.
double BakeSums::error() const {
    BrickEstimate all;
    for (const BrickEstimate& e : estimates) {
        all.variance += e.variance;
        all.square += e.square;
    }
    if (!(all.variance > 0)) return 0;
    return all.square > 0 ? std::sqrt(all.variance / all.square) : kUnknown;
}

void BakeSums::writeLight(std::size_t brick, IlluminationVolume& to, float unit) const {
    const std::span<const TexelSum> sums = light(brick);
    PackedTexel* out = to.texels.data() + static_cast<std::size_t>(mBricks[brick].number) * 512;
    std::size_t slot = 0;
    for (int k = 0; k < 8; ++k)
        for (std::uint64_t word = mBricks[brick].wanted[k]; word != 0; word &= word - 1, ++slot) {
            const PackedTexel texel = sums[slot].samples > 0 ? packTexel(sums[slot].mean / unit, 1) : 0;
            std::atomic_ref<PackedTexel>(out[k * 64 + std::countr_zero(word)])
                .store(texel, std::memory_order_relaxed);
        }
}

IlluminationVolume illuminationOf(const BakeSums& sums, float unit) {
    IlluminationVolume volume(sums.frame());
    parallelFor(static_cast<int>(sums.bricks().size()), [&](int n) { sums.writeLight(n, volume, unit); });
    return volume;
}

float lightUnitOf(const BakeSums& sums) {
    // Half-precision numbers lose digits below 2^-14. At a mean of 2^-7 or more, what falls below that is 128
    // times darker than the mean: black in any picture.
    constexpr double kDimmest = 0x1p-7;
    double sum = 0, count = 0, brightest = 0;
    for (std::size_t n = 0; n < sums.bricks().size(); ++n)
        for (const TexelSum& texel : sums.light(n)) {
            if (!(texel.samples > 0)) continue;
            const double most = std::max({texel.mean.x, texel.mean.y, texel.mean.z});
            brightest = std::max(brightest, most);
            sum += most;
            ++count;
        }
    const double mean = count > 0 ? sum / count : 0;
    const bool held = brightest <= static_cast<double>(kLargestHalf) && mean >= kDimmest;
    if (held || !(mean >= 0x1p-100 && mean <= 0x1p100)) return 1;
    return static_cast<float>(std::exp2(std::round(std::log2(mean))));
}

TransferVolume transferOf(const BakeSums& sums) {
    const auto each = static_cast<std::size_t>(sums.shape().numbersPerTexel());
    std::vector<TexelBrick> bricks;
    std::vector<std::size_t> from;
    for (std::size_t n = 0; n < sums.bricks().size(); ++n) {
        if (sums.samples[n] == 0) continue;
        TexelBrick brick = sums.bricks()[n];
        std::size_t slot = 0;
        for (int k = 0; k < 8; ++k)
            for (std::uint64_t word = brick.wanted[k]; word != 0; word &= word - 1, ++slot)
                if (!sums.alive(n)[slot]) brick.wanted[k] &= ~(word & -word);
        if (countTexels(brick.wanted) == 0) continue;
        bricks.push_back(brick);
        from.push_back(n);
    }
    TransferVolume volume(sums.frame(), sums.shape().order, sums.shape().channels, std::move(bricks));
    parallelFor(static_cast<int>(from.size()), [&](int n) {
        const std::size_t source = from[n];
        const std::span<const float> numbers = sums.transfer(source);
        const float share = 1.0f / static_cast<float>(sums.samples[source]);
        std::vector<float> means;
        for (std::size_t slot = 0; slot < sums.alive(source).size(); ++slot) {
            if (!sums.alive(source)[slot]) continue;
            for (std::size_t c = 0; c < each; ++c) means.push_back(numbers[slot * each + c] * share);
        }
        volume.setBrick(n, means);
    });
    return volume;
}

BrickEstimate estimateOf(std::span<const TexelSum> texels) {
    BrickEstimate estimate;
    for (const TexelSum& t : texels) {
        if (t.samples < 0) continue;
        const double n = t.samples, y = luminance(glm::dvec3(t.mean));
        estimate.variance += n >= 2 ? t.squares / (n * (n - 1)) : kUnknown;
        estimate.square += y * y;
    }
    return estimate;
}

// With means a of n and b of m samples, E |a - b|^2 = v (1 / n + 1 / m) for samples of variance v, and the
// mean of all has variance v / (n + m).
BrickEstimate estimateOf(std::span<const float> before, std::uint32_t countBefore, std::span<const float> all,
                         std::uint32_t count) {
    BrickEstimate estimate;
    const double n = countBefore, m = static_cast<double>(count) - n;
    if (count == 0) return {all.empty() ? 0.0 : kUnknown, 0};
    for (std::size_t c = 0; c < all.size(); ++c) {
        const double mean = all[c] / (n + m);
        estimate.square += mean * mean;
        if (!(n > 0 && m > 0)) continue;
        const double difference = before[c] / n - (static_cast<double>(all[c]) - before[c]) / m;
        estimate.variance += difference * difference * n * m / ((n + m) * (n + m));
    }
    if (!(n > 0 && m > 0)) estimate.variance = estimate.square > 0 ? kUnknown : 0;
    return estimate;
}

}  // namespace stereonav
