// Spacings that no work on a volume would end with are refused before any is done; very small and very large
// ones that are even are read.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "../camera/temporary_folder.h"
#include "../support/nifti_files.h"
#include "../support/read_study.h"
#include "../support/volume_files.h"
#include "colon/study/study.h"
#include "study_dicom_slices.h"
#include "study_ramp.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using namespace test;

using Spacing = std::array<double, 3>;  // millimetres

std::string directedLines(const Spacing& s) {
    return replaced(kShortLines, "(0.5,0,0) (0,0.6,0) (0,0,2)",
                    fmt::format("({:g},0,0) (0,{:g},0) (0,0,{:g})", s[0], s[1], s[2]));
}

// The same spacing in each format that there is. 32 bits hold it in some.
std::vector<fs::path> filesWith(const fs::path& folder, const Spacing& s) {
    const std::string samples = bytesOfSamples(ramp<short>());
    const std::string spaced = fmt::format("spacings: {:g} {:g} {:g}", s[0], s[1], s[2]);
    std::vector<fs::path> files{
        writeNrrd(folder / "directed.nrrd", directedLines(s), samples),
        writeNrrd(folder / "spaced.nrrd",
                  "type: short\ndimension: 3\nsizes: 5 4 3\nendian: little\nencoding: raw\n" + spaced + "\n",
                  samples),
        writeMeta(folder / "a.mha",
                  fmt::format("DimSize = 5 4 3\nElementType = MET_SHORT\nElementSpacing = {:g} {:g} {:g}\n",
                              s[0], s[1], s[2]),
                  samples)};
    NiftiSpec nifti;
    nifti.version = 2;
    nifti.sformCode = 1;
    nifti.srow = {s[0], 0, 0, 0, 0, s[1], 0, 0, 0, 0, s[2], 0};
    writeBytes(folder / "a.nii", niftiFile(ramp<short>(), nifti));
    files.push_back(folder / "a.nii");
    return files;
}

TEST(StudySpacing, ThatIsTooUnevenIsRefusedWithItsNumbers) {
    for (const Spacing& even :
         {Spacing{1e4, 0.83, 1}, {1e20, 1, 1}, {1, 1e-6, 1}, {0.8, 0.8, 41}, {3, 160, 3}}) {
        const auto [least, most] = std::minmax_element(even.begin(), even.end());
        for (int turn = 0; turn < 3; ++turn) {
            const Spacing s{even[turn % 3], even[(turn + 1) % 3], even[(turn + 2) % 3]};
            const TemporaryFolder folder;
            for (const fs::path& file : filesWith(folder / "", s)) {
                SCOPED_TRACE(file.filename().string());
                const std::string found = fmt::format("{:.4g} x {:.4g} x {:.4g} mm", s[0], s[1], s[2]);
                if (*most > 1e12 && file.extension() == ".nii")
                    expectError(file, {"expected a number of millimetres"});
                else if (*most > 1e9)
                    expectError(file, {"expected a spacing of 1e-09 to 1e+09 mm, found " + found});
                else
                    expectError(file, {"its spacing is too uneven: " + found,
                                       fmt::format("{:.3g} times the smallest", *most / *least)});
            }
        }
    }
}

TEST(StudySpacing, ThatIsTooSmallOrTooLargeIsRefused) {
    for (const double spacing : {1e-10, 1e-30, 2e9, 1e20}) {
        const TemporaryFolder folder;
        for (const fs::path& file : filesWith(folder / "", {spacing, spacing, spacing}))
            expectError(file, {spacing > 1e12 && file.extension() == ".nii"
                                   ? "expected a number of millimetres"
                                   : "expected a spacing of 1e-09 to 1e+09 mm, found"});
    }
}

TEST(StudySpacing, WithinTheBoundsIsRead) {
    for (const Spacing& s :
         {Spacing{1e-8, 1e-8, 1e-8}, {1e-5, 2e-5, 3e-5}, {0.5, 0.5, 24}, {1, 49, 1}, {1e8, 1e8, 1e8}}) {
        const TemporaryFolder folder;
        for (const fs::path& file : filesWith(folder / "", s)) {
            SCOPED_TRACE(file.filename().string());
            const Study study = read(file);
            expectRamp(study);
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(study.grey.frame.spacing[axis] * 1e3 / s[axis], 1, 1e-6) << axis;
        }
    }
}

TEST(StudySpacing, OfDicomSlicesIsHeldAgainstTheSameBounds) {
    const TemporaryFolder folder;
    const auto write = [&](double pixel, double step) {
        for (int k = 0; k < kSlices; ++k) {
            DicomSpec s = specOf(k);
            s.slice.spacing = {pixel, pixel};
            s.slice.position.z = k * step;
            writeDicom(folder / fmt::format("s/s{}.dcm", k), s);
        }
    };
    write(0.01, 2);
    expectError(folder / "s", {"its spacing is too uneven: 0.01 x 0.01 x 2 mm", "200 times the smallest"});
    write(0.05, 2.4);
    expectStudy([&] {
        Study study = read(folder / "s");
        study.grey.frame.spacing.z = 0.002;
        return study;
    }());
}

TEST(StudySpacing, AnOriginThatNumbersDoNotTellFromTheNextVoxelIsRefused) {
    const TemporaryFolder folder;
    for (const char* origin : {"(1e15,8,9)", "(7,-1e13,9)", "(7,8,1e300)"})
        expectError(writeNrrd(folder / "a.nrrd", replaced(kShortLines, "(7,8,9)", origin),
                              bytesOfSamples(ramp<short>())),
                    {"expected an origin within 1e+10 spacings"});
    expectRamp(read(writeNrrd(folder / "a.nrrd", replaced(kShortLines, "(7,8,9)", "(7e8,8,9)"),
                              bytesOfSamples(ramp<short>()))));
}

}  // namespace
}  // namespace stereonav
