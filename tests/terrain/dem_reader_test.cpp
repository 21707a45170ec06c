// Elevation models: what is read, where it lands in metres, and one clear line for what can not be.
#include "terrain/read/dem_reader.h"

#include <cmath>
#include <limits>

#include "raster_files.h"

namespace stereonav::test {
namespace {

DemGrid read(const std::filesystem::path& file, double verticalScale = 1) {
    Progress progress;
    return readDem(file, verticalScale, progress);
}

float sampleAt(const DemGrid& dem, int i, int j) {
    return dem.heights[static_cast<std::size_t>(j) * dem.width + i];
}

void expectOneLine(const std::string& message, const std::filesystem::path& file, const std::string& what) {
    EXPECT_THAT(message, AllOf(HasSubstr(file.string() + ":"), HasSubstr(what), Not(HasSubstr("\n"))));
}

RasterSpec rampSpec() {
    RasterSpec spec;
    spec.width = 12;
    spec.height = 9;
    spec.value = [](int c, int r, int) { return 100.0 + 10 * c - 3 * r; };
    return spec;
}

TEST(DemReader, NorthUpGeoTiffLandsSouthRowFirst) {
    const TempFolder folder;
    const DemGrid dem = read(writeRaster(folder / "ramp.tif", rampSpec()), 2.0);
    ASSERT_EQ(dem.width, 12);
    ASSERT_EQ(dem.height, 9);
    EXPECT_EQ(dem.spacing, glm::dvec2(30, 30));
    EXPECT_EQ(dem.driver, "GeoTIFF");
    EXPECT_EQ(dem.crs, "WGS 84 / UTM zone 33N");
    EXPECT_EQ(dem.projection, "as it is");
    EXPECT_EQ(dem.sourceOffset, glm::dvec2(500000 + 180, 5000000 - 135));
    for (int j = 0; j < 9; ++j)
        for (int i = 0; i < 12; ++i) EXPECT_EQ(sampleAt(dem, i, j), 2 * (100.0 + 10 * i - 3 * (8 - j)));
}

TEST(DemReader, SouthUpAndWestwardRastersGiveTheSameGround) {
    const TempFolder folder;
    const DemGrid plain = read(writeRaster(folder / "plain.tif", rampSpec()));
    RasterSpec turned = rampSpec();
    turned.transform = {500000 + 12 * 30.0, -30, 0, 5000000 - 9 * 30.0, 0, 30};
    turned.value = [](int c, int r, int) { return 100.0 + 10 * (11 - c) - 3 * (8 - r); };
    const DemGrid other = read(writeRaster(folder / "turned.tif", turned));
    EXPECT_EQ(plain.heights, other.heights);
    EXPECT_EQ(plain.sourceOffset, other.sourceOffset);
    EXPECT_EQ(plain.spacing, other.spacing);
}

TEST(DemReader, MissingSamplesOfEveryKind) {
    const TempFolder folder;
    RasterSpec spec = rampSpec();
    spec.hasNodata = true;
    spec.nodata = -9999;
    spec.value = [](int c, int r, int) -> double {
        if (r != 4) return 5;
        const double bad[] = {-9999, NAN, INFINITY, -INFINITY, 1e30, -3.4e38};
        return c < 6 ? bad[c] : 7;
    };
    const DemGrid dem = read(writeRaster(folder / "bad.tif", spec));
    EXPECT_EQ(dem.sourceMissing, 6);
    for (int i = 0; i < 12; ++i) {
        if (i < 6)
            EXPECT_TRUE(std::isnan(sampleAt(dem, i, 4))) << i;
        else
            EXPECT_EQ(sampleAt(dem, i, 4), 7) << i;
    }
}

TEST(DemReader, FloatNodataIsFoundAfterRounding) {
    const TempFolder folder;
    RasterSpec spec = rampSpec();
    spec.hasNodata = true;
    spec.nodata = 0.1;  // not a float: stored samples hold its rounding
    spec.value = [](int c, int, int) { return c == 3 ? 0.1 : 1.0; };
    EXPECT_EQ(read(writeRaster(folder / "n.tif", spec)).sourceMissing, 9);
}

TEST(DemReader, FeetBecomeMetresUpAndAcross) {
    const TempFolder folder;
    RasterSpec spec = rampSpec();
    spec.unit = "ft";
    spec.linearUnit = "US survey foot";
    spec.linearMetres = 1200.0 / 3937;
    spec.transform = {500000 / spec.linearMetres, 100, 0, 5000000 / spec.linearMetres, 0, -100};
    const DemGrid dem = read(writeRaster(folder / "feet.tif", spec));
    EXPECT_NEAR(dem.spacing.x, 100 * 1200.0 / 3937, 1e-9);
    EXPECT_NEAR(dem.spacing.y, 100 * 1200.0 / 3937, 1e-9);
    EXPECT_FLOAT_EQ(sampleAt(dem, 0, 8), 100 * 0.3048f);
}

TEST(DemReader, UnknownVerticalUnitIsRefused) {
    const TempFolder folder;
    RasterSpec spec = rampSpec();
    spec.unit = "kelvin";
    const auto file = writeRaster(folder / "k.tif", spec);
    expectOneLine(errorOf([&] { read(file); }), file, "\"kelvin\"");
}

// Degrees: distances between neighbours against the ellipsoid's own radii (a second way, closed form).
TEST(DemReader, DegreesBecomeMetres) {
    const TempFolder folder;
    RasterSpec spec;
    spec.epsg = 4326;
    spec.width = 121;
    spec.height = 121;
    const double step = 1.0 / 1200, south = 46.0, west = 11.0;
    spec.transform = {west, step, 0, south + 121 * step, 0, -step};
    // Heights are a function of longitude and latitude, linear in each.
    const auto height = [](double lon, double lat) {
        return 1000 + 20000 * (lon - 11.05) + 9000 * (lat - 46.05);
    };
    spec.value = [&](int c, int r, int) {
        return height(west + (c + 0.5) * step, south + 121 * step - (r + 0.5) * step);
    };
    const DemGrid dem = read(writeRaster(folder / "degrees.tif", spec));
    const double a = 6378137, e2 = 0.00669437999014, lat = (south + 60.5 * step) * M_PI / 180;
    const double w = 1 - e2 * std::sin(lat) * std::sin(lat);
    const double metresLat = a * (1 - e2) / (w * std::sqrt(w)) * M_PI / 180;
    const double metresLon = a / std::sqrt(w) * std::cos(lat) * M_PI / 180;
    EXPECT_NEAR(dem.spacing.x, metresLon * step, 1e-3);
    EXPECT_NEAR(dem.spacing.y, metresLat * step, 1e-3);
    EXPECT_GE(dem.width, 119);
    EXPECT_GE(dem.height, 119);
    EXPECT_EQ(dem.sourceMissing, 0);
    EXPECT_THAT(dem.projection, HasSubstr("local transverse Mercator, resampled from 121x121"));
    // Near the middle the projection is flat to second order; x = 0 is the middle's longitude, and the
    // y axis starts at its latitude.
    for (int j = 40; j < 80; j += 3)
        for (int i = 40; i < 80; i += 3) {
            const double x = dem.sourceOffset.x + (i - 0.5 * (dem.width - 1)) * dem.spacing.x;
            const double y = dem.sourceOffset.y + (j - 0.5 * (dem.height - 1)) * dem.spacing.y;
            const double lon = west + 60.5 * step + x / metresLon,
                         latHere = south + 60.5 * step + y / metresLat;
            EXPECT_NEAR(sampleAt(dem, i, j), height(lon, latHere), 0.25) << i << " " << j;
        }
}

TEST(DemReader, HolesKeepTheirPlaceAndSizeInResampling) {
    const TempFolder folder;
    RasterSpec spec;
    spec.epsg = 4326;
    spec.width = spec.height = 100;
    const double step = 1.0 / 1200;
    spec.transform = {11, step, 0, 46, 0, -step};
    spec.hasNodata = true;
    spec.nodata = -1;
    const auto isHole = [](double c, double r) { return std::hypot(c - 60.3, r - 30.6) < 12; };
    spec.value = [&](int c, int r, int) { return isHole(c, r) ? -1.0 : 300.0; };
    const DemGrid dem = read(writeRaster(folder / "hole.tif", spec));
    long long missing = 0;
    for (int j = 0; j < dem.height; ++j)
        for (int i = 0; i < dem.width; ++i) {
            const float h = sampleAt(dem, i, j);
            missing += std::isnan(h);
            if (!std::isnan(h)) {
                EXPECT_NEAR(h, 300, 1e-3);
            }
            // The grid's middle is the source's; steps are the same there.
            const double c = 49.5 + i - 0.5 * (dem.width - 1), r = 49.5 - j + 0.5 * (dem.height - 1);
            const double fromMiddle = std::hypot(c - 60.3, r - 30.6);
            if (std::abs(fromMiddle - 12) > 1.5) {
                EXPECT_EQ(std::isnan(h), fromMiddle < 12) << i << " " << j;
            }
        }
    EXPECT_NEAR(double(missing), double(dem.sourceMissing), 0.03 * double(dem.sourceMissing));
}

TEST(DemReader, WebMercatorIsBroughtToTrueMetres) {
    const TempFolder folder;
    RasterSpec spec = rampSpec();
    spec.epsg = 3857;
    spec.width = 60;
    spec.height = 60;
    const double latitude = 60 * M_PI / 180, y = 6378137 * std::log(std::tan(M_PI / 4 + latitude / 2));
    spec.transform = {1000000, 50, 0, y + 1500, 0, -50};
    const DemGrid dem = read(writeRaster(folder / "web.tif", spec));
    // At 60 degrees north the map is twice too large (cos 60 = 1/2), within the ellipsoid's flattening.
    EXPECT_NEAR(dem.spacing.x, 25, 0.1);
    EXPECT_NEAR(dem.spacing.y, 25, 0.1);
}

TEST(DemReader, TurnedRasterIsMadeLevel) {
    const TempFolder folder;
    RasterSpec spec;
    spec.width = spec.height = 80;
    const double turn = 0.3, s = 10;
    spec.epsg = 0;
    spec.transform = {1000, s * std::cos(turn), s * std::sin(turn),
                      2000, s * std::sin(turn), -s * std::cos(turn)};
    const auto height = [](double x, double y) { return 0.1 * x - 0.2 * y; };
    spec.value = [&](int c, int r, int) {
        const auto& t = spec.transform;
        return height(t[0] + (c + 0.5) * t[1] + (r + 0.5) * t[2], t[3] + (c + 0.5) * t[4] + (r + 0.5) * t[5]);
    };
    const DemGrid dem = read(writeRaster(folder / "turned.tif", spec));
    EXPECT_GT(dem.width, 80);  // the rectangle around it
    int known = 0;
    for (int j = 0; j < dem.height; ++j)
        for (int i = 0; i < dem.width; ++i) {
            const float h = sampleAt(dem, i, j);
            if (std::isnan(h)) continue;
            ++known;
            const double x = dem.sourceOffset.x + (i - 0.5 * (dem.width - 1)) * dem.spacing.x;
            const double y = dem.sourceOffset.y + (j - 0.5 * (dem.height - 1)) * dem.spacing.y;
            // Beside the border a sample may lie up to half a step outside, where it is clamped.
            EXPECT_NEAR(h, height(x, y), 1.6) << i << " " << j;
        }
    const double expected = 80.0 * 80.0 * s * s / (dem.spacing.x * dem.spacing.y);
    EXPECT_NEAR(known, expected, 0.05 * expected);
}

TEST(DemReader, EsriAsciiWithoutSystem) {
    const TempFolder folder;
    const auto file = folder.text("g.asc",
                                  "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 5\nNODATA_value -1\n"
                                  "1.5 2 3\n4 -1 6\n");
    const DemGrid dem = read(file);
    ASSERT_EQ(dem.width, 3);
    EXPECT_EQ(dem.spacing, glm::dvec2(5));
    EXPECT_EQ(sampleAt(dem, 0, 1), 1.5f);
    EXPECT_EQ(sampleAt(dem, 2, 0), 6.0f);
    EXPECT_TRUE(std::isnan(sampleAt(dem, 1, 0)));
}

// 1201 x 1201 big-endian numbers, row 0 north; the place is in the name alone.
TEST(DemReader, SrtmHgt) {
    const TempFolder folder;
    std::string content;
    for (int r = 0; r < 1201; ++r)
        for (int c = 0; c < 1201; ++c) {
            const int height = r == 600 && c == 600 ? -32768 : 1000 + c - 2 * (r - 600);
            content += static_cast<char>(height >> 8 & 255);
            content += static_cast<char>(height & 255);
        }
    const DemGrid dem = read(folder.text("N46E011.hgt", content));
    EXPECT_EQ(dem.sourceMissing, 1);
    EXPECT_THAT(dem.driver, HasSubstr("SRTM"));
    EXPECT_NEAR(dem.spacing.y, 92.63, 0.02);
    const double latitude = 46.5 * M_PI / 180, sine = std::sin(latitude);
    const double primeVertical = 6378137 / std::sqrt(1 - 0.00669437999014 * sine * sine);
    EXPECT_NEAR(dem.spacing.x, primeVertical * std::cos(latitude) * M_PI / 180 / 1200, 0.001);
    // North is up and east is right, and the middle is the middle sample's neighbour.
    EXPECT_NEAR(sampleAt(dem, dem.width / 2 + 5, dem.height / 2), 1605, 3);
    EXPECT_GT(sampleAt(dem, dem.width / 2, dem.height - 10), sampleAt(dem, dem.width / 2, 10) + 2000);
}

TEST(DemReader, SixteenBitPngIsAMetreASampleUnlessAWorldFileSaysElse) {
    const TempFolder folder;
    RasterSpec spec = rampSpec();
    spec.driver = "PNG";
    spec.type = GDT_UInt16;
    spec.placed = false;
    const auto file = writeRaster(folder / "h.png", spec);
    DemGrid dem = read(file);
    EXPECT_EQ(dem.spacing, glm::dvec2(1));
    EXPECT_EQ(dem.projection, "none: 1 m a sample");
    EXPECT_EQ(sampleAt(dem, 1, 8), 110.0f);
    folder.text("h.wld", "4\n0\n0\n-2\n1000\n2000\n");
    dem = read(file);
    EXPECT_EQ(dem.spacing, glm::dvec2(4, 2));
}

RasterSpec gsiSpec(const std::function<int(int, int)>& centimetres) {
    RasterSpec spec;
    spec.driver = "PNG";
    spec.type = GDT_Byte;
    spec.width = spec.height = 256;
    spec.bands = 3;
    spec.placed = false;
    spec.value = [centimetres](int c, int r, int band) -> double {
        const int code = centimetres(c, r) & 0xffffff;
        return code >> (16 - 8 * band) & 255;
    };
    return spec;
}

TEST(DemReader, GsiTileIsDecoded) {
    const TempFolder folder;
    const auto code = [](int c, int r) { return c == 7 && r == 9 ? 1 << 23 : 100 * c - 40 * r; };
    std::filesystem::create_directories(folder / "15/29099");
    const DemGrid assumed = read(writeRaster(folder / "tile.png", gsiSpec(code)));
    EXPECT_THAT(assumed.driver, HasSubstr("GSI"));
    EXPECT_NEAR(assumed.spacing.x, 7.73, 0.01);
    EXPECT_EQ(assumed.sourceMissing, 1);
    for (int r = 0; r < 256; r += 15)
        for (int c = 0; c < 256; c += 15) EXPECT_FLOAT_EQ(sampleAt(assumed, c, 255 - r), float(c - 0.4 * r));
    const DemGrid placed = read(writeRaster(folder / "15/29099/12902.png", gsiSpec(code)));
    // The tile's latitude by the inverse Gudermannian, on the sphere of the web map.
    const double latitude = std::atan(std::sinh(M_PI * (1 - 2 * 12902.5 / 32768)));
    EXPECT_NEAR(placed.spacing.x, 2 * M_PI * 6378137 * std::cos(latitude) / (256 * 32768.0), 1e-9);
}

TEST(DemReader, PhotoOfTheSizeOfATileIsAPicture) {
    const TempFolder folder;
    const auto file =
        writeRaster(folder / "photo.png", gsiSpec([](int c, int r) { return c * 60000 + r * 911; }));
    expectOneLine(errorOf([&] { read(file); }), file, "found a picture (PNG, 3 bands of Byte)");
}

TEST(DemReader, ExtremeHeightRangesLoad) {
    const TempFolder folder;
    RasterSpec spec = rampSpec();
    spec.type = GDT_Float64;
    spec.value = [](int c, int, int) { return c * 1e-6 / 11; };
    const DemGrid tiny = read(writeRaster(folder / "tiny.tif", spec));
    EXPECT_NEAR(sampleAt(tiny, 11, 0) - sampleAt(tiny, 0, 0), 1e-6, 1e-12);
    spec.value = [](int c, int, int) { return c * 1e6 / 11; };
    const DemGrid huge = read(writeRaster(folder / "huge.tif", spec));
    EXPECT_EQ(huge.sourceMissing, 0);
    EXPECT_NEAR(sampleAt(huge, 11, 0), 1e6, 0.1);
}

TEST(DemReader, MissingEmptyAndFolder) {
    const TempFolder folder;
    const auto none = folder / "none.tif", empty = folder.text("empty.tif", "");
    expectOneLine(errorOf([&] { read(none); }), none, "no such file");
    expectOneLine(errorOf([&] { read(empty); }), empty, "the file is empty");
    std::filesystem::create_directory(folder / "nothing");
    expectOneLine(errorOf([&] { read(folder / "nothing"); }), folder / "nothing",
                  "found a folder without any");
}

TEST(DemReader, NotAnElevationModel) {
    const TempFolder folder;
    const auto text = folder.text("notes.tif", "These are notes, no elevations.\nSecond line.\n");
    expectOneLine(errorOf([&] { read(text); }), text, "expected an elevation model");
    RasterSpec photo = rampSpec();
    photo.driver = "JPEG";
    photo.type = GDT_Byte;
    photo.bands = 3;
    photo.width = photo.height = 32;
    photo.placed = false;
    const auto jpeg = writeRaster(folder / "photo.jpg", photo);
    expectOneLine(errorOf([&] { read(jpeg); }), jpeg, "found a picture (JPEG, 3 bands of Byte)");
}

TEST(DemReader, TruncatedGeoTiff) {
    const TempFolder folder;
    RasterSpec spec = rampSpec();
    spec.width = spec.height = 200;
    const auto file = writeRaster(folder / "cut.tif", spec);
    const auto whole = std::filesystem::file_size(file);
    for (const double share : {0.9, 0.5, 0.1}) {
        std::filesystem::resize_file(file, static_cast<std::uintmax_t>(double(whole) * share));
        expectOneLine(errorOf([&] { read(file); }), file, "the file is cut off or damaged");
    }
    std::filesystem::resize_file(file, 6);
    expectOneLine(errorOf([&] { read(file); }), file, "expected an elevation model");
}

// A system that GDAL can not make sense of is no damage to the samples.
TEST(DemReader, BrokenSystemIsNotTakenForDamage) {
    const TempFolder folder;
    const auto file =
        folder.text("g.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 5\n1 2\n3 4\n");
    folder.text("g.prj", "PROJCS[\"nonsense\",GEOGCS[7],,]");
    const DemGrid dem = read(file);
    EXPECT_EQ(dem.crs, "");
    EXPECT_EQ(sampleAt(dem, 1, 0), 4.0f);
}

TEST(DemReader, TruncatedAsciiGrid) {
    const TempFolder folder;
    const auto file =
        folder.text("cut.asc", "ncols 4\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 5\n1 2 3 4\n5 6");
    expectOneLine(errorOf([&] { read(file); }), file, "the file is cut off or damaged");
}

TEST(DemReader, AllNodata) {
    const TempFolder folder;
    RasterSpec spec = rampSpec();
    spec.hasNodata = true;
    spec.nodata = -32768;
    spec.value = [](int, int, int) { return -32768.0; };
    const auto file = writeRaster(folder / "void.tif", spec);
    expectOneLine(errorOf([&] { read(file); }), file, "all 108 samples are missing");
}

TEST(DemReader, OneSampleAndOneRow) {
    const TempFolder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}}) {
        RasterSpec spec = rampSpec();
        spec.width = width;
        spec.height = height;
        const auto file = writeRaster(folder / "thin.tif", spec);
        expectOneLine(
            errorOf([&] { read(file); }), file,
            "expected at least 2x2 samples, got " + std::to_string(width) + "x" + std::to_string(height));
    }
}

TEST(DemReader, HugeHeadersAreRefusedBeforeMemoryIsTaken) {
    const TempFolder folder;
    for (const auto& [w, h] : {std::pair{100000, 100000}, {70000, 2}, {65536, 65536}}) {
        const auto file =
            folder.text("huge.asc", "ncols " + std::to_string(w) + "\nnrows " + std::to_string(h) +
                                        "\nxllcorner 0\nyllcorner 0\ncellsize 5\n1 2 3 4\n");
        expectOneLine(errorOf([&] { read(file); }), file, "expected at most 65536 samples a side");
    }
}

TEST(DemReader, HalfTheGlobeIsRefused) {
    const TempFolder folder;
    RasterSpec spec = rampSpec();
    spec.epsg = 4326;
    spec.transform = {-180, 15, 0, 90, 0, -15};
    const auto file = writeRaster(folder / "globe.tif", spec);
    expectOneLine(errorOf([&] { read(file); }), file, "expected at most 20 degrees a side");
}

TEST(DemReader, DegreesWithoutASystemAreRecognised) {
    const TempFolder folder;
    std::string rows;
    for (int j = 0; j < 20; ++j) {
        for (int i = 0; i < 20; ++i) rows += std::to_string(i + j) + " ";
        rows += "\n";
    }
    const auto file = folder.text(
        "d.asc", "ncols 20\nnrows 20\nxllcorner 11\nyllcorner 46\ncellsize 0.0008333333333\n" + rows);
    const DemGrid dem = read(file);
    EXPECT_THAT(dem.crs, HasSubstr("assumed"));
    EXPECT_NEAR(dem.spacing.y, 92.6, 0.2);
}

TEST(DemReader, CancelStopsIt) {
    const TempFolder folder;
    const auto file = writeRaster(folder / "ramp.tif", rampSpec());
    Progress progress;
    progress.cancel();
    EXPECT_THROW(readDem(file, 1, progress), Cancelled);
}

struct RealCase {
    const char* name;
    int width, height;
    double minimum, maximum;
    long long missing;
};

TEST(DemReader, RealFiles) {
    const RealCase cases[] = {{"srtm_bigtujunga30m_utm11.tif", 1197, 643, 315, 2295, 0},
                              {"SainteHelens.dem", 327, 468, 682, 2543, 4151},
                              {"ararat/agri-small-dem-utm38n-30m.tif", 457, 499, 1727.9, 5142.91, 3466},
                              {"gsi/altitude.png", 256, 256, 11.41, 24.4, 6631}};
    for (const RealCase& c : cases) {
        const auto file = test::realData(c.name);
        if (file.empty()) GTEST_SKIP() << "real data is absent: " << c.name;
        const DemGrid dem = read(file);
        EXPECT_EQ(dem.width, c.width) << c.name;
        EXPECT_EQ(dem.height, c.height) << c.name;
        EXPECT_EQ(dem.sourceMissing, c.missing) << c.name;
        float low = INFINITY, high = -INFINITY;
        for (const float h : dem.heights)
            if (!std::isnan(h)) low = std::min(low, h), high = std::max(high, h);
        EXPECT_NEAR(low, c.minimum, 0.01) << c.name;
        EXPECT_NEAR(high, c.maximum, 0.01) << c.name;
    }
}

TEST(DemReader, RealDegrees) {
    const auto file = test::realData("mt_rainier_90m.tif");
    if (file.empty()) GTEST_SKIP() << "real data is absent: mt_rainier_90m.tif";
    const DemGrid dem = read(file);
    EXPECT_NEAR(double(dem.sourceMissing) / (1201.0 * 1201.0), 0.0063, 0.00005);
    EXPECT_NEAR(dem.spacing.x, 63.97, 0.02);
    EXPECT_NEAR(dem.spacing.y, 92.63, 0.02);
    // Resampling keeps the share of missing samples.
    const auto missing =
        std::count_if(dem.heights.begin(), dem.heights.end(), [](float h) { return std::isnan(h); });
    EXPECT_NEAR(double(missing) / double(dem.heights.size()), 0.0063, 0.0002);
    EXPECT_NEAR(*std::max_element(dem.heights.begin(), dem.heights.end(),
                                  [](float a, float b) { return !(b <= a) && !std::isnan(b); }),
                4371, 3);
}

}  // namespace
}  // namespace stereonav::test
