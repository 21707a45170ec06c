// Flesh thinner than a voxel, as masks have it: the side that a ray meets is the one that is lit, whatever
// the smoothed gradient in the middle of the flesh is. By the plain caster and by each instruction set.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/volume/volume_renderer.h"
#include "tests/oracle/plain_composite.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

constexpr double kThinWall = -500;  // the isovalue
constexpr int kThinMiddle = 10;

// A sheet of one voxel across an axis, as smoothing leaves one of a mask: hardly above the wall's value.
// Beside it values go up and down by `uneven`, so that smoothed gradients in its middle lead to either side.
GreyVolume thinSheet(const VolumeFrame& frame, int axis, double uneven, unsigned seed = 1) {
    test::Random random(seed);
    return test::greyVolume(frame, [&](const glm::dvec3& v) {
        const double off = std::abs(v[axis] - kThinMiddle), by = uneven * random.between(-1, 1);
        return off == 0 ? -490 : off == 1 ? -725 + by : -950.0;
    });
}

glm::dvec3 outOf(const VolumeFrame& frame, int axis, int side) {
    glm::dvec3 way(0.0);
    way[axis] = side;
    return frame.axes * way;
}

TEST(ThinSheet, HasTheNormalOfTheSideThatARayMeets) {
    for (const VolumeFrame& frame :
         {test::slantedFrame({21, 21, 21}), test::slantedFrame({21, 21, 21}, {1e-3, 1e-3, 1e-3})})
        for (const int axis : {0, 1, 2})
            for (const double uneven : {0.0, 3.0, 60.0}) {
                const GreyVolume sheet = thinSheet(frame, axis, uneven);
                test::Random random(7);
                for (int n = 0; n < 200; ++n) {
                    const int side = n % 2 ? 1 : -1;
                    glm::dvec3 from = random.inBox(glm::dvec3(6), glm::dvec3(14)),
                               to = from + random.inBox(glm::dvec3(-3), glm::dvec3(3));
                    from[axis] = kThinMiddle + 6 * side, to[axis] = kThinMiddle;
                    const glm::dvec3 eye = frame.worldFromVoxel(from), way = frame.worldFromVoxel(to) - eye;
                    const PlainHit hit = castPlainVolume(sheet, kThinWall, {eye, way, 0});
                    ASSERT_TRUE(hit.hit());
                    const double facing = glm::dot(plainNormal(sheet, hit.voxel()), outOf(frame, axis, side));
                    EXPECT_GT(facing, uneven == 0   ? 0.9999
                                      : uneven < 10 ? 0.99
                                                    : 0.9)
                        << axis << " " << uneven;
                }
            }
}

// A lumen of one voxel between two such sheets: nowhere is there a smoothed gradient.
TEST(ThinSheet, HasANormalBesideANarrowGap) {
    const VolumeFrame frame = test::slantedFrame({21, 21, 21});
    for (const int axis : {0, 1, 2}) {
        const GreyVolume sheets =
            test::greyVolume(frame, [&](const glm::dvec3& v) { return int(v[axis]) % 2 ? -510.0 : -490.0; });
        for (const int side : {-1, 1}) {
            glm::dvec3 from(10.3, 9.6, 10.2), to = from;
            from[axis] = kThinMiddle + side, to[axis] = kThinMiddle;
            const glm::dvec3 eye = frame.worldFromVoxel(from), way = frame.worldFromVoxel(to) - eye;
            const PlainHit hit = castPlainVolume(sheets, kThinWall, {eye, way, 0});
            ASSERT_TRUE(hit.hit());
            EXPECT_GT(glm::dot(plainNormal(sheets, hit.voxel()), outOf(frame, axis, side)), 0.999);
        }
    }
}

// Across z, around the world's origin.
VolumeScene thinScene(int axis, double uneven, std::uint32_t denseFrom) {
    VolumeFrame frame;
    frame.size = glm::ivec3(21);
    frame.spacing = {0.9e-3, 1e-3, 1.1e-3};
    frame.origin = -10.0 * frame.spacing;
    VolumeScene scene;
    scene.field = thinSheet(frame, axis, uneven);
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = kThinWall;
    setting.denseFrom = denseFrom;
    Progress progress;
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    scene.look.ambient = 0.05f;
    scene.look.specular = 0.2f;
    return scene;
}

EyeView thinView(int axis, int side) {
    EyeView view;
    glm::dvec3 ahead(0.0), up(0.0);
    ahead[axis] = -side, up[(axis + 1) % 3] = 1;
    view.eye = view.head = -0.007 * ahead + 0.0007 * up;
    view.forward = ahead, view.up = up, view.right = glm::cross(ahead, up);
    view.width = view.height = 24;
    view.xMin = view.yMin = -0.4, view.xMax = view.yMax = 0.4;
    view.nearDepth = 1e-4;
    return view;
}

// A level sheet is lit as one whose normal is known; an uneven one has no dark spots on either side.
TEST(ThinSheet, IsLitAsItsSideIsByEachInstructionSet) {
    for (const int axis : {0, 1, 2})
        for (const double uneven : {0.0, 30.0})
            for (const std::uint32_t denseFrom : {1u, SurfaceSetting::kNeverDense}) {
                const VolumeScene scene = thinScene(axis, uneven, denseFrom);
                for (const SimdTarget target : simdTargets())
                    for (const int side : {-1, 1}) {
                        SCOPED_TRACE(testing::Message()
                                     << nameOf(target) << " " << axis << " " << uneven << " " << side);
                        const VolumeRenderer renderer(scene, {target});
                        const EyeView view = thinView(axis, side);
                        EyeImage image;
                        image.resize(24, 24, renderer.viewDependence());
                        renderEye(renderer, view, image);
                        for (int y = 0; y < 24; ++y)
                            for (int x = 0; x < 24; ++x) {
                                const double t = image.viewDepth.at(x, y);
                                ASSERT_LT(t, kMissDepth);
                                const glm::dvec3 world = view.pointAt(x + 0.5, y + 0.5, t);
                                const auto lit = [&](const glm::dvec3& normal) {
                                    return packColor(
                                        glm::vec3(shadePlain(scene.look, world, normal, view.head, view.eye,
                                                             glm::dvec3(scene.look.surface))));
                                };
                                const PackedColor level = lit(outOf(scene.field.frame, axis, side));
                                ASSERT_LE(test::channelDifference(image.color.at(x, y), level),
                                          uneven == 0 ? 6 : 250)
                                    << x << " " << y;
                                const PackedColor plain =
                                    lit(plainNormal(scene.field, scene.field.frame.voxelFromWorld(world)));
                                ASSERT_LE(test::channelDifference(image.color.at(x, y), plain), 12)
                                    << x << " " << y;
                            }
                    }
            }
}

// The same where it is shown as a medium of samples.
TEST(ThinSheet, IsLitOnTheEyesSideWhereItIsTranslucent) {
    VolumeScene scene = thinScene(2, 30, SurfaceSetting::kNeverDense);
    SurfaceSetting setting;
    setting.isovalue = kThinWall, setting.lowest = -720, setting.highest = 32767;
    Progress progress;
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    scene.look.transfer =
        TransferFunction({{-720, {0.8f, 0.6f, 0.5f}, 0}, {-600, {0.8f, 0.6f, 0.5f}, 0.9}}, 1e-4, "test");
    for (const SimdTarget target : simdTargets())
        for (const int side : {-1, 1}) {
            const VolumeRenderer renderer(scene, {target});
            const EyeView view = thinView(2, side);
            EyeImage image;
            image.resize(24, 24, renderer.viewDependence());
            renderEye(renderer, view, image);
            for (int y = 0; y < 24; y += 3)
                for (int x = 0; x < 24; x += 3) {
                    const PlainComposite plain = compositePlain(
                        scene.field, scene.look,
                        {view.eye, view.rayDirection(x + 0.5, y + 0.5), view.nearDepth}, view.head, 0.5);
                    EXPECT_LT(plain.left, 0.02);
                    // The albedo in red is 0.8, under a lamp that is almost above it.
                    EXPECT_GT(unpackColor(image.color.at(x, y)).x, 0.35f) << nameOf(target) << side;
                }
        }
}

}  // namespace
}  // namespace stereonav
