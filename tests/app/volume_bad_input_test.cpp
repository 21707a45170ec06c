// Bad studies and options of studies, through the real program: one line, exit status 1, nothing left.
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

class VolumeBadInput : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    void expectSceneRefused(const std::string& scene, const std::vector<std::string>& words,
                            const std::vector<std::string>& options = {}) const {
        std::vector<std::string> arguments{"render", scene, "--size", "32x24", "--out", "out.png"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expectRefused(arguments, words);
    }
};

TEST_F(VolumeBadInput, NotAVolume) {
    expectSceneRefused("nowhere.nrrd", {"nowhere.nrrd", "no such file", ".nii.gz", "colon"});
    for (const std::string name : {"letter.nrrd", "letter.nii", "letter.nii.gz", "letter.mha", "letter.mhd"})
        expectSceneRefused(input(name, "Dear reader,\nthis is a letter.\n"), {name});
    for (const std::string name : {"empty.nrrd", "empty.nii.gz", "empty.mha"})
        expectSceneRefused(input(name, ""), {name});
    std::filesystem::create_directory(mFolder / "folder");
    expectSceneRefused((mFolder / "folder").string(), {"folder", "DICOM"});
    input("folder/letter.txt", "Dear reader");
    expectSceneRefused((mFolder / "folder").string(), {"folder", "DICOM"});
}

TEST_F(VolumeBadInput, ArchivesAreToBeUnpacked) {
    expectSceneRefused(input("study.zip", std::string("PK\3\4\x14\0\0\0", 8) + "slice.dcm"),
                       {"study.zip", "found an archive (zip)", "unpack it"});
    expectSceneRefused(input("study", std::string("PK\3\4\x14\0\0\0", 8)), {"study", "archive"});
    expectSceneRefused(input("study.7z", std::string("7z\xbc\xaf\x27\x1c\0\4", 8)), {"archive (7z)"});
}

TEST_F(VolumeBadInput, CutOffOrTheWrongNumberOfBytes) {
    const std::string whole = contentOf(maskedTube());
    expectSceneRefused(input("cut.nrrd", whole.substr(0, whole.size() / 2)), {"cut.nrrd"});
    expectSceneRefused(input("head.nrrd", whole.substr(0, 60)), {"head.nrrd"});
    expectSceneRefused(input("short.nrrd", header({}) + std::string(100, 'x')), {"short.nrrd", "100"});
}

TEST_F(VolumeBadInput, HeadersThatCanNotBeMeant) {
    SmallStudy study;
    study.width = study.height = study.depth = 100000;
    expectSceneRefused(input("huge.nrrd", header(study)), {"huge.nrrd"});
    study.width = study.height = study.depth = 2000000000;
    expectSceneRefused(input("overflow.nrrd", header(study)), {"overflow.nrrd"});
    for (const double spacing : {0.0, -1.0}) {
        study = {};
        study.spacing_mm = spacing;
        if (spacing < 0) {  // a negative direction is a mirrored axis; a negative spacing is nonsense
            expectSceneRefused(input("negative.nrrd",
                                     "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 4 4\nspacings: 1 -1 1\n"
                                     "encoding: raw\nendian: little\n\n" +
                                         std::string(128, '\0')),
                               {"negative.nrrd"});
        } else {
            expectSceneRefused(nrrd("zero.nrrd", study, [](int, int, int) { return 0; }), {"zero.nrrd"});
        }
    }
    study = {};
    study.depth = 1;
    expectSceneRefused(nrrd("slice.nrrd", study, [](int i, int, int) { return i; }), {"slice.nrrd"});
}

TEST_F(VolumeBadInput, NothingToFlyThrough) {
    expectSceneRefused(nrrd("air.nrrd", {}, [](int i, int, int) { return -1000 + i % 2; }),
                       {"air.nrrd", "nothing but air", "--isosurface"});
    // Tissue with one cold corner, so that it counts as CT in HU.
    expectSceneRefused(
        nrrd("tissue.nrrd", {}, [](int i, int j, int k) { return i + j + k == 0 ? -1000 : 40 + i % 2; }),
        {"tissue.nrrd", "nothing like a colon", "1 piece outside a body", "--seed", "--isosurface"});
    expectSceneRefused(nrrd("flesh.nrrd", {}, [](int i, int, int) { return i == 0 ? -600 : 40; }),
                       {"flesh.nrrd", "no air", "--isosurface"});
}

TEST_F(VolumeBadInput, MasksOfSeveralLabels) {
    const auto labels = [](int i, int j, int k) { return inTube(i, j, k) ? 1 + k / 12 : 0; };
    const std::string mask = nrrd("labels.nrrd", {24, 24, 24, 2, "uchar", ""}, labels);
    expectSceneRefused(mask, {"labels.nrrd", "--label"});
    expectSceneRefused(mask, {"labels.nrrd", "7"}, {"--label", "7"});
    expectSceneRefused(mask, {"--label"}, {"--label", "x"});
}

TEST_F(VolumeBadInput, SeedsThatHitNothing) {
    const std::string mask = maskedTube();
    expectSceneRefused(mask, {"tube.nrrd", "--seed 500,0,0", "outside"}, {"--seed", "500,0,0"});
    for (const std::string seed : {"1,2", "1,2,3,4", "a,b,c", "1,2,", "nan,1,2", "", "1,,2", "1 2 3"})
        expectSceneRefused(mask, {"--seed"}, {"--seed", seed});
}

TEST_F(VolumeBadInput, TransferFunctionsThatCanNotBe) {
    const std::string mask = maskedTube();
    expectSceneRefused(mask, {"nowhere.txt", "wall_95"}, {"--transfer", "nowhere.txt"});
    expectSceneRefused(ball(), {"nowhere.txt", "wall_95"}, {"--isosurface", "--transfer", "nowhere.txt"});
    const std::string unsorted = input("unsorted.txt", "reference_mm 1\n100 1 1 1 0.5\n-100 1 1 1 0.5\n");
    expectSceneRefused(mask, {"unsorted.txt", "3"}, {"--transfer", unsorted});
    const std::string nan = input("nan.txt", "reference_mm 1\n-100 1 1 1 0.5\nnan 1 1 1 0.5\n");
    expectSceneRefused(mask, {"nan.txt", "3"}, {"--transfer", nan});
    expectSceneRefused(mask, {"empty.txt"}, {"--transfer", input("empty.txt", "")});
    // In one word, while the command line is read.
    for (const std::string curve :
         {"curve:", "curve:0:1:1:1", "curve:0:1:1:1:2", "curve:nan:1:1:1:0", "curve:5:1:1:1:0,5:1:1:1:1",
          "curve:0:1:1:red:1", "curve:reference_mm:0,0:1:1:1:1"})
        expectSceneRefused(mask, {"--transfer", "part ", "curve:VALUE:RED:GREEN:BLUE:OPACITY"},
                           {"--transfer", curve});
    const std::string scene =
        input("curve.toml", "scene = \"" + mask + "\"\n\n[options]\ntransfer = \"curve:0:1:1:1:2\"\n");
    expectSceneRefused(scene, {"curve.toml:4", "transfer", "part 1", "an opacity in 0 to 1, got 2"});
    for (const std::string opacity : {"0", "-1", "1.5", "nan"})
        expectSceneRefused(mask, {"--opacity"}, {"--opacity", opacity});
    expectSceneRefused(mask, {"--opacity", "--transfer"}, {"--opacity", "0.5", "--transfer", nan});
}

TEST_F(VolumeBadInput, PathsThatLeaveTheLumen) {
    const std::string mask = maskedTube();
    const std::string astray = input("astray.path", "0 0 0 0 0 0 0 1\n1 0.02 0.02 0 0 0 0 1\n");
    expectRefused({"play", mask, "--size", "32x24", "--path", astray, "--frames", "2", "--out", "frames"},
                  {"astray.path", "pose 2", "inside"});
    expectRefused({"compare", mask, "--size", "32x24", "--path", astray, "--json", "out.json"},
                  {"astray.path", "pose 2", "inside"});
}

TEST_F(VolumeBadInput, OptionsOfAnotherKindOfScene) {
    for (const std::vector<std::string>& option : {std::vector<std::string>{"--series", "2"},
                                                   {"--label", "1"},
                                                   {"--seed", "1,2,3"},
                                                   {"--mask-smoothing", "1"},
                                                   {"--resample"},
                                                   {"--isosurface"},
                                                   {"--isovalue", "3"},
                                                   {"--transfer", "x.txt"},
                                                   {"--opacity", "0.5"},
                                                   {"--backwards"},
                                                   {"--no-cache"}})
        expectSceneRefused(hills(), {option.front(), "terrain"}, option);
    for (const std::vector<std::string>& option : {std::vector<std::string>{"--vertical-scale", "2"},
                                                   {"--open-holes"},
                                                   {"--image", "x.png"},
                                                   {"--sun", "90,30"}})
        expectSceneRefused("colon", {option.front(), "study"}, option);
    expectSceneRefused("colon", {"--sky", "--light"}, {"--sky", "x.png"});
    expectSceneRefused("colon", {"--series"}, {"--series", "1"});
    expectSceneRefused("colon", {"--label"}, {"--label", "1"});
    expectSceneRefused("colon", {"--isosurface"}, {"--isosurface", "--seed", "1,2,3"});
    expectRefused({"mesh", "colon", "--out", "a.glb"}, {"terrain"});
    expectRefused({"mesh", maskedTube(), "--out", "a.glb"}, {"tube.nrrd", "terrain"});
    expectSceneRefused(maskedTube(), {"--isovalue", "--isosurface"}, {"--isovalue", "3"});
    expectSceneRefused(ball(), {"--isovalue"}, {"--isovalue", "nan"});
}

}  // namespace
}  // namespace stereonav::test
