// What a file is before it is loaded: by its headers, whatever its kind; and one line for what is broken.
#include "app/scene/file_glance.h"

#include <gmock/gmock.h>

#include <map>

#include "engine/base/error.h"
#include "tests/app/volume_input.h"
#include "tests/colon/study_dicom_slices.h"

namespace stereonav::test {
namespace {

using testing::HasSubstr;
using Rows = std::map<std::string, std::string>;

class FileGlance : public VolumeTest {
protected:
    static Rows glance(const std::string& file) {
        Progress progress;
        const auto rows = rowsOf(glanceAt(file, progress));
        return {rows.begin(), rows.end()};
    }
    static std::string problemOf(const std::string& file) {
        try {
            glance(file);
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
        return "";
    }
    // A model whose description claims `corners` corners; their buffer is not there.
    std::string gltf(const std::string& corners) const {
        return input("mesh.gltf", R"({"asset":{"version":"2.0"},"accessors":[{"count":)" + corners +
                                      R"(,"componentType":5126,"type":"VEC3"}],"meshes":[{"primitives":)"
                                      R"([{"attributes":{"POSITION":0}}]}],"materials":[{}]})");
    }
};

TEST_F(FileGlance, OfATerrain) {
    Rows rows = glance(hills());
    EXPECT_EQ(rows["kind"], "terrain");
    EXPECT_THAT(rows["samples"], HasSubstr("32 x 24"));
    EXPECT_THAT(rows["spacing"], HasSubstr("30 x 30"));
}

TEST_F(FileGlance, OfWhatIsNoMeshIsOneLine) {
    std::string deep = "{\"asset\":{},\"meshes\":";
    for (int n = 0; n < 100000; ++n) deep += '[';
    for (int n = 0; n < 100000; ++n) deep += ']';
    EXPECT_THAT(problemOf(input("deep.gltf", deep + "}")), HasSubstr("at most 100 deep"));
    EXPECT_THAT(problemOf(input("cut.gltf", "{\"asset\"")), HasSubstr("expected a glTF 2.0 mesh"));
}

TEST_F(FileGlance, OfASceneFileIsThatOfWhatItNames) {
    hills();
    Rows rows = glance(input("scene.toml", "[terrain]\ndem = \"hills.asc\"\n"));
    EXPECT_THAT(rows["scene of"], HasSubstr("hills.asc"));
    EXPECT_THAT(rows["samples"], HasSubstr("32 x 24"));
    ball();
    rows = glance(input("study.toml", "scene = \"ball.nrrd\"\n"));
    EXPECT_THAT(rows["voxels"], HasSubstr("24 x 24 x 24"));
    EXPECT_THAT(glance(input("colon.toml", "scene = \"colon\"\n"))["kind"], HasSubstr("colon"));
    EXPECT_THAT(problemOf(input("wrong.toml", "[terrain]\ndem = \"none.asc\"\n")), HasSubstr("none.asc"));
}

TEST_F(FileGlance, OfAVolume) {
    Rows rows = glance(ball());
    EXPECT_EQ(rows["kind"], "volume");
    EXPECT_EQ(rows["voxels"], "24 x 24 x 24, int16");
    EXPECT_EQ(rows["spacing"], "2 x 2 x 2 mm");
}

TEST_F(FileGlance, OfAFolderOfSlices) {
    const std::filesystem::path folder = mFolder / "slices";
    std::filesystem::create_directory(folder);
    writeStudy(folder);
    Rows rows = glance(folder.string());
    EXPECT_EQ(rows["read by"], "DICOM");
    EXPECT_EQ(rows["pixels"], "8 x 7");
    EXPECT_EQ(rows["files"], "3");
    EXPECT_THAT(problemOf((mFolder / "place").string()), HasSubstr("folder"));
}

TEST_F(FileGlance, OfAMeshReadsNoBuffer) {
    Rows rows = glance(gltf("300"));
    EXPECT_EQ(rows["kind"], "mesh");
    EXPECT_EQ(rows["triangles"], "100 over 300 vertices");
    EXPECT_THAT(glance(gltf("1e300"))["triangles"], HasSubstr("over")) << "nothing is taken for it";
    EXPECT_THAT(problemOf(gltf("0")), HasSubstr("no triangles"));
    EXPECT_THAT(problemOf(gltf("\"many\"")), HasSubstr("damaged"));
    EXPECT_THAT(problemOf(input("cut.glb", std::string("glTF\2\0\0\0\xff\0\0\0\xf0\0\0\0JSON{", 21))),
                HasSubstr("cut.glb"));
    EXPECT_THAT(problemOf(input("text.gltf", "hello")), HasSubstr("something else"));
}

TEST_F(FileGlance, OfWhatIsBrokenIsOneLine) {
    EXPECT_THAT(problemOf((mFolder / "none").string()), HasSubstr("no such file"));
    const std::string whole = contentOf(ball());
    EXPECT_THAT(problemOf(input("short.nrrd", whole.substr(0, whole.size() / 2))), HasSubstr("short.nrrd"));
    EXPECT_THAT(problemOf(input("text.tif", "hello")), HasSubstr("text.tif"));
    EXPECT_THAT(problemOf(input("empty.nii", "")), HasSubstr("empty.nii"));
    EXPECT_THAT(problemOf(input("broken.toml", "[terrain\n")), HasSubstr("broken.toml"));
}

TEST_F(FileGlance, EndsWhenItIsNotWantedAnyMore) {
    Progress progress;
    progress.cancel();
    EXPECT_THROW(glanceAt(hills(), progress), Cancelled);
}

}  // namespace
}  // namespace stereonav::test
