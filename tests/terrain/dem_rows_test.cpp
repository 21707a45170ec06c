// Rows of elevation models against what readDem() reads at once.
#include "terrain/read/dem_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "raster_files.h"

namespace stereonav::test {
namespace {

std::vector<float> byRows(DemRows& rows, int run) {
    const DemGrid& dem = rows.place();
    std::vector<float> heights(static_cast<std::size_t>(dem.width) * dem.height);
    for (int row = 0; row < dem.height; row += run)
        rows.read(row, std::min(run, dem.height - row),
                  heights.data() + static_cast<std::ptrdiff_t>(row) * dem.width);
    return heights;
}

RasterSpec hills(int width, int height) {
    RasterSpec spec;
    spec.width = width, spec.height = height;
    spec.value = [](int c, int r, int) {
        return std::floor(500 + 200 * std::sin(0.2 * c) * std::cos(0.15 * r));
    };
    return spec;
}

void expectAsReadAtOnce(const RasterSpec& spec, const char* what) {
    const TempFolder folder;
    const std::filesystem::path file = writeRaster(folder / "ground.tif", spec);
    Progress progress;
    const DemGrid dem = readDem(file, 1, progress);
    for (const int run : {1, 7, 1000}) {
        DemRows rows(file);
        std::vector<float> heights = byRows(rows, run);
        if (rows.mustBeReadAgain()) heights = byRows(rows, run);
        EXPECT_FALSE(rows.mustBeReadAgain()) << what;
        ASSERT_EQ(heights.size(), dem.heights.size()) << what;
        EXPECT_EQ(std::memcmp(heights.data(), dem.heights.data(), heights.size() * sizeof(float)), 0)
            << what << " in runs of " << run;
        EXPECT_EQ(rows.place().spacing, dem.spacing) << what;
        EXPECT_EQ(rows.place().sourceOffset, dem.sourceOffset) << what;
        EXPECT_EQ(rows.place().projection, dem.projection) << what;
        EXPECT_NO_THROW(rows.checkHeights(1)) << what;
    }
}

TEST(DemRows, AreThoseOfTheWhole) {
    expectAsReadAtOnce(hills(37, 29), "north up");
    RasterSpec spec = hills(37, 29);
    spec.transform = {501110, -30, 0, 4999130, 0, 30};
    expectAsReadAtOnce(spec, "south up and westward");
    spec = hills(300, 290);
    spec.type = GDT_Int16;
    spec.hasNodata = true, spec.nodata = 500;
    spec.options = {"TILED=YES", "BLOCKXSIZE=64", "BLOCKYSIZE=64", "COMPRESS=DEFLATE"};
    expectAsReadAtOnce(spec, "whole numbers with a value for missing ones, in blocks");
    spec = hills(37, 29);
    spec.type = GDT_Float64;
    spec.unit = "ft";
    expectAsReadAtOnce(spec, "feet");
    spec = hills(37, 29);
    spec.value = [](int c, int r, int) { return c == 3 && r > 5 ? -9999.0 : 100.0 + c; };
    expectAsReadAtOnce(spec, "-9999 without a word");
    spec.value = [](int c, int, int) { return c % 5 == 0 ? std::nan("") : 1.5 * c; };
    expectAsReadAtOnce(spec, "no numbers");
}

// A degree grid: the same grid, heights between those around, at most as far off as its summits are cut.
TEST(DemRows, OfDegreesLieOnTheSameGrid) {
    const TempFolder folder;
    RasterSpec spec;
    spec.width = 80, spec.height = 70;
    spec.epsg = 4326;
    spec.transform = {7.0, 1.0 / 3600, 0, 46.0, 0, -1.0 / 3600};
    spec.value = [](int c, int r, int) { return 500 + 20 * c + 10 * std::sin(0.2 * r); };
    const std::filesystem::path file = writeRaster(folder / "degrees.tif", spec);
    Progress progress;
    const DemGrid dem = readDem(file, 1, progress);
    DemRows rows(file);
    const std::vector<float> heights = byRows(rows, 16);
    ASSERT_EQ(heights.size(), dem.heights.size());
    double worst = 0;
    long long known = 0;
    for (std::size_t n = 0; n < heights.size(); ++n) {
        if (!std::isfinite(heights[n]) || !std::isfinite(dem.heights[n])) continue;
        ++known;
        worst = std::max(worst, std::abs(double(heights[n]) - dem.heights[n]));
    }
    EXPECT_GT(known, 0.9 * double(heights.size()));
    EXPECT_LT(worst, 20 * 0.6) << "more than half a sample of this slope";
}

TEST(DemRows, RefuseWhatCanNotBeRead) {
    const TempFolder folder;
    const std::filesystem::path cut = writeRaster(folder / "cut.tif", hills(300, 290));
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
    EXPECT_THAT(errorOf([&] {
                    DemRows rows(cut);
                    byRows(rows, 64);
                }),
                AllOf(HasSubstr("cut.tif"), Not(HasSubstr("\n"))));
    RasterSpec none = hills(20, 20);
    none.hasNodata = true, none.nodata = 5;
    none.value = [](int, int, int) { return 5.0; };
    DemRows rows(writeRaster(folder / "none.tif", none));
    byRows(rows, 20);
    EXPECT_THAT(errorOf([&] { rows.checkHeights(1); }), HasSubstr("all 400 samples are missing"));
    EXPECT_THAT(errorOf([&] { DemRows text(folder.text("text.tif", "no raster")); }), HasSubstr("text.tif"));
}

TEST(DemRows, AreNamedByTheirFile) {
    const TempFolder folder;
    const std::filesystem::path file = writeRaster(folder / "ground.tif", hills(37, 29));
    const std::uint64_t before = DemRows(file).identity();
    EXPECT_EQ(DemRows(file).identity(), before);
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(3));
    EXPECT_NE(DemRows(file).identity(), before);
}

}  // namespace
}  // namespace stereonav::test
