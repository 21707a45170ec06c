// Meshes as scenes: closed forms, the pixels of a picture against single rays, what is beyond an edge, and
// sizes from the smallest to the largest.
#include "engine/mesh/mesh_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "engine/camera/stereo_rig.h"
#include "engine/stereo/right_eye.h"
#include "tests/support/whole_progress.h"

namespace stereonav {
namespace {

using Vertex = TriangleMesh::Vertex;

Vertex cornerAt(const glm::dvec3& position) {
    return {position, glm::vec3(0), glm::vec3(1), glm::vec2(0)};
}

// A box's six sides, white.
TriangleMesh boxMesh(const glm::dvec3& low, const glm::dvec3& high) {
    TriangleMesh mesh;
    mesh.materials.emplace_back();
    for (int k = 0; k < 8; ++k)
        mesh.vertices.push_back(
            cornerAt({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z}));
    const std::uint32_t corners[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 4, 6}, {0, 6, 2},
                                          {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}};
    for (const auto& c : corners) mesh.triangles.push_back({{c[0], c[1], c[2]}, 0});
    return mesh;
}

// Triangles here and there around the origin.
TriangleMesh crowd(int count) {
    TriangleMesh mesh;
    mesh.materials.emplace_back();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1, 1), side(-0.2, 0.2);
    for (int n = 0; n < count; ++n) {
        const glm::dvec3 middle(place(random), place(random), place(random));
        for (int k = 0; k < 3; ++k)
            mesh.vertices.push_back(cornerAt(middle + glm::dvec3(side(random), side(random), side(random))));
        const auto first = static_cast<std::uint32_t>(3 * n);
        mesh.triangles.push_back({{first, first + 1, first + 2}, 0});
    }
    return mesh;
}

EyeView viewFrom(const glm::dvec3& eye, int width, int height, double nearDepth) {
    EyeView view;  // northwards, z up
    view.eye = view.head = eye;
    view.right = {1, 0, 0}, view.forward = {0, 1, 0}, view.up = {0, 0, 1};
    view.yMax = 0.5, view.yMin = -0.5;
    view.xMax = 0.5 * width / height, view.xMin = -view.xMax;
    view.width = width, view.height = height, view.nearDepth = nearDepth;
    return view;
}

EyeImage imageOf(const MeshRenderer& renderer, const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height);
    renderEye(renderer, view, image);
    return image;
}

// Returns where the ray through a pixel enters a box, as a view depth; infinite where it misses it.
double slabDepth(const EyeView& view, int x, int y, const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 direction = view.rayDirection(x + 0.5, y + 0.5);
    double from = -std::numeric_limits<double>::infinity(), to = -from;
    for (int c = 0; c < 3; ++c) {
        const double a = (low[c] - view.eye[c]) / direction[c], b = (high[c] - view.eye[c]) / direction[c];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from < to && from > view.nearDepth ? from : std::numeric_limits<double>::infinity();
}

TEST(MeshRenderer, ABoxIsSeenWhereTheSlabsSayAtAnySizeAndPlace) {
    for (const double size : {1e-6, 1e-3, 1.0, 1e4, 1e7})
        for (const double away : {0.0, 1e5}) {
            SCOPED_TRACE(testing::Message() << "size " << size << ", " << away << " sizes from the origin");
            const glm::dvec3 middle(away * size, -0.3 * away * size, 0);
            const glm::dvec3 low = middle - size * glm::dvec3(0.5, 0.4, 0.3),
                             high = middle + size * glm::dvec3(0.5, 0.4, 0.3);
            const MeshRenderer renderer(MeshCaster(boxMesh(low, high), "box"));
            const EyeView view = viewFrom(middle + size * glm::dvec3(0.11, -3, 0.23), 61, 43, 1e-3 * size);
            const EyeImage image = imageOf(renderer, view);
            int hits = 0, edges = 0;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const double expected = slabDepth(view, x, y, low, high);
                    const double depth = image.viewDepth.at(x, y);
                    if (std::isfinite(expected) != std::isfinite(depth)) {
                        ++edges;  // a ray along an edge may go either way, positions being floats
                        continue;
                    }
                    if (!std::isfinite(expected)) {
                        EXPECT_EQ(image.color.at(x, y),
                                  packColor(meshBackground(view.rayDirection(x + 0.5, y + 0.5))));
                        continue;
                    }
                    ++hits;
                    EXPECT_NEAR(depth, expected, 1e-6 * expected) << x << ", " << y;
                }
            EXPECT_GT(hits, 150);
            EXPECT_LE(edges, 2);
        }
}

TEST(MeshRenderer, SinglePixelsAreThoseOfThePicture) {
    const MeshRenderer renderer(MeshCaster(crowd(400), "crowd"));
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {33, 31}, {64, 5}, {5, 64}}) {
        const EyeView view = viewFrom({0.1, -3, 0.2}, size.x, size.y, 0.01);
        const EyeImage whole = imageOf(renderer, view);
        EyeImage single;
        single.resize(size.x, size.y);
        const PixelRect bounds{0, 0, size.x, size.y};
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const PixelIndex pixel{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
                renderer.renderPixels(view, bounds, {&pixel, 1}, single);
                EXPECT_EQ(single.color.at(x, y), whole.color.at(x, y)) << x << ", " << y;
                EXPECT_EQ(single.viewDepth.at(x, y), whole.viewDepth.at(x, y)) << x << ", " << y;
            }
    }
}

TEST(MeshRenderer, WhatMayBeBeyondAnEdgeIsNeverDenied) {
    const MeshRenderer renderer(MeshCaster(crowd(60), "crowd"));
    int denied = 0, hit = 0;
    for (const double distance : {0.0, 2.0, 6.0}) {
        const EyeView view = viewFrom({0.1, -distance, 0.2}, 48, 36, 0.01);
        const EyeImage image = imageOf(renderer, view);
        for (int x = 0; x < view.width; x += 6)
            for (int y = 0; y < view.height; y += 6) {
                const PixelRect rect{x, y, x + 6, y + 6};
                for (const double column : {x + 2.0, x + 9.0, 48.0})
                    for (const double scale : {0.5, 5.0, 80.0}) {
                        bool any = false;
                        for (int v = rect.y0; v < rect.y1; ++v)
                            for (int u = rect.x0; u < rect.x1; ++u) {
                                const double last = u + 1 < column ? scale / (column - (u + 1)) : kMissDepth;
                                any = any || image.viewDepth.at(u, v) < last;
                            }
                        const bool may = renderer.mayHitBeyondEdge(view, rect, column, scale);
                        EXPECT_TRUE(may || !any) << x << ", " << y << ", " << column << ", " << scale;
                        denied += !may, hit += any;
                    }
            }
    }
    EXPECT_GT(denied, 50);
    EXPECT_GT(hit, 50);
}

TEST(MeshRenderer, TheSunLightsWhatFacesIt) {
    MeshRenderer renderer(MeshCaster(boxMesh({-1, -1, -1}, {1, 1, 1}), "box"));
    const EyeView view = viewFrom({0, -4, 0}, 9, 9, 0.01);
    renderer.setLight({{0, -1, 0}, 0.25f});  // from behind the viewer
    EXPECT_EQ(imageOf(renderer, view).color.at(4, 4), packColor(glm::vec3(1.0f)));
    renderer.setLight({{0, 1, 0}, 0.25f});  // from beyond: what is seen lies in shadow
    EXPECT_EQ(imageOf(renderer, view).color.at(4, 4), packColor(glm::vec3(0.25f)));
    renderer.setLight({{0, 0, 1}, 0.25f});
    EXPECT_EQ(imageOf(renderer, view).color.at(4, 4), packColor(glm::vec3(0.25f)));
    renderer.setLight({{0, 0, 1}, 0.25f, 1.0});  // wrapped around: half of it at a right angle
    EXPECT_EQ(imageOf(renderer, view).color.at(4, 4), packColor(glm::vec3(0.25f + 0.75f / 2)));
    renderer.setLight({{0, 1, 0}, 0.25f, 1.0});
    EXPECT_EQ(imageOf(renderer, view).color.at(4, 4), packColor(glm::vec3(0.25f)));
}

// A sheet without thickness has two sides, each lit where it faces the sun: whichever way its triangles go
// round, and its normals point.
TEST(MeshRenderer, ASheetIsLitOnTheSideThatFacesTheSun) {
    for (const bool reversed : {false, true})
        for (const double normal : {0.0, 1.0, -1.0}) {
            TriangleMesh mesh;
            mesh.materials.emplace_back();
            for (const auto& [x, z] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                mesh.vertices.push_back(cornerAt({x, 0, z}));
                mesh.vertices.back().normal = glm::vec3(0, normal, 0);
            }
            mesh.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
            if (reversed) mesh.triangles = {{{2, 1, 0}, 0}, {{3, 2, 0}, 0}};
            MeshRenderer renderer(MeshCaster(mesh, "sheet"));
            for (const double sun : {-1.0, 1.0}) {
                renderer.setLight({glm::normalize(glm::dvec3(0, sun, 0.75)), 0.25f});
                for (const double from : {-1.0, 1.0}) {
                    SCOPED_TRACE(testing::Message()
                                 << reversed << " normal " << normal << " sun " << sun << " seen " << from);
                    EyeView view = viewFrom({0, 4 * from, 0}, 9, 9, 0.01);
                    view.forward = {0, -from, 0}, view.right = {-from, 0, 0};
                    const EyeImage image = imageOf(renderer, view);
                    EXPECT_NEAR(image.viewDepth.at(4, 4), 4, 1e-6);
                    EXPECT_EQ(image.color.at(4, 4),
                              packColor(glm::vec3(from == sun ? 0.25f + 0.75f * 0.8f : 0.25f)));
                }
            }
        }
}

TEST(MeshRenderer, BuildingItsTreeEndsWhenItIsCancelled) {
    Progress cancelled;
    cancelled.cancel();
    EXPECT_THROW(MeshCaster(crowd(20000), "crowd", cancelled), Cancelled);
    for (const int count : {1, 20000})
        test::expectWholeProgress("sorting " + std::to_string(count) + " triangles", 0,
                                  [&](Progress& progress) { MeshCaster(crowd(count), "crowd", progress); });
}

// Flat in one direction, in two, in all three: triangles without area are never hit, and harm nothing.
TEST(MeshRenderer, FlatMeshesAreSeenAndPointsAreNot) {
    const EyeView view = viewFrom({0, -4, 0.5}, 16, 16, 0.01);
    TriangleMesh wall = boxMesh({-1, 0, -1}, {1, 0, 1});
    EXPECT_NEAR(imageOf(MeshRenderer(MeshCaster(wall, "wall")), view).viewDepth.at(8, 8), 4, 1e-6);
    for (const glm::dvec3& end : {glm::dvec3(0, 0, 1), glm::dvec3(0)}) {
        const EyeImage image = imageOf(MeshRenderer(MeshCaster(boxMesh(glm::dvec3(0), end), "line")), view);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) EXPECT_FALSE(std::isnan(image.viewDepth.at(x, y)));
    }
}

TEST(MeshRenderer, NothingNearerThanTheNearDepthIsSeen) {
    const MeshRenderer renderer(MeshCaster(boxMesh({-1, -1, -1}, {1, 1, 1}), "box"));
    EXPECT_NEAR(imageOf(renderer, viewFrom({0, -4, 0}, 5, 5, 2.9)).viewDepth.at(2, 2), 3, 1e-6);
    EXPECT_NEAR(imageOf(renderer, viewFrom({0, -4, 0}, 5, 5, 3.1)).viewDepth.at(2, 2), 5, 1e-6);
    EXPECT_EQ(imageOf(renderer, viewFrom({0, -4, 0}, 5, 5, 5.1)).viewDepth.at(2, 2), kMissDepth);
}

// The right eye, warped from the left, against one that is cast.
TEST(MeshRenderer, TheWarpedEyeIsTheCastOneButForResampling) {
    const MeshRenderer renderer(MeshCaster(crowd(400), "crowd"));
    Lens lens;
    lens.width = 320, lens.height = 240;
    lens.nearDepth = 0.01;
    const StereoViews views = makeStereoViews(poseFromAngles({0, -4, 0}, 0, 0, 0), lens, {0.1, 4.0});
    EyeImage left, right, cast;
    left.resize(320, 240), cast.resize(320, 240);
    renderEye(renderer, views.left, left);
    renderEye(renderer, views.right, cast);
    WarpSetting warp;
    warp.method = RightEyeMethod::Linear;
    RightEye().render(renderer, views, left, warp, right);
    int different = 0, depths = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
            different += right.color.at(x, y) != cast.color.at(x, y);
            const double a = right.viewDepth.at(x, y), b = cast.viewDepth.at(x, y);
            depths +=
                std::isfinite(a) != std::isfinite(b) || (std::isfinite(a) && std::abs(a - b) > 0.02 * b);
        }
    EXPECT_LT(depths, 320 * 240 / 50);  // along silhouettes
    EXPECT_LT(different, 320 * 240 * 3 / 10);
}

}  // namespace
}  // namespace stereonav
