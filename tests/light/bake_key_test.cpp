// The key of a volume's bake: whatever its light depends on gives another key, and so another file. Bakes
// that are the same go on from each other.
#include <gtest/gtest.h>

#include <memory>

#include "engine/light/bake/bake_file.h"
#include "tests/support/each_member.h"
#include "tests/volume/test_volumes.h"

namespace stereonav::test {

template <>
struct Members<VolumeFrame> {
    static constexpr std::array names{"size", "spacing", "origin", "axes"};
};
template <>
struct Members<PointLight> {
    static constexpr std::array names{"position", "intensity", "radius"};
};
template <>
struct Members<LightSetup> {
    static constexpr std::array names{"probe", "sky", "lights", "albedo", "reach", "bounces"};
};
template <>
struct Members<TexelSampling> {
    static constexpr std::array names{"naive",   "lowDiscrepancy", "cosine",  "nextEvent", "roulette",
                                      "leaping", "lowest",         "highest", "seed",      "simd"};
};
template <>
struct Members<TexelChoice> {
    static constexpr std::array names{"lowest", "highest", "region", "full"};
};
template <>
struct Members<BakeShape> {
    static constexpr std::array names{"kind", "order", "channels"};
};
template <>
struct Members<BakeInputs> {
    static constexpr std::array names{"content", "light", "sampling", "texels", "choice", "shape"};
};

namespace {

std::shared_ptr<const LightProbe> keyProbe(int width, int height, const std::vector<glm::vec3>& pixels) {
    return std::make_shared<LightProbe>(width, height, pixels, "probe");
}

// What does not change what is baked: over what rays leap, and the instruction set.
const std::vector<std::string> kWithoutEffect{"sampling.leaping", "sampling.simd"};
// Pointers, which the tests below change.
const std::vector<std::string> kByHand{"light.probe", "choice.region"};

std::vector<std::string> joined(std::initializer_list<std::vector<std::string>> lists) {
    std::vector<std::string> all;
    for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

BakeInputs bakeInputs(BakeKind kind) {
    BakeInputs in;
    in.content = 1;
    in.shape.kind = kind;
    in.texels = slantedFrame({5, 6, 7});
    in.choice.lowest = 8;
    in.choice.highest = 10;
    in.sampling.lowest = 8;
    in.sampling.highest = 10;
    in.light.sky = glm::vec3(0.5f, 0.25f, 0.125f);
    in.light.reach = 0.25;
    in.light.probe = keyProbe(4, 2, std::vector<glm::vec3>(8, glm::vec3(1)));
    in.light.lights.resize(2);
    in.light.lights[0].position = {1, 2, 3};
    return in;
}

// Kinds are told apart below: most of what counts for one of them is of no use to another.
TEST(BakeKey, OfIrradianceHasEverySettingOfTheLightAndThePaths) {
    const BakeInputs base = bakeInputs(BakeKind::Irradiance);
    const std::vector<std::string> ofTransfer{"shape.order", "shape.channels"};
    auto changes = eachMemberChanged(base, joined({kWithoutEffect, kByHand, ofTransfer, {"shape.kind"}}));
    const auto add = [&](const std::string& what, const auto& change) {
        changes.push_back({what, base});
        change(changes.back().value);
    };
    const MaskVolume region;
    add("a region", [&](BakeInputs& in) { in.choice.region = &region; });
    add("no probe", [](BakeInputs& in) { in.light.probe = nullptr; });
    std::vector<glm::vec3> pixels(8, glm::vec3(1));
    add("a probe of another shape", [&](BakeInputs& in) { in.light.probe = keyProbe(2, 4, pixels); });
    add("a larger probe",
        [&](BakeInputs& in) { in.light.probe = keyProbe(8, 4, std::vector<glm::vec3>(32, glm::vec3(1))); });
    for (std::size_t n = 0; n < pixels.size(); ++n)
        for (int channel = 0; channel < 3; ++channel)
            add("a pixel of the probe " + std::to_string(n), [&](BakeInputs& in) {
                std::vector<glm::vec3> other = pixels;
                other[n][channel] = std::nextafter(1.0f, 2.0f);
                in.light.probe = keyProbe(4, 2, other);
            });
    for (const BakeKind kind : {BakeKind::Transfer, BakeKind::Openness})
        add("another kind", [&](BakeInputs& in) { in.shape.kind = kind; });
    expectKeysDiffer(base, changes, bakeKey);
}

TEST(BakeKey, OfTransferHasEverySettingOfTheSurfaceAndTheHarmonics) {
    const BakeInputs base = bakeInputs(BakeKind::Transfer);
    const std::vector<std::string> ofIrradiance{"light.sky", "light.lights"};
    expectKeysDiffer(base, eachMemberChanged(base, joined({kWithoutEffect, kByHand, ofIrradiance})), bakeKey);
}

TEST(BakeKey, OfOpennessHasEverySettingOfTheRays) {
    const BakeInputs base = bakeInputs(BakeKind::Openness);
    const std::vector<std::string> ofOthers{"light.sky",     "light.lights", "light.albedo",
                                            "light.bounces", "shape.order",  "shape.channels"};
    expectKeysDiffer(base, eachMemberChanged(base, joined({kWithoutEffect, kByHand, ofOthers})), bakeKey);
}

// All texels for any isovalue: limits of those that are shown do not choose them.
TEST(BakeKey, OfAllTexelsHasTheSurfacesThatTheyStandFor) {
    BakeInputs base = bakeInputs(BakeKind::Irradiance);
    base.choice.full = true;
    base.sampling.lowest = base.choice.lowest = 0;
    const std::vector<std::string> limits{"choice.lowest", "choice.highest"};
    const std::vector<std::string> ofTransfer{"shape.order", "shape.channels"};
    const auto leftOut = joined({kWithoutEffect, kByHand, limits, ofTransfer});
    expectKeysDiffer(base, eachMemberChanged(base, leftOut), bakeKey);
}

TEST(BakeKey, IsThatOfABakeWhoseLightIsTheSame) {
    for (const BakeKind kind : {BakeKind::Irradiance, BakeKind::Transfer, BakeKind::Openness}) {
        const BakeInputs base = bakeInputs(kind);
        std::vector<Changed<BakeInputs>> same;
        const auto add = [&](const std::string& what, const auto& change) {
            same.push_back({what, base});
            change(same.back().value);
        };
        add("leaping", [](BakeInputs& in) { in.sampling.leaping = false; });
        add("the instruction set", [](BakeInputs& in) { in.sampling.simd = SimdTarget::Plain; });
        if (kind != BakeKind::Irradiance) {
            add("the sky", [](BakeInputs& in) { in.light.sky.y = 3; });
            add("lights", [](BakeInputs& in) { in.light.lights.clear(); });
        } else {
            add("the same probe", [](BakeInputs& in) {
                in.light.probe = keyProbe(4, 2, std::vector<glm::vec3>(8, glm::vec3(1)));
            });
        }
        if (kind != BakeKind::Transfer) add("order", [](BakeInputs& in) { in.shape.order = 3; });
        expectKeysEqual(base, same, bakeKey);
    }
}

std::vector<Changed<VolumeFrame>> framesBeside(const VolumeFrame& frame) {
    return eachMemberChanged(frame, {"size"});
}

TEST(BakeContent, IsEveryVoxelAndWhereTheyLie) {
    const VolumeFrame frame = slantedFrame({4, 3, 2});
    const GreyVolume base = greyVolume(frame, [](const glm::dvec3& v) { return 7 * v.x + v.y - 3 * v.z; });
    struct Case {
        VolumeFrame frame;
        std::vector<std::int16_t> values;
    };
    const Case first{frame, {base.values.data(), base.values.data() + frame.count()}};
    std::vector<Changed<Case>> changes;
    for (const auto& other : framesBeside(frame))
        changes.push_back({other.what, {other.value, first.values}});
    for (const glm::ivec3& size : {glm::ivec3(3, 4, 2), glm::ivec3(4, 2, 3), glm::ivec3(2, 3, 4)}) {
        changes.push_back({"another shape", first});
        changes.back().value.frame.size = size;
    }
    for (std::size_t n = 0; n < frame.count(); ++n) {
        changes.push_back({"voxel " + std::to_string(n), first});
        changes.back().value.values[n] ^= 1;
    }
    expectKeysDiffer(first, changes, [](const Case& c) {
        GreyVolume volume(c.frame);
        std::copy(c.values.begin(), c.values.end(), volume.values.data());
        return contentHash(volume);
    });
}

TEST(BakeContent, NearAWallIsWhatIsKnownThereAndTheWholeRegion) {
    const VolumeFrame frame = slantedFrame({25, 9, 9});
    struct Case {
        VolumeFrame frame;
        std::vector<TexelBrick> bricks{{0, {}}, {1, {}}};
        glm::ivec3 voxel{-1}, inRegion{-1};  // that differ from 0
    };
    Case base;
    base.frame = frame;
    base.bricks[0].wanted[2] = 1ull << 9;          // texel (1, 1, 2)
    base.bricks[1].wanted[0] = 1ull << 63 | 1ull;  // texels (15, 7, 0) and (8, 0, 0)
    std::vector<Changed<Case>> changes;
    for (const auto& other : framesBeside(frame)) {
        changes.push_back({other.what, base});
        changes.back().value.frame = other.value;
    }
    for (const glm::ivec3& voxel : {glm::ivec3(1, 1, 2), glm::ivec3(15, 7, 0), glm::ivec3(8, 0, 0)}) {
        changes.push_back({"a voxel near the wall", base});
        changes.back().value.voxel = voxel;
    }
    for (const glm::ivec3& voxel : {glm::ivec3(0), glm::ivec3(16, 8, 8), glm::ivec3(1, 1, 2)}) {
        changes.push_back({"the region", base});
        changes.back().value.inRegion = voxel;
    }
    changes.push_back({"a brick less", base});
    changes.back().value.bricks.pop_back();
    changes.push_back({"another brick of the same values", base});
    changes.back().value.bricks[1].number = 2;
    const auto key = [](const Case& c) {
        GreyVolume volume(c.frame);
        MaskVolume region(c.frame);
        if (c.voxel.x >= 0) volume.at(c.voxel) = 1;
        if (c.inRegion.x >= 0) region.at(c.inRegion) = 1;
        return contentHashNear(volume, region, c.bricks);
    };
    expectKeysDiffer(base, changes, key);
    Case far = base;
    far.voxel = {16, 8, 8};
    expectKeysEqual(base, {{"a voxel that is not known there", far}}, key);
}

TEST(BakeKey, NamesTheFileInTheCache) {
    EXPECT_NE(bakeCacheFile(1), bakeCacheFile(2));
    EXPECT_NE(bakeCacheFile(1), bakeCacheFile(1ull << 63 | 1));
    EXPECT_EQ(bakeCacheFile(3), bakeCacheFile(3));
}

}  // namespace
}  // namespace stereonav::test
