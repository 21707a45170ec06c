// Meshes whose files ask for more work than they have bytes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "engine/camera/gltf_file.h"
#include "engine/image/image_file.h"
#include "engine/mesh/mesh_file.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/error_of.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

// A thousand nodes that each show a mesh of so many primitives.
std::string shown(int primitives) {
    std::string nodes, roots, parts;
    for (int n = 0; n < 1000; ++n) {
        nodes += n ? R"(,{"mesh":0})" : R"({"mesh":0})";
        roots += fmt::format("{}{}", n ? "," : "", n);
    }
    for (int n = 0; n < primitives; ++n)
        parts += n ? R"(,{"attributes":{},"mode":0})" : R"({"attributes":{},"mode":0})";
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[{}]}}],"nodes":[{}],"meshes":[{{"primitives":[{}]}}]}})",
        roots, nodes, parts);
}

// The file grows by the sum, what is shown by the product.
TEST(HostileMesh, PrimitivesAreCountedAsOftenAsNodesShowThem) {
    const TemporaryFolder folder;
    const auto errorFor = [&](int primitives) {
        std::ofstream(folder / "a.gltf") << shown(primitives);
        return test::errorOf([&] { readMesh(folder / "a.gltf"); });
    };
    EXPECT_THAT(errorFor(1001), HasSubstr("a.gltf:scene: shows more than 1000000 primitives; simplify"));
    EXPECT_THAT(errorFor(3), HasSubstr("expected a mesh with triangles, found none"));
}

TEST(HostileMesh, APictureIsDecodedOnceForAllThatShowIt) {
    const TemporaryFolder folder;
    tinygltf::Model model;
    model.asset.version = "2.0";
    const std::vector<float> positions{0, 0, 0, 4, 0, 0, 0, 0, -2}, uvs{0, 1, 1, 1, 0, 0};
    const int places = addFloats(model, positions, 3, true), texturePlaces = addFloats(model, uvs, 2, false);
    for (int image = 0; image < 2; ++image) {
        model.images.emplace_back();
        model.images[image].bufferView =
            addBytes(model, encodeColorImage(Plane<PackedColor>(4 + image, 2), ".png"));
        model.images[image].mimeType = "image/png";
    }
    model.meshes.emplace_back();
    for (int n = 0; n < 6; ++n) {
        model.textures.emplace_back();
        model.textures[n].source = n % 2;
        model.materials.emplace_back();
        model.materials[n].pbrMetallicRoughness.baseColorTexture.index = n;
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = n;
        primitive.attributes["POSITION"] = places;
        primitive.attributes["TEXCOORD_0"] = texturePlaces;
        model.meshes[0].primitives.push_back(primitive);
    }
    model.nodes.emplace_back();
    model.nodes[0].mesh = 0;
    model.scenes.emplace_back();
    model.scenes[0].nodes = {0};
    writeGltf(folder / "a.glb", model);
    const TriangleMesh mesh = readMesh(folder / "a.glb");
    EXPECT_EQ(mesh.textures.size(), 2u);
    for (int n = 0; n < 6; ++n) EXPECT_EQ(mesh.materials.at(n).texture, n % 2);
}

}  // namespace
}  // namespace stereonav
