// Odd but valid elevation models, each against the library's own reading of the same file, sample by sample.
#include <sys/stat.h>

#include <cmath>
#include <limits>

#include "gdal_reading.h"
#include "raster_files.h"
#include "terrain/read/dem_reader.h"

namespace stereonav::test {
namespace {

constexpr double kSurveyFoot = 1200.0 / 3937;

RasterSpec oddSpec(GDALDataType type = GDT_Float32) {
    RasterSpec spec;
    spec.type = type;
    spec.width = 41;
    spec.height = 33;
    spec.value = [](int c, int r, int) {
        return std::floor(100 + 40 * std::sin(0.2 * c) - r + 0.5 * (c % 3));
    };
    return spec;
}

// missing: samples of the grid that have to be missing, -1 where it is resampled.
void expectAsGdal(const std::filesystem::path& file, int missing = 0, int band = 1, double metres = 1) {
    SCOPED_TRACE(file.filename().string());
    const DemGrid dem = readGround(file);
    const Compared all =
        compareWithGdal(dem, GdalReading(file, band, dem.georeferenced ? dem.grid.wkt : ""), metres);
    EXPECT_EQ(all.wrong, 0) << all.first;
    EXPECT_GT(all.exact + all.between, 1000);
    if (missing < 0) return;
    EXPECT_EQ(all.missing, missing);
    EXPECT_EQ(all.between + all.outside, 0);
}

TEST(DemValues, EveryNumericType) {
    const TempFolder folder;
    for (const GDALDataType type : {GDT_Byte, GDT_UInt16, GDT_Int16, GDT_UInt32, GDT_Int32, GDT_UInt64,
                                    GDT_Int64, GDT_Float32, GDT_Float64})
        expectAsGdal(writeRaster(folder / (std::string(GDALGetDataTypeName(type)) + ".tif"), oddSpec(type)));
}

TEST(DemValues, EveryWayOfStoring) {
    const TempFolder folder;
    const auto stored = [&](const char* name, GDALDataType type, std::vector<const char*> options) {
        RasterSpec spec = oddSpec(type);
        spec.options = std::move(options);
        expectAsGdal(writeRaster(folder / name, spec));
    };
    stored("big_endian.tif", GDT_Int16, {"ENDIANNESS=BIG"});
    stored("big_endian_float.tif", GDT_Float32, {"ENDIANNESS=BIG", "BIGTIFF=YES"});
    stored("tiled.tif", GDT_Float32,
           {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", "COMPRESS=DEFLATE", "PREDICTOR=3"});
    stored("lzw.tif", GDT_Int32, {"COMPRESS=LZW", "PREDICTOR=2"});
    stored("strips.tif", GDT_Float64, {"BLOCKYSIZE=5", "COMPRESS=PACKBITS"});
    stored("zstd.tif", GDT_UInt16, {"COMPRESS=ZSTD", "TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=32"});
}

TEST(DemValues, OtherFormats) {
    const TempFolder folder;
    const auto as = [&](const char* driver, const char* name, GDALDataType type,
                        std::vector<const char*> options = {}) {
        RasterSpec spec = oddSpec(type);
        spec.driver = driver;
        spec.options = std::move(options);
        expectAsGdal(writeRaster(folder / name, spec));
    };
    as("HFA", "erdas.img", GDT_Int16);
    as("EHdr", "esri.bil", GDT_Int16);
    as("ENVI", "envi.dat", GDT_Float64);
    as("SAGA", "saga.sdat", GDT_Float32);
    as("GS7BG", "surfer7.grd", GDT_Float64);
    as("GSBG", "surfer6.grd", GDT_Float32);
    as("BT", "binary.bt", GDT_Float32);
    as("AAIGrid", "esri.asc", GDT_Float32);
    as("GPKG", "package.gpkg", GDT_Float32, {"TILE_FORMAT=TIFF"});
    as("JP2OpenJPEG", "lossless.jp2", GDT_Int16, {"QUALITY=100", "REVERSIBLE=YES"});
}

TEST(DemValues, ScaleAndOffset) {
    const TempFolder folder;
    RasterSpec spec = oddSpec(GDT_Int16);
    spec.hasNodata = true;
    spec.nodata = 100;  // stored
    spec.adorn = [](GDALDataset& dataset) {
        dataset.GetRasterBand(1)->SetScale(0.1);
        dataset.GetRasterBand(1)->SetOffset(-50.25);
    };
    const auto file = writeRaster(folder / "scaled.tif", spec);
    int stored100 = 0;
    for (int r = 0; r < spec.height; ++r)
        for (int c = 0; c < spec.width; ++c) stored100 += spec.value(c, r, 0) == 100;
    ASSERT_GT(stored100, 10);
    expectAsGdal(file, stored100);
    EXPECT_EQ(readGround(file).heightUnit, "stored times 0.1 plus -50.25");
    EXPECT_EQ(readGround(file).missingValue, "100");
    spec.adorn = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetScale(0); };
    const auto flat = writeRaster(folder / "flat.tif", spec);
    EXPECT_THAT(errorOf([&] { readGround(flat); }), HasSubstr("expected a scale other than 0"));
}

TEST(DemValues, SignedBytes) {
    const TempFolder folder;
    RasterSpec spec = oddSpec(GDT_Byte);
    spec.options = {"PIXELTYPE=SIGNEDBYTE"};
    spec.value = [](int c, int r, int) { return (c + 7 * r) % 256; };
    const DemGrid dem = readGround(writeRaster(folder / "signed.tif", spec));
    for (int r = 0; r < spec.height; ++r)
        for (int c = 0; c < spec.width; ++c) {
            const int stored = (c + 7 * r) % 256;
            EXPECT_EQ(dem.heights[(spec.height - 1 - r) * spec.width + c],
                      stored > 127 ? stored - 256 : stored);
        }
}

TEST(DemValues, MissingSamplesAsGivenOrMasked) {
    const TempFolder folder;
    const auto with = [&](const char* name, GDALDataType type, double nodata, const char* said) {
        RasterSpec spec = oddSpec(type);
        spec.hasNodata = true;
        spec.nodata = nodata;
        if (type == GDT_Int64)
            spec.adorn = [=](GDALDataset& dataset) {
                dataset.GetRasterBand(1)->SetNoDataValueAsInt64(static_cast<std::int64_t>(nodata));
            };
        const auto usual = spec.value;
        spec.value = [=](int c, int r, int b) { return c == 3 && r < 9 ? nodata : usual(c, r, b); };
        const auto file = writeRaster(folder / name, spec);
        expectAsGdal(file, 9);
        EXPECT_EQ(readGround(file).missingValue, said);
    };
    with("nan.tif", GDT_Float32, NAN, "nan");
    with("least.tif", GDT_Int32, -2147483648.0, "-2.14748365e+09");
    with("most.tif", GDT_UInt16, 65535, "65535");
    with("zero.tif", GDT_Byte, 0, "0");
    with("float.tif", GDT_Float32, -3.4028234663852886e38, "-3.40282347e+38");
    with("double.tif", GDT_Float64, -1.7976931348623157e308, "-1.79769313e+308");
    with("wide.tif", GDT_Int64, -9999, "-9999");
    RasterSpec masked = oddSpec();
    masked.adorn = [](GDALDataset& dataset) {
        ASSERT_EQ(dataset.CreateMaskBand(GMF_PER_DATASET), CE_None);
        std::vector<unsigned char> mask(41 * 33, 255);
        for (int k = 0; k < 20; ++k) mask[100 + 3 * k] = 0;
        ASSERT_EQ(dataset.GetRasterBand(1)->GetMaskBand()->RasterIO(GF_Write, 0, 0, 41, 33, mask.data(), 41,
                                                                    33, GDT_Byte, 0, 0, nullptr),
                  CE_None);
    };
    const auto file = writeRaster(folder / "masked.tif", masked);
    expectAsGdal(file, 20);
    EXPECT_EQ(readGround(file).missingValue, "by a mask");
    RasterSpec alpha = oddSpec(GDT_UInt16);
    alpha.bands = 2;
    alpha.value = [](int c, int r, int band) { return band == 0 ? 100 + c : (r == 4 ? 0 : 65535); };
    alpha.adorn = [](GDALDataset& dataset) {
        dataset.GetRasterBand(2)->SetColorInterpretation(GCI_AlphaBand);
    };
    expectAsGdal(writeRaster(folder / "alpha.tif", alpha), 41);
}

// A value that the file does not name: taken for missing where it is far from all else, and said.
TEST(DemValues, CustomaryMissingValues) {
    const TempFolder folder;
    RasterSpec spec = oddSpec();
    spec.value = [](int c, int r, int) { return c == 7 && r < 5 ? -9999.0 : 300.0 + c; };
    DemGrid dem = readGround(writeRaster(folder / "land.tif", spec));
    EXPECT_EQ(dem.sourceMissing, 5);
    EXPECT_THAT(dem.missingValue, HasSubstr("-9999, by convention: the file names none"));
    // The sea floor may lie there.
    spec.value = [](int c, int r, int) { return c == 7 && r < 5 ? -9999.0 : -9990.0 + c; };
    dem = readGround(writeRaster(folder / "trench.tif", spec));
    EXPECT_EQ(dem.sourceMissing, 0);
    EXPECT_EQ(dem.missingValue, "");
}

TEST(DemValues, UnitsOfHeights) {
    const TempFolder folder;
    const auto in = [&](const char* name, const char* unit, double metres, const char* said) {
        RasterSpec spec = oddSpec();
        spec.unit = unit;
        const auto file = writeRaster(folder / name, spec);
        expectAsGdal(file, 0, 1, metres);
        EXPECT_EQ(readGround(file).heightUnit, said);
    };
    in("metre.tif", "metre", 1, "");
    in("ft.tif", "ft", 0.3048, "ft, 0.3048 m each, by the band");
    in("survey.tif", "US survey foot", kSurveyFoot, "US survey foot, 0.30480061 m each, by the band");
    in("cm.tif", "cm", 0.01, "cm, 0.01 m each, by the band");
    // NAVD88 height in survey feet: said by the reference system alone.
    for (const char* version : {"GEOTIFF_VERSION=1.0", "GEOTIFF_VERSION=1.1"}) {
        RasterSpec spec = oddSpec();
        spec.options = {version};
        spec.adorn = [](GDALDataset& dataset) {
            OGRSpatialReference plan, up, both;
            plan.importFromEPSG(26910);
            up.importFromEPSG(6360);
            both.SetCompoundCS("NAD83 / UTM zone 10N + NAVD88 height (ftUS)", &plan, &up);
            ASSERT_EQ(dataset.SetSpatialRef(&both), CE_None);
        };
        const auto file = writeRaster(folder / (std::string(version) + ".tif"), spec);
        expectAsGdal(file, 0, 1, kSurveyFoot);
        EXPECT_THAT(readGround(file).heightUnit,
                    AllOf(HasSubstr("US survey foot"), HasSubstr("0.30480061 m each")));
    }
}

TEST(DemValues, UnitsOfThePlan) {
    const TempFolder folder;
    for (const auto& [name, metres] : {std::pair{"US survey foot", kSurveyFoot}, {"foot", 0.3048}}) {
        RasterSpec spec = oddSpec();
        spec.linearUnit = name;
        spec.linearMetres = metres;
        spec.transform = {500000 / metres, 100, 0, 5000000 / metres, 0, -50};
        const auto file = writeRaster(folder / "feet.tif", spec);
        const DemGrid dem = readGround(file);
        EXPECT_NEAR(dem.spacing.x, 100 * metres, 1e-9);
        EXPECT_NEAR(dem.spacing.y, 50 * metres, 1e-9);
        EXPECT_THAT(dem.projection, HasSubstr("m a unit"));
        expectAsGdal(file);
    }
}

TEST(DemValues, TurnedShearedAndMirrored) {
    const TempFolder folder;
    const auto placed = [&](const char* name, const std::array<double, 6>& transform, bool resampled,
                            int epsg = 32633) {
        RasterSpec spec = oddSpec();
        spec.epsg = epsg;
        spec.transform = transform;
        expectAsGdal(writeRaster(folder / name, spec), resampled ? -1 : 0);
    };
    placed("south_up.tif", {500000, 30, 0, 5000000, 0, 30}, false);
    placed("westward.tif", {500000, -30, 0, 5000000, 0, -30}, false);
    placed("both.tif", {500000, -30, 0, 5000000, 0, 20}, false);
    placed("turned.tif", {500000, 26, 15, 5000000, 15, -26}, true);
    placed("quarter.tif", {500000, 0, 30, 5000000, 30, 0}, true);
    placed("sheared.tif", {500000, 30, 8, 5000000, 0, -30}, true);
    placed("mirrored.tif", {500000, 26, -15, 5000000, 15, 26}, true);
    placed("nameless.tif", {500, 2.6, 1.5, 300, 1.5, -2.6}, true, 0);
    placed("degrees.tif", {11, 0.001, 0, 46, 0, -0.0008}, true, 4326);
    placed("degrees_up.tif", {11, 0.001, 0, 46, 0, 0.0008}, true, 4326);
    placed("date_line.tif", {179.98, 0.001, 0, 46, 0, -0.001}, true, 4326);
    placed("conic.tif", {3000000, 900, 0, 3000000, 0, -900}, false, 3035);
}

RasterSpec bandSpec(int bands, GDALDataType type) {
    RasterSpec spec = oddSpec(type);
    spec.bands = bands;
    spec.value = [](int c, int r, int band) { return 10 * (band + 1) + c % 5 - r % 3; };
    return spec;
}

TEST(DemValues, OfSeveralBandsThatOfHeights) {
    const TempFolder folder;
    const auto chosen = [&](const char* name, const RasterSpec& spec, int band, double metres,
                            const char* said) {
        const auto file = writeRaster(folder / name, spec);
        expectAsGdal(file, 0, band, metres);
        EXPECT_EQ(readGround(file).band, said);
    };
    RasterSpec spec = bandSpec(3, GDT_Int16);
    spec.adorn = [](GDALDataset& dataset) {
        dataset.GetRasterBand(1)->SetDescription("height error");
        dataset.GetRasterBand(3)->SetDescription("Surface height (DSM)");
    };
    chosen("named.tif", spec, 3, 1, "band 3 of 3: it is called \"Surface height (DSM)\"");
    spec.adorn = [](GDALDataset& dataset) {
        dataset.GetRasterBand(2)->SetMetadataItem("long_name", "elevation above the geoid");
    };
    chosen("long_name.tif", spec, 2, 1, "band 2 of 3: it is called \"elevation above the geoid\"");
    spec = bandSpec(2, GDT_Float32);
    spec.adorn = [](GDALDataset& dataset) { dataset.GetRasterBand(2)->SetUnitType("ft"); };
    chosen("unit.tif", spec, 2, 0.3048, "band 2 of 2: it alone has a unit of length");
    chosen("silent.tif", bandSpec(4, GDT_Float32), 1, 1, "band 1 of 4: the first; none is called heights");
    const auto picture = writeRaster(folder / "rgb.tif", bandSpec(3, GDT_UInt16));
    EXPECT_THAT(errorOf([&] { readGround(picture); }),
                HasSubstr("found a picture (GTiff, 3 bands of UInt16)"));
}

TEST(DemValues, HeightsThatFloatsCanNotHold) {
    const TempFolder folder;
    RasterSpec spec = oddSpec(GDT_Float64);
    spec.value = [](int c, int r, int) { return 9e6 + 0.3 * c - 0.1 * r; };
    const auto steps = writeRaster(folder / "steps.tif", spec);
    EXPECT_THAT(errorOf([&] { readGround(steps); }),
                AllOf(HasSubstr(steps.string() + ":heights: expected heights that single precision can hold"),
                      HasSubstr("subtract a constant"), Not(HasSubstr("\n"))));
    spec.value = [](int c, int r, int) { return 3e6 + 300.3 * c - 100.1 * r; };  // a planet's radius
    EXPECT_EQ(readGround(writeRaster(folder / "radius.tif", spec)).sourceMissing, 0);
    Progress progress;
    const auto hills = writeRaster(folder / "hills.tif", oddSpec());
    for (const double scale : {1e300, 1e6, 1e-300})
        EXPECT_THAT(errorOf([&] { readDem(hills, scale, progress); }),
                    AllOf(HasSubstr(hills.string() + ":vertical scale: expected heights"),
                          HasSubstr("--vertical-scale"), Not(HasSubstr("\n"))));
    EXPECT_EQ(readDem(hills, 1e4, progress).sourceMissing, 0);
}

// Written by hand: parts of two files side by side, scaled, with a system of heights that no band's unit
// repeats.
std::string virtualRaster(const std::string& left, const std::string& right) {
    const auto source = [](const std::string& name, int from, int to) {
        return "<ComplexSource><SourceFilename relativeToVRT=\"1\">" + name +
               "</SourceFilename><SourceBand>1</SourceBand><SrcRect xOff=\"" + std::to_string(from) +
               "\" yOff=\"0\" xSize=\"20\" ySize=\"33\"/><DstRect xOff=\"" + std::to_string(to) +
               "\" yOff=\"0\" xSize=\"20\" "
               "ySize=\"33\"/><ScaleOffset>5</ScaleOffset><ScaleRatio>2</ScaleRatio>"
               "</ComplexSource>";
    };
    return "<VRTDataset rasterXSize=\"41\" "
           "rasterYSize=\"33\"><SRS>EPSG:26910+6360</SRS><GeoTransform>500000, 30, 0, "
           "5000000, 0, -30</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><NoDataValue>-1"
           "</NoDataValue>" +
           source(left, 0, 0) + source(right, 20, 21) + "</VRTRasterBand></VRTDataset>";
}

TEST(DemValues, VirtualRasterOfLocalFiles) {
    const TempFolder folder;
    writeRaster(folder / "left.tif", oddSpec());
    writeRaster(folder / "right.tif", oddSpec(GDT_Int16));
    const auto file = folder.text("both.vrt", virtualRaster("left.tif", "right.tif"));
    expectAsGdal(file, 33, 1, kSurveyFoot);  // the column between them
    EXPECT_EQ(readGround(file).heightUnit,
              "US survey foot, 0.30480061 m each, by the vertical reference system");
    EXPECT_EQ(readGround(file).verticalDatum, "NAVD88 height (ftUS), North American Vertical Datum 1988");
    EXPECT_EQ(readGround(folder / "left.tif").verticalDatum, "") << "a file that names none";
}

TEST(DemValues, VirtualRastersOfOtherThingsAreRefused) {
    const TempFolder folder;
    writeRaster(folder / "left.tif", oddSpec());
    folder.text("notes.txt", "These are notes.");
    folder.text("map.xml",
                "<GDAL_WMS><Service name=\"TMS\"><ServerUrl>http://localhost:9/${z}</ServerUrl></Service>"
                "</GDAL_WMS>");
    const auto refused = [&](const std::string& right, const std::string& what) {
        const auto file = folder.text("both.vrt", virtualRaster("left.tif", right));
        EXPECT_THAT(errorOf([&] { readGround(file); }),
                    AllOf(HasSubstr(file.string() + ": "), HasSubstr(what), Not(HasSubstr("\n"))));
    };
    refused("http://localhost:9/right.tif",
            "expected names of local files, found \"http://localhost:9/right.tif\"");
    refused("/vsicurl/http://localhost:9/right.tif", "expected names of local files");
    refused("/vsizip/right.zip/right.tif", "expected names of local files");
    refused("none.tif", "names \"none.tif\", and there is no such file");
    refused("notes.txt", "names \"notes.txt\", and that is no raster of a format read here");
    refused("map.xml", "names \"map.xml\", and that is no raster of a format read here");
    refused("both.vrt", "found virtual rasters that refer to each other");
    const auto damaged = folder.text("cut.vrt", virtualRaster("left.tif", "left.tif").substr(0, 300));
    EXPECT_THAT(errorOf([&] { readGround(damaged); }), HasSubstr("found damaged XML"));
}

TEST(DemValues, AddressesAndPipesAreRefused) {
    for (const char* name :
         {"/vsicurl/http://localhost:9/a.tif", "http://localhost:9/a.tif", "https:/host/a.tif",
          "folder/http:/host/a.tif", "/vsis3/bucket/a.tif", "s3://bucket/a.tif"})
        EXPECT_THAT(
            errorOf([&] { readGround(name); }),
            AllOf(HasSubstr(std::string(name) + ": expected a file on this machine, found an address"),
                  HasSubstr("fetch it first"), Not(HasSubstr("\n"))));
    const TempFolder folder;
    const auto pipe = folder / "pipe.tif";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(errorOf([&] { readGround(pipe); }), HasSubstr("found a pipe or a device"));
}

}  // namespace
}  // namespace stereonav::test
