// The simplified ground: the error bound by brute force, no cracks, no holes covered, and the file.
#include "terrain/mesh/terrain_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <random>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/gltf/gltf_file.h"
#include "engine/image/image_file.h"
#include "terrain/mesh/mesh_triangulation.h"
#include "terrain/scene/terrain_loader.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/own_cache.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Heightfield made(int width, int height, const std::function<double(int, int)>& z) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) heights.push_back(static_cast<float>(z(i, j)));
    return Heightfield(width, height, glm::dvec2(30, 20), heights, "made");
}

Heightfield rough(int width, int height, unsigned seed = 6) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-8, 8);
    return made(width, height, [&](int i, int j) {
        return 1000 + 150 * std::sin(0.11 * i) * std::cos(0.07 * j) + noise(random);
    });
}

TerrainMesh simplified(const Heightfield& ground, double error) {
    Progress progress;
    return simplifyTerrain(ground, error, progress);
}

bool isOpenCell(const Heightfield& ground, int i, int j) {
    return !std::isfinite(ground.sample(i, j) + ground.sample(i + 1, j) + ground.sample(i, j + 1) +
                          ground.sample(i + 1, j + 1));
}

// The largest vertical distance of any sample to the triangles that contain it, with barycentric
// coordinates; -1 when a sample of a closed cell is in no triangle.
double bruteError(const Heightfield& ground, const TerrainMesh& mesh) {
    std::vector<double> error(static_cast<std::size_t>(ground.width()) * ground.height(), -1.0);
    for (const auto& t : mesh.triangles) {
        const glm::dvec2 a(mesh.vertices[t[0]]), b(mesh.vertices[t[1]]), c(mesh.vertices[t[2]]);
        const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        const auto height = [&](int k) {
            return ground.sample(mesh.vertices[t[k]].x, mesh.vertices[t[k]].y);
        };
        const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        for (int j = int(low.y); j <= int(high.y); ++j)
            for (int i = int(low.x); i <= int(high.x); ++i) {
                const glm::dvec2 p(i, j);
                const double u = ((b.x - p.x) * (c.y - p.y) - (c.x - p.x) * (b.y - p.y)) / area;
                const double v = ((c.x - p.x) * (a.y - p.y) - (a.x - p.x) * (c.y - p.y)) / area;
                const double w = 1 - u - v;
                if (u < -1e-12 || v < -1e-12 || w < -1e-12) continue;
                const double z = u * height(0) + v * height(1) + w * height(2);
                double& e = error[static_cast<std::size_t>(j) * ground.width() + i];
                e = std::max(e, std::abs(z - ground.sample(i, j)));
            }
    }
    double worst = 0;
    for (int j = 0; j + 1 < ground.height(); ++j)
        for (int i = 0; i + 1 < ground.width(); ++i)
            for (int k = 0; k < 4 && !isOpenCell(ground, i, j); ++k) {
                const double e = error[static_cast<std::size_t>(j + k / 2) * ground.width() + i + k % 2];
                if (e < 0) return -1;
                worst = std::max(worst, e);
            }
    return worst;
}

double gridArea(const TerrainMesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        const auto area = twiceArea(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
        EXPECT_GT(area, 0) << "triangles run counterclockwise and are not flat";
        sum += 0.5 * static_cast<double>(area);
    }
    return sum;
}

// Each directed edge once; its opposite too, unless both its ends lie on the border of the ground or a hole.
void expectWatertight(const Heightfield& ground, const TerrainMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    const auto closed = [&](int i, int j) {
        return i >= 0 && j >= 0 && i + 1 < ground.width() && j + 1 < ground.height() &&
               !isOpenCell(ground, i, j);
    };
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        if (edges.contains({edge.second, edge.first})) continue;
        const glm::ivec2 a = mesh.vertices[edge.first], b = mesh.vertices[edge.second];
        ASSERT_TRUE(a.x == b.x || a.y == b.y) << "a crack: an edge without partner leads across cells";
        const glm::ivec2 low = glm::min(a, b), high = glm::max(a, b);
        for (int i = low.x; i <= high.x; ++i)
            for (int j = low.y; j <= high.y; ++j) {
                if (a.x == b.x && j == high.y) continue;
                if (a.y == b.y && i == high.x) continue;
                const bool here = closed(i, j), there = a.x == b.x ? closed(i - 1, j) : closed(i, j - 1);
                ASSERT_NE(here, there) << "a crack: ground on both sides at " << i << ' ' << j;
            }
    }
}

TEST(TerrainMesh, ErrorHoldsAtEverySampleOfRoughGround) {
    for (const auto& [w, h] : {std::pair(65, 65), {97, 41}, {2, 70}, {33, 2}, {2, 2}, {3, 3}}) {
        const Heightfield ground = rough(w, h);
        for (const double error : {0.0, 0.5, 3.0, 10.0, 60.0, 1e4}) {
            const TerrainMesh mesh = simplified(ground, error);
            const double brute = bruteError(ground, mesh);
            ASSERT_GE(brute, 0) << "every sample is covered";
            ASSERT_LE(brute, error + 1e-9) << w << 'x' << h << " at " << error;
            ASSERT_NEAR(brute, mesh.maxError, 1e-9) << "the error reported is the one there is";
            ASSERT_EQ(gridArea(mesh), double(w - 1) * (h - 1));
            expectWatertight(ground, mesh);
        }
    }
}

TEST(TerrainMesh, PlanesTakeTwoTrianglesWhateverTheSize) {
    for (const auto& [w, h] : {std::pair(2, 2), {65, 65}, {100, 37}, {5, 900}}) {
        EXPECT_EQ(simplified(made(w, h, [](int, int) { return 12.5; }), 0).triangles.size(), 2u);
        EXPECT_EQ(simplified(made(w, h, [](int i, int j) { return 3000 + 0.25 * i - 0.5 * j; }), 0)
                      .triangles.size(),
                  2u);
    }
}

TEST(TerrainMesh, FewerTrianglesForALargerError) {
    const Heightfield ground = rough(129, 129);
    std::size_t before = 2 * 128 * 128 + 1;
    for (const double error : {0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 64.0, 1e4}) {
        const std::size_t count = simplified(ground, error).triangles.size();
        EXPECT_LT(count, before) << error;
        before = count;
    }
    EXPECT_EQ(before, 2u);
}

// One spike: a mesh that only looked at midpoints, or lost samples on edges, would miss it.
TEST(TerrainMesh, NoSpikeIsLost) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> x(0, 60), y(0, 44);
    for (int k = 0; k < 60; ++k) {
        const glm::ivec2 spike(x(random), y(random));
        const Heightfield ground =
            made(61, 45, [&](int i, int j) { return spike == glm::ivec2(i, j) ? 50.0 : 0.0; });
        const TerrainMesh mesh = simplified(ground, 1);
        ASSERT_LE(bruteError(ground, mesh), 1 + 1e-9);
        ASSERT_TRUE(std::count(mesh.vertices.begin(), mesh.vertices.end(), spike) == 1);
        ASSERT_LT(mesh.triangles.size(), 60u);
        expectWatertight(ground, mesh);
    }
}

TEST(TerrainMesh, HolesStayOpenAndNothingElseDoes) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> chance(0, 1);
    for (const double share : {0.001, 0.02, 0.3}) {
        const Heightfield ground = made(60, 47, [&](int i, int j) {
            const bool lake = (i - 20) * (i - 20) + (j - 22) * (j - 22) < 90 || (i > 50 && j > 40) || i == 0;
            return lake || chance(random) < share ? double(kNan)
                                                  : 100 + 30 * std::sin(0.2 * i) + 20 * std::cos(0.3 * j);
        });
        int closed = 0;
        for (int j = 0; j + 1 < 47; ++j)
            for (int i = 0; i + 1 < 60; ++i) closed += !isOpenCell(ground, i, j);
        for (const double error : {0.0, 2.0, 1000.0}) {
            const TerrainMesh mesh = simplified(ground, error);
            ASSERT_EQ(gridArea(mesh), closed) << "exactly the closed cells are covered";
            const double brute = bruteError(ground, mesh);
            ASSERT_GE(brute, 0);
            ASSERT_LE(brute, error + 1e-9);
            expectWatertight(ground, mesh);
            for (const auto& v : mesh.vertices) ASSERT_TRUE(std::isfinite(ground.sample(v.x, v.y)));
        }
    }
}

TEST(TerrainMesh, ExtremeHeightRanges) {
    for (const double range : {1e-6, 1e6}) {
        std::mt19937 random(9);
        std::uniform_real_distribution<double> height(0, range);
        const Heightfield ground = made(40, 30, [&](int, int) { return height(random); });
        const TerrainMesh mesh = simplified(ground, 0.1 * range);
        EXPECT_LE(bruteError(ground, mesh), 0.1 * range * (1 + 1e-9));
        EXPECT_GT(mesh.triangles.size(), 100u);
    }
}

// The paper's own mountains, 1197 x 643 samples: less than an eighth of the triangles at half a spacing.
TEST(TerrainMesh, RealMountains) {
    if (test::realData().empty()) GTEST_SKIP() << "no real data: set STEREONAV_TEST_DATA";
    const auto file = test::realData() / "terrain/srtm_bigtujunga30m_utm11.tif";
    Progress progress;
    const TerrainScene scene = loadTerrain(sceneFileFromName(file.string()), progress);
    const TerrainMesh mesh = simplifyTerrain(scene.ground, 15, progress);
    EXPECT_LE(bruteError(scene.ground, mesh), 15 + 1e-9);
    EXPECT_EQ(gridArea(mesh), 1196.0 * 642.0);
    EXPECT_LT(mesh.triangles.size(), 2u * 1196 * 642 / 8);
    expectWatertight(scene.ground, mesh);
}

// Delaunay by definition: no point lies inside the circle of a triangle (checked in long double).
TEST(MeshTriangulation, EveryCircleIsEmpty) {
    std::mt19937 random(10);
    std::uniform_int_distribution<int> x(0, 40), y(0, 25);
    MeshTriangulation mesh(40, 25);
    std::vector<int> changed;
    for (int k = 0; k < 300; ++k) {
        const glm::ivec2 p(x(random), y(random));
        if (std::count(mesh.points().begin(), mesh.points().end(), p)) continue;
        mesh.insert(p, mesh.locate(p, 0), changed);
    }
    for (int t = 0; t < mesh.triangleCount(); ++t) {
        const glm::dvec2 a(mesh.corner(t, 0)), b = glm::dvec2(mesh.corner(t, 1)) - a,
                                               c = glm::dvec2(mesh.corner(t, 2)) - a;
        const double d = 2 * (b.x * c.y - b.y * c.x);
        ASSERT_GT(d, 0);
        const glm::dvec2 centre((c.y * glm::dot(b, b) - b.y * glm::dot(c, c)) / d,
                                (b.x * glm::dot(c, c) - c.x * glm::dot(b, b)) / d);
        for (const auto& p : mesh.points())
            ASSERT_GE(glm::distance(glm::dvec2(p) - a, centre), glm::length(centre) * (1 - 1e-12)) << t;
    }
}

TEST(TerrainMesh, BadErrorsAndCancelling) {
    const Heightfield ground = rough(9, 9);
    for (const double error : {-1.0, double(kNan), std::numeric_limits<double>::infinity()})
        EXPECT_THROW(simplified(ground, error), Error);
    Progress progress;
    progress.cancel();
    EXPECT_THROW(simplifyTerrain(ground, 0, progress), Cancelled);
}

ColorTexture someColor(const Heightfield& ground) {
    Plane<PackedColor> image(32, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x) image.at(x, y) = packColor({x / 31.0f, y / 15.0f, 0.25f});
    return ColorTexture(image, glm::dvec2(0),
                        glm::dvec2(ground.width() - 1, ground.height() - 1) / glm::dvec2(32, 16));
}

TEST(TerrainMeshFile, ReadsBackWithEveryVertexOnTheGround) {
    const TemporaryFolder folder;
    const Heightfield ground = rough(50, 40);
    const TerrainMesh mesh = simplified(ground, 5);
    for (const char* name : {"ground.glb", "ground.gltf"}) {
        writeTerrainMesh(folder / name, ground, someColor(ground), mesh);
        const GltfFile file = readGltf(folder / name);
        const auto& primitive = file.model.meshes.at(0).primitives.at(0);
        const auto position = accessorValues(file, primitive.attributes.at("POSITION"), 3, "");
        const auto normal = accessorValues(file, primitive.attributes.at("NORMAL"), 3, "");
        const auto uv = accessorValues(file, primitive.attributes.at("TEXCOORD_0"), 2, "");
        const auto indices = accessorValues(file, primitive.indices, 1, "");
        ASSERT_EQ(indices.size(), 3 * mesh.triangles.size());
        ASSERT_EQ(position.size(), 3 * mesh.vertices.size());
        for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
            const glm::dvec3 world =
                worldFromGltf({position[3 * k], position[3 * k + 1], position[3 * k + 2]});
            ASSERT_NEAR(world.z, ground.heightAt(glm::dvec2(world)), 1e-3);
            const glm::dvec3 n = worldFromGltf({normal[3 * k], normal[3 * k + 1], normal[3 * k + 2]});
            ASSERT_LT(glm::distance(n, ground.normalAt(glm::dvec2(world))), 1e-3);
            // East is right in the picture, north is up.
            const glm::dvec2 extent = glm::dvec2(49, 39) * ground.spacing();
            ASSERT_NEAR(uv[2 * k], 0.5 + world.x / extent.x, 1e-5);
            ASSERT_NEAR(uv[2 * k + 1], 0.5 - world.y / extent.y, 1e-5);
        }
        for (std::size_t t = 0; t < indices.size(); t += 3) {
            glm::dvec3 corner[3];
            for (int k = 0; k < 3; ++k) {
                const auto v = static_cast<std::size_t>(indices[t + k]);
                corner[k] = worldFromGltf({position[3 * v], position[3 * v + 1], position[3 * v + 2]});
            }
            ASSERT_GT(glm::cross(corner[1] - corner[0], corner[2] - corner[0]).z, 0) << "front faces look up";
        }
        const auto& image = file.model.images.at(0);
        EXPECT_EQ(image.mimeType, "image/png");
        const Plane<PackedColor> picture =
            decodeColorImage(bufferViewBytes(file, image.bufferView, ""), name, "");
        ASSERT_EQ(picture.width(), 32);
        ASSERT_EQ(picture.height(), 16);
        EXPECT_LT(glm::distance(unpackColor(picture.at(31, 0)), glm::vec3(1, 0, 0.25f)), 0.01)
            << "top right: north-east";
        EXPECT_LT(glm::distance(unpackColor(picture.at(0, 15)), glm::vec3(0, 1, 0.25f)), 0.01);
    }
}

TEST(TerrainMeshFile, OtherNamesAreRefusedAndNothingIsWritten) {
    const TemporaryFolder folder;
    const Heightfield ground = rough(5, 5);
    try {
        writeTerrainMesh(folder / "ground.obj", ground, someColor(ground), simplified(ground, 1));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("expected a mesh named .glb or .gltf, got \".obj\""));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "ground.obj"));
}

}  // namespace
}  // namespace stereonav
