// NRRD, NIfTI and MetaImage: voxels, frames and values as the file has them, and one clear line for what can
// not be read.
#include <fmt/format.h>
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
#include "colon/study.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using namespace test;

constexpr glm::ivec3 kSize(5, 4, 3);

template <typename T>
std::vector<T> ramp(double start = -300, double step = 17) {
    std::vector<T> values;
    for (int n = 0; n < kSize.x * kSize.y * kSize.z; ++n) values.push_back(static_cast<T>(start + step * n));
    return values;
}

void expectRamp(const Study& study, double start = -300, double step = 17) {
    ASSERT_FALSE(study.isMask);
    ASSERT_EQ(study.grey.frame.size, kSize);
    for (int k = 0, n = 0; k < kSize.z; ++k)
        for (int j = 0; j < kSize.y; ++j)
            for (int i = 0; i < kSize.x; ++i, ++n)
                EXPECT_EQ(study.grey.at(i, j, k) * study.grey.scale + study.grey.offset, start + step * n);
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

const std::string kShortLines =
    "type: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 5 4 3\n"
    "space directions: (0.5,0,0) (0,0.6,0) (0,0,2)\nendian: little\nencoding: raw\nspace origin: (7,8,9)\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

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

TEST(StudyNifti, RefusesNumbersThatEndTheLibraryBehindIt) {
    const TemporaryFolder folder;
    const std::string good =
        niftiBytes(kSize, {1, 1, 1}, {0, 0, 0}, DT_INT16, 16, bytesOfSamples(ramp<short>()));
    const auto write = [&](std::size_t at, const auto& number) {
        std::string bytes = good;
        std::memcpy(bytes.data() + at, &number, sizeof number);
        writeBytes(folder / "a.nii", bytes);
    };
    const float bad[] = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                         std::numeric_limits<float>::quiet_NaN(), 3e38f};
    for (const float number : bad) {
        for (const std::size_t at :
             {offsetof(nifti_1_header, pixdim) + 12, offsetof(nifti_1_header, pixdim)}) {
            write(at, number);
            expectError(folder / "a.nii", {fmt::format("byte {}", at), "the spacing"});
        }
        for (std::size_t at = offsetof(nifti_1_header, quatern_b); at < offsetof(nifti_1_header, intent_name);
             at += 4) {
            write(at, number);
            expectError(folder / "a.nii", {fmt::format("byte {}", at), "the directions and the origin"});
        }
    }
    for (int axis = 1; axis <= 3; ++axis) {
        write(offsetof(nifti_1_header, dim) + 2 * axis, short(-4));
        expectError(folder / "a.nii", {fmt::format("axis {}", axis), "found -4"});
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
    options.label = 9;
    const Study study = read(folder / "a.nrrd", options);
    ASSERT_TRUE(study.isMask);
    for (int n = 0; n < 60; ++n) EXPECT_EQ(study.mask.values[n], values[n] == 9);
    options.label = 5;
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
    label.label = 1;
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

TEST(StudyBad, NotAVolume) {
    const TemporaryFolder folder;
    writeBytes(folder / "a.txt", "hello");
    expectError(folder / "a.txt", {"expected a volume"});
    expectError(folder / "none.nrrd", {"does not exist"});
    for (const char* name : {"a.nrrd", "b.nii", "c.nii.gz", "d.mha", "e.nhdr", "f.mhd"}) {
        for (const std::string& text : {std::string(), std::string("hello\n"), std::string(5000, '\xff')}) {
            writeBytes(folder / name, text);
            expectError(folder / name, {"expected a"});
        }
    }
    writeBytes(folder / "g.nrrd", "NRRD0005\ntype: what\n\n");
    expectError(folder / "g.nrrd", {"expected a NRRD volume"});
}

TEST(StudyBad, CutOff) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    writeNrrd(folder / "a.nrrd", kShortLines, bytes.substr(0, 77));
    expectError(folder / "a.nrrd", {"cut off", "120 bytes", "found 77"});
    std::vector<short> noise(60);
    unsigned state = 7;
    for (short& x : noise) x = static_cast<short>((state = state * 1664525 + 1013904223) >> 16);
    const std::string packed = gzipped(bytesOfSamples(noise));
    writeNrrd(folder / "b.nrrd", replaced(kShortLines, "raw", "gzip"), packed.substr(0, packed.size() - 60));
    expectError(folder / "b.nrrd", {"cut off", "120 bytes", "found "});
    const std::string nifti = niftiBytes(kSize, {1, 1, 1}, {0, 0, 0}, DT_INT16, 16, bytesOfSamples(noise));
    writeBytes(folder / "c.nii", nifti.substr(0, nifti.size() - 21));
    expectError(folder / "c.nii", {"cut off", "120 bytes", "found 99"});
    const std::string small = gzipped(nifti);
    writeBytes(folder / "d.nii.gz", small.substr(0, small.size() - 50));
    expectError(folder / "d.nii.gz", {"cut off", "120 bytes", "found "});
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

TEST(StudyBad, SizesBeyondAllMemoryOrNumbers) {
    const TemporaryFolder folder;
    const std::string bytes(200, '\0');
    writeNrrd(folder / "a.nrrd", replaced(kShortLines, "5 4 3", "100000 100000 100000"), bytes);
    expectError(folder / "a.nrrd", {"100000 x 100000 x 100000 voxels need", "this machine has"});
    writeNrrd(folder / "b.nrrd", replaced(kShortLines, "5 4 3", "4294967296 4294967296 4294967296"), bytes);
    EXPECT_THAT(errorOf(folder / "b.nrrd"), AllOf(HasSubstr("b.nrrd"), Not(HasSubstr("no error"))));
    writeNrrd(folder / "c.nrrd", replaced(replaced(kShortLines, "raw", "gzip"), "5 4 3", "1000 1000 500"),
              gzipped(bytes));
    expectError(folder / "c.nrrd", {"cut off", "1000000000 bytes"});
    writeNrrd(folder / "d.nrrd", replaced(kShortLines, "5 4 3", "-5 4 3"), bytes);
    EXPECT_THAT(errorOf(folder / "d.nrrd"), AllOf(HasSubstr("d.nrrd"), Not(HasSubstr("no error"))));
}

TEST(StudyBad, MetaHeadersThatTheLibraryPrintsOrHangsOver) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    const std::string good =
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 7 8 "
        "9\n"
        "ElementSpacing = 0.5 0.6 2\nDimSize = 5 4 3\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
    const struct {
        const char *from, *to, *place, *says;
    } cases[] = {
        {"NDims = 3", "NDims =-3", "a.mha:2", "1 to 10 axes"},
        {"NDims = 3", "NDims = nan", "a.mha:2", "1 to 10 axes"},
        {"NDims = 3", "NDims = 1e9", "a.mha:2", "1 to 10 axes"},
        {"NDims = 3\n", "", "a.mha:3", "expected NDims"},
        {"NDims", "NDimz", "a.mha:4", "expected NDims"},
        {"DimSize", "DimSizf", "a.mha", "no DimSize"},
        {"ElementType", "Elementtipe", "a.mha", "no ElementType"},
        {"5 4 3", "5 4", "a.mha:7", "3 numbers, found 2"},
        {"5 4 3", "5 -4 3", "a.mha:7", "sizes above 0"},
        {"7 8 9", "7 inf 9", "a.mha:5", "expected numbers"},
        {"0 1 0 0 0 1", "0 1 0 0 0", "a.mha:4", "9 numbers, found 8"},
        {"0 1 0 0 0 1", "0 1 0 0 0 nan", "a.mha:4", "expected numbers"},
    };
    for (const auto& c : cases) {
        writeBytes(folder / "a.mha", replaced(good, c.from, c.to) + bytes);
        expectError(folder / "a.mha", {c.place, c.says});
    }
    writeBytes(folder / "a.mha", good + bytes);
    expectRamp(read(folder / "a.mha"));
}

TEST(StudyBad, SpacingThatIsNone) {
    const TemporaryFolder folder;
    const std::string lines = "DimSize = 5 4 3\nElementType = MET_SHORT\n";
    const std::string bytes = bytesOfSamples(ramp<short>());
    for (const char* spacing : {"0.5 0.5 0", "0.5 -1 0.5", "nan 1 1"}) {
        writeMeta(folder / "a.mha", lines + "ElementSpacing = " + spacing + "\n", bytes);
        EXPECT_THAT(errorOf(folder / "a.mha"), AllOf(HasSubstr("a.mha"), HasSubstr("spacing"))) << spacing;
    }
    for (const char* direction : {"(0,0,0)", "(0,0,nan)"}) {
        writeNrrd(folder / "b.nrrd", replaced(kShortLines, "(0,0,2)", direction), bytes);
        EXPECT_THAT(errorOf(folder / "b.nrrd"), AllOf(HasSubstr("b.nrrd"), Not(HasSubstr("no error"))))
            << direction;
    }
}

TEST(StudyBad, NotThreeAxesOfNumbers) {
    const TemporaryFolder folder;
    const std::string bytes(400, '\1');
    writeNrrd(folder / "a.nrrd", "type: short\ndimension: 2\nsizes: 5 4\nendian: little\nencoding: raw\n",
              bytes);
    expectError(folder / "a.nrrd", {"3 axes", "found 2 (5 x 4)"});
    writeNrrd(folder / "b.nrrd", replaced(kShortLines, "5 4 3", "5 4 1"), bytes);
    expectError(folder / "b.nrrd", {"2 or more voxels along each axis", "5 x 4 x 1"});
    writeNrrd(folder / "c.nrrd",
              "type: short\ndimension: 4\nsizes: 3 5 4 3\nkinds: vector domain domain domain\nendian: "
              "little\nencoding: raw\n",
              bytes);
    expectError(folder / "c.nrrd", {"one number a voxel, found 3"});
    writeNrrd(folder / "d.nrrd", "type: short\ndimension: 4\nsizes: 5 4 3 2\nendian: little\nencoding: raw\n",
              bytes);
    expectError(folder / "d.nrrd", {"3 axes", "found 4 (5 x 4 x 3 x 2)"});
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
