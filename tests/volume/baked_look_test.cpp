// Baked light as the ray caster shows it, and hard shadows: packets against the scalar lookups and the plain
// caster, one pixel at a time.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/camera/stereo_rig.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/plain_volume_caster.h"
#include "engine/volume/volume_renderer.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

using namespace test;
using Lookup = IlluminationVolume::Lookup;

// Two balls of 4 and 2.5 voxels; the small one to the left of the large one.
VolumeScene balls() {
    VolumeFrame frame = slantedFrame({26, 22, 24}, {0.8e-3, 0.7e-3, 0.9e-3});
    VolumeScene scene;
    scene.field = greyVolume(frame, [](const glm::dvec3& v) {
        const double large = 4 - glm::length(v - glm::dvec3(15, 11, 12));
        const double small = 2.5 - glm::length(v - glm::dvec3(6, 11, 12));
        return 100 * std::max(large, small);
    });
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = 0;
    Progress progress;
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    scene.look.surface = {0.9f, 0.5f, 0.25f};
    return scene;
}

std::shared_ptr<IlluminationVolume> randomLight(const VolumeFrame& volume, double perVoxel, double unknown) {
    auto light = std::make_shared<IlluminationVolume>(texelFrame(volume, perVoxel));
    Random random(7);
    const glm::ivec3 size = light->frame.size;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const glm::vec3 value(random.inBox(glm::dvec3(0.05), glm::dvec3(0.9)));
                const float weight = random.between(0, 1) < unknown ? 0.0f : 1.0f;
                const float part = random.between(0, 1) < 0.2 ? 0.25f : 1.0f;
                light->texels[light->layout.index(i, j, k)] = packTexel(value, weight * part);
            }
    return light;
}

EyeView viewOf(const VolumeFrame& frame, const glm::dvec3& voxel) {
    Pose pose;
    pose.position = frame.worldFromVoxel(voxel);
    const glm::dvec3 forward = glm::normalize(frame.worldFromVoxel({12, 11, 12}) - pose.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1)));
    pose.orientation = glm::quat_cast(glm::dmat3(right, glm::cross(right, forward), -forward));
    Lens lens;
    lens.width = 61;
    lens.height = 47;
    lens.verticalFov = 0.6;
    lens.nearDepth = 1e-4;
    return makeEyeView(pose, lens);
}

EyeImage castBaked(const VolumeRenderer& renderer, const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, image);
    return image;
}

TEST(BakedLook, packetsLookUpAsTheScalarDoes) {
    for (const double perVoxel : {0.5, 1.0, 2.0})
        for (const Lookup lookup :
             {Lookup::Trilinear, Lookup::Nearest, Lookup::NearestIsovalue, Lookup::Tricubic}) {
            VolumeScene scene = balls();
            scene.look.baked.light = randomLight(scene.field.frame, perVoxel, 0.3);
            scene.look.baked.lookup = lookup;
            const EyeView view = viewOf(scene.field.frame, {12, -18, 14});
            for (const SimdTarget target : simdTargets()) {
                const VolumeRenderer renderer(scene, {target});
                EXPECT_EQ(renderer.viewDependence(),
                          lookup == Lookup::Trilinear ? ViewDependence::Normal : ViewDependence::None);
                const EyeImage image = castBaked(renderer, view);
                int hits = 0;
                for (int y = 0; y < view.height; ++y)
                    for (int x = 0; x < view.width; ++x) {
                        const double depth = image.viewDepth.at(x, y);
                        if (!(depth < kMissDepth)) continue;
                        const glm::dvec3 world = view.eye + depth * view.rayDirection(x + 0.5, y + 0.5);
                        const IlluminationVolume& light = *scene.look.baked.light;
                        const auto found = lookup == Lookup::NearestIsovalue
                                               ? light.nearestIsovalue(world, scene.field, 0)
                                               : light.at(world, lookup);
                        if (!(found.weight > 1e-3)) continue;
                        ++hits;
                        ASSERT_LE(channelDifference(image.color.at(x, y),
                                                    packColor(scene.look.surface * found.value)),
                                  lookup == Lookup::Trilinear ? 2 : 1)
                            << perVoxel << " " << x << " " << y;
                    }
                EXPECT_GT(hits, 300);
            }
        }
}

TEST(BakedLook, rowsLookUpAgainWhatWasCast) {
    VolumeScene scene = balls();
    scene.look.baked.light = randomLight(scene.field.frame, 1, 0.3);
    const EyeView view = viewOf(scene.field.frame, {12, -18, 14});
    for (const SimdTarget target : simdTargets()) {
        const VolumeRenderer renderer(scene, {target});
        EyeImage image = castBaked(renderer, view);
        const Plane<PackedColor> wanted = image.color;
        for (int y = 0; y < view.height; ++y) {
            std::fill_n(image.color.row(y), view.width, PackedColor{0});
            renderer.shadeAgain(view, y, 0, view.width, image);
            for (int x = 0; x < view.width; ++x)
                ASSERT_LE(channelDifference(image.color.at(x, y), wanted.at(x, y)), 4) << x << " " << y;
        }
    }
}

TEST(BakedLook, whereNothingIsKnownTheLampShows) {
    VolumeScene scene = balls();
    const EyeView view = viewOf(scene.field.frame, {12, -18, 14});
    const EyeImage lamp = castBaked(VolumeRenderer(scene), view);
    scene.look.baked.light = std::make_shared<IlluminationVolume>(texelFrame(scene.field.frame, 1));
    const EyeImage unknown = castBaked(VolumeRenderer(scene), view);
    scene.look.baked.light = randomLight(scene.field.frame, 1, 0);
    scene.look.baked.use = BakedLook::Use::Openness;
    const EyeImage open = castBaked(VolumeRenderer(scene), view);
    int darker = 0, hits = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            ASSERT_EQ(unknown.color.at(x, y), lamp.color.at(x, y));
            if (!(lamp.viewDepth.at(x, y) < kMissDepth)) continue;
            ++hits;
            darker += (open.color.at(x, y) & 1023u) < (lamp.color.at(x, y) & 1023u);
        }
    EXPECT_GT(hits, 300);
    EXPECT_GT(darker, hits * 9 / 10) << "openness is at most 0.9 here";
}

// The small ball stands between the lamp and the large one.
TEST(HardShadow, fallsWhereThePlainCasterMeetsSomething) {
    VolumeScene scene = balls();
    scene.look.falloff = 0;
    scene.look.specular = 0;
    scene.look.ambient = 0;
    for (const glm::dvec3 lampVoxel : {glm::dvec3(-20, 9, 12), glm::dvec3(1.5, 10.2, 11.7)}) {
        scene.look.lampAt = scene.field.frame.worldFromVoxel(lampVoxel);
        const EyeView view = viewOf(scene.field.frame, {4, -18, 14});
        scene.look.shadows = false;
        const EyeImage bright = castBaked(VolumeRenderer(scene), view);
        scene.look.shadows = true;
        for (const SimdTarget target : simdTargets()) {
            const EyeImage shaded = castBaked(VolumeRenderer(scene, {target}), view);
            int shadow = 0, lit = 0;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const double depth = bright.viewDepth.at(x, y);
                    if (!(depth < kMissDepth) || bright.color.at(x, y) == 0) continue;
                    const glm::dvec3 hit = view.eye + depth * view.rayDirection(x + 0.5, y + 0.5);
                    const glm::dvec3 way = hit - *scene.look.lampAt;
                    const PlainHit met = castPlainVolume(scene.field, 0, {*scene.look.lampAt, way, 0});
                    // Within two voxels of the hit, whether it shades itself is a matter of the lift.
                    if (met.t < 1 && met.t > 1 - 1.6e-3 / glm::length(way)) continue;
                    const bool dark = met.t < 1;
                    ++(dark ? shadow : lit);
                    ASSERT_EQ(shaded.color.at(x, y), dark ? 0u : bright.color.at(x, y)) << x << " " << y;
                }
            EXPECT_GT(shadow, 20);
            EXPECT_GT(lit, 30);
        }
    }
}

TEST(Fog, leavesOneOverEAtItsDistance) {
    VolumeScene scene = balls();
    scene.look.background = {0.0f, 0.0f, 1.0f};
    const EyeView view = viewOf(scene.field.frame, {12, -18, 14});
    const EyeImage clear = castBaked(VolumeRenderer(scene), view);
    scene.look.fog = 0.012f;
    const EyeImage fog = castBaked(VolumeRenderer(scene), view);
    int hits = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double depth = clear.viewDepth.at(x, y);
            if (!(depth < kMissDepth)) continue;
            ++hits;
            const double way = depth * glm::length(view.rayDirection(x + 0.5, y + 0.5));
            const glm::vec3 expected = glm::mix(scene.look.background, unpackColor(clear.color.at(x, y)),
                                                static_cast<float>(std::exp(-way / 0.012)));
            ASSERT_LE(channelDifference(fog.color.at(x, y), packColor(expected)), 2) << x << " " << y;
        }
    EXPECT_GT(hits, 300);
}

}  // namespace
}  // namespace stereonav
