// Pictures on meshes: what a glTF file says of each of their two directions, and which texel a place shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/gltf/gltf_file.h"
#include "engine/image/image_file.h"
#include "engine/math/constants.h"
#include "engine/mesh/mesh_file.h"
#include "engine/mesh/mesh_shader.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/error_of.h"

namespace stereonav {
namespace {

// A triangle under a picture of 4 x 2 pixels, or what else is given for one, whose sampler says that of its
// directions; -1: it has none.
tinygltf::Model picturedTriangle(
    int wrapS, int wrapT,
    const std::vector<unsigned char>& picture = encodeColorImage(Plane<PackedColor>(4, 2), ".png")) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    const std::vector<float> positions{0, 0, 0, 4, 0, 0, 0, 0, -2}, uvs{0, 1, 1, 1, 0, 0};
    primitive.attributes["POSITION"] = addFloats(model, positions, 3, true);
    primitive.attributes["TEXCOORD_0"] = addFloats(model, uvs, 2, false);
    model.images.emplace_back();
    model.images[0].bufferView = addBytes(model, picture);
    model.images[0].mimeType = "image/png";
    model.textures.emplace_back();
    model.textures[0].source = 0;
    if (wrapS >= 0) {
        model.samplers.emplace_back();
        model.samplers[0].wrapS = wrapS, model.samplers[0].wrapT = wrapT;
        model.textures[0].sampler = 0;
    }
    model.materials.emplace_back();
    model.materials[0].pbrMetallicRoughness.baseColorTexture.index = 0;
    model.meshes.emplace_back();
    model.meshes[0].primitives.push_back(primitive);
    model.nodes.emplace_back();
    model.nodes[0].mesh = 0;
    model.scenes.emplace_back();
    model.scenes[0].nodes = {0};
    model.defaultScene = 0;
    return model;
}

TEST(MeshTexture, EachDirectionIsRepeatedOrNotByItsOwnWord) {
    const TemporaryFolder folder;
    // glTF 2.0, 5.26: the numbers that stand for each.
    const std::pair<int, TextureWrap> kWraps[] = {{33071, TextureWrap::ClampToEdge},
                                                  {33648, TextureWrap::MirroredRepeat},
                                                  {10497, TextureWrap::Repeat}};
    for (const auto& [wrapS, wrapX] : kWraps)
        for (const auto& [wrapT, wrapY] : kWraps) {
            writeGltf(folder / "a.glb", picturedTriangle(wrapS, wrapT));
            const TriangleMesh mesh = readMesh(folder / "a.glb");
            const MeshMaterial& material = mesh.materials.at(0);
            ASSERT_EQ(material.texture, 0);
            EXPECT_EQ(material.wrapX, wrapX) << wrapS << " " << wrapT;
            EXPECT_EQ(material.wrapY, wrapY) << wrapS << " " << wrapT;
        }
    writeGltf(folder / "b.glb", picturedTriangle(-1, -1));
    const MeshMaterial bare = readMesh(folder / "b.glb").materials.at(0);
    EXPECT_EQ(bare.wrapX, TextureWrap::Repeat) << "as glTF says of textures without a sampler";
    EXPECT_EQ(bare.wrapY, TextureWrap::Repeat);
}

TEST(MeshTexture, AWrapThatGltfDoesNotKnowIsRefusedByItsNumber) {
    const TemporaryFolder folder;
    for (const bool across : {true, false}) {
        writeGltf(folder / "a.glb", picturedTriangle(across ? 10496 : 10497, across ? 10497 : 10496));
        EXPECT_THAT(test::errorOf([&] { readMesh(folder / "a.glb"); }),
                    testing::AllOf(testing::HasSubstr("a.glb:sampler 0: expected a wrap of 10497, 33071 or"),
                                   testing::HasSubstr("got 10496")));
    }
}

// glTF says of it that it is PNG. What its bytes are is told by them, and the library that reads the glTF
// unpacks none of it.
TEST(MeshTexture, WhatIsNoPictureIsRefusedByItsPlace) {
    const TemporaryFolder folder;
    std::string dicom(128, '\0');
    dicom += "DICM";
    const std::vector<unsigned char> png = encodeColorImage(Plane<PackedColor>(4, 2), ".png");
    const std::pair<std::vector<unsigned char>, const char*> kPictures[] = {
        {{dicom.begin(), dicom.end()}, "is not a picture of a format that is read here"},
        {{'P', '6', '\n', '1', ' ', '1'}, "is not a picture of a format that is read here"},
        {{png.begin(), png.begin() + 40}, "is cut off"},
        {{png.begin(), png.begin() + 20}, "is cut off"}};
    for (const auto& [picture, problem] : kPictures) {
        writeGltf(folder / "a.glb", picturedTriangle(-1, -1, picture));
        EXPECT_THAT(test::errorOf([&] { readMesh(folder / "a.glb"); }),
                    testing::AllOf(testing::HasSubstr("a.glb:image 0: "), testing::HasSubstr(problem),
                                   testing::Not(testing::HasSubstr("\n"))));
    }
}

// The extension's own first example: the lower left quarter of a picture, turned clockwise by 90 degrees. Its
// second one: v counted from below.
TEST(MeshTexture, CoordinatesArePlacedAsKhrTextureTransformSays) {
    const TemporaryFolder folder;
    const auto number = [](double x) { return tinygltf::Value(x); };
    const auto pair = [&](double x, double y) {
        return tinygltf::Value(tinygltf::Value::Array{number(x), number(y)});
    };
    const auto uvsOf = [&](const tinygltf::Value::Object& transform) {
        tinygltf::Model model = picturedTriangle(-1, -1);
        model.extensionsUsed = model.extensionsRequired = {"KHR_texture_transform"};
        model.materials[0].pbrMetallicRoughness.baseColorTexture.extensions["KHR_texture_transform"] =
            tinygltf::Value(transform);
        writeGltf(folder / "a.glb", model);
        std::vector<glm::vec2> uvs;
        for (const auto& vertex : readMesh(folder / "a.glb").vertices) uvs.push_back(vertex.uv);
        return uvs;
    };
    const auto expectUvs = [](const std::vector<glm::vec2>& uvs, const std::vector<glm::vec2>& expected) {
        ASSERT_EQ(uvs.size(), expected.size());
        for (std::size_t k = 0; k < uvs.size(); ++k)
            ASSERT_LT(glm::distance(uvs[k], expected[k]), 1e-6) << k << ": " << uvs[k].x << " " << uvs[k].y;
    };
    // The triangle has (0, 1) lower left, (1, 1) lower right, (0, 0) upper left.
    expectUvs(uvsOf({{"offset", pair(0, 1)}, {"rotation", number(kPi / 2)}, {"scale", pair(0.5, 0.5)}}),
              {{0.5, 1}, {0.5, 0.5}, {0, 1}});
    expectUvs(uvsOf({{"offset", pair(0, 1)}, {"scale", pair(1, -1)}}), {{0, 0}, {1, 0}, {0, 1}});
    // Scaled before it is turned.
    expectUvs(uvsOf({{"rotation", number(kPi / 2)}, {"scale", pair(3, 2)}}), {{2, 0}, {2, -3}, {0, 0}});
    expectUvs(uvsOf({}), {{0, 1}, {1, 1}, {0, 0}});
}

TEST(MeshTexture, TheTransformsOwnSetOfCoordinatesCounts) {
    const TemporaryFolder folder;
    tinygltf::Model model = picturedTriangle(-1, -1);
    const std::vector<float> others{0.25, 0.5, 0.75, 0.5, 0.25, 0.125};
    model.meshes[0].primitives[0].attributes["TEXCOORD_1"] = addFloats(model, others, 2, false);
    auto& texture = model.materials[0].pbrMetallicRoughness.baseColorTexture;
    texture.extensions["KHR_texture_transform"] =
        tinygltf::Value(tinygltf::Value::Object{{"texCoord", tinygltf::Value(1)}});
    writeGltf(folder / "a.glb", model);
    const TriangleMesh mesh = readMesh(folder / "a.glb");
    ASSERT_EQ(mesh.vertices.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(mesh.vertices[k].uv, glm::vec2(others[2 * k], others[2 * k + 1])) << k;
}

// A picture of 5 x 3 texels, each of its own colour, as the material of one triangle.
class TexelsOfAMesh : public testing::Test {
protected:
    static constexpr int kWide = 5, kHigh = 3;

    TexelsOfAMesh() {
        Plane<PackedColor> picture(kWide, kHigh);
        for (int y = 0; y < kHigh; ++y)
            for (int x = 0; x < kWide; ++x) picture.at(x, y) = packColor(texel(x, y));
        mMesh.textures.emplace_back(picture, glm::dvec2(0), glm::dvec2(1));
        mMesh.materials.emplace_back();
        mMesh.materials[0].texture = 0;
        for (int k = 0; k < 3; ++k)
            mMesh.vertices.push_back(
                {{k == 1 ? 9.0 : 0.0, k == 2 ? 7.0 : 0.0, 0}, glm::vec3(0), glm::vec3(1), glm::vec2(0)});
        mMesh.triangles.push_back({{0, 1, 2}, 0});
    }
    // Row 0 on top, as files have it.
    static glm::vec3 texel(int x, int y) {
        return {static_cast<float>(0.1 + 0.15 * x), static_cast<float>(0.2 + 0.25 * y), 0.5f};
    }
    // The colour at that place of the picture, in texels from its upper left corner.
    glm::vec3 at(double x, double y) {
        const glm::vec2 uv(static_cast<float>(x / kWide), static_cast<float>(y / kHigh));
        for (auto& vertex : mMesh.vertices) vertex.uv = uv;
        MeshHit hit;
        hit.t = 1e-6, hit.triangle = 0, hit.weight[0] = 1, hit.faceNormal = {0, 0, 1};
        return colorOf(mMesh, hit, {0, 0, -1}, 1e-6, {});
    }

    TriangleMesh mMesh;
};

TEST_F(TexelsOfAMesh, LieWhereTheirCoordinatesSay) {
    for (int y = 0; y < kHigh; ++y)
        for (int x = 0; x < kWide; ++x)
            EXPECT_LT(glm::distance(at(x + 0.5, y + 0.5), texel(x, y)), 3e-3) << x << " " << y;
    // A quarter of the way from one texel to those beside it.
    EXPECT_LT(glm::distance(at(1.75, 0.5), 0.75f * texel(1, 0) + 0.25f * texel(2, 0)), 3e-3);
    EXPECT_LT(glm::distance(at(1.5, 0.75), 0.75f * texel(1, 0) + 0.25f * texel(1, 1)), 3e-3);
}

// Which texel is shown where texel n of an endless row would be: written out, after the pictures of glTF's
// sample TextureSettingsTest.
int shownTexel(int n, int size, TextureWrap wrap) {
    std::vector<int> row;  // texels of a picture before, the picture, and one behind it
    for (int k = 0; k < size; ++k)
        row.push_back(wrap == TextureWrap::Repeat ? k : wrap == TextureWrap::ClampToEdge ? 0 : size - 1 - k);
    for (int k = 0; k < size; ++k) row.push_back(k);
    for (int k = 0; k < size; ++k)
        row.push_back(wrap == TextureWrap::Repeat        ? k
                      : wrap == TextureWrap::ClampToEdge ? size - 1
                                                         : size - 1 - k);
    return row.at(static_cast<std::size_t>(n + size));
}

TEST_F(TexelsOfAMesh, GoOnOrEndInEachDirectionByItself) {
    constexpr TextureWrap kWraps[] = {TextureWrap::Repeat, TextureWrap::MirroredRepeat,
                                      TextureWrap::ClampToEdge};
    for (const TextureWrap wrapX : kWraps)
        for (const TextureWrap wrapY : kWraps) {
            SCOPED_TRACE(static_cast<int>(wrapX) * 10 + static_cast<int>(wrapY));
            mMesh.materials[0].wrapX = wrapX, mMesh.materials[0].wrapY = wrapY;
            for (int x = -kWide; x < 2 * kWide; ++x)
                for (int y = -kHigh; y < 2 * kHigh; ++y) {
                    const int i = shownTexel(x, kWide, wrapX), j = shownTexel(y, kHigh, wrapY);
                    ASSERT_LT(glm::distance(at(x + 0.5, y + 0.5), texel(i, j)), 3e-3) << x << " " << y;
                    // A quarter of the way to the next texel, over borders too.
                    if (x + 1 < 2 * kWide) {
                        const glm::vec3 east = texel(shownTexel(x + 1, kWide, wrapX), j);
                        ASSERT_LT(glm::distance(at(x + 0.75, y + 0.5), 0.75f * texel(i, j) + 0.25f * east),
                                  3e-3)
                            << x << " " << y;
                    }
                    if (y + 1 < 2 * kHigh) {
                        const glm::vec3 south = texel(i, shownTexel(y + 1, kHigh, wrapY));
                        ASSERT_LT(glm::distance(at(x + 0.5, y + 0.75), 0.75f * texel(i, j) + 0.25f * south),
                                  3e-3)
                            << x << " " << y;
                    }
                }
        }
}

// A picture and its mirror image are two: what is shown comes again after twice the picture's width.
TEST_F(TexelsOfAMesh, FarAwayAndBelowZeroMirrorsStillAlternate) {
    mMesh.materials[0].wrapX = mMesh.materials[0].wrapY = TextureWrap::MirroredRepeat;
    for (const int pictures : {-7, -6, -3, -2, -1, 1, 2, 3, 6, 7, 100, 101})
        for (int x = 0; x < kWide; ++x)
            for (int y = 0; y < kHigh; ++y) {
                const bool turned = pictures % 2 != 0;
                const glm::vec3 shown = texel(turned ? kWide - 1 - x : x, turned ? kHigh - 1 - y : y);
                ASSERT_LT(glm::distance(at(pictures * kWide + x + 0.5, pictures * kHigh + y + 0.5), shown),
                          3e-3)
                    << pictures << ": " << x << " " << y;
            }
}

}  // namespace
}  // namespace stereonav
