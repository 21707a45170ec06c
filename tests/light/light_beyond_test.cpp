// Light for texels that no bake lit: what closed forms and the known texels say it must be.
#include "engine/light/transfer/light_beyond.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/volume/baked_data.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

using namespace test;

template <typename Texel>  // PackedTexel texel(i, j, k)
IlluminationVolume lightOf(const glm::ivec3& size, Texel texel) {
    IlluminationVolume light(slantedFrame(size));
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) light.texels[light.layout.index(i, j, k)] = texel(i, j, k);
    return light;
}

template <typename Check>  // check(place in texels, light there)
void everywhere(const IlluminationVolume& light, const IlluminationVolume& beyond, const Check& check) {
    Random random(3);
    for (int n = 0; n < 500; ++n) {
        const glm::dvec3 texel = random.inBox(glm::dvec3(-2), glm::dvec3(light.frame.size + 1));
        check(texel, beyond.at(light.frame.worldFromVoxel(texel)));
    }
}

TEST(LightBeyond, oneKnownTexelLightsAll) {
    const glm::vec3 value(0.25f, 0.5f, 2.0f);
    for (const glm::ivec3 size : {glm::ivec3(21, 17, 9), glm::ivec3(1, 1, 1), glm::ivec3(40, 2, 3)}) {
        const glm::ivec3 known = size / 3;
        const IlluminationVolume light = lightOf(size, [&](int i, int j, int k) {
            return glm::ivec3(i, j, k) == known ? packTexel(value, 0.5f) : 0;
        });
        const IlluminationVolume beyond = lightBeyond(light);
        ASSERT_FALSE(beyond.empty());
        everywhere(light, beyond, [&](const glm::dvec3&, const IlluminationVolume::Light& found) {
            EXPECT_EQ(found.weight, 1);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(found.value[c], value[c], 1e-3f * value[c]);
        });
    }
}

TEST(LightBeyond, whereNothingIsKnownThereIsNone) {
    const IlluminationVolume dark = lightOf({9, 9, 9}, [](int, int, int) { return PackedTexel{0}; });
    EXPECT_TRUE(lightBeyond(dark).empty());
    EXPECT_TRUE(lightBeyond({}).empty());
}

// A wall lit brightly, one across lit dimly: near each its own light, between them steadily from one to the
// other, and all over the whole height alike.
TEST(LightBeyond, isTheLightOfWhatIsNear) {
    const glm::ivec3 size(64, 24, 24);
    const auto light = lightOf(size, [&](int i, int, int) {
        return i < 2 ? packTexel(glm::vec3(0.9f), 1) : i >= 62 ? packTexel(glm::vec3(0.1f), 1) : 0;
    });
    const IlluminationVolume beyond = lightBeyond(light);
    const auto at = [&](const glm::dvec3& texel) {
        return beyond.at(light.frame.worldFromVoxel(texel)).value.x;
    };
    EXPECT_NEAR(at({1, 12, 12}), 0.9f, 1e-3f);
    EXPECT_NEAR(at({62, 12, 12}), 0.1f, 1e-3f);
    EXPECT_NEAR(at({31.5, 12, 12}), 0.5f, 1e-3f) << "half way";
    EXPECT_GT(at({8, 12, 12}), 0.8f);
    float before = 1;
    for (int i = 0; i < 64; ++i) {
        const float now = at(glm::dvec3(i, 12, 12));
        EXPECT_LE(now, before + 1e-4f) << i;
        EXPECT_NEAR(at(glm::dvec3(i, 3, 20)), now, 1e-3f) << i;
        before = now;
    }
}

TEST(LightBeyond, isNeitherBrighterNorDarkerThanWhatIsKnown) {
    Random random(5);
    const auto light = lightOf({30, 27, 22}, [&](int, int, int) {
        const auto value = static_cast<float>(random.between(0.2, 0.7));
        return random.between(0, 1) < 0.02 ? packTexel({value, 1e30f, 0}, 1) : 0;
    });
    everywhere(light, lightBeyond(light), [](const glm::dvec3&, const IlluminationVolume::Light& found) {
        EXPECT_GE(found.value.x, 0.199f);
        EXPECT_LE(found.value.x, 0.701f);
        EXPECT_NEAR(found.value.y, 65504, 100);
        EXPECT_EQ(found.value.z, 0);
    });
}

TEST(LightBeyond, isBroughtUpToDateAsIfMadeAnew) {
    auto light = lightOf({30, 27, 22}, [](int i, int j, int k) {
        return (i + 2 * j + 5 * k) % 41 == 0 ? packTexel(glm::vec3(0.3f), 1) : 0;
    });
    IlluminationVolume beyond = lightBeyond(light);
    for (int n = 0; n < 9; ++n) light.texels[light.layout.index(3 * n, 2 * n, n)] = packTexel({1, 2, 3}, 1);
    const int threads = threadCount();
    setThreadCount(1);
    updateLightBeyond(light, beyond);
    setThreadCount(3);
    const IlluminationVolume anew = lightBeyond(light);
    setThreadCount(threads);
    ASSERT_EQ(anew.layout.count(), beyond.layout.count());
    for (std::size_t n = 0; n < anew.layout.count(); ++n) ASSERT_EQ(anew.texels[n], beyond.texels[n]) << n;
}

// What pictures show: known texels as they are, where none is known what is beyond, no step between.
TEST(LightBeyond, goesOnFromKnownLightWithoutAStep) {
    const glm::ivec3 size(32, 24, 24);
    BakedLook look;
    look.light = std::make_shared<IlluminationVolume>(lightOf(size, [](int i, int j, int k) {
        const float value = 0.4f + 0.2f * std::sin(0.3f * static_cast<float>(j + k));
        return i < 8 ? packTexel(glm::vec3(value), 1) : 0;
    }));
    const VolumeFrame& frame = look.light->frame;
    const IlluminationVolume::Light lampHere = bakedLightAt(look, frame.worldFromVoxel({20, 12, 12}));
    EXPECT_EQ(lampHere.weight, 0);
    look.beyond = std::make_shared<IlluminationVolume>(lightBeyond(*look.light));
    float before = bakedLightAt(look, frame.worldFromVoxel({0, 12, 12})).value.x;
    for (double i = 0; i < 31; i += 1.0 / 64) {
        const auto here = bakedLightAt(look, frame.worldFromVoxel({i, 12, 12}));
        EXPECT_EQ(here.weight, 1);
        EXPECT_NEAR(here.value.x, before, 0.01f) << i;
        before = here.value.x;
        if (i <= 7) {
            EXPECT_EQ(here.value, look.light->at(frame.worldFromVoxel({i, 12, 12})).value) << i;
        }
    }
}

}  // namespace
}  // namespace stereonav
