// Masks whose labels the header names, in one layer or in several that overlap: written by hand after 3D
// Slicer's documentation of .seg.nrrd files.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

constexpr int kVoxels = 60;  // 5 x 4 x 3

struct Segment {
    std::string name, id;
    int layer = 0, value = 1;
};

std::string keysOf(const std::vector<Segment>& segments) {
    std::string text;
    for (std::size_t n = 0; n < segments.size(); ++n)
        text += fmt::format(
            "Segment{0}_Color:=0.5 0.25 1\nSegment{0}_Extent:=0 4 0 3 0 2\nSegment{0}_ID:={1}\n"
            "Segment{0}_LabelValue:={2}\nSegment{0}_Layer:={3}\nSegment{0}_Name:={4}\n"
            "Segment{0}_Tags:=TerminologyEntry:~^^~^^~~^^~|\n",
            n, segments[n].id, segments[n].value, segments[n].layer, segments[n].name);
    return text + "Segmentation_ContainedRepresentationNames:=Binary labelmap|\n";
}

// Colon and liver share a layer, the polyp lies over the colon's end in the other one.
const std::vector<Segment> kThree = {
    {"colon", "Segment_1", 0, 1}, {"liver, left", "Segment_7", 0, 2}, {"polyp", "Segment_2", 1, 3}};

int layerValue(int layer, int n) {
    if (layer == 1) return n >= 18 && n < 22 ? 3 : 0;
    return n >= 5 && n < 20 ? 1 : n >= 30 && n < 41 ? 2 : 0;
}

std::string layeredLines(bool first, const std::string& type = "unsigned char") {
    const std::string none = "none ", steps = "(0.5,0,0) (0,0.6,0) (0,0,2)";
    return "type: " + type +
           "\ndimension: 4\nspace: left-posterior-superior\nsizes: " + (first ? "2 5 4 3" : "5 4 3 2") +
           "\nspace directions: " + (first ? "none " + steps : steps + " none") +
           "\nkinds: " + (first ? "list domain domain domain" : "domain domain domain list") +
           "\nendian: little\nencoding: raw\nspace origin: (7,8,9)\n";
}

template <typename T>
std::string layeredSamples(bool first) {
    std::vector<T> samples;
    for (int n = 0; n < 2 * kVoxels; ++n)
        samples.push_back(
            static_cast<T>(first ? layerValue(n % 2, n / 2) : layerValue(n / kVoxels, n % kVoxels)));
    return bytesOfSamples(samples);
}

void expectSegment(const fs::path& file, const std::string& label, int layer, int value) {
    SCOPED_TRACE(label);
    StudyOptions options;
    options.label = label;
    const Study study = read(file, options);
    ASSERT_TRUE(study.isMask);
    ASSERT_EQ(study.mask.frame.size, kSize);
    for (int n = 0; n < kVoxels; ++n) ASSERT_EQ(study.mask.values[n], layerValue(layer, n) == value) << n;
    // LPS millimetres: (7 + 0.5 i, 8 + 0.6 j, 9 + 2 k).
    expectNear(study.mask.frame.worldFromVoxel({4, 3, 2}), {0.009, 0.0098, 0.013});
}

TEST(StudyLabels, EachSegmentOfSeveralLayersIsReadByNumberNameAndId) {
    const TemporaryFolder folder;
    for (const bool first : {true, false})
        for (const bool wide : {false, true})
            for (const bool packed : {false, true}) {
                SCOPED_TRACE(fmt::format("{} {} {}", first, wide, packed));
                std::string lines = layeredLines(first, wide ? "short" : "unsigned char") + keysOf(kThree);
                std::string samples =
                    wide ? layeredSamples<short>(first) : layeredSamples<unsigned char>(first);
                if (packed) lines = replaced(lines, "raw", "gzip"), samples = gzipped(samples);
                const fs::path file = writeNrrd(folder / "a.seg.nrrd", lines, samples);
                for (const Segment& segment : kThree)
                    for (const std::string& word : {std::to_string(segment.value), segment.name, segment.id})
                        expectSegment(file, word, segment.layer, segment.value);
            }
}

TEST(StudyLabels, WithoutAChoiceTheyAreListedByName) {
    const TemporaryFolder folder;
    const fs::path file = writeNrrd(folder / "a.seg.nrrd", layeredLines(true) + keysOf(kThree),
                                    layeredSamples<unsigned char>(true));
    const std::string list = "1 \"colon\", 2 \"liver, left\", 3 \"polyp\"";
    expectError(file, {"a mask of several labels: " + list, "--label N, or by its name"});
    StudyOptions options;
    for (const char* unknown : {"4", "0", "Colon", "", "-1", "99999999999999999999"}) {
        options.label = unknown;
        expectError(file, {"is not in the mask, which has " + list, "--label"}, options);
    }
    const Study chosen = [&] {
        options.label = "polyp";
        return read(file, options);
    }();
    ASSERT_EQ(chosen.notes.size(), 1u);
    EXPECT_THAT(chosen.notes[0], HasSubstr("3 \"polyp\" of 3"));
}

TEST(StudyLabels, ANumberOfSeveralSegmentsIsRefusedAndTheirNamesAreTaken) {
    const TemporaryFolder folder;
    std::vector<unsigned char> samples;
    for (int n = 0; n < 2 * kVoxels; ++n) samples.push_back(layerValue(n % 2, n / 2) == (n % 2 ? 3 : 2));
    const fs::path file = writeNrrd(folder / "a.seg.nrrd",
                                    layeredLines(true) + keysOf({{"liver", "A", 0, 1}, {"polyp", "B", 1, 1}}),
                                    bytesOfSamples(samples));
    StudyOptions options;
    options.label = "1";
    expectError(file, {"label 1 is that of several segments: 1 \"liver\", 1 \"polyp\"", "--label NAME"},
                options);
    for (const auto& [word, layer, value] : {std::tuple("liver", 0, 2), {"B", 1, 3}}) {
        options.label = word;
        const Study study = read(file, options);
        ASSERT_TRUE(study.isMask);
        for (int n = 0; n < kVoxels; ++n) ASSERT_EQ(study.mask.values[n], layerValue(layer, n) == value) << n;
    }
}

// Segments as Slicer wrote them before 4.11: a layer each, of zeros and ones.
TEST(StudyLabels, SegmentsThatSayNothingOfLayersHaveOneEach) {
    const TemporaryFolder folder;
    std::vector<unsigned char> samples;
    for (int n = 0; n < 2 * kVoxels; ++n) samples.push_back(layerValue(n % 2, n / 2) == (n % 2 ? 3 : 1));
    const fs::path file =
        writeNrrd(folder / "a.seg.nrrd",
                  layeredLines(true) +
                      "Segment0_ID:=first\nSegment0_Name:=colon\nSegment1_ID:=second\nSegment1_Name:=polyp\n",
                  bytesOfSamples(samples));
    expectSegment(file, "colon", 0, 1);
    StudyOptions options;
    options.label = "polyp";
    const Study study = read(file, options);
    for (int n = 0; n < kVoxels; ++n) ASSERT_EQ(study.mask.values[n], layerValue(1, n) == 3) << n;
}

TEST(StudyLabels, OneSegmentAmongLayersNeedsNoChoice) {
    const TemporaryFolder folder;
    const fs::path file =
        writeNrrd(folder / "a.seg.nrrd", layeredLines(true) + keysOf({{"polyp", "B", 1, 3}}),
                  layeredSamples<unsigned char>(true));
    const Study study = read(file);
    ASSERT_TRUE(study.isMask);
    for (int n = 0; n < kVoxels; ++n) ASSERT_EQ(study.mask.values[n], layerValue(1, n) == 3) << n;
    EXPECT_TRUE(study.notes.empty());
}

std::string singleLines() {
    return replaced(kShortLines, "short", "unsigned char");
}

// Labels that change from voxel to voxel are labels all the same where the header says so.
TEST(StudyLabels, NamesOfOneLayerAreListedAndTaken) {
    const TemporaryFolder folder;
    std::vector<unsigned char> samples;
    for (int n = 0; n < kVoxels; ++n) samples.push_back(static_cast<unsigned char>(n % 4));
    const fs::path file =
        writeNrrd(folder / "a.seg.nrrd",
                  singleLines() + keysOf({{"colon", "A", 0, 1}, {"liver", "B", 0, 2}, {"spleen", "C", 0, 9}}),
                  bytesOfSamples(samples));
    expectError(file, {"several labels: 1 \"colon\", 2 \"liver\", 3", "or by its name"});
    StudyOptions options;
    for (const auto& [word, value] : {std::pair("colon", 1), {"B", 2}, {"2", 2}, {"3", 3}}) {
        options.label = word;
        const Study study = read(file, options);
        ASSERT_TRUE(study.isMask) << word;
        for (int n = 0; n < kVoxels; ++n) ASSERT_EQ(study.mask.values[n], samples[n] == value) << word << n;
    }
    options.label = "spleen";
    expectError(file, {"the label 9 \"spleen\" has no voxels"}, options);
    options.label = "kidney";
    expectError(file, {"label kidney is not in the mask, which has 1 \"colon\""}, options);
}

TEST(StudyLabels, TheOnlyOneWithVoxelsNeedsNoChoiceAndIsNamed) {
    const TemporaryFolder folder;
    std::vector<unsigned char> samples(kVoxels, 0);
    samples[7] = samples[31] = 2;
    const std::string lines = singleLines() + keysOf({{"colon", "A", 0, 1}, {"liver", "B", 0, 2}});
    const Study study = read(writeNrrd(folder / "a.seg.nrrd", lines, bytesOfSamples(samples)));
    ASSERT_TRUE(study.isMask);
    ASSERT_EQ(study.notes.size(), 1u);
    EXPECT_THAT(study.notes[0], HasSubstr("only this one has voxels: 2 \"liver\""));
    samples.assign(kVoxels, 0);
    expectError(writeNrrd(folder / "b.seg.nrrd", lines, bytesOfSamples(samples)),
                {"a mask without voxels, of 1 \"colon\", 2 \"liver\""});
}

TEST(StudyLabels, WhatIsNoLayerOrNumberIsRefusedByItsKey) {
    const TemporaryFolder folder;
    const auto expectRefused = [&](const std::string& lines, const std::vector<std::string>& parts) {
        expectError(writeNrrd(folder / "a.seg.nrrd", lines, layeredSamples<unsigned char>(true)), parts);
    };
    const std::string lines = layeredLines(true) + keysOf(kThree);
    expectRefused(replaced(lines, "Segment2_Layer:=1", "Segment2_Layer:=2"),
                  {"Segment2_Layer: expected a layer of 0 to 1, found 2"});
    expectRefused(replaced(lines, "Segment1_Layer:=0", "Segment1_Layer:=-1"), {"Segment1_Layer", "found -1"});
    expectRefused(replaced(lines, "Segment1_Layer:=0", "Segment1_Layer:=x"),
                  {"Segment1_Layer: expected a whole number, found \"x\""});
    expectRefused(replaced(lines, "Segment0_LabelValue:=1", "Segment0_LabelValue:=1.5"),
                  {"Segment0_LabelValue: expected a whole number"});
    // Layers without names may be anything; nor are there two axes of layers.
    expectRefused(layeredLines(true), {"expected one number a voxel, found 2"});
    expectRefused(replaced(replaced(replaced(lines, "sizes: 2 5 4 3", "sizes: 2 2 5 4 3"), "dimension: 4",
                                    "dimension: 5"),
                           "none (", "none none ("),
                  {"expected one number a voxel, found 2"});
    expectRefused(replaced(lines, "sizes: 2 5 4 3", "sizes: 2000000000000 5 4 3"),
                  {"expected one number a voxel, found 2000000000000"});
}

TEST(StudyLabels, FilesThatHoldLessThanAllLayersAreCutOff) {
    const TemporaryFolder folder;
    std::string samples = layeredSamples<unsigned char>(true);
    samples.pop_back();
    StudyOptions options;
    options.label = "polyp";
    expectError(writeNrrd(folder / "a.seg.nrrd", layeredLines(true) + keysOf(kThree), samples),
                {"cut off", "120 bytes", "found 119"}, options);
}

TEST(StudyLabels, NamesAreForFilesThatNameThem) {
    const TemporaryFolder folder;
    StudyOptions options;
    options.label = "colon";
    std::vector<unsigned char> samples(kVoxels, 0);
    samples[3] = 1;
    expectError(writeNrrd(folder / "a.nrrd", singleLines(), bytesOfSamples(samples)),
                {"expected the number of a label", "--label colon"}, options);
}

TEST(StudyLabels, EachHasAKeyOfItsOwn) {
    const TemporaryFolder folder;
    const fs::path file = writeNrrd(folder / "a.seg.nrrd", layeredLines(true) + keysOf(kThree),
                                    layeredSamples<unsigned char>(true));
    std::vector<std::uint64_t> keys;
    for (const char* word : {"colon", "polyp", "0", "1", "2"}) {
        StudyOptions options;
        options.label = word;
        keys.push_back(studyKey(file, options));
    }
    keys.push_back(studyKey(file, {}));
    for (std::size_t a = 0; a < keys.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) ASSERT_NE(keys[a], keys[b]) << a << " " << b;
}

}  // namespace
}  // namespace stereonav
