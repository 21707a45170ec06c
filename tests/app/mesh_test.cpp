// `stereonav mesh` as a user runs it.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/gltf/gltf_file.h"
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

// The file beside the mesh leads back to the elevation model's own coordinates.
TEST_F(MeshCommand, KeepsItsPlace) {
    const std::string ground = hills();
    input("hills.prj",
          "PROJCS[\"WGS 84 / UTM zone 33N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\","
          "6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
          "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
          "PARAMETER[\"central_meridian\",15],PARAMETER[\"scale_factor\",0.9996],"
          "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]");
    const Outcome outcome = run({"mesh", ground, "--vertical-scale", "2", "--out", "hills.glb", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out).at("place").at("path"), "hills.glb.json");
    const auto beside = nlohmann::json::parse(contentOf(place() / "hills.glb.json"));
    EXPECT_EQ(beside.at("crs"), "WGS 84 / UTM zone 33N");
    EXPECT_EQ(beside.at("vertical_scale"), 2.0);
    EXPECT_TRUE(beside.at("vertical_datum").is_null());
    const auto info = nlohmann::json::parse(run({"info", ground, "--json", "--size", "16x12"}).out);
    EXPECT_EQ(beside.at("offset"), info.at("terrain").at("source_offset"));
    EXPECT_EQ(info.at("terrain").at("vertical_datum"), "");
    EXPECT_NE(run({"info", ground, "--size", "16x12"}).out.find("no vertical one named; heights in metres"),
              std::string::npos);
}

TEST_F(MeshCommand, ThePlaceBesideIsWrittenWithTheMeshOrNotAtAll) {
    const std::filesystem::path out = mFolder / "hills.glb";
    std::filesystem::create_directory(mFolder / "hills.glb.json");
    expectRefused({"mesh", hills(), "--out", out.string()}, {"beside --out", "hills.glb.json"});
    EXPECT_FALSE(std::filesystem::exists(out));
    // Nothing is known of the generated ground; a file of an earlier mesh does not stay.
    std::ofstream(place() / "a.gltf.json") << "of an earlier mesh";
    ASSERT_EQ(run({"mesh", "terrain", "--error", "500", "--out", "a.gltf"}).status, 0);
    EXPECT_TRUE(nlohmann::json::parse(contentOf(place() / "a.gltf.json")).at("offset").is_null());
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
