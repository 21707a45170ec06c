// DICOM files in every encoding, one file by name, enhanced images, and forged or damaged ones: read as GDCM
// reads them, or one line, without a library's own words.
#include "colon/study/study_dicom_file.h"

#include <fmt/format.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "../camera/temporary_folder.h"
#include "../support/dicom_files.h"
#include "../support/read_study.h"
#include "colon/study/study.h"
#include "study_dicom_slices.h"
#include "study_ramp.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::HasSubstr;
using testing::Not;
using namespace test;

// Packs the slices of a folder through GDCM. Returns false where it does not write that.
bool pack(const fs::path& from, const fs::path& to, gdcm::TransferSyntax::TSType syntax) {
    fs::create_directories(to);
    for (const auto& entry : fs::directory_iterator(from)) {
        gdcm::ImageReader reader;
        reader.SetFileName(entry.path().c_str());
        if (!reader.Read()) return false;
        gdcm::ImageChangeTransferSyntax change;
        change.SetTransferSyntax(syntax);
        change.SetInput(reader.GetImage());
        if (!change.Change()) return false;
        gdcm::ImageWriter writer;
        writer.SetFileName((to / entry.path().filename()).c_str());
        writer.SetFile(reader.GetFile());
        writer.SetImage(change.GetOutput());
        if (!writer.Write()) return false;
    }
    return true;
}

constexpr std::pair<gdcm::TransferSyntax::TSType, const char*> kPacked[] = {
    {gdcm::TransferSyntax::RLELossless, "RLE"},
    {gdcm::TransferSyntax::JPEGLosslessProcess14, "JPEG lossless, process 14"},
    {gdcm::TransferSyntax::JPEGLosslessProcess14_1, "JPEG lossless"},
    {gdcm::TransferSyntax::JPEGLSLossless, "JPEG-LS"},
    {gdcm::TransferSyntax::JPEG2000Lossless, "JPEG 2000 lossless"},
    {gdcm::TransferSyntax::JPEG2000, "JPEG 2000"}};

TEST(StudyDicomSyntax, PlainOnesOfAnyOrder) {
    for (const auto syntax :
         {DicomSyntax::Implicit, DicomSyntax::Explicit, DicomSyntax::BigEndian, DicomSyntax::Deflated}) {
        const TemporaryFolder folder;
        SCOPED_TRACE(uidOf(syntax));
        writeStudy(folder / "s", syntax);
        expectStudy(read(folder / "s"));
    }
}

TEST(StudyDicomSyntax, WithoutAHead) {
    const TemporaryFolder folder;
    for (const auto syntax : {DicomSyntax::Implicit, DicomSyntax::Explicit}) {
        fs::create_directories(folder / "s");
        for (int k = 0; k < kSlices; ++k) {
            DicomSpec s = specOf(k);
            s.syntax = syntax;
            const std::string bytes = dicomBytes(s);
            writeBytes(folder / fmt::format("s/{}", k),
                       bytes.substr(bytes.find(std::string("\x08\0\x08\0", 4), 132)));
        }
        expectStudy(read(folder / "s"));
    }
}

TEST(StudyDicomSyntax, CompressedOnes) {
    const TemporaryFolder folder;
    writeStudy(folder / "plain");
    for (const auto& [syntax, name] : kPacked) {
        SCOPED_TRACE(name);
        ASSERT_TRUE(pack(folder / "plain", folder / name, syntax));
        ASSERT_LT(static_cast<int>(fileBytes(folder / name / "s0.dcm").find("DICM")), 200);
        if (syntax == gdcm::TransferSyntax::JPEG2000) {  // with loss
            EXPECT_EQ(read(folder / name).grey.frame.size.z, kSlices);
            continue;
        }
        expectStudy(read(folder / name));
    }
}

TEST(StudyDicomSyntax, OthersAreRefusedByName) {
    const TemporaryFolder folder;
    writeStudy(folder / "plain");
    ASSERT_TRUE(pack(folder / "plain", folder / "s", gdcm::TransferSyntax::RLELossless));
    for (const auto& entry : fs::directory_iterator(folder / "s")) {
        std::string bytes = fileBytes(entry.path());
        const auto at = bytes.find("1.2.840.10008.1.2.5");
        ASSERT_NE(at, std::string::npos);
        writeBytes(entry.path(), bytes.replace(at, 19, "1.2.840.10008.1.2.7"));
    }
    const std::string message = errorOf(folder / "s");
    EXPECT_THAT(message, HasSubstr("not read (transfer syntax 1.2.840.10008.1.2.7)"));
}

DicomSpec enhanced(bool knownLengths, DicomSyntax syntax) {
    DicomSpec s = specOf(0);
    s.syntax = syntax;
    s.sopClass = "1.2.840.10008.5.1.4.1.1.2.1";
    s.knownLengths = knownLengths;
    s.slice.pixels.clear();
    for (const int k : {2, 0, 1}) {  // not in the order of their places
        s.frames.emplace_back(10, 20, 30 + 2 * k);
        for (int n = 0; n < kColumns * kRows; ++n) s.slice.pixels.push_back(pixelOf(n, k));
    }
    s.intercepts = {-1024, -1024, -1024};
    return s;
}

TEST(StudyDicomEnhanced, FramesLieWhereTheirGroupsSay) {
    for (const auto syntax : {DicomSyntax::Implicit, DicomSyntax::Explicit, DicomSyntax::BigEndian})
        for (const bool known : {true, false}) {
            const TemporaryFolder folder;
            SCOPED_TRACE(fmt::format("{} {}", uidOf(syntax), known));
            DicomSpec s = enhanced(known, syntax);
            writeDicom(folder / "s/a.dcm", s);
            expectStudy(read(folder / "s"));
            expectStudy(read(folder / "s/a.dcm"));
            EXPECT_EQ(read(folder / "s").key, studyKey(folder / "s/a.dcm", {}));
            s.intercepts = {-1000, -1024, -1024};
            writeDicom(folder / "s/a.dcm", s);
            EXPECT_EQ(read(folder / "s").grey.at(0, 0, 2), pixelOf(0, 2) - 1000);
        }
}

// The pictures of single slices, packed through GDCM, as frames of one file.
TEST(StudyDicomEnhanced, CompressedFrames) {
    const TemporaryFolder folder;
    writeStudy(folder / "plain");
    for (const auto& [syntax, name] : kPacked) {
        if (syntax == gdcm::TransferSyntax::JPEG2000) continue;
        SCOPED_TRACE(name);
        ASSERT_TRUE(pack(folder / "plain", folder / name, syntax));
        DicomSpec s = enhanced(true, DicomSyntax::Explicit);
        for (const int k : {2, 0, 1}) {
            const DicomFile slice(folder / name / fmt::format("s{}.dcm", k));
            s.packedSyntax = slice.syntax();
            ASSERT_EQ(slice.pixels().fragments.size(), 2u);
            const auto& [at, bytes] = slice.pixels().fragments[1];
            s.packed.emplace_back(reinterpret_cast<const char*>(slice.data()) + at, bytes);
        }
        writeDicom(folder / "frames" / name, s);
        expectStudy(read(folder / "frames" / name));
    }
}

TEST(StudyDicomEnhanced, WhatDoesNotFitIsSaid) {
    const TemporaryFolder folder;
    DicomSpec s = enhanced(true, DicomSyntax::Explicit);
    s.frames[1] = s.frames[0];
    writeDicom(folder / "s/a.dcm", s);
    expectError(folder / "s", {"repeated slices: a.dcm frame ", "34.00 mm"});
    s = enhanced(true, DicomSyntax::Explicit);
    std::string bytes = dicomBytes(s);
    writeBytes(folder / "s/a.dcm", replaced(bytes, "3 ", "9 "));
    EXPECT_THAT(errorOf(folder / "s"), HasSubstr("a.dcm is"));
    writeBytes(folder / "s/a.dcm", bytes.substr(0, bytes.size() - 31));
    expectError(folder / "s", {"a.dcm", "is cut off: 31 bytes of its pixels are missing"});
}

TEST(StudyDicomSingle, OneSliceIsAskedForItsSeries) {
    const TemporaryFolder folder;
    writeStudy(folder / "s");
    EXPECT_TRUE(looksLikeStudy(folder / "s/s0.dcm"));
    expectError(folder / "s/s0.dcm", {"2 or more slices, found 1", "give the folder that holds the series"});
    fs::rename(folder / "s/s0.dcm", folder / "s/IMG0");
    EXPECT_TRUE(looksLikeStudy(folder / "s/IMG0"));
    EXPECT_TRUE(looksLikeStudy(folder / "s"));
    // A name without an extension is a slice beside files of other kinds only where it begins as one.
    std::filesystem::create_directory(folder / "ground");
    writeTextFile(folder / "ground/README", "of the ground");
    EXPECT_TRUE(looksLikeStudy(folder / "ground"));
    writeTextFile(folder / "ground/part.tif", "no picture");
    EXPECT_FALSE(looksLikeStudy(folder / "ground"));
    std::filesystem::copy_file(folder / "s/IMG0", folder / "ground/IMG0");
    EXPECT_TRUE(looksLikeStudy(folder / "ground"));
    writeBytes(folder / "s/x.dcm", "hello");
    expectError(folder / "s/x.dcm", {"expected a DICOM image"});
}

TEST(StudyDicomForged, LengthsAreHeldAgainstTheFile) {
    for (const auto syntax : {DicomSyntax::Implicit, DicomSyntax::Explicit})
        for (const int forged : {1, 2}) {
            const TemporaryFolder folder;
            writeStudy(folder / "s", syntax);
            for (int k = 0; k < forged; ++k) {
                DicomSpec s = specOf(k);
                s.syntax = syntax;
                s.pixelLength = 0xfffffff0;
                writeDicom(folder / fmt::format("s/s{}.dcm", k), s);
            }
            rusage before{}, after{};
            getrusage(RUSAGE_SELF, &before);
            expectError(folder / "s",
                        {"s0.dcm is damaged: it says 4294967280 bytes of pixels, 8 x 7 of them have 112"});
            getrusage(RUSAGE_SELF, &after);
            EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100'000);  // KB
        }
}

TEST(StudyDicomForged, AnyElementsLength) {
    const TemporaryFolder folder;
    writeStudy(folder / "s");
    const std::string good = fileBytes(folder / "s/s1.dcm");
    int refused = 0;
    for (const char* tag : {"\x08\0\x08\0", "\x08\0\x16\0", "\x20\0\x32\0", "\x28\0\x02\0", "\x28\0\x10\0"}) {
        std::string bytes = good;
        const auto at = bytes.find(std::string(tag, 4), 132);
        ASSERT_NE(at, std::string::npos);
        bytes[at + 6] = bytes[at + 7] = '\xff';
        writeBytes(folder / "s/s1.dcm", bytes);
        const std::string message = errorOf(folder / "s");
        EXPECT_THAT(message, HasSubstr("s1.dcm"));
        EXPECT_THAT(message, Not(HasSubstr("missing between")));
        refused += message != "no error";
    }
    EXPECT_EQ(refused, 5);
}

// GDCM ends the program over a directory whose records have no places.
TEST(StudyDicomForged, DirectoriesAreLeftOut) {
    const TemporaryFolder folder;
    writeStudy(folder / "s");
    DicomBytes set(DicomSyntax::Explicit), record(DicomSyntax::Explicit);
    record.text(0x00041430, "CS", "PATIENT");
    set.text(0x00041130, "CS", "DIR");
    set.sequence(0x00041220, set.item(record.bytes(), true), true);
    const std::string bytes = dicomFile(DicomSyntax::Explicit, set.bytes(), "1.2.840.10008.1.3.10");
    for (const char* name : {"DICOMDIR", "dicomdir.dcm", "index"}) {
        writeBytes(folder / "s" / name, bytes);
        expectStudy(read(folder / "s"));
    }
}

TEST(StudyDicomAside, LocalizersAndCapturesAreLeftOutWithAWord) {
    const TemporaryFolder folder;
    writeStudy(folder / "s");
    DicomSpec scout = specOf(0), capture = specOf(1), colour = specOf(1);
    scout.imageType = "ORIGINAL\\PRIMARY\\LOCALIZER";
    scout.slice.along = {0, 1, 0};
    scout.slice.down = {0, 0, -1};
    writeDicom(folder / "s/scout.dcm", scout);  // in the same series, as some scanners have it
    scout.slice.uid = "1.2.3.0";
    writeDicom(folder / "s/scout2.dcm", scout);
    capture.sopClass = "1.2.840.10008.5.1.4.1.1.7";
    capture.slice.uid = "1.2.3.7";
    writeDicom(folder / "s/capture.dcm", capture);
    colour.samples = 3;
    colour.slice.uid = "1.2.3.8";
    writeDicom(folder / "s/colour.dcm", colour);
    const Study study = read(folder / "s");
    expectStudy(study);
    ASSERT_EQ(study.notes.size(), 1u);
    EXPECT_EQ(study.notes[0], "left aside: 2 localizers, 1 picture in colour, 1 secondary capture");
    EXPECT_EQ(lookAtSeries(folder / "s").size(), 1u);
    // Alone, they are what there is.
    fs::create_directories(folder / "t");
    fs::copy(folder / "s/scout.dcm", folder / "t/scout.dcm");
    expectError(folder / "t", {"found 1 (a localizer)"});
}

TEST(StudyDicomDamaged, IsNotCalledMissing) {
    const TemporaryFolder folder;
    writeStudy(folder / "s");
    for (const int k : {3, 4, 5}) writeDicom(folder / fmt::format("s/s{}.dcm", k), specOf(k));
    const std::string good = fileBytes(folder / "s/s1.dcm");
    for (std::size_t bytes = 140; bytes < good.size(); bytes += 7) {
        writeBytes(folder / "s/s1.dcm", good.substr(0, bytes));
        const std::string message = errorOf(folder / "s");
        EXPECT_THAT(message, HasSubstr("s1.dcm"));
        EXPECT_THAT(message, Not(HasSubstr("missing between"))) << bytes;
    }
    writeBytes(folder / "s/s1.dcm", std::string(good.size(), '\xee'));  // nothing of it is DICOM
    expectError(folder / "s", {"1 slice is missing between s0.dcm", "and s2.dcm", "(not DICOM: s1.dcm)"});
    fs::remove(folder / "s/s1.dcm");
    EXPECT_THAT(errorOf(folder / "s"), Not(HasSubstr("not DICOM")));
}

// A codec believes what its own stream says.
TEST(StudyDicomDamaged, PicturesOfAnotherSizeAreRefused) {
    const TemporaryFolder folder;
    writeStudy(folder / "plain");
    ASSERT_TRUE(pack(folder / "plain", folder / "j2k", gdcm::TransferSyntax::JPEG2000Lossless));
    ASSERT_TRUE(pack(folder / "plain", folder / "ls", gdcm::TransferSyntax::JPEGLSLossless));
    std::string bytes = fileBytes(folder / "j2k/s1.dcm");
    auto at = bytes.find("\xff\x4f\xff\x51");
    ASSERT_NE(at, std::string::npos);
    bytes[at + 8] = 0x7f;  // a byte of the width
    writeBytes(folder / "j2k/s1.dcm", bytes);
    EXPECT_THAT(errorOf(folder / "j2k"),
                HasSubstr("s1.dcm: damaged: its compressed picture has 2130706440 x 7"));
    bytes = fileBytes(folder / "ls/s1.dcm");
    at = bytes.find("\xff\xf7");
    ASSERT_NE(at, std::string::npos);
    bytes[at + 5] = 0x7f;  // a byte of the height
    writeBytes(folder / "ls/s1.dcm", bytes);
    EXPECT_THAT(errorOf(folder / "ls"), HasSubstr("s1.dcm: damaged: its compressed picture has 8 x 32519"));
}

// GDCM follows a length of the codestream past its end: that ends the helper at most.
TEST(StudyDicomDamaged, LengthsWithinAPictureEndNothingButItsHelper) {
    const TemporaryFolder folder;
    writeStudy(folder / "plain");
    ASSERT_TRUE(pack(folder / "plain", folder / "j2k", gdcm::TransferSyntax::JPEG2000Lossless));
    const std::string good = fileBytes(folder / "j2k/s1.dcm");
    for (const char* marker : {"\xff\x52", "\xff\x5c", "\xff\x64"}) {  // COD, QCD, COM
        const auto at = good.find(marker, good.find("\xff\x4f\xff\x51"));
        if (at == std::string::npos) continue;
        std::string bytes = good;
        bytes[at + 2] = bytes[at + 3] = '\xff';
        writeBytes(folder / "j2k/s1.dcm", bytes);
        EXPECT_THAT(errorOf(folder / "j2k"), AllOf(HasSubstr("s1.dcm: "), HasSubstr("damaged"))) << at;
    }
}

// Bytes changed at random, in every syntax: one line or a picture, and nothing else on either stream.
TEST(StudyDicomDamaged, ChangedBytesEndInOneLineAndNothingElse) {
#ifdef __SANITIZE_ADDRESS__  // each try starts a helper of a tenth of a second
    constexpr int kTries = 40;
#else
    constexpr int kTries = 150;
#endif
    const TemporaryFolder folder;
    writeStudy(folder / "Explicit");
    writeStudy(folder / "Implicit", DicomSyntax::Implicit);
    writeStudy(folder / "Deflated", DicomSyntax::Deflated);
    std::vector<std::string> names = {"Explicit", "Implicit", "Deflated"};
    for (const auto& [syntax, name] : kPacked) {
        ASSERT_TRUE(pack(folder / "Explicit", folder / name, syntax));
        names.emplace_back(name);
    }
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    unsigned state = 11;
    const auto random = [&](std::size_t below) { return (state = state * 1664525 + 1013904223) / 7 % below; };
    int lines = 0, pictures = 0;
    for (const std::string& name : names) {
        const std::string good = fileBytes(folder / name / "s1.dcm");
        for (int n = 0; n < kTries; ++n) {
            std::string bytes = good;
            for (std::size_t change = random(3) + 1; change-- > 0;)
                bytes[132 + random(bytes.size() - 132)] = static_cast<char>(random(256));
            writeBytes(folder / name / "s1.dcm", bytes);
            const std::string message = errorOf(folder / name);
            (message == "no error" ? pictures : lines) += 1;
            EXPECT_THAT(message, Not(HasSubstr("\n")));
        }
    }
    const std::string err = testing::internal::GetCapturedStderr(),
                      out = testing::internal::GetCapturedStdout();
    EXPECT_EQ(err, "");
    EXPECT_EQ(out, "");
    EXPECT_GT(lines, 100);
    EXPECT_GT(pictures, 100);
}

}  // namespace
}  // namespace stereonav
