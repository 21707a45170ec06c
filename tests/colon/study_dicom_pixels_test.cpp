// Pixels of DICOM files of every width, frames of files without functional groups, and values by tables.
#include <fmt/format.h>
#include <gdcmImageReader.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "../camera/temporary_folder.h"
#include "../support/dicom_files.h"
#include "../support/read_study.h"
#include "colon/study/study.h"
#include "study_dicom_slices.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::HasSubstr;
using namespace test;

// Returns the stored numbers of one slice from GDCM, widened.
std::vector<double> storedByGdcm(const fs::path& file, int bits, bool isSigned) {
    gdcm::ImageReader reader;
    reader.SetFileName(file.c_str());
    EXPECT_TRUE(reader.Read());
    std::vector<char> bytes(reader.GetImage().GetBufferLength());
    reader.GetImage().GetBuffer(bytes.data());
    std::vector<double> numbers;
    for (int n = 0; n < kColumns * kRows; ++n) {
        std::uint32_t raw = 0;
        std::memcpy(&raw, &bytes[static_cast<std::size_t>(n) * bits / 8], static_cast<std::size_t>(bits / 8));
        const auto unused = 32 - bits;
        numbers.push_back(isSigned ? static_cast<double>(static_cast<std::int32_t>(raw << unused) >> unused)
                                   : static_cast<double>(raw));
    }
    return numbers;
}

TEST(StudyDicomPixels, OfEightSixteenAndThirtyTwoBits) {
    for (const auto syntax : {DicomSyntax::Implicit, DicomSyntax::Explicit, DicomSyntax::BigEndian})
        for (const int bits : {8, 16, 32})
            for (const bool isSigned : {false, true}) {
                SCOPED_TRACE(fmt::format("{} {} {}", uidOf(syntax), bits, isSigned));
                const TemporaryFolder folder;
                for (int k = 0; k < kSlices; ++k) {
                    DicomSpec s = specOf(k);
                    s.syntax = syntax;
                    s.bits = s.slice.bitsStored = bits;
                    s.slice.isSigned = isSigned;
                    s.slice.modality = "OT";
                    s.slice.intercept = "-100";
                    for (std::uint16_t& x : s.slice.pixels)
                        x = static_cast<std::uint16_t>(bits == 8 ? x % 256 : bits == 16 ? 16 * x : x);
                    writeDicom(folder / fmt::format("s/s{}.dcm", k), s);
                }
                const Study study = read(folder / "s");
                // Values over more than 16 bits come through floats of 24 (up to 4095 * 65536: 16) and are
                // kept in 65536 steps.
                const double step = 0.5 * study.grey.scale + 16;
                for (int k = 0; k < kSlices; ++k) {
                    const auto stored = storedByGdcm(folder / fmt::format("s/s{}.dcm", k), bits, isSigned);
                    for (int n = 0; n < kColumns * kRows; ++n)
                        ASSERT_NEAR(study.grey.values[k * kColumns * kRows + n] * study.grey.scale +
                                        study.grey.offset,
                                    stored[static_cast<std::size_t>(n)] - 100,
                                    study.grey.scale == 1 ? 0 : step)
                            << n << " of " << k;
                }
            }
}

// One file of several frames in order, with one position for all.
DicomSpec plainFrames() {
    DicomSpec s = specOf(0);
    s.slice.pixels.clear();
    s.plainFrames = kSlices;
    for (int k = 0; k < kSlices; ++k)
        for (int n = 0; n < kColumns * kRows; ++n) s.slice.pixels.push_back(pixelOf(n, k));
    return s;
}

TEST(StudyDicomFrames, WithoutGroupsLieByTheirDistanceOrOffsets) {
    const TemporaryFolder folder;
    DicomSpec s = plainFrames();
    s.spacingBetween = "2";
    writeDicom(folder / "distance/a.dcm", s);
    gdcm::ImageReader gdcmReads;  // has the same rule
    gdcmReads.SetFileName((folder / "distance/a.dcm").c_str());
    ASSERT_TRUE(gdcmReads.Read());
    EXPECT_EQ(gdcmReads.GetImage().GetDimension(2), 3u);
    const Study byDistance = read(folder / "distance");
    expectStudy(byDistance);
    EXPECT_THAT(byDistance.notes, testing::Contains(HasSubstr("a distance of 2 mm (0018,0088)")));
    EXPECT_NEAR(byDistance.grey.frame.origin.z, 0.030, 1e-12);

    s.spacingBetween = "5";  // the offsets are each frame's own
    s.offsets = "0\\2\\4";
    writeDicom(folder / "offsets/a.dcm", s);
    expectStudy(read(folder / "offsets"));
    s.offsets = "30\\32\\34";  // from the patient's origin
    writeDicom(folder / "offsets/a.dcm", s);
    expectStudy(read(folder / "offsets"));
    s.offsets = "0\\-2\\-4";
    writeDicom(folder / "offsets/a.dcm", s);
    const Study down = read(folder / "offsets");
    EXPECT_NEAR(down.grey.frame.worldFromVoxel({0, 0, 0}).z, 0.026, 1e-12);
    EXPECT_EQ(down.grey.at(3, 2, 2), pixelOf(2 * kColumns + 3, 0) - 1024);
    s.offsets = "0\\2\\5";
    writeDicom(folder / "offsets/a.dcm", s);
    expectError(folder / "offsets", {"a.dcm frame "});
}

TEST(StudyDicomFrames, WithoutAnyPlaceAreRefused) {
    const TemporaryFolder folder;
    for (const char* distance : {"", "0", "-2", "nan"}) {
        DicomSpec s = plainFrames();
        s.spacingBetween = distance;
        writeDicom(folder / "s/a.dcm", s);
        expectError(folder / "s", {"a.dcm holds 3 frames", "offsets or a spacing between slices"});
    }
}

// PS3.3 C.11.1: a number's value is the table's, below its first number that one's, beyond its last the
// last's.
TEST(StudyDicomTables, GiveTheValues) {
    for (const auto syntax : {DicomSyntax::Implicit, DicomSyntax::Explicit, DicomSyntax::BigEndian})
        for (const int width : {1, 2}) {
            SCOPED_TRACE(fmt::format("{} {}", uidOf(syntax), width));
            const TemporaryFolder folder;
            const auto value = [&](int at) { return width == 1 ? (at * 7) % 256 : (at * 911) % 30000; };
            for (int k = 0; k < kSlices; ++k) {
                DicomSpec s = specOf(k);
                s.syntax = syntax;
                s.rescaled = false;
                s.slice.modality = "OT";
                s.tableHead = {3001, 500, width == 1 ? 8 : 16};
                s.tableWidth = width;
                for (int n = 0; n < 3001; ++n) s.tableValues.push_back(value(n));
                writeDicom(folder / fmt::format("s/s{}.dcm", k), s);
            }
            const Study study = read(folder / "s");
            EXPECT_THAT(study.notes, testing::Contains(HasSubstr("modality LUT")));
            for (int k = 0; k < kSlices; ++k)
                for (int n = 0; n < kColumns * kRows; ++n)
                    ASSERT_EQ(study.grey.values[k * kColumns * kRows + n],
                              value(std::clamp(pixelOf(n, k) - 500, 0, 3000)));
        }
}

TEST(StudyDicomTables, ThatDoNotFitAreRefused) {
    const TemporaryFolder folder;
    const auto expectRefused = [&](const DicomSpec& s, const char* words) {
        writeDicom(folder / "s/a.dcm", s);
        DicomSpec second = s;
        second.slice.position.z += 2;
        writeDicom(folder / "s/b.dcm", second);
        expectError(folder / "s", {words});
    };
    DicomSpec s = specOf(0);
    s.tableHead = {4, 0, 16};
    s.tableValues = {1, 2, 3, 4};
    expectRefused(s, "both a table of values (modality LUT) and a rescale slope");
    s.rescaled = false;
    s.tableHead = {5, 0, 16};
    expectRefused(s, "its table of 5 values of 16 bits has 8 bytes");
    s.tableHead = {0, 0, 16};
    expectRefused(s, "its table of 65536 values");
    s.tableHead = {4, 0, 40};
    expectRefused(s, "4 values of 40 bits");
    s.tableHead = {4, 0};
    expectRefused(s, "no header or no data");
}

TEST(StudyDicomTables, OfADoseAreItsScaling) {
    const TemporaryFolder folder;
    DicomSpec s = plainFrames();
    s.slice.modality = "RTDOSE";
    s.rescaled = false;
    s.offsets = "0\\2\\4";
    s.doseScaling = "0.5";
    writeDicom(folder / "s/a.dcm", s);
    const Study study = read(folder / "s");
    const GreyVolume& grey = study.grey;
    EXPECT_NEAR(grey.at(3, 2, 1) * grey.scale + grey.offset, 0.5 * pixelOf(2 * kColumns + 3, 1), grey.scale);
}

}  // namespace
}  // namespace stereonav
