// What resampling keeps: summits and pits with their heights and places, and heights between those of the
// file.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include "raster_files.h"
#include "terrain/read/dem_reader.h"

namespace stereonav {
namespace {

using test::RasterSpec;
using test::TempFolder;
using test::writeRaster;

// Turns places on the grid into pixels of the file, by the library's own transform.
class ToSource {
public:
    explicit ToSource(const DemGrid& dem) : mDem(dem) {
        mFrom.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        mTo.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        mFrom.importFromWkt(dem.grid.wkt.c_str());
        mTo.importFromWkt(dem.source.wkt.c_str());
        mTransform.reset(OGRCreateCoordinateTransformation(&mFrom, &mTo));
    }
    // Sample (i, j) of the grid, j = 0 southernmost; the result counts from the centre of the first sample.
    glm::dvec2 at(int i, int j) const {
        glm::dvec2 p = mDem.grid.fromPixel({i + 0.5, mDem.height - 1 - j + 0.5});
        EXPECT_TRUE(mTransform->Transform(1, &p.x, &p.y));
        return mDem.source.toPixel(p) - 0.5;
    }

private:
    const DemGrid& mDem;
    OGRSpatialReference mFrom, mTo;
    std::unique_ptr<OGRCoordinateTransformation> mTransform;
};

struct Ground {
    int width = 0, height = 0;
    std::vector<float> samples;
    float at(int i, int j) const { return samples[static_cast<std::size_t>(j) * width + i]; }
};

// Cones and pits of a few samples, and noise: no two grids agree on the height of either.
Ground conesAndPits(int width, int height, double noise) {
    Ground ground{width, height, std::vector<float>(static_cast<std::size_t>(width) * height)};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            double h = 1000 + 4 * i + noise * unit(random);
            for (int c = 0; c < 40; ++c) {
                const double x = 6.5 + 17.3 * (c % 8) - 0.21 * c, y = 7.1 + 23.7 * (c / 8) + 0.13 * c;
                const double steep = c % 3 == 0 ? -180 : 240;
                h += steep * std::max(0.0, 3.2 - std::hypot(i - x, j - y));
            }
            ground.samples[static_cast<std::size_t>(j) * width + i] = static_cast<float>(h);
        }
    return ground;
}

// Returns whether a sample is above (1), or below (-1), all eight around.
bool isSummit(const Ground& g, int i, int j, float sign) {
    for (int b = -1; b <= 1; ++b)
        for (int a = -1; a <= 1; ++a)
            if ((a != 0 || b != 0) && !(sign * g.at(i + a, j + b) < sign * g.at(i, j))) return false;
    return true;
}

struct Kept {
    int summits = 0, lost = 0,
        moved = 0;     // moved: by more than the way to the nearest sample of a turned grid
    double worst = 0;  // metres lost where a summit is lost
    int beyond = 0;    // heights beyond the four samples around
};

Kept lookFor(const Ground& ground, const DemGrid& dem) {
    Kept kept;
    const ToSource map(dem);
    std::vector<float> near(ground.samples.size() * 2, NAN);  // best height beside each summit, and its place
    std::vector<double> away(ground.samples.size(), INFINITY);
    for (int j = 0; j < dem.height; ++j)
        for (int i = 0; i < dem.width; ++i) {
            const glm::dvec2 p = map.at(i, j);
            const float h = dem.heights[static_cast<std::size_t>(j) * dem.width + i];
            const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
            if (x < 0 || y < 0 || x + 1 >= ground.width || y + 1 >= ground.height) continue;
            const auto [low, high] = std::minmax(
                {ground.at(x, y), ground.at(x + 1, y), ground.at(x, y + 1), ground.at(x + 1, y + 1)});
            const float slack = 1e-3f * (high - low);  // a place on a border between cells
            kept.beyond += !(h >= low - slack && h <= high + slack);
            for (int b = 0; b < 2; ++b)
                for (int a = 0; a < 2; ++a) {
                    const std::size_t at = static_cast<std::size_t>(y + b) * ground.width + x + a;
                    const float wanted = ground.samples[at];
                    if (!(std::abs(near[at] - wanted) <= std::abs(h - wanted))) near[at] = h;
                    const double d = std::hypot(p.x - x - a, p.y - y - b);
                    if (h == wanted) away[at] = std::min(away[at], d);
                }
        }
    for (int j = 2; j + 2 < ground.height; ++j)
        for (int i = 2; i + 2 < ground.width; ++i)
            for (const float sign : {1.0f, -1.0f}) {
                const std::size_t at = static_cast<std::size_t>(j) * ground.width + i;
                if (!isSummit(ground, i, j, sign) || std::isnan(near[at])) continue;
                ++kept.summits;
                if (near[at] != ground.samples[at]) {
                    ++kept.lost;
                    kept.worst = std::max(kept.worst, double(std::abs(near[at] - ground.samples[at])));
                }
                kept.moved += away[at] > 0.72;
            }
    return kept;
}

void expectKept(int epsg, const std::array<double, 6>& transform, double noise) {
    const TempFolder folder;
    const Ground ground = conesAndPits(150, 130, noise);
    RasterSpec spec;
    spec.width = ground.width;
    spec.height = ground.height;
    spec.epsg = epsg;
    spec.transform = transform;
    spec.value = [&](int c, int r, int) { return ground.at(c, r); };
    Progress progress;
    const DemGrid dem = readDem(writeRaster(folder / "cones.tif", spec), 1, progress);
    ASSERT_THAT(dem.projection, testing::HasSubstr("resampled"));
    const Kept kept = lookFor(ground, dem);
    std::printf(
        "[          ] %d at %.0f: %d summits and pits, %d lost (by up to %.2f m), %d moved, %d beyond\n",
        epsg, transform[3], kept.summits, kept.lost, kept.worst, kept.moved, kept.beyond);
    EXPECT_GE(kept.summits, 38);
    EXPECT_EQ(kept.lost, 0) << kept.worst;
    EXPECT_LE(kept.moved, kept.summits / 20);  // the nearest sample may hold another one
    EXPECT_EQ(kept.beyond, 0);
}

TEST(DemResample, SummitsAndPitsOfDegreesAreKept) {
    const double step = 1.0 / 1200;
    for (const double latitude : {0.3, 46.85, -71.0})
        for (const double noise : {0.0, 30.0}) expectKept(4326, {-121.9, step, 0, latitude, 0, -step}, noise);
}

TEST(DemResample, SummitsAndPitsOfOtherProjectionsAreKept) {
    expectKept(3857, {1000000, 50, 0, 8400000, 0, -50}, 10);
    // Turned by 0.3, and sheared.
    expectKept(32633, {500000, 9.55, 2.96, 5000000, 2.96, -9.55}, 10);
    expectKept(32633, {500000, 10, 1.5, 5000000, 0.5, -12}, 10);
}

// Samples of degrees are narrower away from the equator: the grid keeps the steps of the middle, and is a
// fifth coarser than the source at that end.
TEST(DemResample, SummitsOfATallRasterAreKept) {
    expectKept(4326, {10, 0.01, 0, 70, 0, -0.1}, 0);
}

TEST(DemResample, RealSummitsAreKept) {
    const auto file = test::realData("mt_rainier_90m.tif");
    if (file.empty()) GTEST_SKIP() << "real data is absent: mt_rainier_90m.tif";
    Progress progress;
    const DemGrid dem = readDem(file, 1, progress);
    Ground ground{dem.source.width, dem.source.height, {}};
    ground.samples.resize(static_cast<std::size_t>(ground.width) * ground.height);
    GDALAllRegister();
    GDALDataset* dataset = GDALDataset::Open(file.string().c_str());
    ASSERT_NE(dataset, nullptr);
    ASSERT_EQ(
        dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, ground.width, ground.height, ground.samples.data(),
                                            ground.width, ground.height, GDT_Float32, 0, 0, nullptr),
        CE_None);
    GDALClose(dataset);
    for (float& h : ground.samples)
        if (h < -1000) h = NAN;
    const Kept kept = lookFor(ground, dem);
    std::printf("[          ] %d summits and pits, %d lost (by up to %.2f m)\n", kept.summits, kept.lost,
                kept.worst);
    EXPECT_GT(kept.summits, 10000);
    EXPECT_EQ(kept.lost, 0) << kept.worst;
}

}  // namespace
}  // namespace stereonav
