// One clear line for volume files that can not be read, whatever the libraries behind would do with them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

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

// Both forms have a code, so that the sform counts alone.
TEST(StudyNifti, RefusesNumbersThatCountAndEndALibrary) {
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
            expectRamp(read(folder / "a.nii"));
        }
        for (std::size_t at = offsetof(nifti_1_header, quatern_b); at < offsetof(nifti_1_header, srow_x);
             at += 4) {
            write(at, number);
            expectRamp(read(folder / "a.nii"));
        }
        for (std::size_t at = offsetof(nifti_1_header, srow_x); at < offsetof(nifti_1_header, intent_name);
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

TEST(StudyBad, SizesBeyondAllMemoryOrNumbers) {
    const TemporaryFolder folder;
    const std::string bytes(200, '\0');
    writeNrrd(folder / "a.nrrd", replaced(kShortLines, "5 4 3", "100000 100000 100000"), bytes);
    expectError(folder / "a.nrrd", {"100000 x 100000 x 100000 voxels need", "would fit"});
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

// Found by fuzzing: places of 60 million slices were kept before the file was looked at.
TEST(StudyBad, SlicesThatTheFileDoesNotHoldTakeNoMemory) {
    const TemporaryFolder folder;
    writeBytes(folder / "a.mha",
               "ObjectType = Image\nNDims = 3\nDimSize = 2 2 60000000\nElementType = MET_SHORT\n"
               "ElementDataFile = LOCAL\n0123cdef");
    const auto peak = [] {
        rusage used{};
        getrusage(RUSAGE_SELF, &used);
        return used.ru_maxrss;  // kB
    };
    const long before = peak();
    expectError(folder / "a.mha", {"a.mha"});
    EXPECT_LT(peak() - before, 100'000);
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

}  // namespace
}  // namespace stereonav
