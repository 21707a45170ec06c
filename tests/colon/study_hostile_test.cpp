// Studies that somebody made to do more than be shown: headers that name files elsewhere or what is no file,
// and streams that unpack to more than the header says.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "../camera/temporary_folder.h"
#include "../support/dicom_files.h"
#include "../support/error_of.h"
#include "../support/held_memory.h"
#include "../support/read_study.h"
#include "../support/volume_files.h"
#include "colon/study/study.h"
#include "colon/study/study_dicom_file.h"
#include "study_dicom_slices.h"
#include "study_ramp.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using namespace test;

const std::string kBareMetaLines = "DimSize = 5 4 3\nElementType = MET_SHORT\n";

class HostileStudy : public testing::Test {
protected:
    HostileStudy() {
        fs::create_directories(mFolder / "in/below");
        for (const char* name : {"out.raw", "in/own.raw", "in/below/own.raw"})
            writeBytes(mFolder / name, bytesOfSamples(ramp<short>()));
    }
    fs::path nrrd(const std::string& data) const {
        return writeNrrd(mFolder / "in/a.nhdr", kShortLines + "data file: " + data + "\n", "");
    }
    fs::path meta(const std::string& data) const {
        writeBytes(mFolder / "in/a.mhd",
                   "ObjectType = Image\nNDims = 3\n" + kBareMetaLines + "ElementDataFile = " + data + "\n");
        return mFolder / "in/a.mhd";
    }

    TemporaryFolder mFolder;
};

TEST_F(HostileStudy, DataElsewhereIsNamedAndNotRead) {
    const std::string full = (mFolder / "out.raw").string();
    for (const std::string& data :
         {std::string("../out.raw"), std::string("below/../../out.raw"), full, std::string("/etc/hostname"),
          std::string("LIST\n../out.raw"), "LIST\nown.raw\n" + full, std::string("../out%d.raw 1 3 1")}) {
        const std::vector<std::string> said{"names the data file \"", "not in its own folder or below"};
        expectError(nrrd(data), said);
        expectError(meta(data), said);
        EXPECT_THAT(errorOf(mFolder / "in/a.mhd"), HasSubstr("put both into one folder"));
    }
}

TEST_F(HostileStudy, DataInTheFolderOrBelowIsReadHoweverItIsNamed) {
    for (const std::string& data : {std::string("own.raw"), std::string("./own.raw"),
                                    std::string("below/own.raw"), std::string("../in/own.raw"),
                                    (mFolder / "in/below/own.raw").string(), std::string("LIST\nown.raw")}) {
        SCOPED_TRACE(data);
        expectRamp(read(nrrd(data)));
        expectRamp(read(meta(data)));
    }
    fs::create_symlink("../out.raw", mFolder / "in/link.raw");
    expectRamp(read(nrrd("link.raw")));
}

TEST_F(HostileStudy, DataThatIsNoFileHoldsUpNothing) {
    ASSERT_EQ(mkfifo((mFolder / "in/pipe.raw").c_str(), 0600), 0);
    fs::create_symlink("pipe.raw", mFolder / "in/link.raw");
    fs::create_directory(mFolder / "in/folder.raw");
    fs::create_symlink("/dev/zero", mFolder / "in/device.raw");
    for (const auto& [name, kind] : {std::pair("pipe.raw", "a pipe"),
                                     {"link.raw", "a pipe"},
                                     {"folder.raw", "a folder"},
                                     {"device.raw", "a device"}})
        for (const fs::path& file : {nrrd(name), meta(name)}) {
            const std::string found = fmt::format("{}: expected a file, found {}", name, kind);
            EXPECT_THAT(errorOf(file), HasSubstr(found));
            EXPECT_THAT(errorOf(file), HasSubstr(found));
            Progress progress;
            EXPECT_THROW(glanceAtStudy(file, progress), Error);
            EXPECT_THROW(studyKey(file, {}), Error);
        }
    // NIfTI's other file has the name of the first.
    ASSERT_EQ(mkfifo((mFolder / "in/n.img").c_str(), 0600), 0);
    std::string head(348, '\0');
    head[0] = 0x5c, head[1] = 1;
    head.replace(344, 3, "ni1");
    head[40] = 3, head[42] = 5, head[44] = 4, head[46] = 3, head[70] = 4, head[72] = 16;
    for (const int spacing : {80, 84, 88}) head.replace(spacing, 4, std::string("\0\0\x80\x3f", 4));  // 1
    writeBytes(mFolder / "in/n.hdr", head);
    EXPECT_THAT(errorOf(mFolder / "in/n.hdr"), HasSubstr("n.img: expected a file, found a pipe"));
}

// Each is looked up once, not beside all before it.
TEST_F(HostileStudy, ManyNamesTakeNoLongTime) {
    std::string names = "LIST\n";
    for (int n = 0; n < 60'000; ++n) names += fmt::format("{}\n", n);
    EXPECT_THAT(test::errorOf([&] { studyKey(nrrd(names), {}); }), HasSubstr(": can not be opened"));
}

TEST_F(HostileStudy, WhatIsLeftOutOfAStreamIsBounded) {
    const std::string packed = gzipped(std::string(3, 'x') + bytesOfSamples(ramp<short>()));
    const std::string lines = replaced(kShortLines, "raw", "gzip");
    for (const char* encoding : {"gzip", "bzip2"}) {
        writeNrrd(mFolder / "a.nrrd", replaced(kShortLines, "raw", encoding) + "byte skip: 999999999999\n",
                  packed);
        expectError(mFolder / "a.nrrd", {"at most 67108864 bytes, found 999999999999 to leave out"});
    }
    writeNrrd(mFolder / "a.nrrd", lines + "byte skip: 3\n", packed);
    expectRamp(read(mFolder / "a.nrrd"));
}

// --- DICOM, deflated

// A data set of a slice up to its pixels, and what is put in before them.
std::string deflatedSet(const std::string& before, const std::string& pixels, std::int64_t said = -1,
                        int rows = kRows, int columns = kColumns) {
    DicomBytes out(DicomSyntax::Explicit);
    const DicomSpec spec = specOf(0);
    out.text(0x00080060, "CS", "CT");
    const std::string head = out.bytes();
    DicomBytes rest(DicomSyntax::Explicit);
    rest.text(0x0020000e, "UI", spec.slice.uid);
    rest.word(0x00280002, 1);
    rest.word(0x00280010, rows);
    rest.word(0x00280011, columns);
    rest.word(0x00280100, 16);
    rest.element(0x7fe00010, "OW", pixels, said);
    return head + before + rest.bytes();
}

std::string privateElement(std::size_t bytes) {
    DicomBytes out(DicomSyntax::Explicit);
    out.element(0x00091010, "OB", std::string(bytes, '\0'));
    return out.bytes();
}

constexpr std::size_t kPictureBytes = 2 * kColumns * kRows;

class DeflatedDicom : public testing::Test {
protected:
    // Returns what is wrong with the file of this data set; "" where nothing is.
    std::string damageOf(const std::string& set) const {
        writeBytes(mFolder / "a.dcm", dicomFile(DicomSyntax::Deflated, set));
        return DicomFile(mFolder / "a.dcm").damage();
    }
    TemporaryFolder mFolder;
};

TEST_F(DeflatedDicom, PixelsAreHeldAgainstRowsAndColumns) {
    EXPECT_EQ(damageOf(deflatedSet("", std::string(kPictureBytes, 'x'))), "");
    EXPECT_EQ(damageOf(deflatedSet("", std::string(kPictureBytes + 100, 'x'))), "") << "more than needed";
    EXPECT_THAT(damageOf(deflatedSet("", std::string(48 << 20, '\0'))),
                "is damaged: it says 50331648 bytes of pixels, 8 x 7 of them have 112");
    EXPECT_THAT(damageOf(deflatedSet("", std::string(1 << 20, '\0'), 0xfffffff0)),
                HasSubstr("it says 4294967280 bytes of pixels"));
}

TEST_F(DeflatedDicom, WhatStandsBeforeThePixelsIsBounded) {
    EXPECT_EQ(damageOf(deflatedSet(privateElement(20 << 20), std::string(kPictureBytes, 'x'))), "");
    EXPECT_THAT(damageOf(deflatedSet(privateElement(80 << 20), std::string(kPictureBytes, 'x'))),
                "is damaged: it has no pixels in its first 67108864 bytes, unpacked");
}

// Nobody would see that its end is cut off.
TEST_F(DeflatedDicom, WhatStandsBehindThePixelsIsLeftPacked) {
    DicomBytes behind(DicomSyntax::Explicit);
    behind.element(0xfffcfffc, "OB", std::string(40 << 20, '\0'));
    const std::string whole =
        dicomFile(DicomSyntax::Deflated, deflatedSet("", std::string(kPictureBytes, 'x')) + behind.bytes());
    writeBytes(mFolder / "a.dcm", whole.substr(0, whole.size() - 100));
    const DicomFile file(mFolder / "a.dcm");
    EXPECT_EQ(file.damage(), "");
    EXPECT_EQ(file.pixels().bytes, kPictureBytes);
}

TEST_F(DeflatedDicom, MemoryIsAskedForBeforePixelsAreUnpacked) {
    const std::string set = deflatedSet("", std::string(32'000'000, '\0'), -1, 4000, 4000);
    EXPECT_EQ(damageOf(set), "");
    setenv("STEREONAV_MEMORY", fmt::format("{:.0f}", bytesHeld() + 20e6).c_str(), 1);
    const std::string error = test::errorOf([&] { DicomFile(mFolder / "a.dcm").damage(); });
    unsetenv("STEREONAV_MEMORY");
    EXPECT_THAT(error, AllOf(HasSubstr("a.dcm: needs 32 MB of memory"), HasSubstr("not deflated")));
}

TEST_F(DeflatedDicom, CutOffOnesAreDamaged) {
    const std::string whole =
        dicomFile(DicomSyntax::Deflated, deflatedSet("", std::string(kPictureBytes, 'x')));
    for (std::size_t left = 1; left < 60; left += 7) {
        writeBytes(mFolder / "a.dcm", whole.substr(0, whole.size() - left));
        EXPECT_THAT(DicomFile(mFolder / "a.dcm").damage(), HasSubstr("is cut off")) << left;
    }
}

// --- DICOM, plain

// Zeros behind the pixels are looked through once, not once for each eight of them.
TEST(HostileDicom, ZerosThatDoNotReachTheEndTakeNoLongTime) {
    const TemporaryFolder folder;
    DicomSpec spec = specOf(0);
    spec.syntax = DicomSyntax::Implicit;
    const std::string slice = dicomBytes(spec);
    writeBytes(folder / "a.dcm", slice + std::string(4 << 20, '\0'));
    EXPECT_EQ(DicomFile(folder / "a.dcm").damage(), "");
    // An element without a value for each eight zeros, and then one that is none.
    writeBytes(folder / "a.dcm", slice + std::string(4 << 20, '\0') + "abc");
    EXPECT_THAT(DicomFile(folder / "a.dcm").damage(), HasSubstr("is cut off or damaged at byte"));
}

TEST(HostileDicom, ItemsAreCounted) {
    const TemporaryFolder folder;
    DicomBytes out(DicomSyntax::Explicit);
    std::string items;
    for (int n = 0; n < 1'000'001; ++n) items += out.item("", true);
    out.sequence(0x52009230, items, true);
    writeBytes(folder / "a.dcm", dicomFile(DicomSyntax::Explicit, out.bytes()));
    EXPECT_EQ(DicomFile(folder / "a.dcm").damage(), "is damaged: its sequences have more than 1000000 items");
}

}  // namespace
}  // namespace stereonav
