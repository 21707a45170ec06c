// Elevation models a run of rows at a time, held against the same files read at once.
#include "terrain/read/dem_rows.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>

#include "terrain/ground/nodata.h"
#include "tests/terrain/gdal_reading.h"
#include "tests/terrain/raster_files.h"

namespace stereonav {
namespace {

using namespace test;

std::vector<float> allRows(DemRows& rows, int run) {
    const int width = rows.place().width, height = rows.place().height;
    std::vector<float> heights(static_cast<std::size_t>(width) * height, -1.0f);
    for (int first = 0; first < height; first += run)
        rows.read(first, std::min(run, height - first), &heights[static_cast<std::size_t>(first) * width]);
    return heights;
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

void expectSamePlace(const DemGrid& got, const DemGrid& whole) {
    EXPECT_EQ(got.width, whole.width);
    EXPECT_EQ(got.height, whole.height);
    EXPECT_EQ(got.spacing, whole.spacing);
    EXPECT_EQ(got.driver, whole.driver);
    EXPECT_EQ(got.crs, whole.crs);
    EXPECT_EQ(got.projection, whole.projection);
    EXPECT_EQ(got.sourceOffset, whole.sourceOffset);
    EXPECT_EQ(got.sourceUnit, whole.sourceUnit);
    EXPECT_EQ(got.band, whole.band);
    EXPECT_EQ(got.heightUnit, whole.heightUnit);
    EXPECT_EQ(got.missingValue, whole.missingValue);
    EXPECT_EQ(got.grid.transform, whole.grid.transform);
    EXPECT_EQ(got.source.transform, whole.source.transform);
}

// Reads runs of 1, 7 and all rows; a second time where the file turned out to need it.
void expectAsReadAtOnce(const std::filesystem::path& file) {
    const DemGrid whole = readGround(file);
    for (const int run : {1, 7, whole.height}) {
        DemRows rows(file);
        std::vector<float> heights = allRows(rows, run);
        if (rows.mustBeReadAgain()) heights = allRows(rows, run);
        EXPECT_FALSE(rows.mustBeReadAgain());
        EXPECT_NO_THROW(rows.checkHeights(1));
        expectSamePlace(rows.place(), whole);
        EXPECT_TRUE(sameBits(heights, whole.heights)) << "runs of " << run;
    }
}

double hills(int column, int row, int) {
    return 700 + 90 * std::sin(0.3 * column) * std::cos(0.2 * row) + 3 * column - row;
}

RasterSpec hillsSpec(GDALDataType type = GDT_Float32) {
    RasterSpec spec;
    spec.type = type, spec.width = 37, spec.height = 29, spec.value = hills;
    return spec;
}

TEST(DemRows, GivesTheRowsThatAreReadAtOnceWhicheverWayTheyLie) {
    const TempFolder folder;
    for (const auto type : {GDT_Float32, GDT_Int16, GDT_Float64})
        for (const double dx : {30.0, -30.0})
            for (const double dy : {-30.0, 30.0}) {
                RasterSpec spec = hillsSpec(type);
                spec.transform = {500000, dx, 0, 5000000, 0, dy};
                SCOPED_TRACE(testing::Message() << GDALGetDataTypeName(type) << " " << dx << " " << dy);
                expectAsReadAtOnce(writeRaster(folder / "turned.tif", spec));
            }
}

TEST(DemRows, FindsTheSamplesThatAreMissing) {
    const TempFolder folder;
    RasterSpec shorts = hillsSpec(GDT_Int16);
    shorts.value = [](int c, int r, int) { return (c + r) % 5 == 0 ? -32768 : (c + r) % 7 == 0 ? -9999 : c; };
    expectAsReadAtOnce(writeRaster(folder / "unnamed.tif", shorts));
    shorts.hasNodata = true, shorts.nodata = -9999;
    expectAsReadAtOnce(writeRaster(folder / "named.tif", shorts));
    shorts.nodata = 0.5;  // no sample has it
    expectAsReadAtOnce(writeRaster(folder / "half.tif", shorts));

    RasterSpec floats = hillsSpec();
    floats.hasNodata = true, floats.nodata = -3.4e38;
    floats.value = [](int c, int r, int) {
        constexpr double kOdd[] = {NAN, INFINITY, -INFINITY, -3.4e38, 1e7, 1.01e7, -0.0, 1e-40, 5, 6, 7};
        return kOdd[(c + 3 * r) % 11];
    };
    expectAsReadAtOnce(writeRaster(folder / "odd.tif", floats));
    floats.nodata = NAN;
    expectAsReadAtOnce(writeRaster(folder / "nan.tif", floats));
}

TEST(DemRows, AppliesMasksScalesAndUnits) {
    const TempFolder folder;
    RasterSpec masked = hillsSpec();
    masked.adorn = [](GDALDataset& dataset) {
        ASSERT_EQ(dataset.CreateMaskBand(GMF_PER_DATASET), CE_None);
        std::vector<unsigned char> mask(37 * 29, 255);
        for (std::size_t k = 0; k < mask.size(); k += 3) mask[k] = 0;
        ASSERT_EQ(dataset.GetRasterBand(1)->GetMaskBand()->RasterIO(GF_Write, 0, 0, 37, 29, mask.data(), 37,
                                                                    29, GDT_Byte, 0, 0, nullptr),
                  CE_None);
    };
    const auto file = writeRaster(folder / "masked.tif", masked);
    ASSERT_GT(readGround(file).sourceMissing, 0);
    expectAsReadAtOnce(file);

    RasterSpec scaled = hillsSpec(GDT_Int16);
    scaled.adorn = [](GDALDataset& dataset) {
        dataset.GetRasterBand(1)->SetScale(0.1);
        dataset.GetRasterBand(1)->SetOffset(-50);
    };
    expectAsReadAtOnce(writeRaster(folder / "scaled.tif", scaled));
    RasterSpec feet = hillsSpec();
    feet.unit = "ft";
    expectAsReadAtOnce(writeRaster(folder / "feet.tif", feet));
}

TEST(DemRows, SaysWhenTheCustomaryValueTurnsOutToBeNone) {
    const TempFolder folder;
    RasterSpec spec = hillsSpec();
    spec.value = [](int c, int r, int) { return c == 5 && r > 3 ? -9999.0 : hills(c, r, 0); };
    const auto file = writeRaster(folder / "customary.tif", spec);
    DemRows rows(file);
    EXPECT_EQ(allRows(rows, 4)[5], -9999.0f);  // the south row
    EXPECT_TRUE(rows.mustBeReadAgain());
    EXPECT_TRUE(std::isnan(allRows(rows, 4)[5]));
    expectAsReadAtOnce(file);
    spec.value = [](int c, int r, int) { return c == 5 ? -9999.0 : c == 6 ? -9500.0 : hills(c, r, 0); };
    DemRows deep(writeRaster(folder / "deep.tif", spec));
    allRows(deep, 4);
    EXPECT_FALSE(deep.mustBeReadAgain());
}

TEST(DemRows, RefusesHeightsAsReadingAtOnceDoes) {
    const TempFolder folder;
    const auto expectSameError = [&](const std::filesystem::path& file, double scale) {
        Progress progress;
        const std::string whole = errorOf([&] { readDem(file, scale, progress); });
        EXPECT_NE(whole, "");
        EXPECT_EQ(errorOf([&] {
                      DemRows rows(file);
                      allRows(rows, 8);
                      rows.mustBeReadAgain();
                      rows.checkHeights(scale);
                  }),
                  whole);
    };
    RasterSpec spec = hillsSpec(GDT_Float64);
    spec.value = [](int c, int, int) { return 9e6 + 0.01 * c; };
    expectSameError(writeRaster(folder / "steps.tif", spec), 1);
    spec.value = [](int, int, int) { return -9999; };
    expectSameError(writeRaster(folder / "missing.tif", spec), 1);
    spec.value = [](int, int, int) { return NAN; };
    expectSameError(writeRaster(folder / "none.tif", spec), 1);
    spec.value = [](int, int, int) { return 5000; };
    expectSameError(writeRaster(folder / "scaled.tif", spec), 1e6);
    expectSameError(folder / "absent.tif", 1);
    expectSameError(folder.text("text.tif", "no raster"), 1);
}

TEST(DemRows, NamesTheRowWhereAFileIsCutOff) {
    const TempFolder folder;
    RasterSpec spec = hillsSpec();
    spec.options = {"BLOCKYSIZE=1"};
    const auto file = writeRaster(folder / "cut.tif", spec);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 37 * 4 * 3);
    DemRows rows(file);
    std::vector<float> row(37);
    EXPECT_NO_THROW(rows.read(20, 1, row.data()));
    EXPECT_THAT(errorOf([&] { rows.read(0, 1, row.data()); }),
                AllOf(HasSubstr("row 29 of 29"), HasSubstr("cut off or damaged"), HasSubstr("cut.tif")));
}

// Heights that are not readDem()'s are its summits and pits, which lie between others here.
void expectResampledAlike(const std::filesystem::path& file) {
    const DemGrid whole = readGround(file);
    DemRows rows(file);
    const std::vector<float> heights = allRows(rows, whole.height);
    expectSamePlace(rows.place(), whole);
    EXPECT_TRUE(sameBits(allRows(rows, 7), heights));
    ASSERT_EQ(heights.size(), whole.heights.size());
    std::size_t others = 0;
    for (std::size_t k = 0; k < heights.size(); ++k) {
        ASSERT_EQ(std::isnan(heights[k]), std::isnan(whole.heights[k])) << k;
        others += !std::isnan(heights[k]) && heights[k] != whole.heights[k];
    }
    EXPECT_LT(others, heights.size() / 8);
}

TEST(DemRows, ResamplesAsReadingAtOnceDoes) {
    const TempFolder folder;
    RasterSpec degrees = hillsSpec(GDT_Int16);
    degrees.epsg = 4326, degrees.width = 90, degrees.height = 80;
    degrees.transform = {10, 0.002, 0, 47, 0, -0.002};
    degrees.hasNodata = true, degrees.nodata = 711;
    expectResampledAlike(writeRaster(folder / "degrees.tif", degrees));
    RasterSpec turned = hillsSpec();
    turned.transform = {500000, 20, 12, 5000000, 12, -20};
    expectResampledAlike(writeRaster(folder / "turned.tif", turned));
    RasterSpec mercator = hillsSpec();
    mercator.epsg = 3857, mercator.transform = {1e6, 30, 0, 6e6, 0, -30};
    expectResampledAlike(writeRaster(folder / "mercator.tif", mercator));
    RasterSpec plane = degrees;  // no summits: the same to the bit
    plane.type = GDT_Float32, plane.hasNodata = false;
    plane.value = [](int c, int r, int) { return 100 + 2 * c + 3 * r; };
    const auto file = writeRaster(folder / "plane.tif", plane);
    DemRows rows(file);
    const std::vector<float> heights = allRows(rows, 13), whole = readGround(file).heights;
    ASSERT_EQ(heights.size(), whole.size());
    // The corners of the file alone are its highest and lowest.
    std::size_t others = 0;
    for (std::size_t k = 0; k < whole.size(); ++k) others += heights[k] != whole[k] && !std::isnan(whole[k]);
    EXPECT_LE(others, 2u);
}

TEST(DemRows, RunsOfRowsAreWholeBlocksOfTheFile) {
    const TempFolder folder;
    RasterSpec spec = hillsSpec();
    spec.height = 300;
    spec.options = {"TILED=YES", "BLOCKXSIZE=48", "BLOCKYSIZE=48"};
    DemRows rows(writeRaster(folder / "tiled.tif", spec));
    EXPECT_EQ(rows.runOfRows(), 240);
    EXPECT_EQ(rows.firstRun(), 60);
    spec.transform[5] = 30;
    EXPECT_EQ(DemRows(writeRaster(folder / "south.tif", spec)).firstRun(), 240);
    spec.options = {"BLOCKYSIZE=1"};
    EXPECT_EQ(DemRows(writeRaster(folder / "strips.tif", spec)).runOfRows(), 256);
}

// Text of so many rows as one could not call for within one another; and one whose header alone is there.
TEST(DemRows, FindsTheRowsOfText) {
    const TempFolder folder;
    std::string text = "ncols 2\nnrows 200000\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    for (int row = 0; row < 200000; ++row) text += std::to_string(row % 97) + " 5\n";
    DemRows rows(folder.text("long.asc", text));
    float heights[4];
    rows.read(0, 2, heights);
    EXPECT_EQ(heights[0], 199999 % 97);
    EXPECT_EQ(heights[2], 199998 % 97);
    const auto cut =
        folder.text("cut.asc", "ncols 100000\nnrows 100000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n");
    EXPECT_THAT(errorOf([&] {
                    std::vector<float> row(100000);
                    DemRows(cut).read(0, 1, row.data());
                }),
                HasSubstr("cut off"));
}

// 40 x 30 blocks of 16 x 16, the west of which are missing, in a fifth of the samples each way.
RasterSpec packedGround() {
    RasterSpec spec;
    spec.width = 640, spec.height = 480;
    spec.transform = {400000, 10, 0, 5000000, 0, -10};
    spec.hasNodata = true, spec.nodata = -32768;
    spec.value = [](int c, int r, int) { return c < 320 ? -32768. : 800 + 0.5 * c - 0.25 * r; };
    spec.options = {"COMPRESS=DEFLATE", "TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16"};
    return spec;
}
constexpr long long kFewSamples = 128 * 96;
constexpr double kNoTime = 0, kAllTime = 1e9;

TEST(DemRows, SomeBlocksOfAPackedFileStandForAll) {
    const TempFolder folder;
    const auto file = writeRaster(folder / "packed.tif", packedGround());
    DemRows rows(file, kFewSamples);
    ASSERT_EQ(rows.place().width, 128);
    ASSERT_TRUE(rows.isPacked());
    ASSERT_TRUE(rows.readSpread(kNoTime, kAllTime, guessMissing));
    const std::vector<float> few = allRows(rows, 96);
    EXPECT_FALSE(rows.mustBeReadAgain());
    EXPECT_NO_THROW(rows.checkHeights(1));
    DemRows every(file, kFewSamples), plain(file, kFewSamples);
    ASSERT_TRUE(every.readSpread(kAllTime, kAllTime, guessMissing));
    const std::vector<float> all = allRows(plain, 96);
    EXPECT_TRUE(sameBits(allRows(every, 7), all)) << "all blocks are read: there is nothing between";
    // The fewest blocks lie 8 apart at most: 128 samples of the file. Half of that from any to the next.
    int same = 0;
    for (int j = 0; j < 96; ++j)
        for (int i = 0; i < 128; ++i) {
            const std::size_t at = static_cast<std::size_t>(j) * 128 + i;
            same += few[at] == all[at];
            if (i < 64 - 26) {
                EXPECT_TRUE(std::isnan(few[at])) << i << " " << j;
            } else if (i >= 64 + 26) {
                EXPECT_NEAR(few[at], all[at], (0.5 + 0.25) * 128) << i << " " << j;
            }
        }
    EXPECT_LT(same, 128 * 96 / 4);
}

TEST(DemRows, StripsAndUnnamedMissingSamplesAreSpreadToo) {
    const TempFolder folder;
    RasterSpec spec = packedGround();
    spec.hasNodata = false;
    spec.value = [](int c, int, int) { return c < 320 ? -9999. : 800 + 0.5 * c; };
    spec.options = {"COMPRESS=LZW", "BLOCKYSIZE=2"};
    DemRows rows(writeRaster(folder / "strips.tif", spec), kFewSamples);
    ASSERT_TRUE(rows.readSpread(kNoTime, kAllTime, guessMissing));
    const std::vector<float> heights = allRows(rows, 96);
    for (int j = 0; j < 96; ++j)
        for (int i = 0; i < 128; ++i) {
            const float height = heights[static_cast<std::size_t>(j) * 128 + i];
            if (i < 62) {
                EXPECT_TRUE(std::isnan(height)) << i << " " << j;
            } else if (i > 66) {
                EXPECT_NEAR(height, 800 + 0.5 * 5 * (i + 0.5), 4) << i << " " << j;
            }
        }
    EXPECT_THAT(rows.place().missingValue, HasSubstr("-9999"));
}

TEST(DemRows, WhatIsNotPackedOrTooSlowIsNotSpread) {
    const TempFolder folder;
    RasterSpec spec = packedGround();
    const auto packed = writeRaster(folder / "packed.tif", spec);
    EXPECT_FALSE(DemRows(packed).isPacked()) << "all samples are read";
    DemRows slow(packed, kFewSamples), untouched(packed, kFewSamples);
    EXPECT_FALSE(slow.readSpread(kNoTime, -1, guessMissing));
    EXPECT_TRUE(sameBits(allRows(slow, 96), allRows(untouched, 96)));
    spec.options = {};
    EXPECT_FALSE(DemRows(writeRaster(folder / "open.tif", spec), kFewSamples).isPacked());
}

TEST(DemRows, TheIdentityFollowsTheFilesOfAVirtualRaster) {
    const TempFolder folder;
    RasterSpec spec = hillsSpec();
    writeRaster(folder / "source.tif", spec);
    const std::string begin =
                          "<VRTDataset rasterXSize=\"37\" rasterYSize=\"29\"><VRTRasterBand dataType="
                          "\"Float32\" band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"1\">",
                      end =
                          "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>"
                          "</VRTDataset>";
    folder.text("inner.vrt", begin + "source.tif" + end);
    const auto file = folder.text("outer.vrt", begin + "inner.vrt" + end);
    const auto identity = [&] { return DemRows(file).identity(); };
    const std::uint64_t before = identity();
    EXPECT_EQ(identity(), before);
    spec.options = {"COMPRESS=DEFLATE"};
    writeRaster(folder / "source.tif", spec);
    const std::uint64_t after = identity();
    EXPECT_NE(after, before);
    const auto time = std::filesystem::last_write_time(folder / "source.tif");
    std::filesystem::last_write_time(folder / "source.tif", time + std::chrono::seconds(5));
    EXPECT_NE(identity(), after);
    EXPECT_NE(DemRows(folder / "inner.vrt").identity(), identity());
}

TEST(DemRows, TakesMoreThanReadingAtOnceAndStillHasALimit) {
    const TempFolder folder;
    const auto blank = [&](int width) {  // no source, so all 0
        return folder.text("blank.vrt", "<VRTDataset rasterXSize=\"" + std::to_string(width) +
                                            "\" rasterYSize=\"20\"><VRTRasterBand dataType=\"Float32\" "
                                            "band=\"1\"></VRTRasterBand></VRTDataset>");
    };
    const auto wide = blank(70000);
    EXPECT_THAT(errorOf([&] { readGround(wide); }), HasSubstr("at most 65536 samples a side"));
    DemRows rows(wide);
    EXPECT_EQ(rows.place().width, 70000);
    EXPECT_EQ(allRows(rows, 20), std::vector<float>(70000 * 20, 0.0f));
    EXPECT_NO_THROW(rows.checkHeights(1));
    EXPECT_THAT(errorOf([&] { DemRows(blank((1 << 20) + 1)); }),
                AllOf(HasSubstr("at most 1048576 samples a side"), HasSubstr("got 1048577 x 20")));
}

TEST(DemRows, RealGroundInDegreesDiffersAtSummitsAndPitsAlone) {
    for (const char* name : {"mt_rainier_90m.tif", "ararat/agri-small-dem.tif", "SainteHelens.dem"}) {
        const auto file = realData(name);
        if (file.empty()) GTEST_SKIP() << "no real data";
        SCOPED_TRACE(name);
        expectResampledAlike(file);
    }
}

}  // namespace
}  // namespace stereonav
