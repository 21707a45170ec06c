// NRRD, NIfTI and MetaImage: voxels, frames and values as the file has them. What can not be read:
// study_damaged_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "../camera/temporary_folder.h"
#include "../support/read_study.h"
#include "../support/volume_files.h"
#include "colon/study/study.h"
#include "study_ramp.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using namespace test;

TEST(StudyNrrd, KeepsVoxelsAndFrame) {
    const TemporaryFolder folder;
    const Study study = read(writeNrrd(folder / "a.nrrd", kShortLines, bytesOfSamples(ramp<short>())));
    EXPECT_EQ(study.format, "NRRD");
    expectRamp(study);
    expectNear(study.grey.frame.spacing, {0.0005, 0.0006, 0.002}, 1e-12);
    expectNear(study.grey.frame.origin, {0.007, 0.008, 0.009}, 1e-12);
    expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), {0.009, 0.0098, 0.013});
}

TEST(StudyNrrd, TurnsRightAnteriorSuperiorIntoThePatientsAxes) {
    const TemporaryFolder folder;
    const std::string lines = replaced(kShortLines, "left-posterior-superior", "right-anterior-superior");
    const Study study = read(writeNrrd(folder / "a.nrrd", lines, bytesOfSamples(ramp<short>())));
    expectRamp(study);
    expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), {-0.009, -0.0098, 0.013});
}

TEST(StudyNrrd, ReadsDetachedSlicesAndASpaceWithoutDirections) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    for (int k = 0; k < 3; ++k) writeBytes(folder / ("s." + std::to_string(k + 1)), bytes.substr(40 * k, 40));
    const std::string lines =
        "dimension: 3\nsizes: 5 4 3\nspacings: 3.2 3.2 1.5\nendian: little\ntype: short\nencoding: raw\n"
        "space: 3D-left-handed\ndata file: s.%d 1 3 1\n";
    const Study study = read(writeNrrd(folder / "a.nhdr", lines, ""));
    expectRamp(study);
    expectNear(study.grey.frame.spacing, {0.0032, 0.0032, 0.0015}, 1e-12);
    ASSERT_EQ(study.notes.size(), 1u);
    EXPECT_THAT(study.notes[0], HasSubstr("space"));
    fs::remove(folder / "s.2");
    expectError(folder / "a.nhdr", {"s.2", "can not be opened"});
}

TEST(StudyNrrd, ReadsASpaceWithoutDirectionsWithItsSamples) {
    const TemporaryFolder folder;
    for (const bool gzip : {false, true}) {
        const std::string bytes = bytesOfSamples(ramp<short>());
        const std::string lines =
            "type: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 5 4 3\n"
            "spacings: 1 2 3\nendian: little\nencoding: " +
            std::string(gzip ? "gzip" : "raw") + "\n";
        const Study study = read(writeNrrd(folder / "a.nrrd", lines, gzip ? gzipped(bytes) : bytes));
        expectRamp(study);
        expectNear(study.grey.frame.spacing, {0.001, 0.002, 0.003}, 1e-12);
    }
}

TEST(StudyNifti, TurnsItsAxesIntoThePatients) {
    const TemporaryFolder folder;
    const std::string bytes =
        niftiBytes(kSize, {0.5, 0.75, 2}, {10, 20, 30}, DT_INT16, 16, bytesOfSamples(ramp<short>()));
    writeBytes(folder / "a.nii", bytes);
    writeBytes(folder / "b.nii.gz", gzipped(bytes));
    for (const char* name : {"a.nii", "b.nii.gz"}) {
        const Study study = read(folder / name);
        EXPECT_EQ(study.format, "NIfTI");
        expectRamp(study);
        // RAS (10 + 0.5 i, 20 + 0.75 j, 30 + 2 k) in millimetres, with the first two turned round.
        expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), {-0.012, -0.02225, 0.034}, 1e-8);
        expectNear(study.grey.frame.worldFromVoxel({0, 0, 0}), {-0.010, -0.020, 0.030}, 1e-8);
    }
}

// Every number of the header the other way around, as machines of the other byte order wrote it.
TEST(StudyNifti, ReadsTheOtherByteOrder) {
    const TemporaryFolder folder;
    std::string bytes =
        niftiBytes(kSize, {0.5, 0.75, 2}, {10, 20, 30}, DT_INT16, 16, bytesOfSamples(ramp<short>()));
    const auto turn = [&](std::size_t from, std::size_t to, std::size_t size) {
        for (std::size_t at = from; at < to; at += size)
            std::reverse(bytes.begin() + static_cast<long>(at), bytes.begin() + static_cast<long>(at + size));
    };
    using H = nifti_1_header;
    turn(0, 4, 4);
    turn(offsetof(H, dim), offsetof(H, intent_p1), 2);
    turn(offsetof(H, intent_p1), offsetof(H, intent_code), 4);
    turn(offsetof(H, intent_code), offsetof(H, pixdim), 2);
    turn(offsetof(H, pixdim), offsetof(H, slice_end), 4);
    turn(offsetof(H, qform_code), offsetof(H, quatern_b), 2);
    turn(offsetof(H, quatern_b), offsetof(H, intent_name), 4);
    turn(352, bytes.size(), 2);
    writeBytes(folder / "a.nii", bytes);
    const Study study = read(folder / "a.nii");
    expectRamp(study);
    expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), {-0.012, -0.02225, 0.034}, 1e-8);
}

TEST(StudyMeta, KeepsVoxelsAndFrameWithAndWithoutDetachedData) {
    const TemporaryFolder folder;
    const std::string lines =
        "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 7 8 9\nElementSpacing = 0.5 0.6 2\nDimSize = 5 4 3\n"
        "ElementType = MET_SHORT\n";
    const std::string bytes = bytesOfSamples(ramp<short>());
    writeMeta(folder / "a.mha", lines, bytes);
    writeBytes(folder / "b.raw", bytes);
    writeBytes(folder / "b.mhd",
               "ObjectType = Image\nNDims = 3\nBinaryData = True\n" + lines + "ElementDataFile = b.raw\n");
    for (const char* name : {"a.mha", "b.mhd"}) {
        const Study study = read(folder / name);
        EXPECT_EQ(study.format, "MetaImage");
        expectRamp(study);
        expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), {0.009, 0.0098, 0.013});
    }
    writeBytes(folder / "b.raw", bytes.substr(1));
    expectError(folder / "b.mhd", {"cut off", "120 bytes", "found 119"});
}

template <typename T>
Study readAs(const std::string& type, const std::vector<T>& values, const StudyOptions& options = {}) {
    const TemporaryFolder folder;
    return read(writeNrrd(folder / "a.nrrd", replaced(kShortLines, "short", type), bytesOfSamples(values)),
                options);
}

TEST(StudyValues, KeepsWhatFitsAndScalesTheRestWithoutClipping) {
    expectRamp(readAs("signed char", ramp<signed char>(-40, 2)), -40, 2);
    expectRamp(readAs("unsigned char", ramp<unsigned char>(3, 4)), 3, 4);
    expectRamp(readAs("int", ramp<int>()));
    expectRamp(readAs("float", ramp<float>()));
    expectRamp(readAs("double", ramp<double>()));
    expectRamp(readAs("unsigned short", ramp<unsigned short>(1000, 1000)), 1000, 1000);  // to 60,000: moved
    for (const auto& [start, step] : {std::pair(-1e9, 3.4e7), {0.125, 0.01}, {-3e-9, 1e-10}}) {
        const Study study = readAs("double", ramp<double>(start, step));
        const GreyVolume& grey = study.grey;
        EXPECT_EQ(study.notes.size(), 1u);
        for (int n = 0; n < 60; ++n)
            EXPECT_NEAR(grey.values[n] * grey.scale + grey.offset, start + step * n,
                        59 * step / 65535 * 0.501);
    }
}

TEST(StudyValues, OneValueOnlyStays) {
    const Study huge = readAs("double", std::vector<double>(60, 1e12));
    for (int n = 0; n < 60; ++n) EXPECT_EQ(huge.grey.values[n] * huge.grey.scale + huge.grey.offset, 1e12);
    const Study zero = readAs("short", std::vector<short>(60, 0));
    for (int n = 0; n < 60; ++n) EXPECT_EQ(zero.grey.values[n], 0);
}

TEST(StudyValues, ReplacesWhatIsNotANumber) {
    std::vector<float> values = ramp<float>();
    values[7] = std::numeric_limits<float>::quiet_NaN();
    values[59] = std::numeric_limits<float>::infinity();
    const Study study = readAs("float", values);
    EXPECT_EQ(study.grey.values[7], -300);
    EXPECT_EQ(study.grey.values[59], -300);
    EXPECT_EQ(study.grey.values[8], -300 + 8 * 17);
    ASSERT_EQ(study.notes.size(), 1u);
    EXPECT_THAT(study.notes[0], HasSubstr("2 voxels"));
    const TemporaryFolder folder;
    const std::vector<float> none(60, std::numeric_limits<float>::quiet_NaN());
    writeNrrd(folder / "a.nrrd", replaced(kShortLines, "short", "float"), bytesOfSamples(none));
    expectError(folder / "a.nrrd", {"no voxel holds a number"});
}

TEST(StudyMask, TwoValuesMakeAMask) {
    std::vector<unsigned char> values(60, 0);
    for (int n = 20; n < 33; ++n) values[n] = 255;
    const Study study = readAs("unsigned char", values);
    ASSERT_TRUE(study.isMask);
    EXPECT_TRUE(study.grey.empty());
    for (int n = 0; n < 60; ++n) EXPECT_EQ(study.mask.values[n], n >= 20 && n < 33);
}

TEST(StudyMask, OneLabelOfSeveralIsChosen) {
    const TemporaryFolder folder;
    std::vector<unsigned char> values(60, 0);
    for (int n = 10; n < 30; ++n) values[n] = 4;
    for (int n = 40; n < 55; ++n) values[n] = 9;
    writeNrrd(folder / "a.nrrd", replaced(kShortLines, "short", "unsigned char"), bytesOfSamples(values));
    expectError(folder / "a.nrrd", {"several labels: 4, 9", "--label N"});
    StudyOptions options;
    options.label = "9";
    const Study study = read(folder / "a.nrrd", options);
    ASSERT_TRUE(study.isMask);
    for (int n = 0; n < 60; ++n) EXPECT_EQ(study.mask.values[n], values[n] == 9);
    options.label = "5";
    expectError(folder / "a.nrrd", {"label 5 is not in the mask", "4, 9"}, options);
    writeNrrd(folder / "grey.nrrd", kShortLines, bytesOfSamples(ramp<short>()));
    expectError(folder / "grey.nrrd", {"found grey values"}, options);
}

TEST(StudyMask, IsWrittenAndReadBackEqual) {
    const TemporaryFolder folder;
    VolumeFrame frame;
    frame.size = {37, 23, 19};
    frame.spacing = {0.00071234567890123, 0.0008, 0.00125};
    frame.origin = {-0.123456789012345, 0.2, 1.5};
    const double c = std::cos(0.3), s = std::sin(0.3);
    frame.axes = glm::dmat3({c, s, 0}, {-s, c, 0}, {0, 0, -1});
    MaskVolume mask(frame);
    unsigned state = 1;
    for (std::size_t n = 0; n < frame.count(); ++n)
        mask.values[n] = (state = state * 1664525 + 1013904223) >> 30 == 0;
    fs::create_directory(folder / "new");
    writeMask(folder / "new" / "m.nrrd", mask, "made\nby a test");
    const Study study = read(folder / "new/m.nrrd");
    ASSERT_TRUE(study.isMask);
    EXPECT_EQ(study.description, "made by a test");
    EXPECT_EQ(study.mask.frame.size, frame.size);
    expectNear(study.mask.frame.spacing, frame.spacing);
    expectNear(study.mask.frame.origin, frame.origin);
    for (int axis = 0; axis < 3; ++axis) expectNear(study.mask.frame.axes[axis], frame.axes[axis]);
    for (std::size_t n = 0; n < frame.count(); ++n) ASSERT_EQ(study.mask.values[n], mask.values[n]);
}

TEST(StudyKey, IsTheSameWithoutDecodingAndChangesWithContentAndOptions) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    const fs::path file = writeNrrd(folder / "a.nrrd", kShortLines, bytes);
    const std::uint64_t key = studyKey(file, {});
    EXPECT_EQ(read(file).key, key);
    StudyOptions resample, label;
    resample.resample = true;
    label.label = "1";
    EXPECT_NE(studyKey(file, resample), key);
    EXPECT_NE(studyKey(file, label), key);
    writeNrrd(folder / "same.nrrd", kShortLines, bytes);
    EXPECT_EQ(studyKey(folder / "same.nrrd", {}), key);
    writeNrrd(file, kShortLines, replaced(bytes, bytes.substr(50, 1), "x"));
    EXPECT_NE(studyKey(file, {}), key);
    const std::string detached = replaced(kShortLines, "encoding", "data file: d.raw\nencoding");
    writeNrrd(folder / "d.nhdr", detached, "");
    writeBytes(folder / "d.raw", bytes);
    const std::uint64_t before = studyKey(folder / "d.nhdr", {});
    EXPECT_EQ(read(folder / "d.nhdr").key, before);
    writeBytes(folder / "d.raw", "y" + bytes.substr(1));
    EXPECT_NE(studyKey(folder / "d.nhdr", {}), before);
}

TEST(StudyMeta, CompressedSamplesAreReadAndCounted) {
    const TemporaryFolder folder;
    std::vector<short> values = ramp<short>();
    std::string packed(compressBound(120), '\0');
    uLongf length = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(values.data()),
             120);
    packed.resize(length);
    const std::string lines = "CompressedData = True\nCompressedDataSize = " + std::to_string(length) +
                              "\nDimSize = 5 4 3\nElementType = MET_SHORT\nElementSpacing = 1 1 1\n";
    expectRamp(read(writeMeta(folder / "a.mha", lines, packed)));
    writeMeta(folder / "a.mha", lines, packed.substr(0, packed.size() / 2));
    expectError(folder / "a.mha", {"cut off", "120 bytes", "found "});
}

// A field that is linear in space stays what it is when a sheared grid is stood upright.
TEST(StudyShear, IsRefusedAndStoodUprightOnRequest) {
    const TemporaryFolder folder;
    const glm::dvec3 a(0.5, 0, 0), b(0, 0.5, 0), c(0, 0.4, 1.0);  // millimetres
    const auto field = [](const glm::dvec3& mm) { return 500 + 100 * mm.x + 200 * mm.y - 300 * mm.z; };
    std::vector<short> values;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 5; ++i)
                values.push_back(
                    static_cast<short>(std::lround(field(a * double(i) + b * double(j) + c * double(k)))));
    writeNrrd(folder / "a.nrrd",
              replaced(replaced(kShortLines, "(0.5,0,0) (0,0.6,0) (0,0,2)", "(0.5,0,0) (0,0.5,0) (0,0.4,1)"),
                       "(7,8,9)", "(0,0,0)"),
              bytesOfSamples(values));
    expectError(folder / "a.nrrd", {"slices 1 to 3", "21.80 degrees", "--resample"});
    StudyOptions options;
    options.resample = true;
    const Study study = read(folder / "a.nrrd", options);
    const VolumeFrame& frame = study.grey.frame;
    EXPECT_EQ(frame.size, glm::ivec3(5, 6, 3));
    expectNear(frame.axes[2], {0, 0, 1});
    ASSERT_EQ(study.notes.size(), 1u);
    int covered = 0;
    const double least = *std::min_element(values.begin(), values.end());
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < 5; ++i) {
                const glm::dvec3 mm = 1e3 * frame.worldFromVoxel(glm::dvec3(i, j, k));
                const double row = (mm.y - 0.4 * mm.z) / 0.5;
                const bool inside = row > -1e-6 && row < 3 + 1e-6;
                covered += inside;
                EXPECT_NEAR(study.grey.at(i, j, k), inside ? field(mm) : least, 1.01);
            }
    EXPECT_GT(covered, 40);
}

TEST(StudyProgress, ReportsAndStops) {
    const TemporaryFolder folder;
    const fs::path file = writeNrrd(folder / "a.nrrd", kShortLines, bytesOfSamples(ramp<short>()));
    std::vector<double> fractions;
    Progress progress([&](double fraction, const std::string&) { fractions.push_back(fraction); });
    readStudy(file, {}, progress);
    ASSERT_GE(fractions.size(), 3u);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.back(), 1);
    progress.cancel();
    EXPECT_THROW(readStudy(file, {}, progress), Cancelled);
}

TEST(StudyNames, AreKnownWithoutReading) {
    const TemporaryFolder folder;
    for (const char* name : {"a.nrrd", "A.NHDR", "b.nii", "b.nii.gz", "c.mha", "c.mhd"})
        EXPECT_TRUE(looksLikeStudy(folder / name)) << name;
    for (const char* name : {"a.tif", "a.gz", "scene.toml", ""})
        EXPECT_FALSE(looksLikeStudy(folder / name)) << name;
    writeBytes(folder / "IM0001", "x");
    EXPECT_TRUE(looksLikeStudy(folder / ""));
}

}  // namespace
}  // namespace stereonav
