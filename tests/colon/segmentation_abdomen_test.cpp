// Which gas in an abdomen is the colon's: generated ones with lungs, stomach, small bowel, prostheses,
// collapsed and drowned segments and stool, whose lumen is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "colon/segmentation/air_measures.h"
#include "colon/segmentation/segmentation_air.h"
#include "colon/segmentation/segmentation_fluid.h"
#include "engine/base/error.h"
#include "tests/support/made_abdomen.h"

namespace stereonav::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct Score {
    std::size_t truth = 0, found = 0, both = 0, lung = 0;
    int clicks = 0, unsureOfThem = 0;

    double sensitivity() const { return static_cast<double>(both) / static_cast<double>(truth); }
    double precision() const { return found ? static_cast<double>(both) / static_cast<double>(found) : 0; }
};

// Voxels of the lumen that was found, and of the one that is there.
void scoreVoxels(const Abdomen& abdomen, const LumenField& lumen, Score& score) {
    const VolumeFrame& study = abdomen.scan.frame;
    const glm::ivec3 shift(glm::round(study.voxelFromWorld(lumen.lumen.frame.worldFromVoxel(glm::dvec3(0)))));
    for (int k = 0; k < study.size.z; ++k)
        for (int j = 0; j < study.size.y; ++j)
            for (int i = 0; i < study.size.x; ++i) {
                const glm::ivec3 at = glm::ivec3(i, j, k) - shift;
                const bool is = lumen.lumen.frame.contains(at) && lumen.lumen.at(at) != 0;
                const std::uint8_t truth = abdomen.truth.at(i, j, k);
                score.truth += truth == kTrueColon;
                score.found += is;
                score.both += is && truth == kTrueColon;
                score.lung += is && truth == kTrueLung;
            }
}

// The part of a piece that is the colon's.
double shareOfColon(const Abdomen& abdomen, const Pieces& pieces, std::size_t piece) {
    const Component& part = pieces.parts.list[piece];
    std::size_t colon = 0;
    for (int k = part.first.z; k <= part.last.z; ++k)
        for (int j = part.first.y; j <= part.last.y; ++j) {
            const std::size_t row = pieces.runs.rowNumber(j, k);
            for (std::uint32_t n = pieces.runs.rowStart[row]; n < pieces.runs.rowStart[row + 1]; ++n)
                if (pieces.parts.ofRun[n] == piece)
                    for (int i = pieces.runs.runs[n].first; i < pieces.runs.runs[n].end; ++i)
                        colon += abdomen.truth.at(i, j, k) == kTrueColon;
        }
    return static_cast<double>(colon) / static_cast<double>(part.voxels);
}

// Pieces that a person would have to click at.
void scoreClicks(const Abdomen& abdomen, const AirPieces& air, Score& score) {
    const AirMeasures measures(abdomen.scan, air.pieces);
    for (std::size_t n = 0; n < air.kinds.size(); ++n) {
        if (air.kinds[n] == AirKind::Outside || measures.volume(static_cast<int>(n)) < 1e-6) continue;
        const bool colon = shareOfColon(abdomen, air.pieces, n) > 0.5;
        if (colon == (air.kinds[n] == AirKind::Colon)) continue;
        ++score.clicks;
        score.unsureOfThem += !air.reasons[n].sure;
    }
}

AirPieces judged(const GreyVolume& scan) {
    Progress progress;
    AirPieces air = findAir(scan, {}, {}, progress);
    findFluid(scan, {}, air);
    return air;
}

Score scoreOf(const AbdomenSetting& setting) {
    const Abdomen abdomen = madeAbdomen(setting);
    Score score;
    Progress progress;
    scoreVoxels(abdomen, segmentColon(abdomen.scan, {}, progress), score);
    scoreClicks(abdomen, judged(abdomen.scan), score);
    return score;
}

TEST(SegmentAbdomenNightly, SixtyStudies) {
    std::array<int, 3> needing{};  // no click, one, more
    std::vector<double> sensitivities, precisions;
    int unsure = 0, clicks = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const AbdomenSetting setting = anyAbdomen(seed);
        const Score score = scoreOf(setting);
        std::printf(
            "%2d: lungs %.0f mm (%.0f HU), stomach %d, prostheses %d, small bowel %d, collapsed %d, drowned "
            "%d, "
            "stool %d: sensitivity %.3f, precision %.3f, lung %zu, clicks %d, %d of them not sure\n",
            static_cast<int>(seed), setting.lungs * 1e3, setting.lungDensity, setting.stomach,
            setting.prostheses, setting.smallBowel, setting.collapsed, setting.drowned, setting.stool,
            score.sensitivity(), score.precision(), score.lung, score.clicks, score.unsureOfThem);
        EXPECT_EQ(score.lung, 0u);
        ++needing[static_cast<std::size_t>(std::min(score.clicks, 2))];
        clicks += score.clicks;
        unsure += score.unsureOfThem;
        sensitivities.push_back(score.sensitivity());
        precisions.push_back(score.precision());
    }
    std::sort(sensitivities.begin(), sensitivities.end());
    std::sort(precisions.begin(), precisions.end());
    const auto mean = [](const std::vector<double>& values) {
        double sum = 0;
        for (const double value : values) sum += value;
        return sum / static_cast<double>(values.size());
    };
    std::printf(
        "no click %d, one %d, more %d; %d clicks, %d at pieces that were said to be not sure\n"
        "sensitivity mean %.4f, least %.4f; precision mean %.4f, least %.4f\n",
        needing[0], needing[1], needing[2], clicks, unsure, mean(sensitivities), sensitivities.front(),
        mean(precisions), precisions.front());
    // Seeds 101 to 160, which nothing was fitted to, gave 33, 19 and 8.
    EXPECT_GE(needing[0], 30);
    EXPECT_LE(needing[2], 10);
    EXPECT_GE(unsure, clicks * 3 / 4);
    EXPECT_GE(mean(sensitivities), 0.96);
    EXPECT_GE(mean(precisions), 0.96);
}

// A coarse abdomen with some of what lies in it.
AbdomenSetting coarse() {
    AbdomenSetting setting;
    setting.size = {144, 144, 120};
    setting.collapsed = setting.drowned = setting.stool = 0;
    return setting;
}

TEST(SegmentAbdomen, LungsAreNoneOfTheColonWhereverTheyAreCut) {
    for (const double height : {0.006, 0.02, 0.06})
        for (const double density : {-800.0, -925.0}) {
            AbdomenSetting setting = coarse();
            setting.lungs = height;
            setting.lungDensity = density;
            const Abdomen abdomen = madeAbdomen(setting);
            SCOPED_TRACE(testing::Message() << height << " m of lungs of " << density << " HU");
            const AirPieces air = judged(abdomen.scan);
            const AirMeasures measures(abdomen.scan, air.pieces);
            int lungs = 0;
            for (std::size_t n = 0; n < air.kinds.size(); ++n) {
                if (measures.volume(static_cast<int>(n)) < 2e-6) continue;
                const glm::ivec3 voxel(
                    glm::round(abdomen.scan.frame.voxelFromWorld(measures.placeIn(static_cast<int>(n)))));
                if (abdomen.truth.at(voxel) != kTrueLung) continue;
                EXPECT_EQ(air.kinds[n], AirKind::Lung) << measures.volume(static_cast<int>(n)) * 1e6 << " ml";
                ++lungs;
            }
            EXPECT_GE(lungs, height > 0.01 ? 2 : 0);
            Score score;
            Progress progress;
            scoreVoxels(abdomen, segmentColon(abdomen.scan, {}, progress), score);
            EXPECT_EQ(score.lung, 0u);
            EXPECT_GT(score.sensitivity(), 0.9);
            EXPECT_GT(score.precision(), 0.9);
        }
}

// "x,y,z" in millimetres behind a word of a note.
glm::dvec3 placeBehind(const std::string& note, const std::string& word) {
    glm::dvec3 place(0.0);
    const std::size_t at = note.find(word);
    EXPECT_NE(at, std::string::npos) << note;
    if (at == std::string::npos) return place;
    EXPECT_EQ(std::sscanf(note.c_str() + at + word.size(), " %lf,%lf,%lf", &place.x, &place.y, &place.z), 3)
        << note;
    return place / 1000.0;
}

bool lumenHolds(const LumenField& lumen, const glm::dvec3& world) {
    const glm::ivec3 voxel(glm::round(lumen.lumen.frame.voxelFromWorld(world)));
    return lumen.lumen.frame.contains(voxel) && lumen.lumen.at(voxel) != 0;
}

TEST(SegmentAbdomen, WhatIsNotSureIsSaidFirstAndItsPlaceChangesIt) {
    AbdomenSetting setting = coarse();
    setting.smallBowel = 0;
    const Abdomen abdomen = madeAbdomen(setting);
    Progress progress;
    const LumenField found = segmentColon(abdomen.scan, {}, progress);
    ASSERT_FALSE(found.notes.empty());
    EXPECT_THAT(found.notes[0], testing::StartsWith("not sure, left out "));
    EXPECT_THAT(found.notes[0], HasSubstr("like a stomach"));
    const glm::dvec3 stomach = placeBehind(found.notes[0], "--include");
    EXPECT_EQ(abdomen.truth.at(glm::ivec3(glm::round(abdomen.scan.frame.voxelFromWorld(stomach)))),
              kTrueStomach);
    EXPECT_FALSE(lumenHolds(found, stomach));
    SegmentationSetting with;
    with.choices.include = {stomach};
    const LumenField more = segmentColon(abdomen.scan, with, progress);
    EXPECT_TRUE(lumenHolds(more, stomach));
    EXPECT_THAT(more.notes, Contains(HasSubstr("by --include")));
    EXPECT_THAT(more.notes, Not(Contains(HasSubstr("like a stomach"))));
    with.choices.exclude = {stomach};
    EXPECT_FALSE(lumenHolds(segmentColon(abdomen.scan, with, progress), stomach)) << "the last word";
}

TEST(SegmentAbdomen, APieceIsLeftOutByAPlaceInIt) {
    AbdomenSetting setting = coarse();
    setting.smallBowel = 0;
    setting.stomach = false;
    setting.collapsed = 2;
    const Abdomen abdomen = madeAbdomen(setting);
    Progress progress;
    const LumenField found = segmentColon(abdomen.scan, {}, progress);
    ASSERT_GE(found.segments.size(), 2u);
    std::vector<glm::dvec3> taken;
    for (const std::string& note : found.notes)
        if (note.starts_with("took ") && note.find(" around ") != std::string::npos)
            taken.push_back(placeBehind(note, "around"));
    ASSERT_GE(taken.size(), 2u);
    for (const glm::dvec3& place : taken) EXPECT_TRUE(lumenHolds(found, place));
    SegmentationSetting without;
    without.choices.exclude = {taken.back()};
    const LumenField less = segmentColon(abdomen.scan, without, progress);
    EXPECT_FALSE(lumenHolds(less, taken.back()));
    EXPECT_TRUE(lumenHolds(less, taken.front()));
    EXPECT_EQ(less.segments.size(), found.segments.size() - 1);
}

TEST(SegmentAbdomen, PlacesInTissueAreRefusedByTheirOption) {
    const Abdomen abdomen = madeAbdomen(coarse());
    glm::ivec3 tissue(0);
    for (const glm::ivec3 size = abdomen.scan.frame.size; tissue.x < size.x; ++tissue.x) {
        tissue.y = size.y / 2;
        tissue.z = size.z / 2;
        if (std::abs(abdomen.scan.at(tissue) - 40) < 60) break;
    }
    SegmentationSetting setting;
    Progress progress;
    for (const bool included : {true, false}) {
        setting.choices = {};
        (included ? setting.choices.include : setting.choices.exclude)
            .push_back(abdomen.scan.frame.worldFromVoxel(glm::dvec3(tissue)));
        EXPECT_THAT([&] { segmentColon(abdomen.scan, setting, progress); },
                    testing::ThrowsMessage<Error>(testing::AllOf(
                        HasSubstr(included ? "--include " : "--exclude "), HasSubstr("lies in tissue"))));
    }
}

TEST(SegmentAbdomen, StreaksBetweenProsthesesAreNoColon) {
    AbdomenSetting setting = coarse();
    setting.prostheses = true;
    setting.lungs = 0;
    setting.stomach = false;
    setting.smallBowel = 0;
    const Abdomen abdomen = madeAbdomen(setting);
    Score score;
    Progress progress;
    scoreVoxels(abdomen, segmentColon(abdomen.scan, {}, progress), score);
    EXPECT_GT(score.sensitivity(), 0.9);
    EXPECT_GT(score.precision(), 0.9);
}

}  // namespace
}  // namespace stereonav::test
