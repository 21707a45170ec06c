// NRRD and MetaImage whole: encodings, detached samples, spaces, units and byte orders; each against ITK's
// own reading of the same file where ITK reads it, else against what the formats' descriptions say.
#include <bzlib.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <itkMetaImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>

#include "../camera/temporary_folder.h"
#include "../support/read_study.h"
#include "../support/volume_files.h"
#include "colon/study/study.h"
#include "study_ramp.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::HasSubstr;
using namespace test;

std::string bzipped(std::string bytes) {
    std::string out(bytes.size() * 2 + 1000, '\0');
    auto length = static_cast<unsigned>(out.size());
    BZ2_bzBuffToBuffCompress(out.data(), &length, bytes.data(), static_cast<unsigned>(bytes.size()), 9, 0, 0);
    out.resize(length);
    return out;
}

std::string turned(std::string bytes, std::size_t each) {
    for (auto at = bytes.begin(); at != bytes.end(); at += static_cast<long>(each))
        std::reverse(at, at + static_cast<long>(each));
    return bytes;
}

std::string rampText() {
    std::string text;
    for (const short x : ramp<short>()) text += std::to_string(x) + (x % 5 == 0 ? "\n" : " ");
    return text;
}

std::string rampHex(const std::string& bytes) {
    std::string text;
    for (const char c : bytes) {
        text += fmt::format("{:02x}", static_cast<unsigned char>(c));
        if (text.size() % 71 > 68) text += "\n";
    }
    return text;
}

// Sizes, places and each value as ITK has them.
void expectAsItk(const fs::path& file, itk::ImageIOBase& io) {
    SCOPED_TRACE(file.filename().string());
    itk::Object::SetGlobalWarningDisplay(false);
    io.SetFileName(file.string());
    io.ReadImageInformation();
    std::vector<char> bytes(io.GetImageSizeInBytes());
    itk::ImageIORegion region(3);
    for (unsigned axis = 0; axis < 3; ++axis) region.SetSize(axis, io.GetDimensions(axis));
    io.SetIORegion(region);
    io.Read(bytes.data());
    const Study study = read(file);
    const VolumeFrame& frame = study.grey.frame;
    for (int axis = 0; axis < 3; ++axis) {
        const auto n = static_cast<unsigned>(axis);
        EXPECT_EQ(frame.size[axis], static_cast<int>(io.GetDimensions(n)));
        EXPECT_NEAR(1e3 * frame.spacing[axis], io.GetSpacing(n), 1e-9);
        EXPECT_NEAR(1e3 * frame.origin[axis], io.GetOrigin(n), 1e-9);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(frame.axes[axis][c], io.GetDirection(n)[static_cast<unsigned>(c)], 1e-9);
    }
    ASSERT_EQ(bytes.size(), 120u);
    for (int n = 0; n < 60; ++n) {
        short value;
        std::memcpy(&value, &bytes[2 * static_cast<std::size_t>(n)], 2);
        ASSERT_EQ(study.grey.values[n] * study.grey.scale + study.grey.offset, value) << n;
    }
}

void expectNrrdAsItk(const fs::path& file) {
    expectAsItk(file, *itk::NrrdImageIO::New());
}
void expectMetaAsItk(const fs::path& file) {
    expectAsItk(file, *itk::MetaImageIO::New());
}

TEST(StudyNrrdEncodings, AllOfThem) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    const struct {
        const char* name;
        std::string bytes;
    } cases[] = {
        {"raw", bytes},       {"gzip", gzipped(bytes)}, {"gz", gzipped(bytes)},    {"ascii", rampText()},
        {"text", rampText()}, {"hex", rampHex(bytes)},  {"bzip2", bzipped(bytes)}, {"bz2", bzipped(bytes)}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.name);
        const fs::path file = writeNrrd(folder / (std::string(c.name) + ".nrrd"),
                                        replaced(kShortLines, "raw", c.name), c.bytes);
        expectRamp(read(file));
        if (c.name[0] != 'b') expectNrrdAsItk(file);
    }
    // Streams one after another, as parallel packers write them.
    for (const bool gzip : {true, false}) {
        const auto packed = [&](const std::string& part) { return gzip ? gzipped(part) : bzipped(part); };
        expectRamp(read(writeNrrd(folder / "two.nrrd", replaced(kShortLines, "raw", gzip ? "gzip" : "bzip2"),
                                  packed(bytes.substr(0, 33)) + packed(bytes.substr(33)))));
    }
    writeNrrd(folder / "x.nrrd", replaced(kShortLines, "raw", "zstd"), bytes);
    expectError(folder / "x.nrrd", {"x.nrrd:8", "an encoding", "found \"zstd\""});
}

TEST(StudyNrrdEncodings, BothByteOrders) {
    const TemporaryFolder folder;
    const std::string bytes = turned(bytesOfSamples(ramp<short>()), 2);
    const std::string lines = replaced(kShortLines, "little", "big");
    expectNrrdAsItk(writeNrrd(folder / "a.nrrd", lines, bytes));
    expectNrrdAsItk(writeNrrd(folder / "b.nrrd", replaced(lines, "raw", "gzip"), gzipped(bytes)));
    const std::string real = turned(bytesOfSamples(ramp<double>()), 8);
    expectRamp(read(writeNrrd(folder / "c.nrrd", replaced(lines, "short", "double"), real)));
    writeNrrd(folder / "d.nrrd", replaced(lines, "endian: big\n", ""), bytes);
    expectError(folder / "d.nrrd", {"endian: little or big"});
}

template <typename T>
void expectNrrdType(const std::vector<const char*>& names, double start, double step) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<T>(start, step));
    for (const char* name : names)
        for (const bool big : {false, true}) {
            SCOPED_TRACE(fmt::format("{} {}", name, big));
            const std::string lines = replaced(kShortLines, "type: short", std::string("type: ") + name);
            expectRamp(read(writeNrrd(folder / "a.nrrd", big ? replaced(lines, "little", "big") : lines,
                                      big ? turned(bytes, sizeof(T)) : bytes)),
                       start, step);
        }
}

// Under every name that the format's description gives them.
TEST(StudyNrrdTypes, AllIntegersAndFloats) {
    expectNrrdType<std::int8_t>({"signed char", "int8", "int8_t"}, -40, 1);
    expectNrrdType<std::uint8_t>({"uchar", "unsigned char", "uint8", "uint8_t"}, 3, 4);
    expectNrrdType<std::int16_t>(
        {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}, -300, 17);
    expectNrrdType<std::uint16_t>({"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"},
                                  1000, 1000);
    expectNrrdType<std::int32_t>({"int", "signed int", "int32", "int32_t"}, -300, 17);
    expectNrrdType<std::uint32_t>({"uint", "unsigned int", "uint32", "uint32_t"}, 3e9, 1000);
    expectNrrdType<std::int64_t>({"longlong", "long long", "long long int", "signed long long",
                                  "signed long long int", "int64", "int64_t"},
                                 -5e9, 1000);
    expectNrrdType<std::uint64_t>(
        {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}, 5e9, 1000);
    expectNrrdType<float>({"float"}, -300, 17);
    expectNrrdType<double>({"double"}, -300, 17);
}

TEST(StudyNrrdEncodings, WhatIsCutOffOrNoNumberIsSaid) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    std::string packed = bzipped(bytes);
    const std::string bz = replaced(kShortLines, "raw", "bzip2"), text = replaced(kShortLines, "raw", "text");
    writeNrrd(folder / "a.nrrd", bz, packed.substr(0, packed.size() - 20));
    expectError(folder / "a.nrrd", {"cut off", "120 bytes", "found "});
    packed[packed.size() / 2] = static_cast<char>(packed[packed.size() / 2] ^ 0x55);
    writeNrrd(folder / "a.nrrd", bz, packed);
    expectError(folder / "a.nrrd", {"damaged", "unpacked"});
    writeNrrd(folder / "a.nrrd", bz, bytes);
    expectError(folder / "a.nrrd", {"damaged", "not bzip2"});
    writeNrrd(folder / "a.nrrd", text, rampText().substr(0, 200));
    expectError(folder / "a.nrrd", {"cut off", "60 samples"});
    writeNrrd(folder / "a.nrrd", text, replaced(rampText(), "-181", "-1x1"));
    expectError(folder / "a.nrrd", {"sample 8", "found \"-1x1\""});
    writeNrrd(folder / "a.nrrd", text, replaced(rampText(), "-181", std::string(309, '9')));
    expectError(folder / "a.nrrd", {"sample 8", "found \"99999"});
    writeNrrd(folder / "a.nrrd", replaced(kShortLines, "raw", "hex"), rampHex(bytes).substr(0, 100));
    expectError(folder / "a.nrrd", {"cut off", "120 bytes"});
    writeNrrd(folder / "a.nrrd", replaced(kShortLines, "raw", "hex"), replaced(rampHex(bytes), "fe", "g0"));
    expectError(folder / "a.nrrd", {"hexadecimal digits"});
}

TEST(StudyNrrdDetached, ListsPatternsAndSkips) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    for (int k = 0; k < 3; ++k) {
        const std::string slice = bytes.substr(40 * static_cast<std::size_t>(k), 40);
        writeBytes(folder / fmt::format("s {:03}.raw", 2 * k + 7), slice);
        writeBytes(folder / fmt::format("p{:03}.raw", 2 * k + 7), slice);
        writeBytes(folder / fmt::format("g{}.gz", k), gzipped(slice));
    }
    const auto header = [&](const std::string& name, const std::string& lines) {
        return writeNrrd(folder / name, kShortLines + lines, "");
    };
    expectRamp(read(header("list.nhdr", "data file: LIST\ns 007.raw\ns 009.raw\ns 011.raw\n")));
    expectRamp(read(header("list2.nhdr", "data file: LIST 2\ns 007.raw\ns 009.raw\ns 011.raw\n")));
    expectNrrdAsItk(header("pattern.nhdr", "data file: p%03d.raw 7 11 2\n"));
    expectNrrdAsItk(header("pattern2.nhdr", "data file: p%03d.raw 7 11 2 2\n"));
    std::string backwards;
    for (int k = 2; k >= 0; --k) backwards += bytes.substr(40 * static_cast<std::size_t>(k), 40);
    writeBytes(folder / "back.raw", backwards);
    expectNrrdAsItk(header("down.nhdr", "data file: p%03d.raw 11 7 -2\n"));
    writeNrrd(folder / "packed.nhdr", replaced(kShortLines, "raw", "gzip") + "data file: g%d.gz 0 2 1\n", "");
    expectRamp(read(folder / "packed.nhdr"));
    writeBytes(folder / "d.raw", "one\ntwo\nABC" + bytes);
    expectNrrdAsItk(header("skip.nhdr", "line skip: 2\nbyte skip: 3\ndata file: d.raw\n"));
    expectNrrdAsItk(header("end.nhdr", "byte skip: -1\ndata file: d.raw\n"));
    expectRamp(
        read(header("absolute.nhdr", "byte skip: -1\ndatafile: " + (folder / "d.raw").string() + "\n")));
    header("step.nhdr", "data file: p%03d.raw 7 11 0\n");
    expectError(folder / "step.nhdr", {"7 to 11 by 0"});
    header("gone.nhdr", "data file: p%03d.raw 7 13 2\n");
    expectError(folder / "gone.nhdr", {"p013.raw", "can not be opened"});
    header("many.nhdr", "data file: p%03d.raw 1 999999999 1\n");
    expectError(folder / "many.nhdr", {"more than 100000 data files"});
    header("uneven.nhdr",
           "data file: LIST\np007.raw\np009.raw\np011.raw\np007.raw\np009.raw\np011.raw\np007.raw\n");
    expectError(folder / "uneven.nhdr", {"equal shares", "7 files"});
}

TEST(StudyNrrdSpaces, AllOfThem) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    const struct {
        const char* name;
        glm::dvec3 signs;
        bool itk, said;  // ITK 5.2 turns the wrong axis of left-anterior-superior
    } cases[] = {{"left-posterior-superior", {1, 1, 1}, true, false},
                 {"LPS", {1, 1, 1}, true, false},
                 {"right-anterior-superior", {-1, -1, 1}, true, false},
                 {"RAS", {-1, -1, 1}, true, false},
                 {"left-anterior-superior", {1, -1, 1}, false, false},
                 {"LAS", {1, -1, 1}, false, false},
                 {"scanner-xyz", {1, 1, 1}, true, true},
                 {"3D-right-handed", {1, 1, 1}, true, true},
                 {"3D-left-handed", {1, 1, -1}, false, true}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.name);
        const fs::path file =
            writeNrrd(folder / "a.nrrd", replaced(kShortLines, "left-posterior-superior", c.name), bytes);
        const Study study = read(file);
        expectRamp(study);
        expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), c.signs * glm::dvec3(0.009, 0.0098, 0.013));
        EXPECT_EQ(study.notes.size(), c.said ? 1u : 0u);
        if (c.itk) expectNrrdAsItk(file);
    }
    writeNrrd(folder / "a.nrrd", replaced(kShortLines, "left-posterior-superior", "sideways"), bytes);
    expectError(folder / "a.nrrd", {"a.nrrd:4", "a space of three axes", "sideways"});
    const Study free =
        read(writeNrrd(folder / "b.nrrd",
                       replaced(kShortLines, "space: left-posterior-superior", "space dimension: 3"), bytes));
    expectNear(free.grey.frame.worldFromVoxel({4, 3, 2}), {0.009, 0.0098, 0.013});
    ASSERT_EQ(free.notes.size(), 1u);
    EXPECT_THAT(free.notes[0], HasSubstr("says nothing of the patient"));
}

TEST(StudyNrrdSpaces, UnitsOfLengthCount) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    for (const auto& [unit, scale] : {std::pair("mm", 1.0),
                                      {"um", 1e-3},
                                      {"\xc2\xb5m", 1e-3},
                                      {"micron", 1e-3},
                                      {"cm", 10.0},
                                      {"m", 1e3},
                                      {"nm", 1e-6}}) {
        const Study study =
            read(writeNrrd(folder / "a.nrrd",
                           kShortLines + fmt::format("space units: \"{0}\" \"{0}\" \"{0}\"\n", unit), bytes));
        expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), scale * glm::dvec3(0.009, 0.0098, 0.013),
                   1e-12 * scale);
    }
    const Study odd =
        read(writeNrrd(folder / "a.nrrd", kShortLines + "space units: \"ell\" \"mm\" \"mm\"\n", bytes));
    ASSERT_EQ(odd.notes.size(), 1u);
    EXPECT_THAT(odd.notes[0], HasSubstr("\"ell\""));
}

TEST(StudyNrrdSpaces, WithoutOneSpacingsAndEndsCount) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    const std::string lines = "type: short\ndimension: 3\nsizes: 5 4 3\nendian: little\nencoding: raw\n";
    expectNrrdAsItk(writeNrrd(folder / "a.nrrd", lines + "spacings: 0.5 0.6 2\n", bytes));
    expectNrrdAsItk(writeNrrd(folder / "b.nrrd", lines + "spacings: 0.5 0.6 2\naxis mins: 1 2 3\n", bytes));
    // 5 cells over 5, 3 steps over 6, 3 cells over 9.
    const Study ends = read(writeNrrd(
        folder / "c.nrrd", lines + "axis mins: 1 2 3\naxis maxs: 6 8 12\ncenters: cell node cell\n", bytes));
    expectNear(ends.grey.frame.spacing, {0.001, 0.002, 0.003});
    expectNear(ends.grey.frame.origin, {0.0015, 0.002, 0.0045});
    const Study none = read(writeNrrd(folder / "d.nrrd", lines, bytes));
    expectNear(none.grey.frame.spacing, {0.001, 0.001, 0.001});
    ASSERT_EQ(none.notes.size(), 1u);
    EXPECT_THAT(none.notes[0], HasSubstr("no spacing"));
}

TEST(StudyNrrdSpaces, AxesOfOneComponentAreLeftOut) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    std::string lines = replaced(replaced(kShortLines, "dimension: 3", "dimension: 4"), "5 4 3", "1 5 4 3");
    expectRamp(
        read(writeNrrd(folder / "a.nrrd", replaced(lines, "directions: (", "directions: none ("), bytes)));
    lines = replaced(lines, "1 5 4 3", "2 5 4 3");
    writeNrrd(folder / "b.nrrd", replaced(lines, "directions: (", "directions: none ("), bytes + bytes);
    expectError(folder / "b.nrrd", {"one number a voxel, found 2"});
}

TEST(StudyNrrdBad, NumbersAndNames) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>()), digits(309, '9');
    const struct {
        std::string from, to, place, says;
    } cases[] = {{"sizes: 5 4 3", "sizes: 5 " + digits + " 3", "a.nrrd:5", "found 9999999999"},
                 {"sizes: 5 4 3", "sizes: 5 4", "a.nrrd:5", "3 sizes, found 2"},
                 {"sizes: 5 4 3", "sizes: 5 0 3", "a.nrrd:5", "above 0, found 0"},
                 {"dimension: 3", "dimension: " + digits, "a.nrrd:3", "(309 characters)"},
                 {"(0,0,2)", "(0,0," + digits + ")", "a.nrrd:6", "vectors of three numbers"},
                 {"(0,0,2)", "(0,2)", "a.nrrd:6", "vectors of three numbers"},
                 {"(0,0,2)", "", "a.nrrd:6", "3 space directions, found 2"},
                 {"type: short", "type: block", "a.nrrd:2", "found \"block\""},
                 {"(7,8,9)", "(7,8," + digits + ")", "a.nrrd:9", "space origin"}};
    for (const auto& c : cases) {
        writeNrrd(folder / "a.nrrd", replaced(kShortLines, c.from, c.to), bytes);
        expectError(folder / "a.nrrd", {c.place, c.says});
        EXPECT_LT(errorOf(folder / "a.nrrd").size(), 400u);
    }
}

const std::string kMetaLines =
    "ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 7 8 9\n"
    "ElementSpacing = 0.5 0.6 2\nDimSize = 5 4 3\nElementType = MET_SHORT\n";

TEST(StudyMetaFiles, AreReadAsItkDoes) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    const auto write = [&](const std::string& name, const std::string& lines, const std::string& data) {
        writeBytes(folder / name, kMetaLines + lines + data);
        return folder / name;
    };
    expectMetaAsItk(write("a.mha", "ElementDataFile = LOCAL\n", bytes));
    expectMetaAsItk(
        write("b.mha", "BinaryDataByteOrderMSB = True\nElementDataFile = LOCAL\n", turned(bytes, 2)));
    expectMetaAsItk(
        write("c.mha", "ElementByteOrderMSB = True\nElementDataFile = LOCAL\n", turned(bytes, 2)));
    for (int k = 0; k < 3; ++k)
        writeBytes(folder / fmt::format("s{:02}.raw", 3 * k + 1),
                   bytes.substr(40 * static_cast<std::size_t>(k), 40));
    expectMetaAsItk(write("list.mhd", "ElementDataFile = LIST\ns01.raw\ns04.raw\ns07.raw\n", ""));
    expectMetaAsItk(write("pattern.mhd", "ElementDataFile = s%02d.raw 1 7 3\n", ""));
    writeBytes(folder / "d.raw", "headerhead" + bytes);
    expectMetaAsItk(write("skip.mhd", "HeaderSize = 10\nElementDataFile = d.raw\n", ""));
    expectMetaAsItk(write("end.mhd", "HeaderSize = -1\nElementDataFile = d.raw\n", ""));
    writeBytes(folder / "t.mha", replaced(kMetaLines, "BinaryData = True", "BinaryData = False") +
                                     "ElementDataFile = LOCAL\n" + rampText());
    expectMetaAsItk(folder / "t.mha");
    const Study turnedAxes = read(folder / "a.mha");
    // i along +y, j along -x.
    expectNear(turnedAxes.grey.frame.worldFromVoxel({4, 3, 2}), {0.0052, 0.010, 0.013});
}

template <typename T>
void expectMetaType(const std::string& name, double start, double step) {
    const TemporaryFolder folder;
    for (const bool big : {false, true}) {
        const std::string bytes = bytesOfSamples(ramp<T>(start, step));
        writeBytes(folder / "a.mha", replaced(kMetaLines, "MET_SHORT", name) +
                                         fmt::format("BinaryDataByteOrderMSB = {}\nElementDataFile = LOCAL\n",
                                                     big ? "True" : "False") +
                                         (big ? turned(bytes, sizeof(T)) : bytes));
        SCOPED_TRACE(name);
        expectRamp(read(folder / "a.mha"), start, step);
        // ITK agrees about the bytes of each.
        const auto io = itk::MetaImageIO::New();
        io->SetFileName((folder / "a.mha").string());
        io->ReadImageInformation();
        EXPECT_EQ(io->GetComponentSize(), sizeof(T));
    }
}

TEST(StudyMetaFiles, AllTypesInBothOrders) {
    expectMetaType<signed char>("MET_CHAR", -40, 2);
    expectMetaType<unsigned char>("MET_UCHAR", 3, 4);
    expectMetaType<std::uint16_t>("MET_USHORT", 1000, 1000);
    expectMetaType<std::int32_t>("MET_INT", -300, 17);
    expectMetaType<std::uint32_t>("MET_UINT", 3e9, 1000);
    expectMetaType<std::int64_t>("MET_LONG_LONG", -5e9, 1000);
    expectMetaType<std::uint64_t>("MET_ULONG_LONG", 5e9, 1000);
    expectMetaType<float>("MET_FLOAT", -300, 17);
    expectMetaType<double>("MET_DOUBLE", -300, 17);
}

// zlib of MetaIO prints lines of its own over such files.
TEST(StudyMetaFiles, DamagedCompressionIsOneLineAndNothingElse) {
    const TemporaryFolder folder;
    const std::string lines = kMetaLines + "CompressedData = True\nElementDataFile = LOCAL\n";
    std::string packed(compressBound(120), '\0');
    uLongf length = packed.size();
    const std::string bytes = bytesOfSamples(ramp<short>());
    compress(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
             120);
    packed.resize(length);
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    writeBytes(folder / "a.mha", lines + packed);
    expectRamp(read(folder / "a.mha"));
    for (const std::size_t at : {std::size_t{0}, packed.size() / 2, packed.size() - 2}) {
        std::string bad = packed;
        bad[at] = static_cast<char>(bad[at] ^ 0x5a);
        writeBytes(folder / "a.mha", lines + bad);
        expectError(folder / "a.mha", {"damaged", "can not be unpacked"});
    }
    writeBytes(folder / "a.mha", lines + "this is not packed at all, whatever the header says");
    expectError(folder / "a.mha", {"can not be unpacked"});
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(StudyMetaFiles, UnitsAndHugeNumbers) {
    const TemporaryFolder folder;
    const std::string bytes = bytesOfSamples(ramp<short>());
    writeBytes(folder / "a.mha", kMetaLines + "DistanceUnits = um\nElementDataFile = LOCAL\n" + bytes);
    expectNear(read(folder / "a.mha").grey.frame.spacing, {0.5e-6, 0.6e-6, 2e-6}, 1e-15);
    writeBytes(folder / "a.mha", replaced(kMetaLines, "5 4 3", "5 4 " + std::string(309, '9')) +
                                     "ElementDataFile = LOCAL\n" + bytes);
    expectError(folder / "a.mha", {"a.mha:7", "sizes above 0", "(313 characters)"});
}

}  // namespace
}  // namespace stereonav
