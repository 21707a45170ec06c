// Composition of two eyes against values worked out by hand, for every mode.
#include "engine/image/stereo_compose.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/error.h"

namespace stereonav {
namespace {

using Picture = Plane<PackedColor>;

// Pixels that tell where they come from: bit 29 is the eye, then y, then x.
Picture marked(int width, int height, std::uint32_t eye) {
    Picture p(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) p.at(x, y) = eye << 29 | static_cast<std::uint32_t>(y << 10 | x);
    return p;
}
constexpr std::uint32_t kLeft = 0, kRight = 1;
PackedColor mark(std::uint32_t eye, int x, int y) {
    return eye << 29 | static_cast<std::uint32_t>(y << 10 | x);
}

Picture compose(OutputMode mode, bool swap = false, int width = 5, int height = 4) {
    return composeStereo(marked(width, height, kLeft), marked(width, height, kRight), {mode, swap, false});
}

Picture filled(int width, int height, PackedColor color) {
    Picture p(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) p.at(x, y) = color;
    return p;
}

// Turns sRGB bytes, which a user sees, into packed colours, and back.
PackedColor packed(int r, int g, int b) {
    const auto& t = packedFromSrgbByte();
    return static_cast<PackedColor>(t[r] | t[g] << 10 | t[b] << 20);
}
std::array<int, 3> bytes(PackedColor c) {
    const auto& t = srgbByteFromPacked();
    return {t[c & 1023], t[c >> 10 & 1023], t[c >> 20 & 1023]};
}

TEST(ComposeStereo, OneEye) {
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x) {
            EXPECT_EQ(compose(OutputMode::Left).at(x, y), mark(kLeft, x, y));
            EXPECT_EQ(compose(OutputMode::Right).at(x, y), mark(kRight, x, y));
            EXPECT_EQ(compose(OutputMode::Left, true).at(x, y), mark(kRight, x, y));
        }
}

TEST(ComposeStereo, FullSideBySideAndTopBottomKeepEveryPixel) {
    const Picture sbs = compose(OutputMode::SideBySide), cross = compose(OutputMode::CrossEyed);
    const Picture tb = compose(OutputMode::TopBottom), bt = compose(OutputMode::BottomTop);
    ASSERT_EQ(sbs.width(), 10);
    ASSERT_EQ(sbs.height(), 4);
    ASSERT_EQ(tb.width(), 5);
    ASSERT_EQ(tb.height(), 8);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x) {
            EXPECT_EQ(sbs.at(x, y), mark(kLeft, x, y));
            EXPECT_EQ(sbs.at(x + 5, y), mark(kRight, x, y));
            EXPECT_EQ(cross.at(x, y), mark(kRight, x, y));
            EXPECT_EQ(cross.at(x + 5, y), mark(kLeft, x, y));
            EXPECT_EQ(tb.at(x, y), mark(kLeft, x, y));
            EXPECT_EQ(tb.at(x, y + 4), mark(kRight, x, y));
            EXPECT_EQ(bt.at(x, y), mark(kRight, x, y));
            EXPECT_EQ(bt.at(x, y + 4), mark(kLeft, x, y));
        }
}

TEST(ComposeStereo, InterleavedTakesEachPixelAtItsPlace) {
    const Picture rows = compose(OutputMode::Rows), columns = compose(OutputMode::Columns);
    const Picture checker = compose(OutputMode::Checkerboard);
    const Picture rowsRight = compose(OutputMode::RowsRightFirst);
    const Picture checkerRight = compose(OutputMode::CheckerboardRightFirst);
    const Picture columnsRight = compose(OutputMode::ColumnsRightFirst);
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 5; ++x) {
            EXPECT_EQ(rows.at(x, y), mark(y % 2, x, y));
            EXPECT_EQ(columns.at(x, y), mark(x % 2, x, y));
            EXPECT_EQ(checker.at(x, y), mark((x + y) % 2, x, y));
            EXPECT_EQ(rowsRight.at(x, y), mark(1 - y % 2, x, y));
            EXPECT_EQ(columnsRight.at(x, y), mark(1 - x % 2, x, y));
            EXPECT_EQ(checkerRight.at(x, y), mark(1 - (x + y) % 2, x, y));
        }
}

TEST(ComposeStereo, HalfModesAveragePairsInLinearLight) {
    // Stripes of black and white average to linear 1/2: channel sqrt(1/2) * 1023 = 723.4.
    const PackedColor white = packColor({1, 1, 1}), gray = packColor({0.5f, 0.5f, 0.5f});
    EXPECT_EQ(gray & 1023u, 723u);
    Picture columns(4, 4), rows(4, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            columns.at(x, y) = x % 2 ? white : 0;
            rows.at(x, y) = y % 2 ? white : 0;
        }
    const Picture sbs = composeStereo(columns, rows, {OutputMode::SideBySideHalf, false, false});
    const Picture tb = composeStereo(rows, columns, {OutputMode::TopBottomHalf, false, false});
    ASSERT_EQ(sbs.width(), 4);
    ASSERT_EQ(tb.height(), 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 2; ++x) {
            EXPECT_EQ(sbs.at(x, y), gray);
            EXPECT_EQ(sbs.at(x + 2, y), y % 2 ? white : 0u);
            EXPECT_EQ(tb.at(y, x), gray);
            EXPECT_EQ(tb.at(y, x + 2), y % 2 ? white : 0u);
        }
}

TEST(ComposeStereo, HalfModesOfOddSizesEndWithTheLastPixelAlone) {
    const Picture sbs = compose(OutputMode::SideBySideHalf, false, 5, 3);
    const Picture tb = compose(OutputMode::TopBottomHalf, false, 5, 3);
    ASSERT_EQ(sbs.width(), 6);
    ASSERT_EQ(tb.height(), 4);
    for (int y = 0; y < 3; ++y) {
        EXPECT_EQ(sbs.at(2, y), mark(kLeft, 4, y));
        EXPECT_EQ(sbs.at(5, y), mark(kRight, 4, y));
    }
    for (int x = 0; x < 5; ++x) {
        EXPECT_EQ(tb.at(x, 1), mark(kLeft, x, 2));
        EXPECT_EQ(tb.at(x, 3), mark(kRight, x, 2));
    }
}

struct AnaglyphCase {
    OutputMode mode;
    std::array<int, 3> expected;
};

// Left (200, 100, 50), right (40, 160, 220). Luma: left 124.2, right 130.96. Dubois by hand from the
// published rows, for instance red/cyan R = .456 200 + .5 100 + .176 50 - .043 40 - .088 160 - .002 220
// = 133.76.
TEST(ComposeStereo, AnaglyphsOnEncodedValuesByHand) {
    const Picture left = filled(3, 2, packed(200, 100, 50)), right = filled(3, 2, packed(40, 160, 220));
    const AnaglyphCase cases[] = {
        {OutputMode::RedCyanGray, {124, 131, 131}},      {OutputMode::RedCyanHalf, {124, 160, 220}},
        {OutputMode::RedCyanColor, {200, 160, 220}},     {OutputMode::RedCyanDubois, {134, 116, 243}},
        {OutputMode::GreenMagentaGray, {131, 124, 131}}, {OutputMode::GreenMagentaHalf, {40, 124, 220}},
        {OutputMode::GreenMagentaColor, {40, 100, 220}}, {OutputMode::GreenMagentaDubois, {109, 113, 214}},
        {OutputMode::AmberBlueGray, {124, 124, 131}},    {OutputMode::AmberBlueHalf, {200, 100, 131}},
        {OutputMode::AmberBlueColor, {200, 100, 220}},   {OutputMode::AmberBlueDubois, {183, 95, 210}},
        {OutputMode::RedBlueGray, {124, 0, 131}},        {OutputMode::RedGreenGray, {124, 131, 0}},
    };
    for (const AnaglyphCase& c : cases) {
        const Picture out = composeStereo(left, right, {c.mode, false, false});
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 3; ++x)
                for (int k = 0; k < 3; ++k)
                    EXPECT_NEAR(bytes(out.at(x, y))[k], c.expected[k], 1) << infoOf(c.mode).longName << k;
    }
}

// Linear light: half of white in the left eye gives gray of linear 0.5 * 0.299... = channel by hand.
TEST(ComposeStereo, LinearAnaglyphMixesLight) {
    const Picture left = filled(2, 2, packColor({0.5f, 0.25f, 0.125f})), right = filled(2, 2, 0);
    const Picture out = composeStereo(left, right, {OutputMode::RedCyanGray, false, true});
    const double luma = 0.299 * 0.5 + 0.587 * 0.25 + 0.114 * 0.125;
    EXPECT_NEAR(out.at(1, 1) & 1023u, std::sqrt(luma) * 1023, 1.0);
    EXPECT_EQ(out.at(1, 1) >> 10, 0u);
    const Picture encoded = composeStereo(left, right, {OutputMode::RedCyanGray, false, false});
    EXPECT_NE(encoded.at(1, 1) & 1023u, out.at(1, 1) & 1023u);
}

TEST(ComposeStereo, AnaglyphsOfWhiteAndBlackStayNeutral) {
    const Picture white = filled(2, 2, packed(255, 255, 255)), black = filled(2, 2, 0);
    for (const OutputModeInfo& info : outputModes()) {
        if (info.layout != OutputLayout::Anaglyph) continue;
        const Picture bright = composeStereo(white, white, {info.mode, false, false});
        const Picture dark = composeStereo(black, black, {info.mode, false, false});
        const int noGlass = info.mode == OutputMode::RedBlueGray    ? 1
                            : info.mode == OutputMode::RedGreenGray ? 2
                                                                    : 3;
        for (int k = 0; k < 3; ++k) {
            if (k == noGlass)
                EXPECT_EQ(bytes(bright.at(0, 0))[k], 0) << info.longName;
            else
                EXPECT_GE(bytes(bright.at(0, 0))[k], 250) << info.longName;
            EXPECT_EQ(bytes(dark.at(0, 0))[k], 0) << info.longName;
        }
    }
}

TEST(ComposeStereo, SwappingEyesIsComposingThemTheOtherWayRound) {
    const Picture a = marked(6, 4, kLeft), b = filled(6, 4, packed(40, 160, 220));
    for (const OutputModeInfo& info : outputModes()) {
        if (!fitsInPicture(info.mode)) continue;
        const Picture swapped = composeStereo(a, b, {info.mode, true, false});
        const Picture other = composeStereo(b, a, {info.mode, false, false});
        const Picture plain = composeStereo(a, b, {info.mode, false, false});
        bool differs = false;
        ASSERT_EQ(swapped.width(), other.width());
        for (int y = 0; y < swapped.height(); ++y)
            for (int x = 0; x < swapped.width(); ++x) {
                ASSERT_EQ(swapped.at(x, y), other.at(x, y)) << info.longName;
                differs |= swapped.at(x, y) != plain.at(x, y);
            }
        EXPECT_TRUE(differs) << info.longName;
    }
}

TEST(ComposeStereo, NamesFindTheirModes) {
    std::set<OutputMode> seen;
    for (const OutputModeInfo& info : outputModes()) {
        EXPECT_EQ(outputModeFromName(info.shortName), info.mode);
        EXPECT_EQ(outputModeFromName(info.longName), info.mode);
        EXPECT_EQ(infoOf(info.mode).mode, info.mode) << "the table's order";
        EXPECT_THAT(outputModeNames(true) + ",", testing::HasSubstr(std::string(info.shortName) + ","));
        const bool inFiles =
            (outputModeNames(false) + ",").find(std::string(info.shortName) + ",") != std::string::npos;
        EXPECT_EQ(inFiles, fitsInPicture(info.mode)) << info.shortName;
        seen.insert(info.mode);
    }
    EXPECT_EQ(seen.size(), 34u);
    EXPECT_EQ(outputModeFromName("abl"), OutputMode::TopBottom);
    EXPECT_EQ(outputModeFromName("ab2l"), OutputMode::TopBottomHalf);
    EXPECT_EQ(outputModeFromName("ab2r"), OutputMode::BottomTopHalf);
    for (const char* unknown : {"", "x", "sbs", "arc", "SBSL ", "ab"})
        EXPECT_EQ(outputModeFromName(unknown), std::nullopt) << unknown;
}

TEST(ComposeStereo, SizesMatchWhatIsComposed) {
    for (const OutputModeInfo& info : outputModes())
        for (int width : {1, 2, 3, 8})
            for (int height : {1, 2, 5, 24, 49}) {
                if (!fitsInPicture(info.mode)) continue;
                const Picture out = compose(info.mode, false, width, height);
                EXPECT_EQ(composedSize(info.mode, width, height), std::pair(out.width(), out.height()));
                const auto [w, h] = eyeSizeFor(info.mode, out.width(), out.height());
                EXPECT_EQ(composedSize(info.mode, w, h), std::pair(out.width(), out.height()));
            }
}

// The names of FFmpeg's filter stereo3d for what it writes, version 5.1.
TEST(ComposeStereo, KnowsAllOfFfmpegsNames) {
    for (const char* name : {"sbsl", "sbsr", "sbs2l", "sbs2r", "tbl",  "abl",  "tbr",  "abr",  "tb2l", "ab2l",
                             "tb2r", "ab2r", "al",    "ar",    "irl",  "irr",  "arbg", "argg", "arcg", "arch",
                             "arcc", "arcd", "agmg",  "agmh",  "agmc", "agmd", "aybg", "aybh", "aybc", "aybd",
                             "ml",   "mr",   "chl",   "chr",   "icl",  "icr",  "hdmi"})
        EXPECT_NE(outputModeFromName(name), std::nullopt) << name;
}

TEST(ComposeStereo, FramePackedHasItsGap) {
    EXPECT_EQ(composedSize(OutputMode::FramePacked, 1920, 1080), std::pair(1920, 2205));
    EXPECT_EQ(composedSize(OutputMode::FramePacked, 1280, 720), std::pair(1280, 1470));
    EXPECT_EQ(eyeSizeFor(OutputMode::FramePacked, 1920, 2205), std::pair(1920, 1080));
    EXPECT_EQ(eyeSizeFor(OutputMode::FramePacked, 1920, 2204), std::pair(1920, 1079));
    EXPECT_EQ(eyeSizeFor(OutputMode::FramePacked, 1, 0), std::pair(1, 1));
    Picture left = filled(3, 50, 7), right = filled(3, 50, 9);
    for (const bool swapped : {false, true}) {
        const Picture out = composeStereo(left, right, {OutputMode::FramePacked, swapped, false});
        ASSERT_EQ(out.height(), 102);
        for (int y = 0; y < 102; ++y) {
            const PackedColor first = swapped ? 9 : 7, second = swapped ? 7 : 9;
            EXPECT_EQ(out.at(2, y), y < 50 ? first : y < 52 ? 0u : second) << y;
        }
    }
}

TEST(ComposeStereo, AreasAreWhereTheEyesLie) {
    for (const OutputModeInfo& info : outputModes())
        for (int width : {1, 2, 7, 1920})
            for (int height : {1, 2, 3, 49, 1079, 2205}) {
                const auto [first, second] = eyeAreas(info.mode, width, height);
                for (const EyeArea& area : {first, second}) {
                    EXPECT_GE(std::min({area.x, area.y, area.width, area.height}), 0) << info.longName;
                    EXPECT_LE(area.x + area.width, width) << info.longName;
                    EXPECT_LE(area.y + area.height, height) << info.longName;
                }
                EXPECT_EQ(first.width, second.width);
                EXPECT_EQ(first.height, second.height);
                if (first == second) continue;
                EXPECT_TRUE(second.x >= first.x + first.width || second.y >= first.y + first.height);
            }
    const auto [top, bottom] = eyeAreas(OutputMode::FramePacked, 1920, 2205);
    EXPECT_EQ(top, (EyeArea{0, 0, 1920, 1080}));
    EXPECT_EQ(bottom, (EyeArea{0, 1125, 1920, 1080}));
    EXPECT_NEAR(2205 * kPackedEye, 1080, 1e-3);
    EXPECT_EQ(eyeAreas(OutputMode::Left, -3, 5)[0], (EyeArea{0, 0, 0, 5}));
}

TEST(ComposeStereo, ModesOfWindowsAreRefused) {
    for (const OutputMode mode :
         {OutputMode::Alternating, OutputMode::AlternatingRightFirst, OutputMode::QuadBuffer})
        try {
            composeStereo(filled(2, 2, 1), filled(2, 2, 2), {mode, false, false});
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("sbsl"));
        }
}

TEST(ComposeStereo, EyesOfDifferentSizesAreRefused) {
    EXPECT_THROW(composeStereo(Picture(4, 4), Picture(4, 5), {}), Error);
    EXPECT_THROW(composeStereo(Picture(), Picture(), {}), Error);
    EXPECT_EQ(eyeSizeFor(OutputMode::SideBySide, 1, 1), std::pair(1, 1));
}

}  // namespace
}  // namespace stereonav
