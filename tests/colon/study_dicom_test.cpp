// DICOM folders: slices in order of place, HU, and one clear line that names the slices for all that would
// bend the anatomy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "../camera/temporary_folder.h"
#include "../support/read_study.h"
#include "../support/volume_files.h"
#include "colon/study/study.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using namespace test;

StudyOptions resampling() {
    StudyOptions options;
    options.resample = true;
    return options;
}

// Returns HU that are linear in space (millimetres).
double field(const glm::dvec3& mm) {
    return 10 * mm.x - 20 * mm.y + 5 * mm.z;
}

glm::dvec3 pixelPlace(const SliceSpec& s, int i, int j) {
    return s.position + s.along * (s.spacing.x * i) + s.down * (s.spacing.y * j);
}

void fillWithField(SliceSpec& s) {
    s.pixels.clear();
    for (int j = 0; j < s.rows; ++j)
        for (int i = 0; i < s.columns; ++i)
            s.pixels.push_back(static_cast<std::uint16_t>(std::lround(field(pixelPlace(s, i, j)) + 1024)));
}

// Slices at these heights along z, named so that the names' order is not that of the heights.
void writeSeries(const fs::path& folder, const std::vector<double>& heights, const SliceSpec& base = {},
                 const glm::dvec2& shiftPerMillimetre = glm::dvec2(0.0)) {
    for (std::size_t n = 0; n < heights.size(); ++n) {
        SliceSpec s = base;
        const double rise = heights[n] - heights[0];
        s.position += glm::dvec3(shiftPerMillimetre.x * rise, shiftPerMillimetre.y * rise, heights[n]);
        fillWithField(s);
        writeSlice(folder / ("s" + std::to_string(n * 7 % 10) + ".dcm"), s);
    }
}

void expectField(const GreyVolume& grey, double tolerance) {
    const glm::ivec3 size = grey.frame.size;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                EXPECT_NEAR(grey.at(i, j, k), field(1e3 * grey.frame.worldFromVoxel(glm::dvec3(i, j, k))),
                            tolerance);
}

TEST(StudyDicom, SlicesAreOrderedByPlaceAndInHu) {
    const TemporaryFolder folder;
    writeSeries(folder / "s", {0, 1.5, 3, 4.5, 6});
    const Study study = read(folder / "s");
    EXPECT_EQ(study.format, "DICOM");
    EXPECT_EQ(study.description, "CT, made for a test");
    EXPECT_TRUE(study.notes.empty());
    const VolumeFrame& frame = study.grey.frame;
    ASSERT_EQ(frame.size, glm::ivec3(6, 5, 5));
    EXPECT_NEAR(frame.spacing.x, 0.0008, 1e-12);
    EXPECT_NEAR(frame.spacing.y, 0.0007, 1e-12);
    EXPECT_NEAR(frame.spacing.z, 0.0015, 1e-12);
    EXPECT_NEAR(frame.origin.z, 0.030, 1e-12);
    expectField(study.grey, 0.501);
    EXPECT_EQ(study.key, studyKey(folder / "s", {}));
    EXPECT_NE(study.key, studyKey(folder / "s", resampling()));
    EXPECT_TRUE(looksLikeStudy(folder / "s"));
}

TEST(StudyDicom, AirIsLookedForAsSlicesCome) {
    const TemporaryFolder folder;
    writeSeries(folder / "s", {0, 1.5, 3, 4.5, 6});
    StudyOptions options;
    EXPECT_FALSE(read(folder / "s", options).air);
    options.key = 7;
    for (const double limit : {-2000.0, -1000.0, -900.0, 5000.0}) {
        options.airBelow = limit;
        const Study study = read(folder / "s", options);
        EXPECT_EQ(study.key, 7u);
        ASSERT_TRUE(study.air);
        EXPECT_EQ(study.air->rowStart, runsBelow(study.grey, limit).rowStart) << limit;
        EXPECT_EQ(study.air->voxelCount(), runsBelow(study.grey, limit).voxelCount()) << limit;
    }
}

TEST(StudyDicom, SlicesAcrossThePatientKeepTheirOrientation) {
    const TemporaryFolder folder;
    SliceSpec s;
    s.along = {0, 1, 0};
    s.down = {0, 0, -1};  // sagittal: the normal is -x
    for (int k = 0; k < 4; ++k) {
        s.position = {10.0 - 2 * k, 20, 30};
        fillWithField(s);
        writeSlice(folder / ("s/" + std::to_string(9 - k)), s);
    }
    const Study study = read(folder / "s");
    EXPECT_NEAR(glm::length(study.grey.frame.axes[2] - glm::dvec3(-1, 0, 0)), 0, 1e-12);
    expectField(study.grey, 0.501);
}

TEST(StudyDicom, SlopeSignAndUnusedBitsCount) {
    const TemporaryFolder folder;
    SliceSpec s;
    s.slope = "2";
    s.intercept = "-100";
    s.isSigned = true;
    s.bitsStored = 12;
    s.pixels.assign(30, 0);
    s.pixels[3] = 0xff6a & 0x0fff;  // -150 in 12 bits
    s.pixels[4] = 700;
    for (int k = 0; k < 3; ++k) {
        s.position.z = k;
        writeSlice(folder / ("s/" + std::to_string(k)), s);
    }
    const Study study = read(folder / "s");
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(study.grey.at(3, 0, k), -400);
        EXPECT_EQ(study.grey.at(4, 0, k), 1300);
        EXPECT_EQ(study.grey.at(5, 0, k), -100);
    }
}

TEST(StudyDicom, FractionsOfAnotherModalityAreKept) {
    const TemporaryFolder folder;
    SliceSpec s;
    s.modality = "PT";
    s.slope = "0.001";
    s.intercept = "0";
    for (int n = 0; n < 30; ++n) s.pixels.push_back(static_cast<std::uint16_t>(n * 2000));
    for (int k = 0; k < 3; ++k) {
        s.position.z = k;
        writeSlice(folder / ("s/" + std::to_string(k)), s);
    }
    const GreyVolume grey = std::move(read(folder / "s").grey);
    for (int n = 0; n < 90; ++n) EXPECT_NEAR(grey.values[n] * grey.scale + grey.offset, n % 30 * 2.0, 0.0005);
}

// MONOCHROME1 turns the display round, not the numbers (PS3.3 C.7.6.3.1.2).
TEST(StudyDicom, AnInvertedDisplayLeavesHuAsTheyAre) {
    const TemporaryFolder folder;
    SliceSpec s;
    s.photometric = "MONOCHROME1";
    writeSeries(folder / "s", {0, 1, 2}, s);
    expectField(read(folder / "s").grey, 0.501);
}

TEST(StudyDicom, PaddingOfCtBecomesAir) {
    const TemporaryFolder folder;
    SliceSpec s;
    s.padding = 60000;
    s.pixels.assign(30, 1064);
    s.pixels[0] = 60000;
    s.isSigned = false;
    s.intercept = "-3024";
    for (int n = 1; n < 30; ++n) s.pixels[n] = 3064;
    s.pixels[1] = 0;  // -3024 HU
    for (int k = 0; k < 2; ++k) {
        s.position.z = k;
        writeSlice(folder / ("s/" + std::to_string(k)), s);
    }
    const Study study = read(folder / "s");
    for (int k = 0; k < 2; ++k) {
        EXPECT_EQ(study.grey.at(0, 0, k), -1024);
        EXPECT_EQ(study.grey.at(1, 0, k), -1024);
        EXPECT_EQ(study.grey.at(2, 0, k), 40);
    }
    ASSERT_EQ(study.notes.size(), 1u);
    EXPECT_THAT(study.notes[0], HasSubstr("4 voxels of padding"));
}

TEST(StudyDicom, SeveralSeriesAreListedAndOneIsChosen) {
    const TemporaryFolder folder;
    SliceSpec other;
    other.uid = "1.2.3.2";
    other.description = "the other";
    other.columns = 7;
    writeSeries(folder / "s", {0, 1, 2});
    for (int k = 0; k < 2; ++k) {
        other.position.z = k;
        writeSlice(folder / ("s/other" + std::to_string(k)), other);
    }
    const auto list = lookAtSeries(folder / "s");
    ASSERT_EQ(list.size(), 2u);
    EXPECT_EQ(list[0].info.uid, "1.2.3.1");
    EXPECT_EQ(list[1].info.slices, 2);
    EXPECT_EQ(list[1].info.description, "the other");
    expectError(folder / "s",
                {"2 series", "1: 3 slices \"made for a test\"", "2: 2 slices \"the other\"", "--series N"});
    StudyOptions options;
    std::uint64_t keys[2];
    for (const auto& [name, columns] : {std::pair("1", 6), {"2", 7}, {"1.2.3.1", 6}, {"1.2.3.2", 7}}) {
        options.series = name;
        const Study study = read(folder / "s", options);
        EXPECT_EQ(study.grey.frame.size.x, columns);
        keys[columns - 6] = study.key;
    }
    EXPECT_NE(keys[0], keys[1]);
    options.series = "3";
    expectError(folder / "s", {"no series \"3\"", "2: 2 slices"}, options);
}

TEST(StudyDicom, MissingSlicesAreNamedAndBridged) {
    const TemporaryFolder folder;
    writeSeries(folder / "s", {0, 1, 2, 5, 6, 7});
    expectError(folder / "s",
                {"2 slices are missing between s4.dcm at 32.00 mm and s1.dcm at 35.00 mm", "--resample"});
    const Study study = read(folder / "s", resampling());
    EXPECT_EQ(study.grey.frame.size.z, 8);
    expectField(study.grey, 1.01);
    ASSERT_EQ(study.notes.size(), 1u);
    EXPECT_THAT(study.notes[0], HasSubstr("the largest gap was 3.00 mm"));
}

TEST(StudyDicom, UnevenSlicesAreNamedAndMended) {
    const TemporaryFolder folder;
    writeSeries(folder / "s", {0, 1, 2, 3.4, 4.4, 5.4});
    expectError(folder / "s", {"uneven spacing: 1.40 mm between s4.dcm", "elsewhere 1.00 mm", "--resample"});
    const Study study = read(folder / "s", resampling());
    EXPECT_EQ(study.grey.frame.size.z, 6);
    EXPECT_NEAR(study.grey.frame.spacing.z, 0.001, 1e-12);
    expectField(study.grey, 1.01);
}

TEST(StudyDicom, RepeatedSlicesAreNamed) {
    const TemporaryFolder folder;
    writeSeries(folder / "s", {0, 1, 1, 2});
    expectError(folder / "s", {"repeated slices: s4.dcm and s7.dcm", "31.00 mm"});
    expectError(folder / "s", {"repeated slices"}, resampling());
}

TEST(StudyDicom, GantryTiltIsNamedAndSheared) {
    const TemporaryFolder folder;
    const double slope = std::tan(0.2);  // sideways a millimetre of height: 11.46 degrees
    writeSeries(folder / "s", {0, 2, 4, 6}, {}, {0, slope});
    expectError(folder / "s", {"gantry tilt: slices s0.dcm to s1.dcm", "11.46 degrees", "--resample"});
    const Study study = read(folder / "s", resampling());
    const VolumeFrame& frame = study.grey.frame;
    EXPECT_EQ(frame.size, glm::ivec3(6, 7, 4));
    int covered = 0;
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 7; ++j)
            for (int i = 0; i < 6; ++i) {
                const glm::dvec3 mm = 1e3 * frame.worldFromVoxel(glm::dvec3(i, j, k));
                const double row = (mm.y - 20 - slope * 2 * k) / 0.7;
                if (row < 0 || row > 4) continue;
                ++covered;
                EXPECT_NEAR(study.grey.at(i, j, k), field(mm), 1.01);
            }
    EXPECT_GT(covered, 90);
}

TEST(StudyDicom, MixedSlicesAreNamed) {
    const TemporaryFolder folder;
    for (const int what : {0, 1, 2}) {
        const fs::path place = folder / ("s" + std::to_string(what));
        writeSeries(place, {0, 1, 2});
        SliceSpec odd;
        odd.position.z = 33;
        if (what == 0) odd.rows = 4;
        if (what == 1) odd.spacing = {0.9, 0.7};
        if (what == 2) odd.along = glm::normalize(glm::dvec3(1, 0, 0.1));
        writeSlice(place / "zodd.dcm", odd);
        expectError(place, {"zodd.dcm", what == 2 ? "not parallel" : "mixed sizes"});
    }
}

TEST(StudyDicom, BadFoldersAndSlices) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "empty");
    expectError(folder / "empty", {"expected DICOM images, found none among 0 files"});
    EXPECT_FALSE(looksLikeStudy(folder / "empty"));
    writeBytes(folder / "empty/readme.txt", "hello");
    expectError(folder / "empty", {"found none among 1 files"});
    writeSeries(folder / "one", {0});
    expectError(folder / "one", {"2 or more slices, found 1"});
    SliceSpec flat;
    flat.spacing = {0, 0.7};
    writeSeries(folder / "flat", {0, 1}, flat);
    expectError(folder / "flat", {"spacing of pixels above 0"});
    writeSeries(folder / "cut", {0, 1, 2});
    const std::string bytes = fileBytes(folder / "cut/s7.dcm");
    for (const std::size_t missing : {1, 2, 20, 59}) {
        writeBytes(folder / "cut/s7.dcm", bytes.substr(0, bytes.size() - missing));
        expectError(folder / "cut", {"s7.dcm is cut off: " + std::to_string(missing) + " bytes"});
    }
    // GDCM ends the program over some of these.
    writeSeries(folder / "meta", {0, 1, 2});
    const std::string whole = fileBytes(folder / "meta/s7.dcm");
    ASSERT_EQ(whole.substr(128, 4), "DICM");
    for (const char* damage : {"{I", "--", "\xff\xff", "Ui"}) {
        std::string changed = whole;
        changed.replace(132 + 4, 2, damage);
        writeBytes(folder / "meta/s7.dcm", changed);
        expectError(folder / "meta", {"s7.dcm:byte 132", "header is damaged"});
    }
    for (const std::size_t length : {132, 134, 139, 143}) {
        writeBytes(folder / "meta/s7.dcm", whole.substr(0, length));
        expectError(folder / "meta", {"s7.dcm:byte 1", "header is damaged"});
    }
    // What is no image is left out.
    writeSeries(folder / "extra", {0, 1, 2});
    writeBytes(folder / "extra/notes", "hello");
    EXPECT_EQ(read(folder / "extra").grey.frame.size.z, 3);
}

TEST(StudyDicom, StopsBetweenSlices) {
    const TemporaryFolder folder;
    writeSeries(folder / "s", {0, 1, 2, 3, 4, 5, 6});
    Progress* self = nullptr;
    Progress progress([&](double fraction, const std::string&) {
        if (fraction > 0.15) self->cancel();
    });
    self = &progress;
    EXPECT_THROW(readStudy(folder / "s", {}, progress), Cancelled);
}

fs::path dataFolder() {
    if (const char* given = std::getenv("STEREONAV_TEST_DATA"); given && *given) return given;
    return fs::path(STEREONAV_SOURCE_DIR) / "../shared/data";
}

TEST(StudyReal, TheDicomSeriesReadsInHu) {
    const fs::path folder = dataFolder() / "ct/dicom_series";
    if (!fs::exists(folder)) GTEST_SKIP() << "no " << folder;
    const Study study = read(folder);
    ASSERT_EQ(study.grey.frame.size, glm::ivec3(512, 512, 20));
    EXPECT_NEAR(study.grey.frame.spacing.z, 0.002, 1e-6);
    EXPECT_TRUE(study.notes.empty());
    std::size_t air = 0, tissue = 0;
    const std::size_t count = study.grey.frame.count();
    for (std::size_t n = 0; n < count; ++n) {
        const int hu = study.grey.values[n];
        ASSERT_GE(hu, -1024);
        ASSERT_LE(hu, 4096);
        air += hu < -900;
        tissue += hu > -150 && hu < 150;
    }
    EXPECT_GT(air, count / 10);
    EXPECT_GT(tissue, count / 10);
}

// The last of the slices, compressed, ends early.
TEST(StudyReal, ACompressedSliceThatIsCutOffIsNamed) {
    const fs::path source = dataFolder() / "ct/dicom_series";
    if (!fs::exists(source)) GTEST_SKIP() << "no " << source;
    const TemporaryFolder folder;
    fs::copy(source, folder / "s", fs::copy_options::recursive);
    std::string last;
    for (const auto& entry : fs::directory_iterator(folder / "s"))
        last = std::max(last, entry.path().filename().string());
    const std::string bytes = fileBytes(folder / ("s/" + last));
    fs::remove(folder / ("s/" + last));
    writeBytes(folder / ("s/" + last), bytes.substr(0, bytes.size() / 2));
    expectError(folder / "s", {last, "cut off or damaged"});
}

TEST(StudyReal, TheColonMaskReads) {
    const fs::path file = dataFolder() / "colon/gca00020/large_intestine_mask_clean.nrrd";
    if (!fs::exists(file)) GTEST_SKIP() << "no " << file;
    const Study study = read(file);
    ASSERT_TRUE(study.isMask);
    EXPECT_EQ(study.mask.frame.size, glm::ivec3(411, 332, 635));
    EXPECT_NEAR(study.mask.frame.spacing.x, 0.000808594, 1e-9);
}

TEST(StudyReal, OtherVolumesRead) {
    const fs::path folder = dataFolder() / "ct";
    if (!fs::exists(folder)) GTEST_SKIP() << "no " << folder;
    EXPECT_EQ(read(folder / "engine.nii.gz").grey.frame.size, glm::ivec3(256, 256, 128));
    const Study head = read(folder / "headsq/quarter.nhdr");
    EXPECT_EQ(head.grey.frame.size, glm::ivec3(64, 64, 93));
    EXPECT_EQ(*std::max_element(head.grey.values.data(), head.grey.values.data() + head.grey.frame.count()),
              3926);
    EXPECT_EQ(read(folder / "trunk_ct_3mm.nii.gz").grey.frame.size, glm::ivec3(122, 101, 112));
    expectError(folder / "trunk_ct_3mm_seg30.nii.gz", {"several labels: 1, 2", "--label N"});
    StudyOptions options;
    options.label = "20";
    EXPECT_TRUE(read(folder / "trunk_ct_3mm_seg30.nii.gz", options).isMask);
}

}  // namespace
}  // namespace stereonav
