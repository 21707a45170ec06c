// Tiles on both sides of 180 degrees are one ground: that of one file which goes on beyond it.
#include <cmath>
#include <cstring>

#include "gdal_reading.h"
#include "raster_files.h"
#include "terrain/read/dem_reader.h"

namespace stereonav::test {
namespace {

constexpr int kColumns = 60, kRows = 40;

double bump(int c, int r) {
    return std::floor(200 + 90 * std::sin(0.05 * c) * std::cos(0.07 * r));
}

// Columns count from the western edge of all.
RasterSpec strip(int epsg, double west, double north, double step, int column, int columns) {
    RasterSpec spec;
    spec.epsg = epsg;
    spec.width = columns, spec.height = kRows;
    spec.transform = {west, step, 0, north, 0, -step};
    spec.value = [column](int c, int r, int) { return bump(column + c, r); };
    return spec;
}

// files: west and columns of each, from west to east.
void expectOneGround(const std::string& of, int epsg, double north, double step,
                     const std::vector<std::pair<double, int>>& files) {
    SCOPED_TRACE(of);
    const TempFolder folder;
    std::filesystem::create_directory(folder / "parts");
    int column = 0;
    for (std::size_t n = 0; n < files.size(); ++n) {
        // Names go against the order.
        writeRaster(folder / ("parts/" + std::string(1, char('z' - n)) + ".tif"),
                    strip(epsg, files[n].first, north, step, column, files[n].second));
        column += files[n].second;
    }
    const DemGrid whole =
        readGround(writeRaster(folder / "whole.tif", strip(epsg, files[0].first, north, step, 0, column)));
    const DemGrid dem = readGround(folder / "parts");
    ASSERT_EQ(dem.width, whole.width);
    ASSERT_EQ(dem.height, whole.height);
    EXPECT_NEAR(dem.spacing.x, whole.spacing.x, 1e-6);
    EXPECT_GT(dem.width, column / 2);
    for (std::size_t n = 0; n < dem.heights.size(); ++n)
        ASSERT_NEAR(dem.heights[n], whole.heights[n], 0.01) << n;
    EXPECT_TRUE(dem.notes.empty());
}

TEST(Antimeridian, TilesOnBothSidesAreOneGround) {
    const double step = 1.0 / kColumns;
    expectOneGround("east and west", 4326, -16, step, {{179, kColumns}, {-180, kColumns}});
    expectOneGround("two and one", 4326, 66, step, {{178, kColumns}, {179, kColumns}, {-180, kColumns}});
    expectOneGround("one and two", 4326, 0, step, {{179, kColumns}, {-180, kColumns}, {-179, kColumns}});
    expectOneGround("counted on", 4326, 52, step, {{179, kColumns}, {180, kColumns}});
    expectOneGround("from the west", 4326, 52, step, {{-181, kColumns}, {-180, kColumns}});
    expectOneGround("not all of a degree", 4326, 52, step, {{179.5, kColumns / 2}, {-180, kColumns / 2}});
    expectOneGround("without a system", 0, 52, step, {{179, kColumns}, {-180, kColumns}});
    expectOneGround("far from it", 4326, 52, step, {{-1, kColumns}, {0, kColumns}});
}

TEST(Antimeridian, MapsThatAreAStripGoOnToo) {
    const double half = M_PI * 6378137, step = 500;
    expectOneGround("web Mercator", 3857, 4e6, step, {{half - kColumns * step, kColumns}, {-half, kColumns}});
    expectOneGround("plate carree", 32662, 4e6, step,
                    {{half - kColumns * step, kColumns}, {-half, kColumns}});
}

}  // namespace
}  // namespace stereonav::test
