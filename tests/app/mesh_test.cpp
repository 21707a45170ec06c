// `stereonav mesh` as a user runs it.
#include "engine/camera/gltf_file.h"
#include "tests/app/program.h"

namespace stereonav::test {
namespace {

using MeshCommand = ProgramTest;

TEST_F(MeshCommand, WritesAMeshThatReadsBackAndSaysItsError) {
    const Outcome outcome = run({"mesh", hills(), "--out", "hills.glb", "--error", "5"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(linesIn(outcome.out), 1) << outcome.out;
    EXPECT_NE(outcome.out.find("largest error"), std::string::npos);
    const GltfFile file = readGltf(place() / "hills.glb");
    const auto& primitive = file.model.meshes.at(0).primitives.at(0);
    const auto position = accessorValues(file, primitive.attributes.at("POSITION"), 3, "");
    ASSERT_GE(position.size(), 3 * 4u);
    double low = 1e9, high = -1e9;
    for (std::size_t k = 1; k < position.size(); k += 3) {
        low = std::min(low, position[k]);
        high = std::max(high, position[k]);
    }
    EXPECT_GE(low, 100 - 1e-3);
    EXPECT_LE(high, 149 + 1e-3);
    EXPECT_GT(high - low, 30);
    EXPECT_EQ(file.model.images.size(), 1u);
}

TEST_F(MeshCommand, TheErrorChoosesTheSize) {
    const auto indicesAt = [&](const char* error) {
        EXPECT_EQ(run({"mesh", hills(), "--out", "m.glb", "--error", error}).status, 0);
        const GltfFile file = readGltf(place() / "m.glb");
        return accessorValues(file, file.model.meshes.at(0).primitives.at(0).indices, 1, "").size();
    };
    EXPECT_GT(indicesAt("0"), indicesAt("20"));
    EXPECT_GT(indicesAt("20"), 6u);
    EXPECT_EQ(indicesAt("1000"), 6u);
}

TEST_F(MeshCommand, BadOptionsGiveOneLineAndNoFile) {
    expectRefused({"mesh", hills(), "--out", "hills.obj"}, {"--out", "hills.obj", ".glb"});
    expectRefused({"mesh", hills(), "--out", "hills.glb", "--error", "-1"}, {"--error"});
    expectRefused({"mesh", hills(), "--out", "hills.glb", "--error", "nan"}, {"--error"});
    expectRefused({"mesh", hills()}, {"--out"});
    expectRefused({"mesh", "nowhere.tif", "--out", "hills.glb"}, {"nowhere.tif"});
}

}  // namespace
}  // namespace stereonav::test
