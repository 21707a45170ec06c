// The oracle of ray casting against closed forms and a march in tiny steps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>

#include "test_volumes.h"
#include "tests/oracle/plain_composite.h"

namespace stereonav {
namespace {

using test::greyVolume;
using test::Random;
using test::slantedFrame;

// Trilinear value by weights, written apart from the oracle's.
double valueAt(const GreyVolume& volume, const glm::dvec3& voxel) {
    const glm::dvec3 last(volume.frame.size - 2);
    const glm::dvec3 cell = glm::clamp(glm::floor(voxel), glm::dvec3(0.0), last);
    const glm::dvec3 f = voxel - cell;
    double sum = 0;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 o(n & 1, n >> 1 & 1, n >> 2);
        const glm::dvec3 w(o.x ? f.x : 1 - f.x, o.y ? f.y : 1 - f.y, o.z ? f.z : 1 - f.z);
        sum += w.x * w.y * w.z * volume.at(glm::ivec3(cell) + o);
    }
    return sum;
}

bool isInside(const VolumeFrame& frame, const glm::dvec3& voxel) {
    return voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x <= frame.size.x - 1 &&
           voxel.y <= frame.size.y - 1 && voxel.z <= frame.size.z - 1;
}

GreyVolume noise(const glm::ivec3& size, unsigned seed) {
    Random random(seed);
    return greyVolume(slantedFrame(size), [&](const glm::dvec3&) { return random.between(-1000, 1000); });
}

PlainRay rayThrough(Random& random, const VolumeFrame& frame, double scale) {
    const glm::dvec3 size(frame.size - 1);
    const glm::dvec3 from = frame.worldFromVoxel(random.inBox(-0.5 * size, 1.5 * size));
    const glm::dvec3 to = frame.worldFromVoxel(random.inBox(glm::dvec3(0.0), size));
    return {from, (to - from) * scale, 0};
}

TEST(PlainVolumeCaster, HitsAPlaneWhereItIs) {
    const GreyVolume volume = greyVolume(
        slantedFrame({14, 11, 9}), [](const glm::dvec3& v) { return 31 * v.x - 17 * v.y + 23 * v.z - 200; });
    const VolumeFrame& frame = volume.frame;
    Random random(1);
    int hits = 0;
    for (int n = 0; n < 2000; ++n) {
        const PlainRay ray = rayThrough(random, frame, random.between(0.1, 100));
        const glm::dvec3 o = frame.voxelFromWorld(ray.eye), d = frame.voxelDirection(ray.direction);
        const glm::dvec3 slope(31, -17, 23);
        const double isovalue = 40.5;
        const double t = (isovalue + 200 - glm::dot(slope, o)) / glm::dot(slope, d);
        const PlainHit hit = castPlainVolume(volume, isovalue, ray);
        if (glm::dot(slope, d) > 0 && t > 0 && isInside(frame, o + t * d) && !isInside(frame, o)) {
            ASSERT_TRUE(hit.hit()) << n;
            EXPECT_NEAR(hit.t / t, 1, 1e-10) << n;
            EXPECT_LT(glm::length(hit.voxel() - (o + t * d)), 1e-9) << n;
            ++hits;
        } else if (hit.hit()) {  // it starts or enters behind the plane
            EXPECT_GE(valueAt(volume, hit.voxel()), isovalue - 1e-6) << n;
        }
    }
    EXPECT_GT(hits, 300);
}

TEST(PlainVolumeCaster, NothingReachesTheIsovalueBeforeTheHit) {
    const GreyVolume volume = noise({7, 6, 5}, 2);
    Random random(3);
    int hits = 0, misses = 0;
    for (int n = 0; n < 400; ++n) {
        const PlainRay ray = rayThrough(random, volume.frame, 1);
        const double isovalue = random.between(300, 990);
        const PlainHit hit = castPlainVolume(volume, isovalue, ray);
        const glm::dvec3 o = volume.frame.voxelFromWorld(ray.eye);
        const glm::dvec3 d = volume.frame.voxelDirection(ray.direction);
        if (hit.hit()) {
            EXPECT_LT(glm::length(o + hit.t * d - hit.voxel()), 1e-9) << n;
            EXPECT_GE(valueAt(volume, hit.voxel()), isovalue - 1e-6) << n;
        }
        (hit.hit() ? hits : misses)++;
        if (hit.t == 0) continue;  // the eye is behind the surface
        const double end = std::min(hit.t, 4.0);
        for (int s = 0; s < 4000; ++s) {
            const glm::dvec3 p = o + end * (s / 4000.0) * d;
            if (isInside(volume.frame, p)) {
                ASSERT_LT(valueAt(volume, p), isovalue + 1e-6) << n << " at sample " << s;
            }
        }
    }
    EXPECT_GT(hits, 50);
    EXPECT_GT(misses, 50);
}

TEST(PlainVolumeCaster, StartsWhereTheRayStarts) {
    const GreyVolume volume =
        greyVolume(VolumeFrame{{5, 5, 5}}, [](const glm::dvec3& v) { return 10 * v.x; });
    const PlainHit inside = castPlainVolume(volume, 25, {{0.5, 2.2, 2.7}, {1, 0, 0}, 3.0});
    EXPECT_DOUBLE_EQ(inside.t, 3.0);  // behind the surface already
    const PlainHit before = castPlainVolume(volume, 25, {{0.5, 2.2, 2.7}, {1, 0, 0}, 1.0});
    EXPECT_DOUBLE_EQ(before.t, 2.0);
    EXPECT_EQ(before.cell, glm::ivec3(2, 2, 2));
    EXPECT_NEAR(before.local.x, 0.5, 1e-12);
    const PlainHit entry = castPlainVolume(volume, 25, {{6, 2, 2}, {-1, 0, 0}, 0});
    EXPECT_DOUBLE_EQ(entry.t, 2.0);  // at the face, which is above the isovalue
    EXPECT_FALSE(castPlainVolume(volume, 25, {{6, 2, 2}, {-1, 0, 0}, 6.5}).hit());
    EXPECT_FALSE(castPlainVolume(volume, 25, {{6, 2, 2}, {1, 0, 0}, 0}).hit());
    EXPECT_FALSE(castPlainVolume(volume, 41, {{0, 2, 2}, {1, 0, 0}, 0}).hit());
    EXPECT_DOUBLE_EQ(castPlainVolume(volume, 40, {{0, 2, 2}, {1, 0, 0}, 0}).t, 4.0);
    EXPECT_FALSE(castPlainVolume(volume, 25, {{0.5, 2, 2}, {0, 0, 0}, 0}).hit());
}

TEST(PlainVolumeCaster, RaysThroughCornersAndAlongEdgesAreNotLost) {
    const GreyVolume volume =
        greyVolume(VolumeFrame{{6, 6, 6}}, [](const glm::dvec3& v) { return v.x + v.y + v.z; });
    const double root3 = std::sqrt(3.0);
    for (const double sign : {1.0, -1.0}) {
        const glm::dvec3 eye = sign > 0 ? glm::dvec3(-1.0) : glm::dvec3(6.0);
        const PlainHit diagonal = castPlainVolume(volume, sign > 0 ? 7.5 : 0.0, {eye, glm::dvec3(sign), 0});
        ASSERT_TRUE(diagonal.hit());
        EXPECT_NEAR(diagonal.t * root3, (sign > 0 ? 3.5 : 1.0) * root3, 1e-12);
    }
    for (int j = 0; j < 6; ++j)
        for (int k = 0; k < 6; ++k) {
            const PlainHit hit = castPlainVolume(volume, j + k + 2.5, {{-2, j, k}, {1, 0, 0}, 0});
            ASSERT_TRUE(hit.hit()) << j << " " << k;
            EXPECT_DOUBLE_EQ(hit.t, 4.5) << j << " " << k;
        }
}

TEST(PlainVolumeCaster, ATouchingRayHits) {
    // x + y - 2 x y rises to a half in the middle of the diagonal and falls again.
    const GreyVolume volume = greyVolume(
        VolumeFrame{{2, 2, 2}}, [](const glm::dvec3& v) { return 100 * (v.x + v.y - 2 * v.x * v.y); });
    const PlainRay ray{{-1, -1, 0.5}, {1, 1, 0}, 0};
    EXPECT_NEAR(castPlainVolume(volume, 50, ray).t, 1.5, 1e-6);
    EXPECT_NEAR(castPlainVolume(volume, 48, ray).t, 1.4, 1e-12);  // 2 s - 2 s^2 = 0.48
    EXPECT_FALSE(castPlainVolume(volume, 50.001, ray).hit());
}

TEST(PlainVolumeCaster, FlatVolumesHaveNoCells) {
    const GreyVolume volume = greyVolume(VolumeFrame{{5, 1, 5}}, [](const glm::dvec3&) { return 100; });
    EXPECT_FALSE(castPlainVolume(volume, 50, {{2, -1, 2}, {0, 1, 0}, 0}).hit());
    EXPECT_FALSE(castPlainVolume(GreyVolume(), 50, {{2, -1, 2}, {0, 1, 0}, 0}).hit());
}

VolumeLook evenLight() {
    VolumeLook look;
    look.ambient = 1;
    look.diffuse = look.specular = look.falloff = 0;
    return look;
}

TEST(PlainVolumeCaster, CompositesAnEvenFogAsTheExponentialLawSays) {
    VolumeFrame frame{{41, 9, 9}};
    frame.spacing = glm::dvec3(0.001);
    const GreyVolume volume = greyVolume(frame, [](const glm::dvec3&) { return 7; });
    VolumeLook look = evenLight();
    look.transfer = TransferFunction({{0, {0.2f, 0.4f, 0.8f}, 0.05}}, 0.002, "test");
    const PlainRay ray{{-0.01, 0.004, 0.004}, {2, 0, 0}, 0};
    // Samples at multiples of half a voxel from 0 to 40 voxels: 81 of them.
    const PlainComposite result = compositePlain(volume, look, ray, {0, 0, 0}, 0.5);
    EXPECT_EQ(result.samples, 81);
    EXPECT_NEAR(result.left, std::pow(0.95, 81 * 0.25), 1e-6);
    EXPECT_NEAR(result.firstDepth, 0.005, 1e-12);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(result.color[c], look.transfer.points()[0].color[c] * (1 - result.left), 1e-6);
}

TEST(PlainVolumeCaster, CompositesNearlyTheSameWithFinerSteps) {
    const GreyVolume volume = greyVolume(slantedFrame({16, 16, 16}), [](const glm::dvec3& v) {
        return 40 * glm::length(v - glm::dvec3(7.5));
    });
    VolumeLook look;
    look.falloff = 0;
    look.transfer = TransferFunction({{100, {1, 0.5f, 0.2f}, 0}, {200, {0.2f, 0.5f, 1}, 0.6}}, 0.005, "test");
    const glm::dvec3 eye = volume.frame.worldFromVoxel(glm::dvec3(7.5));
    Random random(5);
    for (int n = 0; n < 50; ++n) {
        const PlainRay ray{eye, random.direction(), 0};
        const PlainComposite coarse = compositePlain(volume, look, ray, eye, 0.5);
        const PlainComposite fine = compositePlain(volume, look, ray, eye, 0.02);
        EXPECT_LT(fine.left, 0.8) << n;
        EXPECT_NEAR(coarse.left, fine.left, 0.03) << n;
        EXPECT_LT(glm::length(coarse.color - fine.color), 0.03) << n;
    }
}

TEST(PlainVolumeCaster, StopsWhereNothingIsLeft) {
    const GreyVolume volume = greyVolume(VolumeFrame{{30, 4, 4}}, [](const glm::dvec3&) { return 7; });
    VolumeLook look = evenLight();
    look.transfer = TransferFunction({{0, glm::vec3(1.0f), 0.5}}, 1.0, "test");
    const PlainComposite result = compositePlain(volume, look, {{0, 1, 1}, {1, 0, 0}, 0}, {0, 1, 1}, 1.0);
    EXPECT_EQ(result.samples, 11);  // 2^-10 is not less than 1/1024
    EXPECT_LT(result.left, 1.0 / 1024);
    const TransferFunction clear({{0, glm::vec3(1.0f), 0}}, 1.0, "test");
    look.transfer = clear;
    const PlainComposite nothing = compositePlain(volume, look, {{0, 1, 1}, {1, 0, 0}, 0}, {0, 1, 1}, 1.0);
    EXPECT_EQ(nothing.left, 1.0);
    EXPECT_FALSE(std::isfinite(nothing.firstDepth));
}

TEST(PlainVolumeCaster, ShadesAsBlinnAndPhongSay) {
    VolumeLook look;
    look.ambient = 0.1f, look.diffuse = 0.8f, look.specular = 0.5f, look.shininess = 2, look.falloff = 2;
    const glm::dvec3 albedo(0.5, 0.25, 1.0), up(0, 0, 1), origin(0.0);
    // Straight above at the distance where half the light is left.
    const glm::dvec3 above = shadePlain(look, origin, up, {0, 0, 2}, {0, 0, 2}, albedo);
    EXPECT_LT(glm::length(above - 0.5 * (albedo * 0.9 + 0.5)), 1e-7);
    // Lamp at 60 degrees, eye mirrored: n.l is a half, n.h is 1.
    const double s = std::sqrt(3.0);
    const glm::dvec3 mirrored = shadePlain(look, origin, up, {s, 0, 1}, {-s, 0, 1}, albedo);
    EXPECT_LT(glm::length(mirrored - 0.5 * (albedo * 0.5 + 0.5)), 1e-7);
    // From behind: ambient alone.
    const glm::dvec3 behind = shadePlain(look, origin, up, {0, 0, -2}, {0, 0, -2}, albedo);
    EXPECT_LT(glm::length(behind - 0.5 * albedo * 0.1), 1e-7);
    look.falloff = 0;
    const glm::dvec3 far = shadePlain(look, origin, up, {0, 0, 1e6}, {0, 0, 1e6}, albedo);
    EXPECT_LT(glm::length(far - (albedo * 0.9 + 0.5)), 1e-7);
    const glm::dvec3 atLamp = shadePlain(look, origin, up, origin, origin, albedo);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(atLamp[c], albedo[c] * 0.1, 1e-7);
}

TEST(PlainVolumeCaster, NormalsPointTowardsSmallerValues) {
    const GreyVolume volume = greyVolume(slantedFrame({24, 24, 20}), [](const glm::dvec3& v) {
        return 900 * glm::length((v - glm::dvec3(11.5, 11.5, 9.5)) * glm::dvec3(0.8, 0.7, 1.1)) / 8;
    });
    Random random(8);
    for (int n = 0; n < 300; ++n) {
        const glm::dvec3 out = random.direction();  // in the volume's axes, millimetres
        const glm::dvec3 voxel =
            glm::dvec3(11.5, 11.5, 9.5) + out * random.between(3, 6) / glm::dvec3(0.8, 0.7, 1.1);
        const glm::dvec3 expected = -(volume.frame.axes * out);
        EXPECT_GT(glm::dot(plainNormal(volume, voxel), expected), std::cos(0.04)) << n;
    }
}

}  // namespace
}  // namespace stereonav
