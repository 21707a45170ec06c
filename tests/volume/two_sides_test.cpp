// Sheets in a volume from both sides: as far away, as bright and as opaque from behind as from before, with
// normals that face away from each other. By the plain caster and by each instruction set.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/volume/volume_renderer.h"
#include "tests/oracle/plain_composite.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

constexpr int kSheetAcross = 24, kSheetDeep = 31, kPicture = 32;
constexpr double kSheetSpacing = 0.001, kFrom = 0.03;

VolumeFrame sheetFrame() {
    VolumeFrame frame;
    frame.size = {kSheetAcross, kSheetAcross, kSheetDeep};
    frame.spacing = glm::dvec3(kSheetSpacing);
    frame.origin = -0.5 * glm::dvec3(frame.size - 1) * frame.spacing;  // about the world's origin
    return frame;
}

// Across z, the same on both sides of the middle; along x and y it is thicker and thinner.
GreyVolume sheetOf(double wide) {
    return test::greyVolume(sheetFrame(), [&](const glm::dvec3& v) {
        const double off = v.z - 0.5 * (kSheetDeep - 1);
        const double here = wide * (1 + 0.3 * std::sin(0.6 * v.x) * std::cos(0.4 * v.y));
        return 1000 * std::exp(-off * off / (2 * here * here));
    });
}

VolumeScene sceneOfSheet(double wide, double lowest, double highest) {
    VolumeScene scene;
    SurfaceSetting setting;
    setting.isovalue = 500;
    setting.lowest = static_cast<float>(lowest);
    setting.highest = static_cast<float>(highest);
    Progress progress;
    scene.field = sheetOf(wide);
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    scene.look.specular = 0.4f;
    return scene;
}

// Returns a view from above (1) or below (-1), y upwards: what is seen at column x from above is seen at the
// mirrored one from below.
EyeView sheetView(int side, const glm::dvec2& aside = {0.002, -0.001}) {
    EyeView view;
    view.eye = view.head = {aside.x, aside.y, side * kFrom};
    view.forward = {0, 0, -side}, view.up = {0, 1, 0}, view.right = {side, 0, 0};
    view.width = view.height = kPicture;
    view.xMin = view.yMin = -0.25, view.xMax = view.yMax = 0.25;
    view.nearDepth = 1e-4;
    return view;
}

int columnOf(int x, int side) {
    return side > 0 ? x : kPicture - 1 - x;
}

TEST(SheetOfTwoSides, IsMetAsFarFromEitherSide) {
    for (const double wide : {0.8, 1.0, 2.5}) {
        const GreyVolume sheet = sheetOf(wide);
        for (int y = 0; y < kPicture; y += 3)
            for (int x = 0; x < kPicture; x += 3) {
                PlainHit hits[2];
                glm::dvec3 normals[2];
                for (const int side : {-1, 1}) {
                    const EyeView view = sheetView(side);
                    const PlainRay ray{view.eye, view.rayDirection(columnOf(x, side) + 0.5, y + 0.5), 1e-4};
                    const int n = side > 0;
                    hits[n] = castPlainVolume(sheet, 500, ray);
                    ASSERT_TRUE(hits[n].hit()) << x << " " << y << " from " << side;
                    normals[n] = plainNormal(sheet, hits[n].voxel());
                    EXPECT_LT(glm::dot(normals[n], ray.direction), 0) << "it faces the eye, from " << side;
                }
                EXPECT_NEAR(hits[0].t, hits[1].t, 1e-9);
                EXPECT_LT(hits[0].t + hits[1].t, 2 * kFrom) << "it has a thickness";
                EXPECT_NEAR(normals[0].x, normals[1].x, 1e-9);
                EXPECT_NEAR(normals[0].y, normals[1].y, 1e-9);
                EXPECT_NEAR(normals[0].z, -normals[1].z, 1e-9);
            }
    }
}

TEST(SheetOfTwoSides, LooksAlikeFromEitherSide) {
    for (const double wide : {0.8, 1.0, 2.5}) {
        const VolumeScene scene = sceneOfSheet(wide, 500, 500);
        for (const SimdTarget target : simdTargets()) {
            SCOPED_TRACE(testing::Message() << nameOf(target) << " " << wide);
            const VolumeRenderer renderer(scene, {target});
            EyeImage images[2];
            for (const int side : {-1, 1}) {
                EyeImage& image = images[side > 0];
                image.resize(kPicture, kPicture, renderer.viewDependence());
                renderEye(renderer, sheetView(side), image);
            }
            const PackedColor black = packColor(glm::vec3(0));
            for (int y = 0; y < kPicture; ++y)
                for (int x = 0; x < kPicture; ++x) {
                    const int other = columnOf(x, -1);
                    ASSERT_NEAR(images[1].viewDepth.at(x, y), images[0].viewDepth.at(other, y), 1e-6);
                    ASSERT_LE(test::channelDifference(images[1].color.at(x, y), images[0].color.at(other, y)),
                              4)
                        << x << " " << y;
                    ASSERT_GT(test::channelDifference(images[0].color.at(x, y), black), 60)
                        << "the lamp is on the eye's side";
                }
        }
    }
}

// The lamp stays on one side: from the other one the sheet has its ambient light alone.
TEST(SheetOfTwoSides, IsLitOnTheLampsSideAlone) {
    for (const int lamp : {-1, 1}) {
        VolumeScene scene = sceneOfSheet(1, 500, 500);
        scene.look.lampAt = glm::dvec3(0.002, -0.001, lamp * 0.02);
        scene.look.ambient = 0.1f;
        for (const SimdTarget target : simdTargets()) {
            const VolumeRenderer renderer(scene, {target});
            for (const int side : {-1, 1}) {
                const EyeView view = sheetView(side);
                EyeImage image;
                image.resize(kPicture, kPicture, renderer.viewDependence());
                renderEye(renderer, view, image);
                for (const auto& [x, y] : {std::pair(16, 16), {9, 20}, {22, 11}}) {
                    const double t = image.viewDepth.at(x, y);
                    const glm::dvec3 world = view.pointAt(x + 0.5, y + 0.5, t);
                    // One lamp, and how far it is.
                    const double away = glm::length(*scene.look.lampAt - world) / scene.look.falloff;
                    const glm::vec3 ambient =
                        scene.look.surface * static_cast<float>(0.1 / (1 + away * away));
                    const glm::vec3 seen = unpackColor(image.color.at(x, y));
                    if (side == lamp)
                        EXPECT_GT(seen.x, 3 * ambient.x) << lamp;
                    else
                        EXPECT_NEAR(seen.x, ambient.x, 0.01) << lamp;
                }
            }
        }
    }
}

TEST(SheetOfTwoSides, IsAsOpaqueFromEitherSide) {
    for (const double wide : {0.8, 1.0, 2.5}) {
        VolumeScene scene = sceneOfSheet(wide, 100, 32767);
        scene.look.transfer = TransferFunction(
            {{100, {0.8f, 0.3f, 0.2f}, 0}, {600, {0.2f, 0.6f, 0.4f}, 0.4}, {1000, {0.8f, 0.6f, 0.9f}, 0.5}},
            0.001, "test");
        scene.look.background = glm::vec3(0.3f, 0.2f, 0.6f);
        for (const SimdTarget target : simdTargets()) {
            SCOPED_TRACE(testing::Message() << nameOf(target) << " " << wide);
            const VolumeRenderer renderer(scene, {target});
            EyeImage images[2];
            for (const int side : {-1, 1}) {
                images[side > 0].resize(kPicture, kPicture, renderer.viewDependence());
                renderEye(renderer, sheetView(side), images[side > 0]);
            }
            for (int y = 0; y < kPicture; ++y)
                for (int x = 0; x < kPicture; ++x) {
                    const EyeView above = sheetView(1), below = sheetView(-1);
                    const int other = columnOf(x, -1);
                    const auto plain = [&](const EyeView& view, int column) {
                        return compositePlain(scene.field, scene.look,
                                              {view.eye, view.rayDirection(column + 0.5, y + 0.5), 0.0},
                                              view.head, 0.5);
                    };
                    if (x % 5 == 0 && y % 5 == 0) {
                        const PlainComposite one = plain(above, x), two = plain(below, other);
                        EXPECT_NEAR(one.left, two.left, 1e-6);
                        EXPECT_LT(one.left, 0.99);
                        EXPECT_NEAR(one.color.x, two.color.x, 1e-6);
                        EXPECT_NEAR(one.color.z, two.color.z, 1e-6);
                    }
                    ASSERT_LE(test::channelDifference(images[1].color.at(x, y), images[0].color.at(other, y)),
                              20)  // a sample in the very middle has the normal of one side
                        << x << " " << y;
                }
        }
    }
}

}  // namespace
}  // namespace stereonav
