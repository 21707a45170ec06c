// Pictures of the ground by what their bands say, and by how much of their bits they use.
#include <cmath>

#include "raster_files.h"
#include "terrain/read/raster_file.h"
#include "terrain/scene/laid_picture.h"

namespace stereonav::test {
namespace {

constexpr int kWide = 40, kHigh = 30;

RasterSpec bandsOf(int bands, GDALDataType type, const std::function<double(int c, int r, int band)>& value) {
    RasterSpec spec;
    spec.type = type;
    spec.width = kWide, spec.height = kHigh;
    spec.bands = bands;
    spec.value = value;
    return spec;
}

// sRGB bytes of a pixel, all of the picture read as it is.
glm::ivec3 colorAt(const std::filesystem::path& file, int c, int r) {
    const auto picture = openRasterPicture(file, "a picture", "give one");
    const auto color =
        picture->read({0, 0, kWide, kHigh}, glm::dvec2(1), picture->tone()).at({c + 0.5, r + 0.5}).color;
    const PackedColor packed = packColor(color);
    const auto& bytes = srgbByteFromPacked();
    return {bytes[packed & 1023], bytes[packed >> 10 & 1023], bytes[packed >> 20 & 1023]};
}

std::vector<std::string> notesOn(const std::filesystem::path& file) {
    return openRasterPicture(file, "a picture", "give one")->tone().notes;
}

using Meanings = std::vector<GDALColorInterp>;

// Bands of these meanings, in that order.
void mean(RasterSpec& spec, const Meanings& meanings, std::vector<const char*> options = {}) {
    spec.adorn = [meanings](GDALDataset& dataset) {
        for (std::size_t n = 0; n < meanings.size(); ++n)
            dataset.GetRasterBand(static_cast<int>(n) + 1)->SetColorInterpretation(meanings[n]);
    };
    spec.options = std::move(options);
}

constexpr int kRed = 200, kGreen = 60, kBlue = 20;

double valueOf(GDALColorInterp meaning) {
    return meaning == GCI_RedBand     ? kRed
           : meaning == GCI_GreenBand ? kGreen
           : meaning == GCI_BlueBand  ? kBlue
           : meaning == GCI_AlphaBand ? 255
                                      : 111;
}

TEST(PictureBands, ColoursAreWhereTheBandsSay) {
    const TempFolder folder;
    for (const Meanings& order : {Meanings{GCI_RedBand, GCI_GreenBand, GCI_BlueBand},
                                  {GCI_BlueBand, GCI_GreenBand, GCI_RedBand},
                                  {GCI_GreenBand, GCI_BlueBand, GCI_RedBand},
                                  {GCI_BlueBand, GCI_GreenBand, GCI_RedBand, GCI_Undefined},
                                  {GCI_Undefined, GCI_RedBand, GCI_GreenBand, GCI_BlueBand},
                                  {GCI_RedBand, GCI_GreenBand, GCI_BlueBand, GCI_AlphaBand},
                                  {GCI_Undefined, GCI_BlueBand, GCI_Undefined, GCI_GreenBand, GCI_RedBand}})
        for (const bool gray : {true, false}) {
            RasterSpec spec = bandsOf(static_cast<int>(order.size()), GDT_Byte,
                                      [order](int, int, int band) { return valueOf(order[band]); });
            mean(spec, order);
            if (gray) spec.options = {"PHOTOMETRIC=MINISBLACK"};
            const auto file = writeRaster(folder / "order.tif", spec);
            EXPECT_EQ(colorAt(file, 7, 9), glm::ivec3(kRed, kGreen, kBlue))
                << order.size() << " " << order[0];
            EXPECT_TRUE(notesOn(file).empty());
        }
}

TEST(PictureBands, DescriptionsTellWhereNothingElseDoes) {
    const TempFolder folder;
    using Names = std::vector<const char*>;
    for (const Names& names : {Names{"blue", "green", "red"},
                               {"Band 2 - Blue", "Band 3 - Green", "Band 4 - Red", "NIR"},
                               {"B02", "B03", "B04", "B08"},
                               {"red edge", "red", "near infrared", "green", "blue"}}) {
        RasterSpec spec = bandsOf(static_cast<int>(names.size()), GDT_Byte, [names](int, int, int band) {
            const std::string name = names[band];
            if (name == "red edge" || name == "near infrared") return 111;
            const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
            return has("ed") || has("B04")     ? kRed
                   : has("reen") || has("B03") ? kGreen
                   : has("lue") || has("B02")  ? kBlue
                                               : 111;
        });
        spec.options = {"PHOTOMETRIC=MINISBLACK"};
        spec.adorn = [names](GDALDataset& dataset) {
            for (std::size_t n = 0; n < names.size(); ++n) {
                GDALRasterBand& band = *dataset.GetRasterBand(static_cast<int>(n) + 1);
                band.SetColorInterpretation(n == 0 ? GCI_GrayIndex : GCI_Undefined);
                band.SetDescription(names[n]);
            }
        };
        const auto file = writeRaster(folder / "named.tif", spec);
        EXPECT_EQ(colorAt(file, 7, 9), glm::ivec3(kRed, kGreen, kBlue)) << names[0];
        EXPECT_TRUE(notesOn(file).empty());
    }
    RasterSpec silent = bandsOf(4, GDT_Byte, [](int, int, int band) { return 10.0 + 50 * band; });
    mean(silent, {GCI_GrayIndex, GCI_Undefined, GCI_Undefined, GCI_Undefined}, {"PHOTOMETRIC=MINISBLACK"});
    const auto file = writeRaster(folder / "silent.tif", silent);
    EXPECT_EQ(colorAt(file, 7, 9), glm::ivec3(10, 60, 110));
    ASSERT_EQ(notesOn(file).size(), 1u);
    EXPECT_THAT(
        notesOn(file)[0],
        HasSubstr("silent.tif does not say which of its 4 bands are red, green and blue: 1, 2 and 3"));
}

TEST(PictureBands, InksAndInvertedGrays) {
    const TempFolder folder;
    RasterSpec inks = bandsOf(4, GDT_Byte, [](int, int, int band) {
        return band == 0 ? 51.0 : band == 1 ? 204.0 : band == 2 ? 255.0 : 0;
    });
    mean(inks, {GCI_CyanBand, GCI_MagentaBand, GCI_YellowBand, GCI_BlackBand}, {"PHOTOMETRIC=CMYK"});
    EXPECT_EQ(colorAt(writeRaster(folder / "inks.tif", inks), 3, 3), glm::ivec3(204, 51, 0));
    RasterSpec gray = bandsOf(1, GDT_Byte, [](int c, int, int) { return 5.0 * c; });
    gray.options = {"PHOTOMETRIC=MINISWHITE"};
    EXPECT_EQ(colorAt(writeRaster(folder / "white.tif", gray), 11, 3), glm::ivec3(255 - 55));
    RasterSpec alpha = bandsOf(2, GDT_Byte, [](int c, int, int band) { return band == 0 ? 5.0 * c : 255.0; });
    mean(alpha, {GCI_GrayIndex, GCI_AlphaBand});
    EXPECT_EQ(colorAt(writeRaster(folder / "alpha.tif", alpha), 11, 3), glm::ivec3(55));
}

// Reflectance times 10000: nothing of it lies in the upper 85 % of 16 bits.
double reflectance(int c, int r, int band) {
    return 300.0 + 40 * c + 20 * r + 100 * band;
}

TEST(PictureBands, SixteenBitsThatAreHardlyUsedAreStretched) {
    const TempFolder folder;
    for (const GDALDataType type : {GDT_UInt16, GDT_Int16}) {
        const auto file = writeRaster(folder / "s2.tif", bandsOf(3, type, reflectance));
        std::vector<double> all;
        for (int band = 0; band < 3; ++band)
            for (int r = 0; r < kHigh; ++r)
                for (int c = 0; c < kWide; ++c) all.push_back(reflectance(c, r, band));
        std::sort(all.begin(), all.end());
        const double low = all[all.size() * 2 / 100], high = all[all.size() * 98 / 100];
        for (int r = 0; r < kHigh; r += 3)
            for (int c = 0; c < kWide; c += 3) {
                const glm::ivec3 color = colorAt(file, c, r);
                for (int band = 0; band < 3; ++band) {
                    const double share = (reflectance(c, r, band) - low) / (high - low);
                    ASSERT_NEAR(color[band], 255 * std::clamp(share, 0.0, 1.0), 2.5)
                        << c << " " << r << " " << band;
                }
            }
        ASSERT_EQ(notesOn(file).size(), 1u);
        EXPECT_THAT(notesOn(file)[0], AllOf(HasSubstr("s2.tif is shown from "), HasSubstr("2 and 98 %")));
    }
    // Pixels without ground count for nothing.
    RasterSpec gaps =
        bandsOf(3, GDT_UInt16, [](int c, int r, int band) { return c < 20 ? 0 : reflectance(c, r, band); });
    gaps.hasNodata = true;
    const auto file = writeRaster(folder / "gaps.tif", gaps);
    EXPECT_EQ(colorAt(file, 39, 29).z, 255);
    EXPECT_LT(colorAt(file, 20, 0).x, 15);
}

TEST(PictureBands, WhatUsesItsBitsStaysAsItIs) {
    const TempFolder folder;
    RasterSpec whole =
        bandsOf(3, GDT_UInt16, [](int c, int r, int band) { return 257.0 * (6 * c + r / 3 % 2 + band); });
    const auto file = writeRaster(folder / "whole.tif", whole);
    for (int c = 0; c < kWide; c += 3)
        ASSERT_EQ(colorAt(file, c, 0), glm::ivec3(6 * c, 6 * c + 1, 6 * c + 2)) << c;
    EXPECT_TRUE(notesOn(file).empty());
    // 12 bits in 16, as the file says.
    RasterSpec twelve = bandsOf(1, GDT_UInt16, [](int c, int, int) { return 4095.0 * (c + 1) / kWide; });
    twelve.options = {"NBITS=12"};
    const auto bits = writeRaster(folder / "twelve.tif", twelve);
    for (int c = 0; c < kWide; c += 3) ASSERT_NEAR(colorAt(bits, c, 5).x, 255.0 * (c + 1) / kWide, 1) << c;
    EXPECT_TRUE(notesOn(bits).empty());
    const auto dark =
        writeRaster(folder / "dark.tif", bandsOf(3, GDT_Byte, [](int c, int, int) { return c / 8; }));
    EXPECT_EQ(colorAt(dark, 39, 5), glm::ivec3(4)) << "8 bits are the colours that somebody saw";
    EXPECT_TRUE(notesOn(dark).empty());
}

// Parts of a picture that are read one by one are shown alike.
TEST(PictureBands, AllPartsHaveOneTone) {
    const TempFolder folder;
    const auto file = writeRaster(folder / "s2.tif", bandsOf(3, GDT_UInt16, reflectance));
    const auto picture = openRasterPicture(file, "a picture", "give one");
    const PictureTone tone = picture->tone();
    const GroundPicture all = picture->read({0, 0, kWide, kHigh}, glm::dvec2(1), tone);
    for (int x = 0; x + 10 <= kWide; x += 10) {
        const GroundPicture part =
            openRasterPicture(file, "a picture", "give one")->read({x, 5, x + 10, 15}, glm::dvec2(1), tone);
        for (int c = x; c < x + 10; ++c)
            ASSERT_EQ(part.at({c + 0.5, 9.5}).color, all.at({c + 0.5, 9.5}).color) << c;
    }
}

}  // namespace
}  // namespace stereonav::test
