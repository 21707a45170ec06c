// Heights by what they are counted from: up or down, in whatever unit, by axis, band or word.
#include <cmath>

#include "gdal_reading.h"
#include "raster_files.h"
#include "terrain/read/dem_reader.h"

namespace stereonav::test {
namespace {

constexpr double kUsFoot = 1200.0 / 3937;

RasterSpec stored(const std::function<void(GDALDataset&)>& adorn, const char* driver = "GTiff") {
    RasterSpec spec;
    spec.driver = driver;
    spec.type = GDT_Float32;
    spec.width = 23, spec.height = 17;
    spec.value = [](int c, int r, int) { return 10 + 3 * c + r % 5; };
    spec.adorn = adorn;
    return spec;
}

// Expects each sample to be the stored number times `metres`.
void expectTimes(const std::string& of, const std::filesystem::path& file, double metres) {
    SCOPED_TRACE(of);
    const DemGrid dem = readGround(file);
    ASSERT_EQ(dem.width, 23);
    ASSERT_EQ(dem.height, 17);
    for (int r = 0; r < 17; ++r)
        for (int c = 0; c < 23; ++c)
            ASSERT_NEAR(dem.heights[(16 - r) * 23 + c], metres * (10 + 3 * c + r % 5),
                        1e-4 * std::abs(metres))
                << c << " " << r;
    EXPECT_EQ(dem.heightUnit.find("downward") != std::string::npos, metres < 0) << dem.heightUnit;
}

// Plan and heights by their EPSG codes.
std::function<void(GDALDataset&)> compound(int plan, int heights) {
    return [=](GDALDataset& dataset) {
        OGRSpatialReference flat, up, both;
        ASSERT_EQ(flat.importFromEPSG(plan), OGRERR_NONE);
        ASSERT_EQ(up.importFromEPSG(heights), OGRERR_NONE);
        ASSERT_EQ(both.SetCompoundCS("both", &flat, &up), OGRERR_NONE);
        ASSERT_EQ(dataset.SetSpatialRef(&both), CE_None);
    };
}

TEST(DemAxis, CompoundSystemsSayWhichWay) {
    const TempFolder folder;
    struct Heights {
        int epsg;
        double metres;
    };
    // MSL height and depth; Black Sea depth; NAVD88 depth; NGVD29 depth and height in US survey feet; NAVD88
    // height in international feet.
    for (const Heights& one : {Heights{5714, 1},
                               {5715, -1},
                               {5336, -1},
                               {6357, -1},
                               {6359, -kUsFoot},
                               {5702, kUsFoot},
                               {8228, 0.3048}})
        for (const int plan : {32630, 25832})
            for (const char* version : {"GEOTIFF_VERSION=1.0", "GEOTIFF_VERSION=1.1"}) {
                RasterSpec spec = stored(compound(plan, one.epsg));
                spec.options = {version};
                expectTimes(std::to_string(one.epsg) + " " + version, writeRaster(folder / "axis.tif", spec),
                            one.metres);
            }
}

// Whatever form of the system says it.
TEST(DemAxis, EveryFormOfASystem) {
    const TempFolder folder;
    const auto by = [&](const std::string& of, const std::string& system, double metres) {
        writeRaster(folder / "inner.tif", stored([](GDALDataset&) {}));
        const auto file = folder.text(
            "form.vrt",
            "<VRTDataset rasterXSize=\"23\" rasterYSize=\"17\"><SRS>" + system +
                "</SRS><GeoTransform>500000, 30, 0, 5000000, 0, -30</GeoTransform><VRTRasterBand "
                "dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"1\">inner.tif"
                "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
        expectTimes(of, file, metres);
    };
    by("codes", "EPSG:32630+5715", -1);
    by("heights", "EPSG:32630+5714", 1);
    const std::string plan =
        "PROJCRS[\"p\",BASEGEOGCRS[\"g\",DATUM[\"World Geodetic System 1984\",ELLIPSOID[\"WGS "
        "84\",6378137,298.257223563,"
        "LENGTHUNIT[\"metre\",1]]]],CONVERSION[\"c\",METHOD[\"Transverse "
        "Mercator\",ID[\"EPSG\",9807]],PARAMETER["
        "\"Latitude of natural origin\",0,ANGLEUNIT[\"degree\",0.0174532925199433]],PARAMETER[\"Longitude of "
        "natural "
        "origin\",-3,ANGLEUNIT[\"degree\",0.0174532925199433]],PARAMETER[\"Scale factor at natural "
        "origin\",0.9996,"
        "SCALEUNIT[\"unity\",1]],PARAMETER[\"False "
        "easting\",500000,LENGTHUNIT[\"metre\",1]],PARAMETER[\"False northing\","
        "0,LENGTHUNIT[\"metre\",1]]],CS[Cartesian,2],AXIS[\"(E)\",east],AXIS[\"(N)\",north],LENGTHUNIT["
        "\"metre\",1]]";
    const auto vertical = [&](const char* axis, const char* unit) {
        return "COMPOUNDCRS[\"own\"," + plan + ",VERTCRS[\"v\",VDATUM[\"local datum\"],CS[vertical,1],AXIS[" +
               axis +
               "],"
               "LENGTHUNIT[" +
               unit + "]]]";
    };
    by("WKT 2, depth", vertical("\"depth (D)\",down", "\"metre\",1"), -1);
    by("WKT 2, height", vertical("\"gravity-related height (H)\",up", "\"metre\",1"), 1);
    by("WKT 2, depth in fathoms", vertical("\"depth (D)\",down", "\"fathom\",1.8288"), -1.8288);
    by("WKT 2, height in feet", vertical("\"gravity-related height (H)\",up", "\"foot\",0.3048"), 0.3048);
    const std::string old =
        "COMPD_CS[\"own\",PROJCS[\"p\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
        "84\",6378137,298.257223563]],"
        "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
        "PARAMETER["
        "\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",-3],PARAMETER[\"scale_factor\",0.9996],"
        "PARAMETER["
        "\"false_easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]],VERT_CS[\"v\",VERT_"
        "DATUM[\"local\","
        "2005],UNIT[\"metre\",1],AXIS[\"Depth\",DOWN]]]";
    by("WKT 1, depth", old, -1);
}

TEST(DemAxis, TheBandMaySayItself) {
    const TempFolder folder;
    const auto band = [&](const std::string& of, const char* key, const char* text, double metres) {
        expectTimes(of, writeRaster(folder / "band.tif", stored([=](GDALDataset& dataset) {
                                        dataset.GetRasterBand(1)->SetMetadataItem(key, text);
                                    })),
                    metres);
    };
    band("positive down", "positive", "down", -1);
    band("positive up", "positive", "up", 1);
    band("a depth", "standard_name", "sea_floor_depth_below_geoid", -1);
    band("an altitude", "standard_name", "surface_altitude", 1);
    RasterSpec spec = stored(compound(32630, 5715));
    spec.unit = "cm";
    expectTimes("a depth in centimetres", writeRaster(folder / "cm.tif", spec), -0.01);
    spec = stored(compound(32630, 5715));
    const auto axis = spec.adorn;
    spec.adorn = [axis](GDALDataset& dataset) {
        axis(dataset);
        dataset.GetRasterBand(1)->SetMetadataItem("positive", "down");
    };
    expectTimes("said twice", writeRaster(folder / "twice.tif", spec), -1);
}

TEST(DemAxis, AFolderOfDepths) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "parts");
    for (int tile = 0; tile < 2; ++tile) {
        RasterSpec spec = stored(compound(32630, 5715));
        spec.transform[0] += 23 * 30 * tile;
        writeRaster(folder / ("parts/" + std::to_string(tile) + ".tif"), spec);
    }
    const DemGrid dem = readGround(folder / "parts");
    ASSERT_EQ(dem.width, 46);
    for (int c = 0; c < 46; ++c) EXPECT_EQ(dem.heights[c], -(10 + 3 * (c % 23) + 16 % 5)) << c;
}

TEST(DemAxis, UnitsAsPeopleWriteThem) {
    const TempFolder folder;
    struct Unit {
        const char* text;
        double metres;  // 0: none
    };
    for (const Unit& unit : {Unit{"m MSL", 1},
                             {"m (NAVD88)", 1},
                             {"m (NAVD-88)", 1},
                             {"meters above mean sea level", 1},
                             {"metres above the ellipsoid", 1},
                             {"Meter", 1},
                             {"meter(s)", 1},
                             {"m.", 1},
                             {"m a.s.l.", 1},
                             {"m.a.s.l.", 1},
                             {"masl", 1},
                             {"m AMSL", 1},
                             {"m EGM96", 1},
                             {"m above EGM 2008", 1},
                             {"m, EVRF2007", 1},
                             {"m+NAP", 1},
                             {"metres_above_sea_level", 1},
                             {"[ft_i]", 0.3048},
                             {"[ft_us]", kUsFoot},
                             {"[yd_i]", 0.9144},
                             {"[in_i]", 0.0254},
                             {"[fth_i]", 1.8288},
                             {"feet NAVD88", 0.3048},
                             {"ft above MSL", 0.3048},
                             {"Foot (US survey)", kUsFoot},
                             {"US survey feet (NAVD88)", kUsFoot},
                             {"U.S. Survey Feet", kUsFoot},
                             {"feet (international)", 0.3048},
                             {"cm above sea level", 0.01},
                             {"m below sea level", -1},
                             {"m (positive up)", 1},
                             {"m, positive down", -1},
                             {"feet below MLLW", -0.3048},
                             {"m/s", 0},
                             {"m2", 0},
                             {"m^2", 0},
                             {"m s-1", 0},
                             {"m-1", 0},
                             {"m per km", 0},
                             {"m*100", 0},
                             {"m 2", 0},
                             {"degrees", 0},
                             {"percent", 0},
                             {"%", 0},
                             {"K", 0},
                             {"counts", 0},
                             {"MSL", 0}}) {
        RasterSpec spec = stored([](GDALDataset&) {});
        spec.unit = unit.text;
        const auto file = writeRaster(folder / "unit.tif", spec);
        if (unit.metres == 0)
            EXPECT_THAT(
                errorOf([&] { readGround(file); }),
                AllOf(HasSubstr("got the unit \"" + std::string(unit.text) + "\""), Not(HasSubstr("\n"))));
        else
            expectTimes(unit.text, file, unit.metres);
    }
}

}  // namespace
}  // namespace stereonav::test
