// Texels in half floats against a conversion by search, and the scalar lookups on fields whose interpolation
// is known in closed form.
#include "engine/volume/illumination_volume.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

using Lookup = IlluminationVolume::Lookup;
constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
constexpr Lookup kLookups[] = {Lookup::Nearest, Lookup::Trilinear, Lookup::Tricubic};

// Returns what the bits of a half stand for, from the definition of the format.
double halfValue(int bits) {
    const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
    return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
}

float red(float v) {
    return texelLight(packTexel({v, 0, 0}, 1)).x;
}

IlluminationVolume filled(const VolumeFrame& frame,
                          const std::function<glm::vec3(const glm::ivec3&)>& light) {
    IlluminationVolume volume(frame);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i)
                volume.texels[volume.layout.index(i, j, k)] = packTexel(light({i, j, k}), 1);
    return volume;
}

TEST(PackedTexel, EveryHalfIsKept) {
    for (int bits = 0; bits < 0x7c00; ++bits) {
        const float value = static_cast<float>(halfValue(bits));
        ASSERT_EQ(packTexel({value, 0, 0}, 0), static_cast<PackedTexel>(bits));
        ASSERT_EQ(texelLight(static_cast<PackedTexel>(bits)).x, value);
    }
}

TEST(PackedTexel, RoundsToTheNearestAndTiesToEven) {
    for (int bits = 0; bits + 1 < 0x7c00; ++bits) {
        const double low = halfValue(bits), high = halfValue(bits + 1), middle = (low + high) / 2;
        const float tie = static_cast<float>(middle);
        ASSERT_EQ(static_cast<double>(tie), middle);
        ASSERT_EQ(red(tie), bits & 1 ? high : low) << bits;
        ASSERT_EQ(red(std::nextafter(tie, 0.0f)), low) << bits;
        ASSERT_EQ(red(std::nextafter(tie, 1e9f)), high) << bits;
    }
}

TEST(PackedTexel, WhatIsNoLightCountsAsNone) {
    for (const float bad : {-1.0f, -0.0f, -kFloatInfinity, kFloatInfinity, std::nanf("")}) {
        EXPECT_EQ(red(bad), 0.0f) << bad;
        EXPECT_EQ(texelWeight(packTexel({1, 1, 1}, bad)), 0.0f) << bad;
    }
    EXPECT_EQ(red(1e30f), 65504.0f);
    EXPECT_EQ(red(65519.0f), 65504.0f);
    EXPECT_EQ(red(1e-30f), 0.0f);
    EXPECT_EQ(texelWeight(packTexel({0, 0, 0}, 7)), 1.0f);
}

TEST(PackedTexel, ChannelsDoNotMix) {
    const PackedTexel texel = packTexel({0.25f, 3.0f, 1000.0f}, 0.5f);
    EXPECT_EQ(texelLight(texel), glm::vec3(0.25f, 3.0f, 1000.0f));
    EXPECT_EQ(texelWeight(texel), 0.5f);
    EXPECT_EQ(packTexel(glm::vec3(0), 0), 0u);
}

TEST(TexelLayout, BricksArePages) {
    const glm::ivec3 size(17, 8, 9);
    const TexelLayout layout(size);
    EXPECT_EQ(layout.count(), 3u * 1 * 2 * 512);
    std::vector<int> used(layout.count());
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const std::size_t at = layout.index(i, j, k);
                ASSERT_LT(at, layout.count());
                ASSERT_EQ(used[at]++, 0);
                ASSERT_EQ(at & 511, static_cast<std::size_t>((i & 7) | (j & 7) << 3 | (k & 7) << 6));
            }
}

// Small integers are exact in halves, so that what remains is the interpolation's own error.
TEST(IlluminationLookup, LinearFieldsAreExactInside) {
    const VolumeFrame frame = test::slantedFrame({12, 9, 10});
    const auto light = [](const glm::ivec3& t) {
        return glm::vec3(3 * t.x + 5, 2 * t.y + t.z, 40 - t.x - t.y - t.z);
    };
    const IlluminationVolume volume = filled(frame, light);
    test::Random random(3);
    for (int n = 0; n < 2000; ++n) {
        const glm::dvec3 p = random.inBox(glm::dvec3(1), glm::dvec3(frame.size) - 2.0);
        for (const Lookup lookup : {Lookup::Trilinear, Lookup::Tricubic}) {
            const auto found = volume.at(frame.worldFromVoxel(p), lookup);
            ASSERT_NEAR(found.value.x, 3 * p.x + 5, 1e-5);
            ASSERT_NEAR(found.value.y, 2 * p.y + p.z, 1e-5);
            ASSERT_NEAR(found.value.z, 40 - p.x - p.y - p.z, 1e-5);
            ASSERT_NEAR(found.weight, 1, 1e-6);
        }
    }
}

TEST(IlluminationLookup, WeightsAddUpToOneAnywhere) {
    const VolumeFrame frame = test::slantedFrame({5, 3, 4});
    const IlluminationVolume volume = filled(frame, [](const glm::ivec3&) { return glm::vec3(7, 0, 0.5f); });
    test::Random random(4);
    for (int n = 0; n < 1000; ++n) {
        const glm::dvec3 p = random.inBox(glm::dvec3(-3), glm::dvec3(8));
        for (const Lookup lookup : kLookups) {
            const auto found = volume.at(frame.worldFromVoxel(p), lookup);
            ASSERT_NEAR(found.weight, 1, 1e-6);
            ASSERT_NEAR(found.value.x, 7, 1e-5);
            ASSERT_EQ(found.value.y, 0);
        }
    }
}

TEST(IlluminationLookup, IsClampedAtTheFaces) {
    const VolumeFrame frame = test::slantedFrame({6, 6, 6});
    const IlluminationVolume volume =
        filled(frame, [](const glm::ivec3& t) { return glm::vec3(t.x, t.y, t.z); });
    for (const double far : {0.5, 100.0, 1e30}) {
        const auto beyond = volume.at(frame.worldFromVoxel({5 + far, 2, -far}), Lookup::Trilinear);
        EXPECT_NEAR(beyond.value.x, 5, 1e-5);
        EXPECT_NEAR(beyond.value.z, 0, 1e-5);
    }
    // A B-spline at the last of clamped values 4, 5, 5, 5 at weights 1/6, 4/6, 1/6 is 29 / 6.
    EXPECT_NEAR(volume.at(frame.worldFromVoxel({5, 5, 5}), Lookup::Tricubic).value.x, 29.0 / 6, 1e-5);
    EXPECT_NEAR(volume.at(frame.worldFromVoxel({0, 0, 0}), Lookup::Tricubic).value.x, 1.0 / 6, 1e-5);
    const double nan = std::nan("");
    for (const Lookup lookup : kLookups)
        EXPECT_TRUE(std::isfinite(volume.at({nan, nan, nan}, lookup).value.x));
}

TEST(IlluminationLookup, UnknownTexelsAreLeftOut) {
    const VolumeFrame frame = test::slantedFrame({4, 4, 4});
    IlluminationVolume volume(frame);
    const auto set = [&](int i, float value, float weight) {
        volume.texels[volume.layout.index(i, 1, 1)] = packTexel({value, 0, 0}, weight);
    };
    set(1, 8, 1);
    const glm::dvec3 p = frame.worldFromVoxel({1.75, 1, 1});
    EXPECT_NEAR(volume.at(p).value.x, 8, 1e-6);
    EXPECT_NEAR(volume.at(p).weight, 0.25, 1e-6);
    set(2, 2, 1);
    EXPECT_NEAR(volume.at(p).value.x, 0.25 * 8 + 0.75 * 2, 1e-6);
    set(2, 2, 0.5f);  // counts half
    EXPECT_NEAR(volume.at(p).value.x, (0.25 * 8 + 0.375 * 2) / 0.625, 1e-6);
    EXPECT_NEAR(volume.at(p).weight, 0.625, 1e-6);
    EXPECT_EQ(volume.at(p, Lookup::Nearest).value.x, 2);
    EXPECT_EQ(volume.at(p, Lookup::Nearest).weight, 0.5f);
}

TEST(IlluminationLookup, NothingKnownHasNoWeight) {
    const VolumeFrame frame = test::slantedFrame({9, 9, 9});
    const IlluminationVolume volume(frame);
    const GreyVolume field(frame);
    const glm::dvec3 p = frame.worldFromVoxel({4.3, 2.2, 5.9});
    for (const Lookup lookup : kLookups) {
        EXPECT_EQ(volume.at(p, lookup).weight, 0);
        EXPECT_EQ(volume.at(p, lookup).value, glm::vec3(0));
    }
    EXPECT_EQ(volume.nearestIsovalue(p, field, 0).weight, 0);
    EXPECT_EQ(IlluminationVolume().at(p).weight, 0);
}

TEST(IlluminationLookup, OneTexelIsEverywhere) {
    const VolumeFrame frame = test::slantedFrame({1, 1, 1});
    const IlluminationVolume volume = filled(frame, [](const glm::ivec3&) { return glm::vec3(1, 2, 3); });
    const GreyVolume field(frame);
    for (const double x : {-5.0, 0.0, 0.3, 99.0}) {
        const glm::dvec3 p = frame.worldFromVoxel({x, -x, 2 * x});
        for (const Lookup lookup : kLookups) {
            EXPECT_NEAR(glm::length(volume.at(p, lookup).value - glm::vec3(1, 2, 3)), 0, 1e-6);
            EXPECT_NEAR(volume.at(p, lookup).weight, 1, 1e-6);
        }
        EXPECT_EQ(volume.nearestIsovalue(p, field, 5).value, glm::vec3(1, 2, 3));
    }
}

TEST(IlluminationLookup, NearestIsovalueTakesTheTexelOnTheSurface) {
    const VolumeFrame frame = test::slantedFrame({8, 8, 8});
    // Values grow along x alone: the light of a texel is its own value.
    const GreyVolume field = test::greyVolume(frame, [](const glm::dvec3& v) { return 100 * v.x; });
    IlluminationVolume volume = filled(frame, [](const glm::ivec3& t) { return glm::vec3(t.x, t.y, t.z); });
    test::Random random(5);
    for (int n = 0; n < 500; ++n) {
        const glm::dvec3 p = random.inBox(glm::dvec3(0.01), glm::dvec3(6.99));
        const float isovalue = static_cast<float>(100 * p.x);
        const auto found = volume.nearestIsovalue(frame.worldFromVoxel(p), field, isovalue);
        ASSERT_EQ(found.value.x, std::round(p.x));
        // The nearest of four texels with the same value is found.
        ASSERT_EQ(found.value.y, std::round(p.y));
        ASSERT_EQ(found.value.z, std::round(p.z));
    }
    const glm::dvec3 p = frame.worldFromVoxel({3.2, 2.1, 2.1});
    EXPECT_EQ(volume.nearestIsovalue(p, field, 390).value.x, 4);  // not the nearest in space
    volume.texels[volume.layout.index(3, 2, 2)] = 0;
    EXPECT_NE(volume.nearestIsovalue(p, field, 320).weight, 0);
}

TEST(IlluminationLookup, NearestIsovalueReadsTheFieldBetweenVoxels) {
    const VolumeFrame frame = test::slantedFrame({8, 8, 8});
    const GreyVolume field = test::greyVolume(frame, [](const glm::dvec3& v) { return 100 * v.x; });
    const VolumeFrame texels = texelFrame(frame, 2);
    const IlluminationVolume volume =
        filled(texels, [](const glm::ivec3& t) { return glm::vec3(t.x, 0, 0); });
    const glm::dvec3 p = texels.worldFromVoxel({7.4, 5, 5});
    EXPECT_EQ(volume.nearestIsovalue(p, field, 370).value.x, 7);
    EXPECT_EQ(volume.nearestIsovalue(p, field, 390).value.x, 8);
}

TEST(IlluminationVolume, TakesMemoryWhereItIsWritten) {
    VolumeFrame frame;
    frame.size = {512, 512, 512};
    IlluminationVolume volume(frame);
    EXPECT_EQ(volume.bytesHeld(), 0u);
    volume.texels[volume.layout.index(100, 200, 300)] = 1;
    EXPECT_GE(volume.bytesHeld(), 4096u);
    EXPECT_LE(volume.bytesHeld(), 2u << 20);  // a large page at most
    EXPECT_EQ(IlluminationVolume().bytesHeld(), 0u);
}

TEST(TexelFrame, CoversTheVolume) {
    const VolumeFrame volume = test::slantedFrame({256, 5, 2});
    for (const double perVoxel : {0.25, 0.5, 1.0 / 3, 1.0, 2.0, 3.0}) {
        const VolumeFrame texels = texelFrame(volume, perVoxel);
        EXPECT_EQ(texels.origin, volume.origin);
        for (int n = 0; n < 3; ++n) {
            const double last = (texels.size[n] - 1) / perVoxel, end = volume.size[n] - 1;
            EXPECT_GE(last, end - 1e-6) << perVoxel;
            EXPECT_LT(last, end + 1 / perVoxel) << perVoxel;
            EXPECT_DOUBLE_EQ(texels.spacing[n] * perVoxel, volume.spacing[n]);
        }
    }
    EXPECT_EQ(texelFrame(volume, 1).size, volume.size);
    EXPECT_EQ(texelFrame(volume, 2).size, glm::ivec3(511, 9, 3));
    EXPECT_EQ(texelFrame(volume, 0.5).size, glm::ivec3(129, 3, 2));
    EXPECT_EQ(texelFrame(test::slantedFrame({1, 1, 1}), 2).size, glm::ivec3(1));
}

TEST(TexelFrame, RefusesWhatCanNotBe) {
    const VolumeFrame volume = test::slantedFrame({1016, 1016, 1016});
    for (const double bad : {0.0, -1.0, std::nan(""), 1e300}) EXPECT_THROW(texelFrame(volume, bad), Error);
    EXPECT_NO_THROW(texelFrame(volume, 1));
    try {
        texelFrame(volume, 2);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("2031 x 2031 x 2031 texels, more than 2^30"));
    }
}

}  // namespace
}  // namespace stereonav
