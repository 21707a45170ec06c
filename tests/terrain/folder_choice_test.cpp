// What lies beside heights in a folder: it is told from them and left aside, whatever it is called.
#include <gdal_utils.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "gdal_reading.h"
#include "raster_files.h"
#include "terrain/raster/elevation_folder.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/dem_rows.h"

namespace stereonav::test {
namespace {

constexpr int kSide = 96;
constexpr double kSpacing = 30;

// Hills of 150 m over so much, with some grain.
double hill(int c, int r, double over = 300) {
    return std::round(over + 100 * std::sin(0.06 * c) * std::cos(0.045 * r) + 50 * std::sin(0.11 * (c + r)) +
                      2 * ((c * 7 + r * 13) % 3));
}

// Radians.
double slopeOfHill(int c, int r) {
    return std::atan(std::hypot(hill(c + 1, r) - hill(c - 1, r), hill(c, r + 1) - hill(c, r - 1)) /
                     (2 * kSpacing));
}

double aspectOfHill(int c, int r) {
    const double degrees =
        std::atan2(hill(c - 1, r) - hill(c + 1, r), hill(c, r + 1) - hill(c, r - 1)) * 180 / M_PI;
    return degrees < 0 ? degrees + 360 : degrees;
}

double shadeOfHill(int c, int r) {
    const double x = (hill(c - 1, r) - hill(c + 1, r)) / (2 * kSpacing),
                 y = (hill(c, r + 1) - hill(c, r - 1)) / (2 * kSpacing);
    return std::round(1 +
                      254 * std::max(0.0, (0.5 - 0.5 * x + 0.5 * y) / std::sqrt(1 + x * x + y * y)) / 1.3);
}

double countOf(int c, int r) {
    return 5 + (c / 17 + r / 23) % 5 * 4 + (c * 31 + r * 17) % 7;
}

using Value = std::function<double(int c, int r)>;

RasterSpec layer(GDALDataType type, const Value& value, std::optional<double> nodata = {}, int column = 0) {
    RasterSpec spec;
    spec.width = spec.height = kSide;
    spec.type = type;
    spec.transform = {500000 + kSpacing * column, kSpacing, 0, 5000000, 0, -kSpacing};
    spec.hasNodata = nodata.has_value(), spec.nodata = nodata.value_or(0);
    spec.value = [value, column](int c, int r, int) { return value(column + c, r); };
    return spec;
}

RasterSpec heightsAt(int column = 0, double over = 300) {
    return layer(
        GDT_Int16, [over](int c, int r) { return hill(c, r, over); }, -9999, column);
}

class FolderChoice : public testing::Test {
protected:
    FolderChoice() { std::filesystem::create_directory(parts()); }
    std::filesystem::path parts() const { return mFolder / "parts"; }
    void write(const std::string& name, const RasterSpec& spec) { writeRaster(parts() / name, spec); }
    // Expects the hills of `tiles` tiles side by side, read at once and by rows, and a note on each file that
    // was left aside.
    void expectHills(const std::string& of, const std::vector<std::string>& aside, int tiles = 1,
                     double over = 300) {
        SCOPED_TRACE(of);
        const DemGrid dem = readGround(parts());
        ASSERT_EQ(dem.width, kSide * tiles);
        ASSERT_EQ(dem.height, kSide);
        DemRows rows(parts());
        std::vector<float> again(dem.heights.size());
        rows.read(0, kSide, again.data());
        for (int r = 0; r < kSide; ++r)
            for (int c = 0; c < dem.width; ++c) {
                const auto at = static_cast<std::size_t>(kSide - 1 - r) * dem.width + c;
                ASSERT_EQ(dem.heights[at], hill(c, r, over)) << c << " " << r;
                ASSERT_EQ(again[at], dem.heights[at]) << c << " " << r;
            }
        EXPECT_THAT(dem.driver, HasSubstr(std::to_string(tiles) + " file"));
        std::string notes;
        for (const std::string& note : dem.notes) notes += note;
        EXPECT_EQ(notes.empty(), aside.empty()) << notes;
        for (const std::string& name : aside)
            EXPECT_THAT(notes, AllOf(HasSubstr("left aside"), HasSubstr(name), Not(HasSubstr("\n"))));
    }
    void emptyFolder() {
        std::filesystem::remove_all(parts());
        std::filesystem::create_directory(parts());
    }

    TempFolder mFolder;
};

TEST_F(FolderChoice, DownloadsKeepTheirHeights) {
    const auto count = layer(GDT_Int16, countOf), bytes = layer(GDT_Byte, countOf);
    const auto mask = layer(GDT_Byte, [](int c, int r) { return c > 60 && r > 40 ? 3.0 : 0.0; });
    write("ASTGTMV003_N35E138_dem.tif", heightsAt()), write("ASTGTMV003_N35E138_num.tif", count);
    expectHills("ASTER", {"_num.tif"});
    write("ASTGTMV003_N35E138_num.tif", bytes);
    expectHills("ASTER, counts in bytes", {"_num.tif"});
    emptyFolder();
    write("ALPSMLC30_N035E138_DSM.tif", heightsAt()), write("ALPSMLC30_N035E138_MSK.tif", mask);
    write("ALPSMLC30_N035E138_STK.tif", bytes);
    expectHills("ALOS", {"_MSK.tif", "_STK.tif"});
    emptyFolder();
    write("Copernicus_DSM_COG_10_N35_00_E138_00_DEM.tif", heightsAt());
    write("Copernicus_DSM_COG_10_N35_00_E138_00_WBM.tif", mask),
        write("Copernicus_DSM_COG_10_N35_00_E138_00_EDM.tif", mask);
    write("Copernicus_DSM_COG_10_N35_00_E138_00_HEM.tif",
          layer(
              GDT_Float32, [](int c, int r) { return 0.3 + 0.01 * ((c * 31 + r * 17) % 50); }, -32767));
    expectHills("Copernicus", {"_WBM.tif", "_EDM.tif", "_HEM.tif"});
}

struct Beside {
    const char* what;
    RasterSpec spec;
};

std::vector<Beside> besideHeights() {
    const auto degrees = [](int c, int r) { return slopeOfHill(c, r) * 180 / M_PI; };
    const auto few = [](int c, int r) { return double((c / 20 + r / 30) % 4); };
    std::vector<Beside> all{{"slope", layer(GDT_Float32, degrees, -9999)},
                            {"aspect", layer(GDT_Float32, aspectOfHill, -9999)},
                            {"hillshade", layer(GDT_Byte, shadeOfHill, 0)},
                            {"counts", layer(GDT_UInt16, countOf)},
                            {"counts in Int16", layer(GDT_Int16, countOf)},
                            {"classes", layer(GDT_Byte, few)},
                            {"a mask", layer(GDT_Byte, [](int c, int) { return c < 50 ? 255.0 : 0.0; })}};
    RasterSpec photo = layer(GDT_Byte, countOf);
    photo.bands = 3;
    all.push_back({"a photo", photo});
    RasterSpec palette = layer(GDT_Byte, few);
    palette.adorn = [](GDALDataset& dataset) {
        GDALColorTable colors;
        for (short n = 0; n < 4; ++n) {
            const GDALColorEntry entry{n, short(40 * n), 0, 255};
            colors.SetColorEntry(n, &entry);
        }
        dataset.GetRasterBand(1)->SetColorTable(&colors);
    };
    all.push_back({"land cover", palette});
    RasterSpec unit = layer(
        GDT_Float32, [](int c, int r) { return hill(c, r, 500); }, -9999);
    unit.unit = "percent";
    all.push_back({"another unit", unit});
    return all;
}

// Before and after it by name, and over ground that lies high or low.
TEST_F(FolderChoice, TellsHeightsWithoutTheirNames) {
    for (const Beside& beside : besideHeights())
        for (const char* name : {"a.tif", "z.tif"})
            for (const double over : {300.0, 1500.0}) {
                emptyFolder();
                write("b.tif", heightsAt(0, over)), write(name, beside.spec);
                expectHills(std::string(beside.what) + " " + name, {name}, 1, over);
            }
}

// What the library's own program makes of a real ground.
TEST_F(FolderChoice, WhatIsMadeOfRealHeightsIsLeftAside) {
    const std::filesystem::path real = realData("srtm_bigtujunga30m_utm11.tif");
    if (real.empty()) GTEST_SKIP() << "the real ground is not there";
    const DemGrid alone = readGround(real);
    GDALAllRegister();
    const char* const words[] = {"-of", "GTiff", nullptr};
    for (const char* kind : {"slope", "aspect", "hillshade", "TRI", "TPI", "roughness"})
        for (const char* name : {"a.tif", "z.tif"}) {
            emptyFolder();
            std::filesystem::copy_file(real, parts() / "m.tif");
            GDALDEMProcessingOptions* const options =
                GDALDEMProcessingOptionsNew(const_cast<char**>(words), nullptr);
            const GDALDatasetH source = GDALOpen(real.c_str(), GA_ReadOnly);
            GDALClose(GDALDEMProcessing((parts() / name).c_str(), source, kind, nullptr, options, nullptr));
            GDALClose(source);
            GDALDEMProcessingOptionsFree(options);
            const DemGrid dem = readGround(parts());
            ASSERT_EQ(dem.heights.size(), alone.heights.size());
            EXPECT_EQ(std::memcmp(dem.heights.data(), alone.heights.data(), 4 * dem.heights.size()), 0)
                << kind << " " << name;
            ASSERT_EQ(dem.notes.size(), 1u) << kind << " " << name;
            EXPECT_THAT(dem.notes[0], HasSubstr(name));
        }
}

TEST_F(FolderChoice, NamesAndAllAtOnce) {
    write("hills.tif", heightsAt());
    std::vector<std::string> names;
    for (const Beside& beside : besideHeights()) {
        names.push_back("hills_" + std::to_string(names.size()) + ".tif");
        write(names.back(), beside.spec);
    }
    expectHills("all kinds", {names.front()});
}

TEST_F(FolderChoice, OneCoversMoreThanTheOther) {
    write("b.tif", heightsAt());
    RasterSpec wide = layer(GDT_Byte, countOf);
    wide.width = wide.height = 3 * kSide;
    wide.transform = {500000 - kSide * kSpacing, kSpacing, 0, 5000000 + kSide * kSpacing, 0, -kSpacing};
    write("c.tif", wide);
    expectHills("counts all around", {"c.tif"});
    RasterSpec coarse = layer(
        GDT_Float32, [](int c, int r) { return slopeOfHill(3 * c, 3 * r) * 180 / M_PI; }, -9999);
    coarse.width = coarse.height = kSide / 3;
    coarse.transform = {500000, 3 * kSpacing, 0, 5000000, 0, -3 * kSpacing};
    write("c.tif", coarse);
    expectHills("a coarse slope", {"c.tif"});
}

// From one place counts alone were sent, which are called like the others.
TEST_F(FolderChoice, KindsGoTogetherOverTiles) {
    for (int tile = 0; tile < 3; ++tile) {
        const std::string name = "N35E13" + std::to_string(tile);
        if (tile < 2) write(name + "_dem.tif", heightsAt(tile * kSide));
        write(name + "_num.tif", layer(GDT_Int16, countOf, {}, tile * kSide));
    }
    expectHills("counts by name", {"N35E132_num.tif"}, 2);
    emptyFolder();
    for (int tile = 0; tile < 3; ++tile) {
        const std::string name = "N35E13" + std::to_string(tile);
        if (tile < 2) write(name + "_x.tif", heightsAt(tile * kSide));
        write(name + "_y.tif", layer(GDT_Byte, countOf, {}, tile * kSide));
    }
    expectHills("counts by what they are called like", {"N35E132_y.tif"}, 2);
}

// Heights twice are no reason to leave anything: a finer model in a wider one, one that counts from another
// zero.
TEST_F(FolderChoice, HeightsBesideHeightsStay) {
    write("a.tif", heightsAt());
    for (const double zero : {0.0, 45.0}) {
        RasterSpec other = layer(
            GDT_Float32, [zero](int c, int r) { return hill(c, r) + zero + 0.25; }, -9999);
        other.width = other.height = kSide / 2;
        write("b.tif", other);
        const DemGrid dem = readGround(parts());
        EXPECT_TRUE(dem.notes.empty()) << dem.notes.front();
        EXPECT_EQ(dem.heights[static_cast<std::size_t>(kSide - 1) * kSide], hill(0, 0) + zero + 0.25);
        EXPECT_EQ(dem.heights[kSide - 1], hill(kSide - 1, kSide - 1));
    }
}

TEST_F(FolderChoice, WhatIsNotClearIsSaid) {
    write("a.tif", heightsAt());
    write("b.tif", layer(
                       GDT_Int16, [](int c, int r) { return hill(r, c) + c; }, -9999));
    DemGrid dem = readGround(parts());
    ASSERT_EQ(dem.notes.size(), 1u);
    EXPECT_THAT(dem.notes[0], AllOf(HasSubstr("a.tif and b.tif cover the same ground with different heights"),
                                    HasSubstr("that of b.tif counts")));
    EXPECT_EQ(dem.heights[static_cast<std::size_t>(kSide - 1) * kSide + 40], hill(0, 40) + 40);
    emptyFolder();
    write("N35E138_num.tif", layer(GDT_Int16, countOf));
    dem = readGround(parts());
    ASSERT_EQ(dem.notes.size(), 1u);
    EXPECT_THAT(dem.notes[0], HasSubstr("N35E138_num.tif is read as heights, although its name"));
}

TEST_F(FolderChoice, PicturesAloneAreNoGround) {
    RasterSpec photo = layer(GDT_Byte, countOf);
    photo.bands = 3;
    write("a.tif", photo), write("b.tif", photo);
    EXPECT_THAT(errorOf([&] { readGround(parts()); }),
                AllOf(HasSubstr("a.tif"), HasSubstr("found a picture"), Not(HasSubstr("\n"))));
}

// Files that macOS and others leave.
TEST_F(FolderChoice, HiddenFilesAreNotThere) {
    write("a.tif", heightsAt());
    std::ofstream(parts() / "._a.tif") << std::string("\0\5\26\7", 4) << "Mac OS X";
    std::ofstream(parts() / ".DS_Store") << "x";
    std::ofstream(parts() / ".b.hgt") << "x";
    EXPECT_EQ(elevationFilesIn(parts()).size(), 1u);
    expectHills("hidden files", {});
}

// Depths, feet and scales, which all files of the folder mean alike.
TEST_F(FolderChoice, UnitsOfAllItsFilesCount) {
    for (int tile = 0; tile < 2; ++tile) {
        RasterSpec spec = heightsAt(tile * kSide);
        spec.unit = "ft";
        spec.adorn = [](GDALDataset& dataset) {
            dataset.GetRasterBand(1)->SetScale(2);
            dataset.GetRasterBand(1)->SetOffset(5);
        };
        write("t" + std::to_string(tile) + ".tif", spec);
    }
    const DemGrid dem = readGround(parts());
    ASSERT_EQ(dem.width, 2 * kSide);
    for (int c = 0; c < 2 * kSide; c += 7)
        EXPECT_NEAR(dem.heights[c], 0.3048 * (2 * hill(c, kSide - 1) + 5), 1e-3) << c;
}

}  // namespace
}  // namespace stereonav::test
