// Landmarks: meshes made here, cast, and compared with slabs and spheres in closed form; light, colour
// and placement from their definitions; files that are no meshes.
#include "terrain/scene/landmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/camera/stereo_rig.h"
#include "engine/gltf/gltf_file.h"
#include "engine/image/image_file.h"
#include "engine/math/constants.h"
#include "tests/camera/temporary_folder.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A shape in glTF's own space (y up).
struct Shape {
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;
};

// Corners at half extents around (0, h.y, 0): it stands on y = 0.
Shape box(const glm::vec3& h) {
    Shape shape;
    for (int k = 0; k < 8; ++k)
        for (const float v : {k & 1 ? h.x : -h.x, k & 2 ? 2 * h.y : 0.0f, k & 4 ? h.z : -h.z})
            shape.positions.push_back(v);
    shape.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2,
                     1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3};
    return shape;
}

Shape sphere(float radius, int rings) {
    Shape shape;
    const int around = 2 * rings;
    for (int r = 0; r <= rings; ++r)
        for (int a = 0; a <= around; ++a) {
            const double polar = kPi * r / rings, turn = 2 * kPi * a / around;
            for (const double v :
                 {std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn)})
                shape.positions.push_back(static_cast<float>(radius * v));
        }
    for (int r = 0; r < rings; ++r)
        for (int a = 0; a < around; ++a) {
            const auto at = static_cast<std::uint32_t>(r * (around + 1) + a);
            const auto below = at + static_cast<std::uint32_t>(around) + 1;
            for (const std::uint32_t v : {at, below, at + 1, at + 1, below, below + 1})
                shape.indices.push_back(v);
        }
    return shape;
}

tinygltf::Model modelOf(const Shape& shape) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = addFloats(model, shape.positions, 3, true);
    if (!shape.indices.empty()) primitive.indices = addIndices(model, shape.indices);
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(primitive);
    model.meshes.push_back(mesh);
    tinygltf::Node node;
    node.mesh = 0;
    model.nodes.push_back(node);
    tinygltf::Scene scene;
    scene.nodes = {0};
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    return model;
}

// Ground rising by 0.25 m a metre eastwards.
Heightfield slope() {
    std::vector<float> heights;
    for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 5; ++i) heights.push_back(static_cast<float>(100 * (0.25 * i)));
    return Heightfield(5, 5, glm::dvec2(100), heights, "slope");
}

class Landmarks : public testing::Test {
protected:
    std::filesystem::path write(const tinygltf::Model& model, const std::string& name = "mesh.glb") {
        writeGltf(mFolder / name, model);
        return mFolder / name;
    }
    LandmarkFile file(const tinygltf::Model& model) {
        LandmarkFile f;
        f.mesh = write(model);
        f.z = 0.0;
        return f;
    }
    LandmarkSet set(const LandmarkFile& f) { return LandmarkSet({f}, mGround, mLook); }
    std::string messageOf(const LandmarkFile& f) {
        try {
            set(f);
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
            return error.what();
        }
        return "no error";
    }
    std::string messageOf(const tinygltf::Model& model) { return messageOf(file(model)); }

    TemporaryFolder mFolder;
    Heightfield mGround = slope();
    TerrainLook mLook;
};

EyeView viewFrom(const Pose& pose, int width = 97, int height = 61) {
    Lens lens;
    lens.width = width;
    lens.height = height;
    return makeEyeView(pose, lens);
}

struct Cast {
    std::vector<glm::dvec3> direction;
    std::vector<float> depth;
    std::vector<PackedColor> color;
};

Cast castAll(const LandmarkSet& set, const EyeView& view, float farDepth = kInfinity) {
    Cast all;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) all.direction.push_back(view.rayDirection(x + 0.5, y + 0.5));
    all.depth.assign(all.direction.size(), farDepth);
    all.color.assign(all.direction.size(), 7u);
    set.cast(view, static_cast<int>(all.direction.size()), all.direction.data(), all.depth.data(),
             all.color.data());
    return all;
}

float castOne(const LandmarkSet& set, const glm::dvec3& eye, const glm::dvec3& direction,
              PackedColor* color = nullptr) {
    EyeView view = viewFrom({eye, glm::dquat(1, 0, 0, 0)});
    float depth = kInfinity;
    PackedColor ignored = 0;
    set.cast(view, 1, &direction, &depth, color ? color : &ignored);
    return depth;
}

// First positive parameter at which a ray enters the box, by slabs; infinity when it misses.
double boxDepth(const glm::dvec3& eye, const glm::dvec3& d, const glm::dvec3& low, const glm::dvec3& high) {
    double begin = 0, end = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const double a = (low[k] - eye[k]) / d[k], b = (high[k] - eye[k]) / d[k];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin <= end ? begin : std::numeric_limits<double>::infinity();
}

TEST_F(Landmarks, BoxIsHitWhereTheSlabsSay) {
    LandmarkFile f = file(modelOf(box({1, 1.5f, 2})));
    f.positionWorld = {40, -25};
    f.z = 10;
    const LandmarkSet landmarks = set(f);
    EXPECT_EQ(landmarks.triangleCount(), 12u);
    // glTF's x, y, z become east, up, south.
    const glm::dvec3 low(39, -27, 10), high(41, -23, 13);
    EXPECT_LT(glm::distance(landmarks.boundsMin(), low), 1e-5);
    EXPECT_LT(glm::distance(landmarks.boundsMax(), high), 1e-5);
    const EyeView view = viewFrom(poseFromAngles({36, -36, 15}, 0.35, -0.3, 0.1));
    const Cast cast = castAll(landmarks, view);
    int hits = 0, differences = 0;
    for (std::size_t k = 0; k < cast.depth.size(); ++k) {
        const double expected = boxDepth(view.eye, cast.direction[k], low, high);
        if (std::isinf(expected) != std::isinf(cast.depth[k])) {
            ++differences;  // a ray along the silhouette
            continue;
        }
        ASSERT_EQ(cast.color[k] == 7u, std::isinf(expected));
        if (std::isinf(expected)) continue;
        ++hits;
        ASSERT_NEAR(cast.depth[k], expected, 1e-6 * expected);
    }
    EXPECT_GT(hits, 300);
    EXPECT_LE(differences, 1);
}

// The faces of a sphere of 2 * 256 * 128 triangles lie less than r (1 - cos(pi / 128)) under it.
TEST_F(Landmarks, SphereIsHitWithinItsTessellation) {
    LandmarkFile f = file(modelOf(sphere(10, 128)));
    f.z = 100;
    const LandmarkSet landmarks = set(f);
    const glm::dvec3 centre(0, 0, 100);
    const EyeView view = viewFrom(poseFromAngles({-30, -20, 110}, std::atan2(30, 20), -0.25, 0));
    const Cast cast = castAll(landmarks, view);
    int hits = 0;
    for (std::size_t k = 0; k < cast.depth.size(); ++k) {
        const glm::dvec3 d = cast.direction[k], o = view.eye - centre;
        const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 100;
        const double root = b * b - a * c;
        if (root < 60 * a) continue;  // near the silhouette the error in depth grows without bound
        ++hits;
        ASSERT_NEAR(cast.depth[k], (-b - std::sqrt(root)) / a, 0.01);
    }
    EXPECT_GT(hits, 300);
}

TEST_F(Landmarks, StandsOnTheGroundUnderItsPosition) {
    tinygltf::Model model = modelOf(box({1, 1, 1}));
    model.nodes[0].translation = {0, -7, 0};  // its base is 7 m below its own origin
    LandmarkFile f = file(model);
    f.z.reset();
    f.positionWorld = {60, 30};
    f.scale = 3;
    const LandmarkSet landmarks = set(f);
    EXPECT_NEAR(landmarks.boundsMin().z, mGround.heightAt({60, 30}), 1e-5);
    EXPECT_NEAR(landmarks.boundsMax().z - landmarks.boundsMin().z, 6, 1e-5);
    f.positionWorld = {5000, 0};
    EXPECT_THAT(messageOf(f), AllOf(HasSubstr("mesh.glb:position"), HasSubstr("a place on the ground")));
}

// glTF's -z is north; a heading of 90 degrees takes what was north to the east.
TEST_F(Landmarks, HeadingTurnsClockwise) {
    Shape north = box({0.5f, 0.5f, 0.5f});
    for (std::size_t k = 2; k < north.positions.size(); k += 3) north.positions[k] -= 10;
    LandmarkFile f = file(modelOf(north));
    f.heading = kPi / 2;
    const LandmarkSet landmarks = set(f);
    EXPECT_LT(glm::distance(landmarks.boundsMin(), glm::dvec3(9.5, -0.5, 0)), 1e-5);
    EXPECT_LT(glm::distance(landmarks.boundsMax(), glm::dvec3(10.5, 0.5, 1)), 1e-5);
}

TEST_F(Landmarks, NodesAreComposed) {
    tinygltf::Model model = modelOf(box({1, 1, 1}));
    tinygltf::Node parent;
    parent.children = {0};
    parent.scale = {2, 1, 1};
    parent.translation = {100, 0, 0};
    model.nodes[0].translation = {5, 0, 0};
    model.nodes.push_back(parent);
    model.scenes[0].nodes = {1};
    const LandmarkSet landmarks = set(file(model));
    EXPECT_LT(glm::distance(landmarks.boundsMin(), glm::dvec3(108, -1, 0)), 1e-4);
    EXPECT_LT(glm::distance(landmarks.boundsMax(), glm::dvec3(112, 1, 2)), 1e-4);
}

// 60 km from the world's origin a float steps by 4 mm; relative to the set's centre nothing is lost.
TEST_F(Landmarks, FarFromTheOriginNothingIsLost) {
    LandmarkFile f = file(modelOf(box({1, 1, 1})));
    f.positionWorld = {60000.125, -45000.375};
    const LandmarkSet landmarks = set(f);
    const float depth = castOne(landmarks, {60000.125, -45010.375, 1}, {0.01, 1, 0.01});
    EXPECT_NEAR(depth, 9, 1e-6);
}

TEST_F(Landmarks, NearerGroundAndMarkedLanesAreLeftAlone) {
    const LandmarkSet landmarks = set(file(modelOf(box({1, 1, 1}))));
    EyeView view = viewFrom({{0, -11, 1}, glm::dquat(1, 0, 0, 0)});
    const std::vector<glm::dvec3> direction(5, {0.001, 1, 0.001});
    std::vector<float> depth{9.9f, -1.0f, 10.1f, kInfinity, 0.05f};
    std::vector<PackedColor> color(5, 7u);
    landmarks.cast(view, 5, direction.data(), depth.data(), color.data());
    EXPECT_EQ(depth[0], 9.9f);
    EXPECT_EQ(depth[1], -1.0f);
    EXPECT_NEAR(depth[2], 10, 1e-5);
    EXPECT_NEAR(depth[3], 10, 1e-5);
    EXPECT_EQ(depth[4], 0.05f);
    EXPECT_EQ(color[0], 7u);
    EXPECT_EQ(color[1], 7u);
    EXPECT_NE(color[2], 7u);
    EXPECT_NE(color[3], 7u);
    // What is nearer than the near depth is not seen: from 0.05 m off the face the back face is.
    view.eye = {0, -1.05, 1};
    view.nearDepth = 0.1;
    float through = kInfinity;
    landmarks.cast(view, 1, direction.data(), &through, color.data());
    EXPECT_NEAR(through, 2.05, 1e-5);
}

// Rays far to the side are left out early; a view from inside the set's bounds must not lose any.
TEST_F(Landmarks, FromBetweenTwoLandmarksBothAreSeen) {
    LandmarkFile a = file(modelOf(box({1, 1, 1}))), b = a;
    a.positionWorld = {-50, 0};
    b.positionWorld = {50, 0};
    const LandmarkSet landmarks({a, b}, mGround, mLook);
    for (const double side : {-1.0, 1.0}) {
        const EyeView view = viewFrom(poseFromAngles({0, 0, 1}, side * kPi / 2, 0, 0.4));
        const Cast cast = castAll(landmarks, view);
        int hits = 0;
        for (std::size_t k = 0; k < cast.depth.size(); ++k) {
            const double x = 50 * side;
            const double expected = boxDepth(view.eye, cast.direction[k], {x - 1, -1, 0}, {x + 1, 1, 2});
            ASSERT_EQ(std::isinf(cast.depth[k]), std::isinf(expected));
            hits += !std::isinf(expected);
        }
        EXPECT_GT(hits, 5);
    }
}

// Every pixel has the same bits whichever others are cast with it.
TEST_F(Landmarks, APixelDoesNotDependOnItsPacket) {
    LandmarkFile f = file(modelOf(sphere(10, 24)));
    const LandmarkSet landmarks = set(f);
    const EyeView view = viewFrom(poseFromAngles({-30, -20, 10}, std::atan2(30, 20), -0.25, 0.3));
    const Cast all = castAll(landmarks, view);
    for (std::size_t k = 0; k < all.depth.size(); ++k) {
        float depth = kInfinity;
        PackedColor color = 7u;
        landmarks.cast(view, 1, &all.direction[k], &depth, &color);
        ASSERT_EQ(depth, all.depth[k]) << k;
        ASSERT_EQ(color, all.color[k]) << k;
    }
}

TEST_F(Landmarks, LambertLightOnBothSides) {
    mLook.sunAzimuth = 1.0;
    mLook.sunElevation = 0.6;
    mLook.ambient = 0.3f;
    // A horizontal square seen from above and from below, without normals in the file.
    tinygltf::Model model = modelOf({{-5, 0, -5, 5, 0, -5, 5, 0, 5, -5, 0, 5}, {0, 1, 2, 0, 2, 3}});
    model.materials.emplace_back();
    model.materials[0].pbrMetallicRoughness.baseColorFactor = {0.8, 0.4, 0.2, 1};
    model.meshes[0].primitives[0].material = 0;
    const LandmarkSet landmarks = set(file(model));
    PackedColor above = 0, below = 0;
    EXPECT_NEAR(castOne(landmarks, {1, 2, 3}, {0.1, 0, -1}, &above), 3, 1e-6);
    EXPECT_NEAR(castOne(landmarks, {1, 2, -4}, {0.1, 0, 1}, &below), 4, 1e-6);
    const float lit = static_cast<float>(0.3 + 0.7 * std::sin(0.6));
    const glm::vec3 base(0.8f, 0.4f, 0.2f);
    EXPECT_LT(glm::distance(unpackColor(above), base * lit), 2e-3);
    EXPECT_LT(glm::distance(unpackColor(below), base * 0.3f), 2e-3)
        << "the side away from the sun has ambient only";
}

TEST_F(Landmarks, FogTakesItsShareByDistance) {
    mLook.ambient = 1;
    mLook.fogDistance = 100;
    mLook.fogColor = {0.25f, 0.25f, 0.25f};
    tinygltf::Model model = modelOf({{-50, 0, -50, 50, 0, -50, 50, 0, 50, -50, 0, 50}, {0, 1, 2, 0, 2, 3}});
    const LandmarkSet landmarks = set(file(model));
    PackedColor color = 0;
    castOne(landmarks, {0.5, 1, 100}, {0, 0, -1}, &color);
    const double through = std::exp(-1.0);
    EXPECT_NEAR(unpackColor(color).x, through * 1 + (1 - through) * 0.25, 2e-3);  // in linear light
}

TEST_F(Landmarks, NormalsAndVertexColoursAreInterpolated) {
    mLook.sunElevation = kPi / 2;
    mLook.ambient = 0;
    tinygltf::Model model = modelOf({{-1, 0, 0, 1, 0, 0, 0, 0, -2}, {0, 1, 2}});
    const float s = static_cast<float>(std::sqrt(0.5));
    const std::vector<float> normals{-s, s, 0, s, s, 0, 0, 1, 0}, colors{1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1};
    auto& primitive = model.meshes[0].primitives[0];
    primitive.attributes["NORMAL"] = addFloats(model, normals, 3, false);
    primitive.attributes["COLOR_0"] = addFloats(model, colors, 4, false);
    const LandmarkSet landmarks = set(file(model));
    PackedColor middle = 0, corner = 0;
    castOne(landmarks, {0, 0.001, 5}, {0, 0, -1}, &middle);  // halfway along the first edge
    castOne(landmarks, {-0.998, 0.001, 5}, {0, 0, -1}, &corner);
    EXPECT_LT(glm::distance(unpackColor(middle), glm::vec3(0.5f, 0.5f, 0)), 5e-3);  // normals meet upwards
    EXPECT_LT(glm::distance(unpackColor(corner), glm::vec3(s, 0, 0)), 5e-3);
}

TEST_F(Landmarks, BaseColourTextureHasItsTopWhereVIsZero) {
    mLook.ambient = 1;
    Plane<PackedColor> picture(2, 2);
    picture.at(0, 0) = packColor({1, 0, 0});
    picture.at(1, 0) = packColor({0, 1, 0});
    picture.at(0, 1) = packColor({0, 0, 1});
    picture.at(1, 1) = packColor({1, 1, 1});
    tinygltf::Model model = modelOf({{0, 0, 0, 2, 0, 0, 2, 0, 2, 0, 0, 2}, {0, 1, 2, 0, 2, 3}});
    const std::vector<float> uvs{0, 0, 1, 0, 1, 1, 0, 1};
    model.meshes[0].primitives[0].attributes["TEXCOORD_0"] = addFloats(model, uvs, 2, false);
    model.meshes[0].primitives[0].material = 0;
    model.images.emplace_back();
    model.images[0].bufferView = addBytes(model, encodeColorImage(picture, ".png"));
    model.images[0].mimeType = "image/png";
    model.samplers.emplace_back();
    model.samplers[0].wrapS = model.samplers[0].wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model.textures.emplace_back();
    model.textures[0].source = 0;
    model.textures[0].sampler = 0;
    model.materials.emplace_back();
    model.materials[0].pbrMetallicRoughness.baseColorTexture.index = 0;
    const LandmarkSet landmarks = set(file(model));
    const auto at = [&](double east, double south) {
        PackedColor color = 0;
        castOne(landmarks, {east, -south, 5}, {0, 0, -1}, &color);
        return unpackColor(color);
    };
    EXPECT_LT(glm::distance(at(0.3, 0.3), glm::vec3(1, 0, 0)), 5e-3);
    EXPECT_LT(glm::distance(at(1.7, 0.3), glm::vec3(0, 1, 0)), 5e-3);
    EXPECT_LT(glm::distance(at(0.3, 1.7), glm::vec3(0, 0, 1)), 5e-3);
    EXPECT_LT(glm::distance(at(1.0, 0.3), glm::vec3(0.5f, 0.5f, 0)), 5e-3);
}

TEST_F(Landmarks, AllIndexKindsMakeTheSameMesh) {
    const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
    const Shape square{{-5, 0, -5, 5, 0, -5, 5, 0, 5, -5, 0, 5}, indices};
    for (const int type : {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                           TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT}) {
        tinygltf::Model model = modelOf(square);
        std::vector<unsigned char> bytes;
        for (const std::uint32_t v : indices)
            for (int b = 0; b < tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)); ++b)
                bytes.push_back(static_cast<unsigned char>(v >> 8 * b));
        auto& accessor = model.accessors[model.meshes[0].primitives[0].indices];
        accessor.bufferView = addBytes(model, bytes);
        accessor.componentType = type;
        const LandmarkSet landmarks = set(file(model));
        EXPECT_EQ(landmarks.triangleCount(), 2u);
        EXPECT_NEAR(castOne(landmarks, {4, 4, 3}, {0, 0, -1}), 3, 1e-6) << type;
        EXPECT_NEAR(castOne(landmarks, {-4, -4, 3}, {0, 0, -1}), 3, 1e-6) << type;
    }
    const Shape strip{{-5, 0, -5, -5, 0, 5, 5, 0, -5, 5, 0, 5}, {}};
    const Shape fan{{-5, 0, -5, -5, 0, 5, 5, 0, 5, 5, 0, -5}, {}};
    for (const int mode : {TINYGLTF_MODE_TRIANGLE_STRIP, TINYGLTF_MODE_TRIANGLE_FAN}) {
        tinygltf::Model model = modelOf(mode == TINYGLTF_MODE_TRIANGLE_FAN ? fan : strip);
        model.meshes[0].primitives[0].mode = mode;
        const LandmarkSet landmarks = set(file(model));
        EXPECT_EQ(landmarks.triangleCount(), 2u);
        for (const double x : {-4.0, 4.0})
            for (const double y : {-4.0, 4.0})
                EXPECT_NEAR(castOne(landmarks, {x, y + 0.1, 3}, {0, 0, -1}), 3, 1e-6) << mode;
    }
}

TEST_F(Landmarks, SeveralFilesAreOneSet) {
    LandmarkFile a = file(modelOf(box({1, 1, 1}))), b = a;
    a.positionWorld = {-50, 0};
    b.positionWorld = {50, 0};
    const LandmarkSet landmarks({a, b}, mGround, mLook);
    EXPECT_EQ(landmarks.triangleCount(), 24u);
    EXPECT_NEAR(castOne(landmarks, {-50, 0.1, 9}, {0, 0.001, -1}), 7, 1e-5);
    EXPECT_NEAR(castOne(landmarks, {50, 0.1, 9}, {0, 0.001, -1}), 7, 1e-5);
    EXPECT_TRUE(std::isinf(castOne(landmarks, {0, 0.1, 9}, {0, 0.001, -1})));
}

TEST_F(Landmarks, BadFilesGiveOneLine) {
    LandmarkFile missing;
    missing.mesh = mFolder / "none.glb";
    EXPECT_THAT(messageOf(missing), HasSubstr("can not be opened"));
    tinygltf::Model model = modelOf(box({1, 1, 1}));
    model.nodes[0].mesh = -1;
    model.nodes[0].translation = {1, 2, 3};
    EXPECT_THAT(messageOf(model),
                AllOf(HasSubstr("mesh.glb:scene"), HasSubstr("expected a mesh with triangles")));
    model = modelOf(box({1, 1, 1}));
    model.meshes[0].primitives[0].mode = TINYGLTF_MODE_LINE;
    EXPECT_THAT(messageOf(model), HasSubstr("expected a mesh with triangles"));
    Shape wild = box({1, 1, 1});
    wild.indices[5] = 8;
    EXPECT_THAT(messageOf(modelOf(wild)), AllOf(HasSubstr("mesh 0, primitive 0, indices"),
                                                HasSubstr("expected vertices 0 to 7, got 8")));
    Shape nan = box({1, 1, 1});
    nan.positions[4] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(messageOf(modelOf(nan)), HasSubstr("mesh 0, primitive 0, POSITION: element 1"));
    Shape odd = box({1, 1, 1});
    odd.indices.pop_back();
    EXPECT_THAT(messageOf(modelOf(odd)), HasSubstr("three indices a triangle, got 35"));
    model = modelOf(box({1, 1, 1}));
    model.meshes[0].primitives[0].material = 3;
    EXPECT_THAT(messageOf(model), HasSubstr("refers to material 3, the file has 0"));
    model = modelOf(box({1, 1, 1}));
    model.nodes[0].mesh = 4;
    EXPECT_THAT(messageOf(model), HasSubstr("refers to mesh 4, the file has 1"));
    model = modelOf(box({1, 1, 1}));
    model.meshes[0].primitives[0].attributes["NORMAL"] =
        addFloats(model, std::vector<float>{0, 1, 0}, 3, false);
    EXPECT_THAT(messageOf(model), HasSubstr("NORMAL: expected 8 elements as POSITION has, got 1"));
    LandmarkFile flat = file(modelOf(box({1, 1, 1})));
    flat.scale = 0;
    EXPECT_THAT(messageOf(flat), HasSubstr("expected a scale above 0, got 0"));
}

TEST_F(Landmarks, TruncatedFilesGiveOneLine) {
    const auto path = write(modelOf(box({1, 1, 1})));
    const std::string whole = readTextFile(path);
    LandmarkFile f;
    f.mesh = path;
    f.z = 0.0;
    for (std::size_t size = 0; size < whole.size(); size += 41) {
        std::ofstream(path, std::ios::binary) << whole.substr(0, size);
        ASSERT_THAT(messageOf(f), HasSubstr("mesh.glb")) << size;
    }
    std::ofstream(path) << "solid not-a-gltf\n";
    EXPECT_THAT(messageOf(f), HasSubstr("is not glTF 2.0 that can be read"));
}

}  // namespace
}  // namespace stereonav
