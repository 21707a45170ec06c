// Meshes whose files ask for more work than they have bytes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "engine/gltf/gltf_file.h"
#include "engine/image/image_file.h"
#include "engine/mesh/mesh_file.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/error_of.h"
#include "tests/support/held_memory.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// A thousand nodes that each show a mesh of `primitives` primitives.
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

// A square picture many times, and a material with a texture of its own for each primitive.
tinygltf::Model pictured(int pictures, int side, int materials) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    const std::vector<float> positions{0, 0, 0, 4, 0, 0, 0, 0, -2}, uvs{0, 1, 1, 1, 0, 0};
    const int places = addFloats(model, positions, 3, true), texturePlaces = addFloats(model, uvs, 2, false);
    const int bytes = addBytes(model, encodeColorImage(Plane<PackedColor>(side, side), ".png"));
    for (int image = 0; image < pictures; ++image) {
        model.images.emplace_back();
        model.images[image].bufferView = bytes;
        model.images[image].mimeType = "image/png";
    }
    model.meshes.emplace_back();
    for (int n = 0; n < materials; ++n) {
        model.textures.emplace_back();
        model.textures[n].source = n % pictures;
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
    return model;
}

TEST(HostileMesh, APictureIsDecodedOnceForAllThatShowIt) {
    const TemporaryFolder folder;
    writeGltf(folder / "a.glb", pictured(2, 4, 6));
    const TriangleMesh mesh = readMesh(folder / "a.glb");
    EXPECT_EQ(mesh.textures.size(), 2u);
    for (int n = 0; n < 6; ++n) EXPECT_EQ(mesh.materials.at(n).texture, n % 2);
}

// None of them is worth asking for alone.
TEST(HostileMesh, ManySmallPicturesAreAskedForTogether) {
    const TemporaryFolder folder;
    writeGltf(folder / "a.glb", pictured(120, 300, 120));  // half a megabyte each
    setenv("STEREONAV_MEMORY", fmt::format("{:.0f}", test::bytesHeld() + 20e6).c_str(), 1);
    const std::string error = test::errorOf([&] { readMesh(folder / "a.glb"); });
    unsetenv("STEREONAV_MEMORY");
    EXPECT_THAT(error, AllOf(HasSubstr("a.glb"), HasSubstr(" MB of memory, and "), Not(HasSubstr("\n"))));
    EXPECT_EQ(readMesh(folder / "a.glb").textures.size(), 120u);
}

}  // namespace
}  // namespace stereonav
