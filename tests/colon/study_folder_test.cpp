// Studies as discs have them: a DICOMDIR at the root, slices some folders below, and a viewer beside them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../camera/temporary_folder.h"
#include "../support/read_study.h"
#include "colon/study/study.h"
#include "study_dicom_slices.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::HasSubstr;
using namespace test;

void writeDirectory(const fs::path& file) {
    DicomBytes set(DicomSyntax::Explicit), record(DicomSyntax::Explicit);
    record.text(0x00041430, "CS", "PATIENT");
    set.text(0x00041130, "CS", "DIR");
    set.sequence(0x00041220, set.item(record.bytes(), true), true);
    writeBytes(file, dicomFile(DicomSyntax::Explicit, set.bytes(), "1.2.840.10008.1.3.10"));
}

// Slices of a series under names without extensions, as discs have them.
void writeSeries(const fs::path& folder, const std::string& uid, int first = 0, int count = kSlices) {
    fs::create_directories(folder);
    for (int k = first; k < first + count; ++k) {
        DicomSpec s = specOf(k);
        s.slice.uid = uid;
        writeDicom(folder / fmt::format("IM{:06}", k), s);
    }
}

void writeViewer(const fs::path& root) {
    writeBytes(root / "AUTORUN.INF", "[autorun]\nopen=viewer.exe\n");
    writeBytes(root / "README", "Double-click the viewer.\n");
    fs::create_directories(root / "VIEWER/lib");
    for (int n = 0; n < 40; ++n)
        writeBytes(root / fmt::format("VIEWER/lib/part{}.dll", n), std::string(2000, 'M'));
    writeBytes(root / "VIEWER/LICENSE", std::string(300, 'L'));
}

TEST(StudyOfADisc, IsOpenedByItsRootAndByItsDirectory) {
    for (const char* name : {"DICOMDIR", "dicomdir"}) {
        const TemporaryFolder folder;
        const fs::path root = folder / "disc";
        writeSeries(root / "DICOM/PA000001/ST000001/SE000001", "1.2.3.1");
        writeViewer(root);
        writeDirectory(root / name);
        for (const fs::path& place : {root, root / name}) {
            SCOPED_TRACE(place.string());
            EXPECT_TRUE(looksLikeStudy(place));
            const Study study = read(place);
            expectStudy(study);
            EXPECT_EQ(study.key, studyKey(root, {}));
            ASSERT_EQ(lookAtSeries(place).size(), 1u);
            Progress progress;
            const StudyGlance glance = glanceAtStudy(place, progress);
            EXPECT_EQ(glance.series, 1u);
            EXPECT_EQ(glance.size, (std::vector<std::uint64_t>{kColumns, kRows}));
        }
    }
}

TEST(StudyOfADisc, SeriesOfAllItsFoldersAreListed) {
    const TemporaryFolder folder;
    const fs::path root = folder / "disc";
    writeSeries(root / "DICOM/A/S1", "1.2.3.1");
    writeSeries(root / "DICOM/A/S2", "1.2.3.2");
    writeDirectory(root / "DICOMDIR");
    expectError(root, {"holds 2 series", "--series N"});
    StudyOptions options;
    options.series = "2";
    expectStudy(read(root, options));
    EXPECT_EQ(lookAtSeries(root).size(), 2u);
}

TEST(StudyOfADisc, ASeriesMayLieInSeveralFolders) {
    const TemporaryFolder folder;
    const fs::path root = folder / "disc";
    writeSeries(root / "D1", "1.2.3.1", 0, 1);
    writeSeries(root / "D2/deeper", "1.2.3.1", 1, kSlices - 1);
    writeDirectory(root / "DICOMDIR");
    expectStudy(read(root));
}

// What lies beside the DICOMDIR is the study then, as it was: a copy below would repeat its slices.
TEST(StudyOfADisc, SlicesAtTheRootItselfCountAlone) {
    const TemporaryFolder folder;
    const fs::path root = folder / "disc";
    writeSeries(root, "1.2.3.1");
    writeSeries(root / "copy", "1.2.3.1");
    writeDirectory(root / "DICOMDIR");
    expectStudy(read(root));
}

TEST(StudyOfADisc, ADirectoryWithoutSlicesIsOneLine) {
    const TemporaryFolder folder;
    const fs::path root = folder / "disc";
    writeViewer(root);
    writeDirectory(root / "DICOMDIR");
    expectError(root, {"expected DICOM images, found none among"});
}

TEST(StudyFolder, NamesTheFoldersBelowThatHoldSlices) {
    const TemporaryFolder folder;
    const fs::path root = folder / "export";
    fs::create_directories(root);
    EXPECT_EQ(studyFoldersAdvice(root), "");
    writeViewer(root);
    EXPECT_EQ(studyFoldersAdvice(root), "");
    EXPECT_FALSE(looksLikeStudy(root));
    writeSeries(root / "P1/S1", "1.2.3.1");
    EXPECT_EQ(studyFoldersAdvice(root), "its folder P1/S1 holds DICOM slices: give that one");
    writeSeries(root / "P1/S0", "1.2.3.1");
    EXPECT_EQ(studyFoldersAdvice(root), "its folders P1/S0 and P1/S1 hold DICOM slices: give one of them");
    for (const char* more : {"P2", "P3", "P4"}) writeSeries(root / more, "1.2.3.1");
    EXPECT_EQ(studyFoldersAdvice(root),
              "its folders P1/S0, P1/S1, P2 and 2 more hold DICOM slices: give one of them");
    EXPECT_FALSE(looksLikeStudy(root)) << "without a DICOMDIR only what was named is opened";
    expectError(root, {"expected DICOM images, found none among 2 files", "its folders P1/S0,"});
}

// Files that macOS leaves on discs that are no Mac's own.
TEST(StudyFolder, HiddenFilesAreNotLookedAt) {
    const TemporaryFolder folder;
    writeStudy(folder / "s");
    const std::string mark("\0\5\x16\7\0\2\0\0Mac OS X", 16);
    for (int k = 0; k < kSlices; ++k) writeBytes(folder / fmt::format("s/._s{}.dcm", k), mark);
    writeBytes(folder / "s/.DS_Store", mark);
    const Study study = read(folder / "s");
    expectStudy(study);
    EXPECT_TRUE(study.notes.empty());
    fs::remove(folder / "s/s1.dcm");
    EXPECT_THAT(errorOf(folder / "s"), testing::Not(HasSubstr("not DICOM")));
}

}  // namespace
}  // namespace stereonav
