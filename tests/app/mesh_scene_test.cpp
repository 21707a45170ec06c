// A glTF mesh as a scene, through the real program.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/gltf/gltf_file.h"
#include "engine/mesh/triangle_mesh.h"
#include "tests/app/program.h"
#include "tests/support/dicom_files.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

class MeshScene : public ProgramTest {
protected:
    // The hills as triangles, with their colour as a texture.
    std::string mesh(const std::string& name = "hills.glb") const {
        const std::string file = (mFolder / name).string();
        EXPECT_EQ(run({"mesh", hills(), "--out", file, "--error", "0"}).status, 0);
        return file;
    }
    std::string picture(const std::string& scene, std::vector<std::string> options) const {
        std::vector<std::string> arguments{"render", scene, "--size", "64x48", "--out", "a.png"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome done = run(arguments);
        EXPECT_EQ(done.status, 0) << done.err;
        return contentOf(place() / "a.png");
    }
};

TEST_F(MeshScene, InfoSaysWhatIsThere) {
    const std::string file = mesh();
    const Outcome text = run({"info", file});
    EXPECT_NE(text.out.find("triangles   "), std::string::npos) << text.out << text.err;
    const Json facts = Json::parse(run({"info", file, "--json"}).out).at("mesh");
    const GltfFile gltf = readGltf(file);
    const auto& primitive = gltf.model.meshes.at(0).primitives.at(0);
    const std::size_t corners = accessorValues(gltf, primitive.indices, 1, "").size();
    EXPECT_EQ(facts.at("triangles"), corners / 3);
    EXPECT_EQ(facts.at("vertices"),
              accessorValues(gltf, primitive.attributes.at("POSITION"), 3, "").size() / 3);
    EXPECT_EQ(facts.at("textures"), 1);
    EXPECT_NEAR(facts.at("size").at(0), 31 * 30.0, 1e-3);
    EXPECT_NEAR(facts.at("size").at(1), 23 * 30.0, 1e-3);
    EXPECT_NEAR(facts.at("size").at(2), 49, 1e-3);
    EXPECT_GT(facts.at("bytes"), corners / 3 * sizeof(TriangleMesh::Triangle));
}

// A texture like one that ended the program by a signal: DICOM inside, compressed, with more segments than it
// has bytes.
TEST_F(MeshScene, ATextureThatIsNoPictureIsOneLine) {
    DicomSpec spec;
    spec.slice.columns = spec.slice.rows = 64;
    spec.slice.bitsStored = spec.bits = 8;
    const DicomBytes numbers(DicomSyntax::Explicit);
    std::string packed = numbers.number(0x7fffffff, 4) + numbers.number(64, 4);
    while (packed.size() < 64) packed += numbers.number(9999, 4);
    spec.packed = {packed + std::string(20, '\x81')};
    spec.packedSyntax = "1.2.840.10008.1.2.5";
    const std::string dicom = dicomBytes(spec), file = mesh();
    tinygltf::Model model = readGltf(file).model;
    model.images.at(0).bufferView = addBytes(model, std::vector<unsigned char>(dicom.begin(), dicom.end()));
    writeGltf(file, model);
    for (const char* command : {"info", "render"}) {
        std::vector<std::string> arguments{command, file};
        if (arguments[0] == "render")
            arguments.insert(arguments.end(), {"--size", "64x48", "--out", "a.png"});
        const Outcome done = run(arguments);
        EXPECT_EQ(done.status, 1);
        EXPECT_EQ(linesIn(done.err), 1) << done.err;
        EXPECT_NE(done.err.find("hills.glb:image 0: is not a picture"), std::string::npos) << done.err;
    }
    EXPECT_TRUE(std::filesystem::is_empty(place()));
}

TEST_F(MeshScene, BothKindsOfFileGiveOnePicture) {
    EXPECT_EQ(picture(mesh("a.glb"), {}), picture(mesh("b.gltf"), {}));
}

TEST_F(MeshScene, IsDrawnFlownAndComparedInEveryMethod) {
    const std::string file = mesh();
    for (const char* method : {"full", "paper", "linear", "cubic", "mcmillan", "nofill"}) {
        const Outcome done = run({"render", file, "--size", "33x25", "--method", method, "--out", "a.png"});
        EXPECT_EQ(done.status, 0) << done.err;
    }
    const auto hashWith = [&](const char* threads) {
        const Outcome flown =
            run({"play", file, "--size", "33x25", "--frames", "3", "--hash", "--threads", threads});
        EXPECT_EQ(flown.status, 0) << flown.err;
        return flown.out.substr(flown.out.find("hash"));
    };
    EXPECT_EQ(hashWith("1"), hashWith("3"));
    const Outcome compared = run({"compare", file, "--size", "64x48", "--frames", "2", "--repeats", "1",
                                  "--methods", "full,linear", "--json", "a.json"});
    EXPECT_EQ(compared.status, 0) << compared.err;
    EXPECT_TRUE(std::filesystem::exists(place() / "a.json"));
}

TEST_F(MeshScene, TheSunTurns) {
    const std::string file = mesh();
    // Without a chosen view, which the light goes with.
    EXPECT_EQ(picture(file, {"--look", "plain"}), picture(file, {"--look", "plain", "--sun", "225,45"}));
    EXPECT_NE(picture(file, {}), picture(file, {"--sun", "135,20"}));
}

TEST_F(MeshScene, WhatItHasNotIsRefusedInOneLine) {
    const std::string file = mesh();
    expectRefused({"render", file, "--light", "auto", "--vertical-scale", "2", "--out", "a.png"},
                  {"--light", "--vertical-scale", "mesh"});
    expectRefused({"render", file, "--medium", "smoke", "--out", "a.png"}, {"--medium", "mesh"});
    expectRefused({"bake", file, "--out", "a.light"}, {"hills.glb", "mesh"});
    expectRefused({"mesh", file, "--out", "a.glb"}, {"hills.glb", "mesh"});
    expectRefused({"centreline", file, "--out", "a.vtp"}, {"hills.glb", "mesh"});
}

TEST_F(MeshScene, ADamagedFileIsRefused) {
    const std::string whole = contentOf(mesh());
    expectRefused({"render", input("short.glb", whole.substr(0, whole.size() / 2)), "--out", "a.png"},
                  {"short.glb", "cut off"});
    expectRefused({"info", input("none.gltf", R"({"asset":{"version":"2.0"}})")},
                  {"none.gltf", "triangles", "found none"});
}

// Vertices that the file does not hold: none of their memory is asked for, and it is called damaged.
TEST_F(MeshScene, ForgedCountsTakeNoMemory) {
    const auto gltf = [](const std::string& count, const std::string& mode) {
        return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": )" +
               mode +
               R"(}]}], "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": )" +
               count +
               R"(}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
               R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    };
    setenv("STEREONAV_MEMORY", "60000000", 1);
    for (const char* mode : {"4", "5"})
        for (const char* count : {"1000000000", "300000000000", "4"})
            expectRefused(
                {"render", input("forged.gltf", gltf(count, mode)), "--size", "16x12", "--out", "a.png"},
                {"forged.gltf", "accessor 0", "buffer view of 36 bytes"});
    const Outcome whole =
        run({"render", input("whole.gltf", gltf("3", "4")), "--size", "16x12", "--out", "a.png"});
    unsetenv("STEREONAV_MEMORY");
    EXPECT_EQ(whole.status, 0) << whole.err;
}

TEST_F(MeshScene, MemoryIsAskedForBeforeItIsTaken) {
    const std::string file = mesh();
    setenv("STEREONAV_MEMORY", "200000", 1);
    const Outcome refused = run({"render", file, "--size", "16x12", "--out", "a.png"});
    unsetenv("STEREONAV_MEMORY");
    EXPECT_EQ(refused.status, 1);
    EXPECT_EQ(linesIn(refused.err), 1) << refused.err;
    EXPECT_NE(refused.err.find("memory"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace stereonav::test
