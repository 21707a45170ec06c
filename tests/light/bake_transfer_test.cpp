// Stored transfer against the numbers it was given and against dot products in double precision, with each
// instruction set.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/light/skies/spherical_harmonics.h"
#include "engine/light/transfer/transfer_volume.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

// Bricks of a 20 x 11 x 17 grid with some texels each: none, one, some, all.
std::vector<TexelBrick> someBricks(const VolumeFrame& frame, unsigned seed) {
    const TexelLayout layout(frame.size);
    test::Random random(seed);
    std::vector<TexelBrick> bricks;
    const int count = layout.bricks.x * layout.bricks.y * layout.bricks.z;
    for (int n = 0; n < count; ++n) {
        if (n % 5 == 1) continue;
        TexelBrick brick{static_cast<std::uint32_t>(n), {}};
        const glm::ivec3 first = brickPlace(layout, brick.number) * 8;
        for (int k = 0; k < 8; ++k)
            for (int bit = 0; bit < 64; ++bit)
                if (frame.contains(first + glm::ivec3(bit & 7, bit >> 3, k)) &&
                    random.between(0, 1) < 0.25 * (n % 5))
                    brick.wanted[k] |= 1ull << bit;
        bricks.push_back(brick);
    }
    return bricks;
}

VolumeFrame frameOf(const glm::ivec3& size) {
    return test::slantedFrame(size);
}

struct Made {
    TransferVolume volume;
    std::vector<std::vector<float>> numbers;  // by brick
};

Made made(const VolumeFrame& frame, int order, int channels) {
    const std::vector<TexelBrick> bricks = someBricks(frame, 7);
    Made m{TransferVolume(frame, order, channels, bricks), {}};
    test::Random random(9);
    for (std::size_t n = 0; n < bricks.size(); ++n) {
        std::vector<float> numbers(
            static_cast<std::size_t>(countTexels(bricks[n].wanted) * order * order * channels));
        for (float& v : numbers) v = static_cast<float>(random.between(-0.5, 1));
        m.volume.setBrick(n, numbers);
        m.numbers.push_back(numbers);
    }
    return m;
}

TEST(TransferVolume, KeepsWhatItIsGiven) {
    const VolumeFrame frame = frameOf({20, 11, 17});
    for (const int order : {1, 2, 5, 6})
        for (const int channels : {1, 3}) {
            const Made m = made(frame, order, channels);
            std::size_t texels = 0;
            for (std::size_t n = 0; n < m.numbers.size(); ++n) {
                const std::vector<glm::ivec3> in = texelsIn(m.volume.layout(), m.volume.bricks()[n]);
                const std::size_t each = static_cast<std::size_t>(m.volume.numbersPerTexel());
                for (std::size_t t = 0; t < in.size(); ++t, ++texels) {
                    const std::vector<float> kept = m.volume.at(in[t]);
                    ASSERT_EQ(kept.size(), each);
                    for (std::size_t c = 0; c < each; ++c)
                        ASSERT_NEAR(kept[c], m.numbers[n][t * each + c], 0.00025) << order << channels;
                }
            }
            EXPECT_EQ(m.volume.texels(), texels);
            EXPECT_GT(texels, 500u);
        }
}

TEST(TransferVolume, HoldsNothingElsewhere) {
    const VolumeFrame frame = frameOf({20, 11, 17});
    const Made m = made(frame, 3, 1);
    std::size_t held = 0;
    for (int k = 0; k < 17; ++k)
        for (int j = 0; j < 11; ++j)
            for (int i = 0; i < 20; ++i) held += !m.volume.at({i, j, k}).empty();
    EXPECT_EQ(held, m.volume.texels());
    EXPECT_TRUE(m.volume.at({-1, 0, 0}).empty());
    EXPECT_TRUE(m.volume.at({0, 11, 0}).empty());
    EXPECT_TRUE(TransferVolume().empty());
}

// In double precision from what at() gives.
TEST(TransferVolume, RelightsEveryTexelAsItsDotProduct) {
    const VolumeFrame frame = frameOf({20, 11, 17});
    test::Random random(21);
    int checked = 0;
    for (const NamedSimdTarget& simd : kSimdTargets)
        for (const int order : {1, 4, 5, 6})
            for (const int channels : {1, 3}) {
                const Made m = made(frame, order, channels);
                std::vector<glm::vec3> light(static_cast<std::size_t>(order * order));
                for (glm::vec3& v : light) v = glm::vec3(random.inBox(glm::dvec3(-1), glm::dvec3(3)));
                IlluminationVolume to(frame);
                try {
                    m.volume.relightAll(light, to, simd.target);
                } catch (const std::exception&) {
                    continue;  // not on this processor
                }
                std::size_t known = 0;
                for (int k = 0; k < 17; ++k)
                    for (int j = 0; j < 11; ++j)
                        for (int i = 0; i < 20; ++i) {
                            const PackedTexel texel = to.texels[to.layout.index(i, j, k)];
                            const std::vector<float> t = m.volume.at({i, j, k});
                            ASSERT_EQ(texelWeight(texel), t.empty() ? 0.0f : 1.0f);
                            if (t.empty()) continue;
                            ++known;
                            for (int c = 0; c < 3; ++c) {
                                double sum = 0;
                                for (std::size_t n = 0; n < light.size(); ++n)
                                    sum += static_cast<double>(light[n][c]) *
                                           t[n * channels + (channels == 3 ? c : 0)];
                                sum = std::max(sum, 0.0);
                                ASSERT_NEAR(texelLight(texel)[c], sum, 1e-5 + sum * 0.0006) << simd.name;
                            }
                        }
                EXPECT_EQ(known, m.volume.texels());
                ++checked;
            }
    EXPECT_GE(checked, 16);  // auto and plain are everywhere
}

TEST(TransferVolume, RelightsOnlyTheBricksAskedFor) {
    const VolumeFrame frame = frameOf({20, 11, 17});
    const Made m = made(frame, 2, 1);
    const std::vector<glm::vec3> light(4, glm::vec3(1));
    IlluminationVolume all(frame), some(frame);
    m.volume.relightAll(light, all);
    const std::vector<std::uint32_t> which{3, 0};
    m.volume.relight(light, which, some);
    for (std::size_t b = 0; b < m.volume.bricks().size(); ++b) {
        const bool asked = b == 3 || b == 0;
        for (const glm::ivec3& t : texelsIn(m.volume.layout(), m.volume.bricks()[b])) {
            const std::size_t at = all.layout.index(t.x, t.y, t.z);
            ASSERT_EQ(some.texels[at], asked ? all.texels[at] : 0) << b;
        }
    }
    m.volume.relight(light, {}, some);  // nothing
}

TEST(TransferVolume, ExtremeNumbersStayFinite) {
    const VolumeFrame frame = frameOf({8, 8, 8});
    TexelBrick brick{0, {}};
    brick.wanted[2] = 0b11111111;
    TransferVolume volume(frame, 1, 1, {brick});
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::vector<float> numbers{std::nanf(""), kInfinity, -kInfinity, 1e30f,
                                     1e-30f,        0x1p-24f,  0x1.2p-15f, -0x1.fp-15f};
    volume.setBrick(0, numbers);
    EXPECT_EQ(volume.at({0, 0, 2}).at(0), 0);
    EXPECT_EQ(volume.at({3, 0, 2}).at(0), 65504);
    // No denormals: the nearest of 0 and the least normal half.
    EXPECT_EQ(volume.at({5, 0, 2}).at(0), 0);
    EXPECT_EQ(volume.at({6, 0, 2}).at(0), 0x1p-14f);
    EXPECT_EQ(volume.at({7, 0, 2}).at(0), -0x1p-14f);
    for (const float light : {0.0f, 1e30f, -1e30f, kInfinity, -kInfinity, std::nanf("")}) {
        IlluminationVolume to(frame);
        const std::vector<glm::vec3> lights{glm::vec3(light)};
        volume.relightAll(lights, to);
        for (int i = 0; i < 8; ++i) {
            const PackedTexel texel = to.texels[to.layout.index(i, 0, 2)];
            ASSERT_EQ(texelWeight(texel), 1.0f);
            ASSERT_LE(texelLight(texel).x, 65504.0f);
            ASSERT_GE(texelLight(texel).x, 0.0f);
        }
    }
}

TEST(TransferVolume, TakesTwoBytesANumber) {
    const VolumeFrame frame = frameOf({64, 64, 64});
    TexelChoice choice;
    choice.full = true;
    Progress progress;
    const GreyVolume volume(frame);
    const TransferVolume transfer(frame, 5, 1, wantedBricks(volume, frame, choice, progress));
    EXPECT_EQ(transfer.texels(), 64u * 64 * 64);
    // 25 coefficients in 13 words.
    const double bytes = static_cast<double>(transfer.bytesHeld()) / static_cast<double>(transfer.texels());
    EXPECT_GE(bytes, 50);
    EXPECT_LT(bytes, 53);
}

}  // namespace
}  // namespace stereonav
