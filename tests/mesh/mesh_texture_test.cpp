// Pictures on meshes: what a glTF file says of each of their two directions, and which texel a place shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/camera/gltf_file.h"
#include "engine/image/image_file.h"
#include "engine/mesh/mesh_file.h"
#include "engine/mesh/mesh_shader.h"
#include "tests/camera/temporary_folder.h"

namespace stereonav {
namespace {

// A triangle under a picture of 4 x 2 pixels, whose sampler says that of its directions; -1: it has none.
tinygltf::Model picturedTriangle(int wrapS, int wrapT) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    const std::vector<float> positions{0, 0, 0, 4, 0, 0, 0, 0, -2}, uvs{0, 1, 1, 1, 0, 0};
    primitive.attributes["POSITION"] = addFloats(model, positions, 3, true);
    primitive.attributes["TEXCOORD_0"] = addFloats(model, uvs, 2, false);
    model.images.emplace_back();
    model.images[0].bufferView = addBytes(model, encodeColorImage(Plane<PackedColor>(4, 2), ".png"));
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
    constexpr int kClamp = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE, kRepeat = TINYGLTF_TEXTURE_WRAP_REPEAT;
    for (const int wrapS : {kClamp, kRepeat})
        for (const int wrapT : {kClamp, kRepeat}) {
            writeGltf(folder / "a.glb", picturedTriangle(wrapS, wrapT));
            const TriangleMesh mesh = readMesh(folder / "a.glb");
            const MeshMaterial& material = mesh.materials.at(0);
            ASSERT_EQ(material.texture, 0);
            EXPECT_EQ(material.repeatX, wrapS == kRepeat) << wrapS << " " << wrapT;
            EXPECT_EQ(material.repeatY, wrapT == kRepeat) << wrapS << " " << wrapT;
        }
    writeGltf(folder / "b.glb", picturedTriangle(-1, -1));
    const MeshMaterial bare = readMesh(folder / "b.glb").materials.at(0);
    EXPECT_TRUE(bare.repeatX && bare.repeatY) << "as glTF says of textures without a sampler";
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

TEST_F(TexelsOfAMesh, GoOnOrEndInEachDirectionByItself) {
    for (const bool repeatX : {false, true})
        for (const bool repeatY : {false, true}) {
            mMesh.materials[0].repeatX = repeatX, mMesh.materials[0].repeatY = repeatY;
            for (const int x : {-6, -1, 2, 5, 13})
                for (const int y : {-4, -1, 1, 3, 8}) {
                    const int i = repeatX ? (x + 5 * kWide) % kWide : std::clamp(x, 0, kWide - 1),
                              j = repeatY ? (y + 5 * kHigh) % kHigh : std::clamp(y, 0, kHigh - 1);
                    EXPECT_LT(glm::distance(at(x + 0.5, y + 0.5), texel(i, j)), 3e-3)
                        << x << " " << y << " " << repeatX << repeatY;
                }
            // Between the last texel and the first one.
            const glm::vec3 east = repeatX ? texel(0, 1) : texel(kWide - 1, 1),
                            south = repeatY ? texel(2, 0) : texel(2, kHigh - 1);
            EXPECT_LT(glm::distance(at(kWide - 0.25, 1.5), 0.75f * texel(kWide - 1, 1) + 0.25f * east), 3e-3);
            EXPECT_LT(glm::distance(at(2.5, kHigh - 0.25), 0.75f * texel(2, kHigh - 1) + 0.25f * south),
                      3e-3);
        }
}

}  // namespace
}  // namespace stereonav
