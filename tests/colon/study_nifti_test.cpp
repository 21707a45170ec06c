// NIfTI whole: both versions, both byte orders, every type, scales, pairs, units, and which of the two forms
// counts. Truth is written by hand after nifti1.h; nibabel gives the same.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../camera/temporary_folder.h"
#include "../support/nifti_files.h"
#include "../support/read_study.h"
#include "../support/volume_files.h"
#include "colon/study/study.h"
#include "study_ramp.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using testing::HasSubstr;
using namespace test;

NiftiSpec placed() {
    NiftiSpec s;
    s.sformCode = 1;
    return s;
}

template <typename T>
Study readNifti(const std::vector<T>& samples, const NiftiSpec& spec, bool packed = false) {
    const TemporaryFolder folder;
    const std::string bytes = niftiFile(samples, spec);
    const fs::path file = folder / (packed ? "a.nii.gz" : "a.nii");
    writeBytes(file, packed ? gzipped(bytes) : bytes);
    return read(file);
}

void expectValues(const Study& study, const std::function<double(int)>& value, double tolerance = 0) {
    ASSERT_FALSE(study.isMask);
    const GreyVolume& grey = study.grey;
    for (int n = 0; n < static_cast<int>(grey.frame.count()); ++n)
        ASSERT_NEAR(grey.values[n] * grey.scale + grey.offset, value(n), tolerance) << "voxel " << n;
}

TEST(StudyNiftiValues, AreScaledAsTheHeaderSays) {
    for (const bool packed : {false, true})
        for (const auto& [slope, intercept] :
             {std::pair(1.0, -1024.0), {0.5, 0.0}, {2.0, -1000.0}, {-0.25, 3.0}, {1.5e-3, 7.0}}) {
            NiftiSpec s = placed();
            s.slope = slope;
            s.intercept = intercept;
            // In the file's 32 bits; computed in 64, as nibabel does.
            const double m = static_cast<float>(slope), b = static_cast<float>(intercept);
            SCOPED_TRACE(fmt::format("{} {} {}", slope, intercept, packed));
            expectValues(
                readNifti(ramp<short>(), s, packed), [&](int n) { return (-300 + 17 * n) * m + b; },
                1e-12 * (1 + std::abs(b)));
        }
}

TEST(StudyNiftiValues, KeepTheirExactScaleOverTheWholeRange) {
    NiftiSpec s = placed();
    s.datatype = 512;
    s.slope = 0.1;
    const double m = static_cast<float>(0.1);
    std::vector<std::uint16_t> samples = ramp<std::uint16_t>(0, 1000);
    samples[59] = 65535;
    expectValues(
        readNifti(samples, s), [&](int n) { return samples[static_cast<std::size_t>(n)] * m; }, 1e-9);
}

TEST(StudyNiftiValues, ScaledMasksAndLabelsAreFound) {
    NiftiSpec s = placed();
    s.datatype = 2;
    s.slope = -0.5;
    s.intercept = 127.5;
    std::vector<unsigned char> samples(60, 255);
    for (int n = 20; n < 33; ++n) samples[n] = 0;
    const Study study = readNifti(samples, s);  // 0 and 127.5
    ASSERT_TRUE(study.isMask);
    for (int n = 0; n < 60; ++n) EXPECT_EQ(study.mask.values[n], n >= 20 && n < 33);
}

TEST(StudyNiftiValues, ASlopeOf0MeansNoScale) {
    NiftiSpec s = placed();
    s.slope = 0;
    s.intercept = 5;
    expectRamp(readNifti(ramp<short>(), s));
    s.intercept = std::numeric_limits<double>::quiet_NaN();
    expectRamp(readNifti(ramp<short>(), s));
}

// The rule of nibabel: a slope that is no number scales nothing, and the intercept does not count then.
TEST(StudyNiftiValues, ASlopeThatIsNoNumberMeansNoScaleAndItIsSaid) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    for (const int version : {1, 2})
        for (const double slope : {nan, inf, -inf})
            for (const double intercept : {0.0, 5.0, nan, inf}) {
                NiftiSpec s = placed();
                s.version = version;
                s.slope = slope;
                s.intercept = intercept;
                const Study study = readNifti(ramp<short>(), s);
                expectRamp(study);
                ASSERT_EQ(study.notes.size(), 1u);
                EXPECT_THAT(study.notes[0], HasSubstr("scl_slope is"));
                EXPECT_THAT(study.notes[0], HasSubstr("values are taken as they are stored"));
            }
}

TEST(StudyNiftiValues, AnInterceptThatIsNoNumberIsRefusedBesideAScale) {
    const TemporaryFolder folder;
    for (const int version : {1, 2})
        for (const double number :
             {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
            NiftiSpec s = placed();
            s.version = version;
            s.slope = 1;
            s.intercept = number;
            writeBytes(folder / "a.nii", niftiFile(ramp<short>(), s));
            expectError(folder / "a.nii", {version == 1 ? "byte 116" : "byte 184", "scl_inter"});
        }
}

template <typename T>
void expectType(int datatype, double start, double step) {
    for (const int version : {1, 2})
        for (const bool bigEndian : {false, true})
            for (const bool packed : {false, true}) {
                NiftiSpec s = placed();
                s.version = version;
                s.bigEndian = bigEndian;
                s.datatype = datatype;
                SCOPED_TRACE(
                    fmt::format("datatype {} version {} {} {}", datatype, version, bigEndian, packed));
                const Study study = readNifti(ramp<T>(start, step), s, packed);
                expectRamp(study, start, step);
                EXPECT_EQ(study.description, "made for a test");
                // RAS (10 + 0.5 i, 20 + 0.75 j, 30 + 2 k) in millimetres, with the first two turned round.
                expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), {-0.012, -0.02225, 0.034}, 1e-9);
            }
}

TEST(StudyNiftiTypes, AllIntegersAndFloatsInBothVersionsAndOrders) {
    expectType<std::uint8_t>(2, 3, 4);
    expectType<std::int8_t>(256, -40, 2);
    expectType<std::int16_t>(4, -300, 17);
    expectType<std::uint16_t>(512, 1000, 1000);
    expectType<std::int32_t>(8, -300, 17);
    expectType<std::uint32_t>(768, 3e9, 1000);
    expectType<std::int64_t>(1024, -5e9, 1000);
    expectType<std::uint64_t>(1280, 5e9, 1000);
    expectType<float>(16, -300, 17);
    expectType<double>(64, -300, 17);
}

TEST(StudyNiftiTypes, OthersAreRefusedByName) {
    const TemporaryFolder folder;
    for (const auto& [datatype, name] : {std::pair(1, "single bits"),
                                         {32, "complex"},
                                         {128, "colours"},
                                         {1536, "128-bit"},
                                         {1792, "complex"},
                                         {2304, "colours"},
                                         {0, "not known"}}) {
        NiftiSpec s = placed();
        s.datatype = datatype;
        writeBytes(folder / "a.nii", niftiFile(std::vector<double>(480), s));
        expectError(folder / "a.nii", {name, fmt::format("datatype {}", datatype)});
    }
}

TEST(StudyNiftiTypes, NumbersThatAreNoneBecomeTheLeast) {
    NiftiSpec s = placed();
    s.datatype = 16;
    s.slope = 2;
    std::vector<float> samples = ramp<float>();
    samples[7] = std::numeric_limits<float>::quiet_NaN();
    const Study study = readNifti(samples, s);
    expectValues(study, [&](int n) { return n == 7 ? -600.0 : 2 * (-300 + 17 * n); });
    ASSERT_EQ(study.notes.size(), 1u);
    EXPECT_THAT(study.notes[0], HasSubstr("1 voxels that are not numbers"));
}

// A quarter turn about z: i to +y, j to -x (RAS).
void turnQuarter(NiftiSpec& s) {
    s.quatern = {0, 0, std::sqrt(0.5)};
    s.qformCode = 1;
}

TEST(StudyNiftiPlaces, TheQformCountsWhereThereIsNoSform) {
    for (const int version : {1, 2}) {
        NiftiSpec s;
        s.version = version;
        turnQuarter(s);
        const Study study = readNifti(ramp<short>(), s);
        expectRamp(study);
        // RAS: (10 - 0.75 j, 20 + 0.5 i, 30 + 2 k).
        expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), {-0.00775, -0.022, 0.034}, 1e-8);
        EXPECT_TRUE(study.notes.empty());
    }
}

TEST(StudyNiftiPlaces, TheThirdAxisTurnsWithQfac) {
    NiftiSpec s;
    s.qformCode = 2;
    s.pixdim[0] = -1;
    expectNear(readNifti(ramp<short>(), s).grey.frame.worldFromVoxel({0, 0, 2}), {-0.010, -0.020, 0.026},
               1e-8);
}

TEST(StudyNiftiPlaces, TheSformCountsWhereBothAreThereAndItIsSaid) {
    NiftiSpec s = placed();
    turnQuarter(s);
    const Study study = readNifti(ramp<short>(), s);
    expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), {-0.012, -0.02225, 0.034}, 1e-8);
    ASSERT_EQ(study.notes.size(), 1u);
    // The corner (4, 3): RAS (12, 22.25) by the sform, (7.75, 22) by the qform: 4.257 mm apart.
    EXPECT_THAT(study.notes[0], HasSubstr("differ by up to 4.26 mm: the sform counts"));
    s.quatern = {0, 0, 0};
    EXPECT_TRUE(readNifti(ramp<short>(), s).notes.empty());
}

TEST(StudyNiftiPlaces, WithoutAnyTheGridIsCentredAndItIsSaid) {
    const Study study = readNifti(ramp<short>(), NiftiSpec());
    // nibabel: RAS (1 - 0.5 i, -1.125 + 0.75 j, -2 + 2 k).
    expectNear(study.grey.frame.worldFromVoxel({0, 0, 0}), {-0.001, 0.001125, -0.002}, 1e-12);
    expectNear(study.grey.frame.worldFromVoxel({4, 3, 2}), {0.001, -0.001125, 0.002}, 1e-12);
    ASSERT_EQ(study.notes.size(), 1u);
    EXPECT_THAT(study.notes[0], HasSubstr("neither sform nor qform"));
}

TEST(StudyNiftiPlaces, AreInTheHeadersUnits) {
    for (const auto& [units, scale] : {std::pair(0, 1.0), {1, 1e3}, {2, 1.0}, {3, 1e-3}, {2 | 8, 1.0}})
        for (const int version : {1, 2}) {
            NiftiSpec s = placed();
            s.version = version;
            s.units = units;
            const Study study = readNifti(ramp<short>(), s);
            expectNear(study.grey.frame.spacing, scale * glm::dvec3(0.0005, 0.00075, 0.002), 1e-9 * scale);
            expectNear(study.grey.frame.origin, scale * glm::dvec3(-0.010, -0.020, 0.030), 1e-9 * scale);
            EXPECT_EQ(study.notes.size(), scale == 1 ? 0u : 1u);
        }
}

TEST(StudyNiftiPlaces, RotationsThatAreNoneAreRefused) {
    const TemporaryFolder folder;
    NiftiSpec s;
    s.qformCode = 1;
    s.quatern = {0.9, 0.9, 0};
    writeBytes(folder / "a.nii", niftiFile(ramp<short>(), s));
    expectError(folder / "a.nii", {"byte 256", "a quaternion of length 1.27"});
    s.qformCode = 0;
    s.sformCode = 1;
    s.srow = {};
    writeBytes(folder / "a.nii", niftiFile(ramp<short>(), s));
    expectError(folder / "a.nii", {"spacing above 0 along axis 1"});
}

// Where the sform counts, a qform and spacings that are no numbers, or no rotation, change nothing.
TEST(StudyNiftiPlaces, WhatDoesNotCountBesideASformMayHoldAnything) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    const auto place = [](const Study& study) { return study.grey.frame.worldFromVoxel({4, 3, 2}); };
    for (const int version : {1, 2})
        for (const int qformCode : {0, 1, 4})
            for (const double bad : {nan, inf, 1e30, 0.9}) {
                SCOPED_TRACE(fmt::format("version {} qform {} {}", version, qformCode, bad));
                NiftiSpec s = placed();
                s.version = version;
                s.qformCode = qformCode;
                s.quatern = {bad, bad, 0};
                Study study = readNifti(ramp<short>(), s);
                expectRamp(study);
                expectNear(place(study), {-0.012, -0.02225, 0.034}, 1e-8);
                ASSERT_EQ(study.notes.size(), qformCode > 0 ? 1u : 0u);
                if (qformCode > 0) {
                    EXPECT_THAT(study.notes[0], HasSubstr("left aside: the sform counts"));
                }
                if (bad == 0.9) continue;  // a spacing that could be
                for (const int field : {0, 1, 2, 3}) {
                    NiftiSpec t = placed();
                    t.version = version;
                    t.qformCode = qformCode;
                    if (field == 0)
                        t.qoffset[1] = bad;
                    else
                        t.pixdim[static_cast<std::size_t>(field)] = bad;
                    study = readNifti(ramp<short>(), t);
                    expectNear(place(study), {-0.012, -0.02225, 0.034}, 1e-8);
                    expectNear(study.grey.frame.spacing, {0.0005, 0.00075, 0.002}, 1e-9);
                    ASSERT_EQ(study.notes.size(), qformCode > 0 ? 1u : 0u) << field;
                }
            }
}

TEST(StudyNiftiPlaces, RowsOfASformThatDoesNotCountMayHoldAnything) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    for (const int version : {1, 2})
        for (const bool qform : {true, false})
            for (const double bad : {nan, inf, 1e30})
                for (std::size_t at = 0; at < 12; ++at) {
                    NiftiSpec s;
                    s.version = version;
                    if (qform) turnQuarter(s);
                    s.srow[at] = bad;
                    if (!qform) s.quatern[at % 3] = s.qoffset[at % 3] = bad;
                    const Study study = readNifti(ramp<short>(), s);
                    expectRamp(study);
                    const glm::dvec3 place = study.grey.frame.worldFromVoxel({4, 3, 2});
                    expectNear(
                        place,
                        qform ? glm::dvec3(-0.00775, -0.022, 0.034) : glm::dvec3(0.001, -0.001125, 0.002),
                        1e-8);
                    ASSERT_EQ(study.notes.size(), qform ? 0u : 1u) << at;
                }
}

TEST(StudyNiftiPlaces, AQfacThatIsNoNumberIsTakenAsOneAndItIsSaid) {
    NiftiSpec s;
    s.qformCode = 1;
    s.pixdim[0] = std::numeric_limits<double>::quiet_NaN();
    const Study study = readNifti(ramp<short>(), s);
    expectNear(study.grey.frame.worldFromVoxel({0, 0, 2}), {-0.010, -0.020, 0.034}, 1e-8);
    ASSERT_EQ(study.notes.size(), 1u);
    EXPECT_THAT(study.notes[0], HasSubstr("qfac"));
}

// The same numbers are refused where they count.
TEST(StudyNiftiPlaces, NumbersThatCountAreChecked) {
    const TemporaryFolder folder;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto expectByte = [&](const NiftiSpec& s, int byte) {
        writeBytes(folder / "a.nii", niftiFile(ramp<short>(), s));
        expectError(folder / "a.nii", {fmt::format("byte {}: expected a number of millimetres", byte)});
    };
    for (int n = 0; n < 12; ++n) {
        NiftiSpec s = placed();
        s.srow[static_cast<std::size_t>(n)] = nan;
        expectByte(s, 280 + 4 * n);
    }
    for (std::size_t n = 0; n < 3; ++n)
        for (const int qformCode : {0, 1}) {
            NiftiSpec s;
            s.qformCode = qformCode;
            s.pixdim[n + 1] = nan;
            expectByte(s, 80 + 4 * static_cast<int>(n));
            if (qformCode == 0) continue;
            s = {};
            s.qformCode = 1;
            s.quatern[n] = nan;
            expectByte(s, 256 + 4 * static_cast<int>(n));
            s = {};
            s.qformCode = 1;
            s.qoffset[n] = nan;
            expectByte(s, 268 + 4 * static_cast<int>(n));
        }
}

TEST(StudyNiftiPairs, AreReadByEitherName) {
    for (const int version : {1, 2})
        for (const bool packed : {false, true}) {
            const TemporaryFolder folder;
            NiftiSpec s = placed();
            s.version = version;
            s.pair = true;
            s.slope = 0.5;
            const std::string end = packed ? ".gz" : "";
            const std::string header = niftiHeader(s), samples = niftiSamples(ramp<short>(), s);
            writeBytes(folder / ("a.hdr" + end), packed ? gzipped(header) : header);
            writeBytes(folder / ("a.img" + end), packed ? gzipped(samples) : samples);
            for (const std::string& name : {"a.hdr" + end, "a.img" + end}) {
                EXPECT_TRUE(looksLikeStudy(folder / name));
                const Study study = read(folder / name);
                expectRamp(study, -150, 8.5);
                EXPECT_EQ(study.key, studyKey(folder / ("a.hdr" + end), {}));
            }
            fs::remove(folder / ("a.img" + end));
            expectError(folder / ("a.hdr" + end), {"a.img", "can not be opened"});
        }
    const TemporaryFolder folder;
    writeBytes(folder / "probe.hdr", "#?RADIANCE\n");
    writeBytes(folder / "ground.img", "EHFA_HEADER_TAG");
    EXPECT_FALSE(looksLikeStudy(folder / "probe.hdr"));
    EXPECT_FALSE(looksLikeStudy(folder / "ground.img"));
}

TEST(StudyNiftiBad, CutOffScaledAndSecondVersion) {
    const TemporaryFolder folder;
    NiftiSpec s = placed();
    s.slope = 0.5;
    for (const int version : {1, 2})
        for (const bool packed : {false, true}) {
            s.version = version;
            std::string bytes = niftiFile(ramp<short>(), s);
            bytes.resize(bytes.size() - 21);
            const fs::path file = folder / (packed ? "a.nii.gz" : "a.nii");
            writeBytes(file, packed ? gzipped(bytes) : bytes);
            expectError(file, {"cut off", "120 bytes", "found 99"});
        }
}

TEST(StudyNiftiBad, DamagedStreamsAreNotTakenForWhole) {
    const TemporaryFolder folder;
    std::vector<short> noise(60);
    unsigned state = 7;
    for (short& x : noise) x = static_cast<short>((state = state * 1664525 + 1013904223) >> 16);
    std::string packed = gzipped(niftiFile(noise, placed()));
    packed[packed.size() - 6] = static_cast<char>(packed[packed.size() - 6] + 1);  // a byte of the checksum
    writeBytes(folder / "a.nii.gz", packed);
    expectError(folder / "a.nii.gz", {"damaged", "can not be unpacked"});
}

TEST(StudyNiftiBad, OffsetsAndSizes) {
    const TemporaryFolder folder;
    NiftiSpec s = placed();
    s.offset = 17;
    writeBytes(folder / "a.nii", niftiFile(ramp<short>(), s));
    expectError(folder / "a.nii", {"byte 108", "found byte 17"});
    s.offset = -1;
    s.version = 2;
    s.size = {1'000'000'000'000, 4, 3};
    writeBytes(folder / "a.nii", niftiFile(ramp<short>(), s));
    expectError(folder / "a.nii", {"1000000000000 x 4 x 3 voxels need", "would fit"});
    s.size = {5, 4, 3, 2};
    writeBytes(folder / "a.nii", niftiFile(ramp<short>(), s));
    expectError(folder / "a.nii", {"3 axes", "found 4 (5 x 4 x 3 x 2)"});
    s.size = {5, 4, 3, 1, 1};
    writeBytes(folder / "a.nii", niftiFile(ramp<short>(), s));
    expectRamp(read(folder / "a.nii"));
}

}  // namespace
}  // namespace stereonav
