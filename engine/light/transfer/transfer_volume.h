// How texels take up distant light, in spherical harmonics, so that light can be turned while flying (Wyman
// et al. 2006, section 4.3; Y4 of docs/ledger.md). Half floats, kept only where texels lie on a surface.
// Frames do not read this: relight() writes the irradiance volume that they look up, a pass over what is
// near.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/light/transfer/bake_texels.h"
#include "engine/light/transfer/transfer_kernel_types.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

class TransferVolume {
public:
    TransferVolume() = default;
    // Holds the texels of `bricks`, by number of their brick. order: 1..kMaxHarmonicsOrder; channels: 1 or 3.
    // Throws Error for others.
    TransferVolume(const VolumeFrame& texels, int order, int channels, std::vector<TexelBrick> bricks);

    bool empty() const { return mBricks.empty(); }
    const VolumeFrame& frame() const { return mFrame; }
    const TexelLayout& layout() const { return mLayout; }
    int order() const { return mOrder; }
    int channels() const { return mChannels; }
    std::span<const TexelBrick> bricks() const { return mBricks; }
    std::size_t texels() const { return mTexels; }
    std::size_t bytesHeld() const;

    // Numbers a texel: coefficient first, then channel.
    int numbersPerTexel() const { return mOrder * mOrder * mChannels; }
    // Sets the numbers of all texels of bricks()[n], in the order of texelsIn(). Different bricks may be set
    // by different threads. Rounds to half floats, none of them denormal; what is not finite becomes 0.
    void setBrick(std::size_t n, std::span<const float> numbers);
    // Returns the numbers of a texel as they are stored; empty where it is not held.
    std::vector<float> at(const glm::ivec3& texel) const;

    // Dots every texel with light: order^2 coefficients (HarmonicsRotation turns them), into `to`, which has
    // the same frame. Negative irradiance, from harmonics' ringing, becomes 0. `which`: indices into
    // bricks(), the order in which they are done; all: relightAll. Light that is not finite counts as none.
    void relight(std::span<const glm::vec3> light, std::span<const std::uint32_t> which,
                 IlluminationVolume& to, SimdTarget target = SimdTarget::Auto) const;
    // Returns the places in bricks() of those whose numbers are named (bricksSeen), in that order; others are
    // not held.
    std::vector<std::uint32_t> heldAmong(std::span<const std::uint32_t> numbers) const;
    void relightAll(std::span<const glm::vec3> light, IlluminationVolume& to,
                    SimdTarget target = SimdTarget::Auto) const;

private:
    struct Light;
    void relightBrick(std::size_t n, const Light& light, IlluminationVolume& to) const;
    std::size_t word(std::size_t brick, std::size_t slot, int coefficient, int channel) const;
    int pairs() const { return (mOrder * mOrder + 1) / 2; }
    std::size_t wordsPerGroup() const {
        return static_cast<std::size_t>(mChannels) * pairs() * kTransferGroup;
    }

    VolumeFrame mFrame;
    TexelLayout mLayout;
    int mOrder = 0, mChannels = 1;
    std::size_t mTexels = 0;
    std::vector<TexelBrick> mBricks;
    std::vector<std::uint32_t> mFirstGroup;  // first group of each brick, and one behind the last
    LazyArray<std::uint32_t> mWords;
};

}  // namespace stereonav
