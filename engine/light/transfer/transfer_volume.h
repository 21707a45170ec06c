// How texels respond to distant light, in spherical harmonics, so that light can be turned during flight
// (Wyman et al. 2006, section 4.3; Y4 of docs/ledger.md). Half floats, stored only for texels on a surface.
// Frames do not read this: relight() writes the irradiance volume that they look up, in a pass over the
// bricks that are in view.
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
    // Holds the texels of `bricks`, which are ordered by brick number. order: 1..kMaxHarmonicsOrder;
    // channels: 1 or 3. Throws Error for other values.
    TransferVolume(const VolumeFrame& texels, int order, int channels, std::vector<TexelBrick> bricks);

    bool empty() const { return mBricks.empty(); }
    const VolumeFrame& frame() const { return mFrame; }
    const TexelLayout& layout() const { return mLayout; }
    int order() const { return mOrder; }
    int channels() const { return mChannels; }
    std::span<const TexelBrick> bricks() const { return mBricks; }
    std::size_t texels() const { return mTexels; }
    std::size_t bytesHeld() const;

    // Numbers per texel: coefficient first, then channel.
    int numbersPerTexel() const { return mOrder * mOrder * mChannels; }
    // Sets the numbers of all texels of bricks()[n], in the order of texelsIn(). Different bricks may be set
    // by different threads. Rounds to half floats that are not denormal; values that are not finite become 0.
    void setBrick(std::size_t n, std::span<const float> numbers);
    // Returns the stored numbers of a texel; empty where it is not held.
    std::vector<float> at(const glm::ivec3& texel) const;

    // Multiplies every texel with the light, order^2 coefficients (rotated by HarmonicsRotation), and writes
    // the results into `to`, which has the same frame. Negative irradiance, from ringing of the harmonics,
    // becomes 0. which: indices into bricks(), in the order of work; relightAll() takes all. Light that is
    // not finite counts as none.
    void relight(std::span<const glm::vec3> light, std::span<const std::uint32_t> which,
                 IlluminationVolume& to, SimdTarget target = SimdTarget::Auto) const;
    // Returns the indices in bricks() of the bricks with these numbers (bricksSeen), in that order; numbers
    // that are not held are left out.
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
    std::vector<std::uint32_t> mFirstGroup;  // first group of each brick; at the end the number of groups
    LazyArray<std::uint32_t> mWords;
};

}  // namespace stereonav
