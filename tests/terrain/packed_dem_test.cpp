// Elevation models as they are sent: SRTM tiles in an archive, netCDF.
#include <cpl_vsi.h>

#include <cmath>

#include "gdal_reading.h"
#include "raster_files.h"
#include "terrain/raster/elevation_folder.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/dem_rows.h"

namespace stereonav::test {
namespace {

constexpr int kTile = 1201;

int tileHeight(int c, int r) {
    return 100 + c % 300 + r / 4;
}

// Big-endian, north row first.
void writeHgt(const std::string& place) {
    VSILFILE* const file = VSIFOpenL(place.c_str(), "wb");
    ASSERT_NE(file, nullptr) << place;
    std::string bytes;
    for (int r = 0; r < kTile; ++r)
        for (int c = 0; c < kTile; ++c) {
            const int height = tileHeight(c, r);
            bytes += static_cast<char>(height >> 8);
            bytes += static_cast<char>(height & 255);
        }
    ASSERT_EQ(VSIFWriteL(bytes.data(), 1, bytes.size(), file), bytes.size());
    ASSERT_EQ(VSIFCloseL(file), 0);
}

TEST(PackedDem, TilesOfSrtmAreReadAsTheyAreSent) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "parts");
    writeHgt((folder / "N35E138.hgt").string());
    writeHgt("/vsizip/" + (folder / "parts/N35E138.hgt.zip").string() + "/N35E138.hgt");
    writeHgt("/vsigzip/" + (folder / "N35E138.hgt.gz").string());
    const DemGrid plain = readGround(folder / "N35E138.hgt");
    EXPECT_EQ(plain.source.width, kTile);
    for (const auto& file : {folder / "parts/N35E138.hgt.zip", folder / "N35E138.hgt.gz", folder / "parts"}) {
        const DemGrid packed = readGround(file);
        EXPECT_EQ(packed.crs, plain.crs) << file;
        ASSERT_EQ(packed.heights.size(), plain.heights.size()) << file;
        for (std::size_t n = 0; n < plain.heights.size(); n += 97)
            ASSERT_EQ(packed.heights[n], plain.heights[n]) << n;
    }
    EXPECT_TRUE(isPackedHeights("N35E138.SRTMGL1.HGT.ZIP"));
    EXPECT_FALSE(isPackedHeights("study.zip"));
}

RasterSpec netCdf() {
    RasterSpec spec;
    spec.driver = "netCDF";
    spec.width = 30, spec.height = 20;
    spec.value = [](int c, int r, int) { return 40.0 + 7 * c - 3 * r; };
    return spec;
}

void expectRows(const std::filesystem::path& file, double metres = 1) {
    SCOPED_TRACE(file);
    const DemGrid dem = readGround(file);
    ASSERT_EQ(dem.width, 30);
    ASSERT_EQ(dem.height, 20);
    DemRows rows(file);
    std::vector<float> again(dem.heights.size());
    rows.read(0, 20, again.data());
    for (int r = 0; r < 20; ++r)
        for (int c = 0; c < 30; ++c) {
            const auto at = static_cast<std::size_t>(19 - r) * 30 + c;
            ASSERT_NEAR(dem.heights[at], metres * (40 + 7 * c - 3 * r), 1e-3) << c << " " << r;
            ASSERT_EQ(again[at], dem.heights[at]);
        }
    EXPECT_EQ(dem.spacing, glm::dvec2(30));
}

TEST(PackedDem, NetCdfIsAnElevationModel) {
    const TempFolder folder;
    for (const char* format : {"FORMAT=NC", "FORMAT=NC2", "FORMAT=NC4"}) {
        RasterSpec spec = netCdf();
        spec.options = {format};
        expectRows(writeRaster(folder / "one.nc", spec));
    }
    std::filesystem::create_directory(folder / "parts");
    writeRaster(folder / "parts/one.nc", netCdf());
    expectRows(folder / "parts");
}

// The one of several variables that is called heights.
TEST(PackedDem, NetCdfOfSeveralVariables) {
    const TempFolder folder;
    RasterSpec spec = netCdf();
    spec.bands = 2;
    const auto usual = spec.value;
    spec.value = [usual](int c, int r, int band) { return band == 1 ? usual(c, r, 0) : 11 + (c + r) % 5; };
    const auto named = [&](const char* first, const char* second) {
        spec.adorn = [first, second](GDALDataset& dataset) {
            dataset.GetRasterBand(1)->SetMetadataItem("NETCDF_VARNAME", first);
            dataset.GetRasterBand(2)->SetMetadataItem("NETCDF_VARNAME", second);
        };
        return writeRaster(folder / "several.nc", spec);
    };
    for (const char* name : {"elevation", "z", "Topography"}) expectRows(named("tid", name));
    const auto several = named("tid", "band_data");
    EXPECT_THAT(
        errorOf([&] { readGround(several); }),
        AllOf(HasSubstr("several.nc"), HasSubstr("found several rasters in one file"), Not(HasSubstr("\n"))));
}

TEST(PackedDem, DamagedOnesAreRefusedInOneLine) {
    const TempFolder folder;
    for (const char* format : {"FORMAT=NC", "FORMAT=NC4"}) {
        RasterSpec spec = netCdf();
        spec.options = {format};
        const auto file = writeRaster(folder / "cut.nc", spec);
        for (const double share : {0.9, 0.5, 0.02}) {
            std::filesystem::resize_file(
                file, static_cast<std::uintmax_t>(share * double(std::filesystem::file_size(file))));
            EXPECT_THAT(errorOf([&] { readGround(file); }), AllOf(HasSubstr("cut.nc"), Not(HasSubstr("\n"))))
                << format << " " << share;
        }
    }
    // More dimensions than the file has bytes, for which the library would take 17 GB; one whose size is cut
    // off.
    for (const std::string_view list : {std::string_view("\0\0\0\n\x7f\xff\xff\xff", 8),
                                        std::string_view("\0\0\0\n\0\0\0\1\0\0\0\1x\0\0", 15)})
        for (const char version : {1, 2}) {
            std::string header = std::string("CDF") + version + std::string(4, '\0') + std::string(list);
            const auto file = folder.text("header.nc", header);
            EXPECT_THAT(errorOf([&] { readGround(file); }),
                        AllOf(HasSubstr("header.nc"), HasSubstr("cut off or damaged"), Not(HasSubstr("\n"))));
        }
    const auto zip = folder.text("N35E138.hgt.zip", "PK\3\4 but no archive");
    EXPECT_THAT(errorOf([&] { readGround(zip); }), AllOf(HasSubstr("N35E138.hgt.zip"), Not(HasSubstr("\n"))));
}

}  // namespace
}  // namespace stereonav::test
