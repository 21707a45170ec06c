// Studies by every name they go by, through the real program: what `info` says of a file is the file's, and
// what can not be read is one line.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/dicom_files.h"
#include "../support/nifti_files.h"
#include "engine/image/image_file.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class StudyCommands : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    Outcome runWell(const std::vector<std::string>& arguments) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome;
    }
    Json info(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"info", "--size", "64x48", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return Json::parse(runWell(arguments).out).at("volume");
    }
    std::filesystem::path placeOf(const std::string& name) const { return mFolder / name; }
};

TEST_F(StudyCommands, InfoGivesTheStudysVoxelsAndThoseKept) {
    // The tube in a corner of a larger block.
    const std::string study = nrrd("tube.nrrd", {60, 50, 40, 2, "uchar", ""},
                                   [](int i, int j, int k) { return k < 24 && inTube(i, j, k) ? 1 : 0; });
    for (const bool cached : {false, true}) {
        SCOPED_TRACE(cached);
        const Json volume = info({study});
        EXPECT_EQ(volume.at("study").at("size"), Json({60, 50, 40}));
        EXPECT_EQ(volume.at("study").at("origin_mm"), Json({-24.0, -24.0, -24.0}));
        EXPECT_LT(volume.at("size")[0].get<int>(), 60);
        const std::string text = runWell({"info", study, "--size", "48x36"}).out;
        EXPECT_THAT(text, HasSubstr("60 x 50 x 40\n"));
        EXPECT_THAT(text, HasSubstr("of them around the lumen are kept"));
    }
    const Json outside = info({ball()});  // with a border for the surface
    EXPECT_EQ(outside.at("study").at("size"), Json({24, 24, 24}));
    EXPECT_EQ(outside.at("size"), Json({26, 26, 26}));
    EXPECT_THAT(runWell({"info", ball(), "--size", "48x36"}).out, HasSubstr("24 x 24 x 24\n"));
}

TEST_F(StudyCommands, ScaledNiftiIsRead) {
    NiftiSpec s;
    s.sformCode = 1;
    s.slope = 0.5;
    std::vector<short> samples;
    for (int n = 0; n < 60; ++n) samples.push_back(static_cast<short>(-300 + 17 * n));
    const Json volume = info({input("a.nii", niftiFile(samples, s)), "--isosurface"});
    EXPECT_EQ(volume.at("range"), Json({-150.0, 351.5}));
    EXPECT_EQ(volume.at("study").at("size"), Json({5, 4, 3}));
}

// The program's own choice is never refused as if it had been asked for.
TEST_F(StudyCommands, ValuesOfAirAloneHaveASurface) {
    const std::string study =
        nrrd("air.nrrd", {}, [](int i, int j, int k) { return i + j + k < 30 ? -1000 : -600; });
    const Json volume = info({study, "--isosurface"});
    EXPECT_GT(volume.at("isovalue").get<double>(), -1000);
    EXPECT_LT(volume.at("isovalue").get<double>(), -600);
}

TEST_F(StudyCommands, OneDicomFileByName) {
    DicomSpec s;
    for (int k = 0; k < 3; ++k) s.frames.emplace_back(10, 20, 30 + 2 * k);
    for (int n = 0; n < 90; ++n) s.slice.pixels.push_back(static_cast<std::uint16_t>(n * 40));
    writeDicom(placeOf("many.dcm"), s);
    const Json volume = info({placeOf("many.dcm").string(), "--isosurface"});
    EXPECT_EQ(volume.at("study").at("size"), Json({6, 5, 3}));
    EXPECT_EQ(volume.at("range"), Json({-1024.0, -1024.0 + 89 * 40}));
    s.frames.clear();
    writeDicom(placeOf("series/one.dcm"), s);
    expectRefused({"info", placeOf("series/one.dcm").string()},
                  {"one.dcm", "2 or more slices, found 1", "give the folder"});
}

TEST_F(StudyCommands, SlicesBesideGroundAreOpenedAndSaySo) {
    for (int k = 0; k < 3; ++k) {
        DicomSpec s;
        s.slice.position.z = 2 * k;
        for (int n = 0; n < 30; ++n) s.slice.pixels.push_back(static_cast<std::uint16_t>(n * 40));
        writeDicom(placeOf("mixed/" + std::to_string(k) + ".dcm"), s);
    }
    const std::vector<std::string> words{"info", placeOf("mixed").string(), "--isosurface", "--size",
                                         "48x36"};
    EXPECT_THAT(runWell(words).out, testing::Not(HasSubstr("left aside")));
    std::ofstream(placeOf("mixed/relief.tif")) << "heights";
    EXPECT_THAT(runWell(words).out, AllOf(HasSubstr("6 x 5 x 3"), HasSubstr("left aside: elevation files")));
}

TEST_F(StudyCommands, EverySeriesHasAPicture) {
    for (int k = 0; k < 3; ++k) {  // CT: air above, bone below
        DicomSpec s;
        s.slice.position.z = 3 * k;
        s.slice.pixels.assign(30, 24);
        if (k == 1)
            for (std::size_t n = 15; n < 30; ++n) s.slice.pixels[n] = 1574;
        writeDicom(placeOf("s/ct" + std::to_string(k)), s);
        s = {};  // MR: rows twice as far apart as columns, from dark to bright
        s.slice.uid = "1.2.3.2";
        s.slice.modality = "MR";
        s.slice.description = "another";
        s.slice.columns = 5;
        s.slice.rows = 4;
        s.slice.spacing = {1, 2};
        s.slice.position.z = 2 - k;
        for (int n = 0; n < 20; ++n) s.slice.pixels.push_back(static_cast<std::uint16_t>(n / 5 * 100 + k));
        writeDicom(placeOf("s/mr" + std::to_string(k)), s);
        s.slice.uid = "1.2.3.3";
        s.pixelLength = 0xfffffff0;
        writeDicom(placeOf("s/broken" + std::to_string(k)), s);
    }
    const std::string folder = placeOf("s").string(), pictures = placeOf("pictures").string();
    const Outcome outcome = runWell({"info", folder, "--series-pictures", pictures, "--json"});
    const Json list = Json::parse(outcome.out).at("series");
    ASSERT_EQ(list.size(), 3u);
    EXPECT_EQ(list[0].at("modality"), "CT");
    EXPECT_EQ(list[1].at("description"), "another");
    EXPECT_EQ(list[1].at("slices"), 3);
    EXPECT_THAT(list[2].at("problem").get<std::string>(), HasSubstr("broken1"));
    EXPECT_FALSE(list[2].contains("picture"));
    const Plane<PackedColor> ct = readColorImage(list[0].at("picture").get<std::string>());
    EXPECT_EQ(ct.at(0, 0), packColor(glm::vec3(0)));
    EXPECT_EQ(ct.height(), 4) << "rows lie nearer than columns";
    EXPECT_EQ(ct.at(5, 3), packColor(glm::vec3(1)));
    const Plane<PackedColor> mr = readColorImage(list[1].at("picture").get<std::string>());
    EXPECT_EQ(mr.width(), 5);
    EXPECT_EQ(mr.height(), 8);
    EXPECT_EQ(mr.at(2, 0), packColor(glm::vec3(0)));
    EXPECT_EQ(mr.at(2, 7), packColor(glm::vec3(1)));
    EXPECT_THAT(runWell({"info", folder, "--series-pictures", pictures}).out,
                AllOf(HasSubstr("1   3 slices of 6 x 5  CT  \"made for a test\""), HasSubstr("series_2.png"),
                      HasSubstr("broken1")));
    expectRefused({"info", folder}, {"holds 3 series", "--series N", "--series-pictures DIR"});
    expectRefused({"info", "colon", "--series-pictures", pictures}, {"--series-pictures", "DICOM"});
    expectRefused({"info", folder, "--series-pictures", placeOf("no/where").string()}, {"--series-pictures"});
}

TEST_F(StudyCommands, PartsOfAVolumeNameTheirHeader) {
    std::string header = VolumeTest::header({});
    header.insert(header.size() - 1, "data file: part.%d 1 24 1\n");
    input("whole.nhdr", header);
    for (int k = 1; k <= 24; ++k) input("part." + std::to_string(k), std::string(24 * 24 * 2, '\0'));
    expectRefused({"info", placeOf("part.3").string()},
                  {"part.3", "whole.nhdr is their header", "give that file"});
}

TEST_F(StudyCommands, ASeriesOfAVolumeFileIsRefused) {
    expectRefused({"info", maskedTube(), "--series", "9"}, {"--series", "tube.nrrd", "leave it out"});
}

TEST_F(StudyCommands, DamagedSlicesAndDirectoriesAreOneLine) {
    for (int k = 0; k < 4; ++k) {
        DicomSpec s;
        s.slice.position.z = k;
        if (k == 2) s.pixelLength = 0xfffffff0;
        writeDicom(placeOf("s/" + std::to_string(k) + ".dcm"), s);
    }
    expectRefused({"info", placeOf("s").string()}, {"2.dcm is damaged", "4294967280 bytes of pixels"});
    // A directory whose record has no place, over which GDCM ends the program.
    DicomBytes set(DicomSyntax::Explicit), record(DicomSyntax::Explicit);
    record.text(0x00041430, "CS", "PATIENT");
    set.sequence(0x00041220, set.item(record.bytes(), true), true);
    std::filesystem::create_directories(placeOf("d"));
    writeBytes(placeOf("d/DICOMDIR"), dicomFile(DicomSyntax::Explicit, set.bytes(), "1.2.840.10008.1.3.10"));
    writeBytes(placeOf("d/other"), dicomFile(DicomSyntax::Explicit, set.bytes(), "1.2.840.10008.1.3.10"));
    expectRefused({"info", placeOf("d").string()}, {"expected DICOM images, found none"});
}

}  // namespace
}  // namespace stereonav::test
