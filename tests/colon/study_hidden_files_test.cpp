// Files that other programs hide in a folder, as macOS's ._NAME beside NAME, are no part of a study.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "../camera/temporary_folder.h"
#include "../support/read_study.h"
#include "colon/study/study.h"
#include "study_dicom_slices.h"

namespace stereonav {
namespace {

using namespace test;

void hideBeside(const std::filesystem::path& folder) {
    std::ofstream(folder / ".DS_Store") << std::string("\0\0\0\1Bud1", 8);
    for (int k = 0; k < kSlices; ++k)
        std::ofstream(folder / fmt::format("._s{}.dcm", k))
            << std::string("\0\5\26\7", 4) << std::string(200, 'x');
    // Even what would be a slice of another series.
    DicomSpec other = specOf(0);
    other.slice.columns = 3, other.slice.rows = 2, other.slice.pixels = {1, 2, 3, 4, 5, 6};
    writeDicom(folder / ".trash.dcm", other);
}

TEST(StudyHiddenFiles, AreNoSlices) {
    const TemporaryFolder folder;
    const std::filesystem::path slices = folder / "s";
    std::filesystem::create_directory(slices);
    writeStudy(slices);
    const std::uint64_t key = studyKey(slices, {});
    hideBeside(slices);
    EXPECT_TRUE(looksLikeStudy(slices));
    expectStudy(read(slices));
    EXPECT_EQ(studyKey(slices, {}), key);
    EXPECT_EQ(lookAtSeries(slices).size(), 1u);
    Progress progress;
    EXPECT_EQ(glanceAtStudy(slices, progress).files, std::size_t(kSlices));
}

// Slices without extensions are known by being alone in their folder.
TEST(StudyHiddenFiles, DoNotMakeAFolderOneOfOtherThings) {
    const TemporaryFolder folder;
    const std::filesystem::path slices = folder / "s";
    std::filesystem::create_directory(slices);
    for (int k = 0; k < kSlices; ++k) std::ofstream(slices / fmt::format("IM{}", k)) << "anything";
    EXPECT_TRUE(looksLikeStudy(slices));
    std::ofstream(slices / ".DS_Store") << "x";
    std::ofstream(slices / "._IM0") << "x";
    EXPECT_TRUE(looksLikeStudy(slices));
    std::ofstream(slices / "README.txt") << "x";
    EXPECT_FALSE(looksLikeStudy(slices));
}

// A header that is hidden is nobody's.
TEST(StudyHiddenFiles, OwnNoSamples) {
    const TemporaryFolder folder;
    std::ofstream(folder / "samples.raw") << std::string(8, 'x');
    std::ofstream(folder / "._samples.nhdr")
        << "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: samples.raw\n";
    EXPECT_FALSE(looksLikeStudy(folder / "samples.raw"));
}

}  // namespace
}  // namespace stereonav
