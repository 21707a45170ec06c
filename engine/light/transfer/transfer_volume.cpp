#include "engine/light/transfer/transfer_volume.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/math/half_float.h"
#include "engine/simd/kernel_sets.h"

namespace stereonav {

STEREONAV_EACH_SET(void relight(const TransferGroups&, std::uint32_t*, std::uint32_t*);)

namespace {

// Returns the half to store: 0 for numbers that are not finite. Numbers below the least normal half, 2^-14,
// become that or 0, with an error of at most 2^-15, the rounding error of numbers near 1/16. Stored as
// denormals, one in seven of them made the dot products 45 times as slow.
std::uint16_t storedHalf(float v) {
    constexpr float kLeast = 0x1p-14f;
    if (!(std::abs(v) <= std::numeric_limits<float>::max())) return 0;
    if (std::abs(v) < kLeast)
        return std::abs(v) < 0.5f * kLeast ? 0 : halfFromFloat(std::copysign(kLeast, v));
    return halfFromFloat(v);
}

constexpr int kBrickTexels = 512;

TransferKernels transferKernels(SimdTarget target) {
    return kernelsOf<TransferKernels>(target, {plain::relight}, {avx2::relight}, {avx512::relight});
}

// Position of a texel among those of a mask, and whether it is one of them.
bool slotOf(const TexelMask& mask, const glm::ivec3& inBrick, std::size_t& slot) {
    const int bit = inBrick.y * 8 + inBrick.x;
    if (!(mask[inBrick.z] >> bit & 1)) return false;
    int before = std::popcount(mask[inBrick.z] & ((1ull << bit) - 1));
    for (int k = 0; k < inBrick.z; ++k) before += std::popcount(mask[k]);
    slot = static_cast<std::size_t>(before);
    return true;
}

}  // namespace

struct TransferVolume::Light {
    static constexpr std::size_t kPairs = (kMaxHarmonics + 1) / 2;
    std::array<float, 2 * kPairs * 3> values{};
    TransferKernels kernels;
};

TransferVolume::TransferVolume(const VolumeFrame& texels, int order, int channels,
                               std::vector<TexelBrick> bricks)
    : mFrame(texels), mLayout(texels.size), mOrder(order), mChannels(channels), mBricks(std::move(bricks)) {
    if (order < 1 || order > kMaxHarmonicsOrder || (channels != 1 && channels != 3))
        throw Error("", "transfer", "expected order 1 to 6 and 1 or 3 channels", "");
    std::size_t groups = 0;
    mFirstGroup.reserve(mBricks.size() + 1);
    for (const TexelBrick& brick : mBricks) {
        mFirstGroup.push_back(static_cast<std::uint32_t>(groups));
        const int count = countTexels(brick.wanted);
        mTexels += static_cast<std::size_t>(count);
        groups += static_cast<std::size_t>((count + kTransferGroup - 1) / kTransferGroup);
    }
    mFirstGroup.push_back(static_cast<std::uint32_t>(groups));
    mWords = LazyArray<std::uint32_t>(groups * wordsPerGroup());
}

std::size_t TransferVolume::bytesHeld() const {
    return mWords.size() * sizeof(std::uint32_t) + mBricks.size() * (sizeof(TexelBrick) + 4);
}

std::size_t TransferVolume::word(std::size_t brick, std::size_t slot, int coefficient, int channel) const {
    const std::size_t group = mFirstGroup[brick] + slot / kTransferGroup;
    return group * wordsPerGroup() +
           (static_cast<std::size_t>(channel) * pairs() + coefficient / 2) * kTransferGroup +
           slot % kTransferGroup;
}

void TransferVolume::setBrick(std::size_t n, std::span<const float> numbers) {
    const std::size_t each = static_cast<std::size_t>(numbersPerTexel());
    const auto count = static_cast<std::size_t>(countTexels(mBricks[n].wanted));
    for (std::size_t slot = 0; slot < count; ++slot)
        for (int c = 0; c < mOrder * mOrder; ++c)
            for (int channel = 0; channel < mChannels; ++channel) {
                const std::size_t from = slot * each + static_cast<std::size_t>(c * mChannels + channel);
                const std::uint32_t half = storedHalf(from < numbers.size() ? numbers[from] : 0.0f);
                std::uint32_t& to = mWords[word(n, slot, c, channel)];
                to = c & 1 ? (to & 0xffffu) | half << 16 : (to & 0xffff0000u) | half;
            }
}

std::vector<float> TransferVolume::at(const glm::ivec3& texel) const {
    if (!mFrame.contains(texel)) return {};
    const glm::ivec3 brick = texel / 8;
    const auto number =
        static_cast<std::uint32_t>((brick.z * mLayout.bricks.y + brick.y) * mLayout.bricks.x + brick.x);
    const auto found = std::lower_bound(mBricks.begin(), mBricks.end(), number,
                                        [](const TexelBrick& b, std::uint32_t m) { return b.number < m; });
    std::size_t slot = 0;
    if (found == mBricks.end() || found->number != number || !slotOf(found->wanted, texel - 8 * brick, slot))
        return {};
    std::vector<float> numbers;
    numbers.reserve(static_cast<std::size_t>(numbersPerTexel()));
    for (int c = 0; c < mOrder * mOrder; ++c)
        for (int channel = 0; channel < mChannels; ++channel) {
            const std::uint32_t w =
                mWords[word(static_cast<std::size_t>(found - mBricks.begin()), slot, c, channel)];
            numbers.push_back(floatFromHalf(static_cast<std::uint16_t>(c & 1 ? w >> 16 : w)));
        }
    return numbers;
}

// Writes each texel as one word, since a frame may read it at the same time.
void TransferVolume::relightBrick(std::size_t n, const Light& light, IlluminationVolume& to) const {
    alignas(64) std::array<std::uint32_t, kBrickTexels> redGreen, blueWeight;
    TransferGroups groups;
    groups.words = mWords.data() + mFirstGroup[n] * wordsPerGroup();
    groups.groups = static_cast<int>(mFirstGroup[n + 1] - mFirstGroup[n]);
    groups.pairs = pairs();
    groups.channels = mChannels;
    groups.light = light.values.data();
    light.kernels.relight(groups, redGreen.data(), blueWeight.data());
    PackedTexel* out = to.texels.data() + static_cast<std::size_t>(mBricks[n].number) * kBrickTexels;
    std::size_t slot = 0;
    for (int k = 0; k < 8; ++k)
        for (std::uint64_t word = mBricks[n].wanted[k]; word != 0; word &= word - 1, ++slot) {
            const PackedTexel texel = redGreen[slot] | static_cast<PackedTexel>(blueWeight[slot]) << 32;
            std::atomic_ref<PackedTexel>(out[k * 64 + std::countr_zero(word)])
                .store(texel, std::memory_order_relaxed);
        }
}

void TransferVolume::relight(std::span<const glm::vec3> light, std::span<const std::uint32_t> which,
                             IlluminationVolume& to, SimdTarget target) const {
    Light prepared;
    prepared.kernels = transferKernels(target);
    const std::size_t count = std::min(light.size(), static_cast<std::size_t>(mOrder * mOrder));
    for (std::size_t c = 0; c < count; ++c)
        for (int channel = 0; channel < 3; ++channel)
            if (std::isfinite(light[c][channel]))
                prepared.values[c * 3 + channel] = light[c][channel] * kTransferLightScale;
    // Number of bricks per task: small single bricks would take less time than handing them out.
    constexpr int kBricksAtOnce = 16;
    const int count32 = static_cast<int>(which.size());
    parallelFor((count32 + kBricksAtOnce - 1) / kBricksAtOnce, [&](int part) {
        for (int n = part * kBricksAtOnce; n < std::min((part + 1) * kBricksAtOnce, count32); ++n)
            relightBrick(which[n], prepared, to);
    });
}

std::vector<std::uint32_t> TransferVolume::heldAmong(std::span<const std::uint32_t> numbers) const {
    std::vector<std::uint32_t> held;
    held.reserve(numbers.size());
    for (const std::uint32_t number : numbers) {
        const auto found =
            std::lower_bound(mBricks.begin(), mBricks.end(), number,
                             [](const TexelBrick& b, std::uint32_t m) { return b.number < m; });
        if (found != mBricks.end() && found->number == number)
            held.push_back(static_cast<std::uint32_t>(found - mBricks.begin()));
    }
    return held;
}

void TransferVolume::relightAll(std::span<const glm::vec3> light, IlluminationVolume& to,
                                SimdTarget target) const {
    std::vector<std::uint32_t> all(mBricks.size());
    std::iota(all.begin(), all.end(), 0u);
    relight(light, all, to, target);
}

}  // namespace stereonav
