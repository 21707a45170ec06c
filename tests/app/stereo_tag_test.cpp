// What files say of their eyes, for every way of composing them: Matroska's StereoMode (RFC 9559), MP4's st3d
// and H.264's frame packing.
#include "app/output/stereo_tag.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace stereonav {
namespace {

struct Said {
    StereoTag plain, swapped;
};

const std::map<std::string, Said>& expectedTags() {
    static const std::map<std::string, Said> expected = [] {
        std::map<std::string, Said> tags{
            {"ml", {{0, 0, -1}, {0, 0, -1}}},
            {"mr", {{0, 0, -1}, {0, 0, -1}}},
            {"sbsl", {{1, 2, 3}, {11, -1, -1}}},
            {"sbs2l", {{1, 2, 3, 2, 1}, {11, -1, -1, 2, 1}}},
            {"tbl", {{3, 1, 4}, {2, -1, -1}}},
            {"tb2l", {{3, 1, 4, 1, 2}, {2, -1, -1, 1, 2}}},
            {"irl", {{7, -1, 2, 1, 2}, {6, -1, -1, 1, 2}}},
            {"icl", {{9, -1, 1, 2, 1}, {8, -1, -1, 2, 1}}},
            {"chl", {{5, -1, 0}, {4, -1, -1}}},
        };
        const std::map<std::string, std::string> mirrored{
            {"sbsr", "sbsl"}, {"sbs2r", "sbs2l"}, {"tbr", "tbl"}, {"tb2r", "tb2l"},
            {"irr", "irl"},   {"icr", "icl"},     {"chr", "chl"}};
        for (const auto& [mode, of] : mirrored) tags[mode] = {tags.at(of).swapped, tags.at(of).plain};
        for (const char method : std::string("ghcd")) {
            tags[std::string("arc") + method] = {{10, -1, -1}, {}};
            tags[std::string("agm") + method] = {{12, -1, -1}, {}};
            tags[std::string("ayb") + method] = {{}, {}};
        }
        // of no value anywhere: a gap between the eyes, other glasses, and what a file never has
        for (const char* mode : {"hdmi", "arbg", "argg", "al", "ar", "quad"}) tags[mode] = {{}, {}};
        return tags;
    }();
    return expected;
}

TEST(StereoTag, EveryModeHasItsValues) {
    EXPECT_EQ(expectedTags().size(), outputModes().size());
    for (const OutputModeInfo& info : outputModes()) {
        SCOPED_TRACE(info.shortName);
        const Said& said = expectedTags().at(std::string(info.shortName));
        EXPECT_EQ(stereoTagOf(info.mode), said.plain);
        EXPECT_EQ(stereoTagOf(info.mode, true), said.swapped);
    }
}

TEST(StereoTag, WhatAFileCanSay) {
    for (const OutputModeInfo& info : outputModes()) {
        SCOPED_TRACE(info.shortName);
        const Said& said = expectedTags().at(std::string(info.shortName));
        const bool one = info.layout == OutputLayout::OneEye;
        for (const bool swapped : {false, true}) {
            const StereoTag& tag = swapped ? said.swapped : said.plain;
            EXPECT_EQ(saysStereo(VideoKind::Avi, info.mode, swapped), one);
            EXPECT_EQ(saysStereo(VideoKind::Mkv, info.mode, swapped), one || tag.matroska > 0);
            EXPECT_EQ(saysStereo(VideoKind::Mp4, info.mode, swapped),
                      one || tag.st3d > 0 || tag.framePacking >= 0);
        }
    }
}

}  // namespace
}  // namespace stereonav
