// Reference systems and databases of strangers open no other file: a pipe lies where they point, and nobody
// opens it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <ogr_spatialref.h>

#include "gdal_reading.h"
#include "raster_files.h"
#include "terrain/read/raster_file.h"
#include "tests/support/watched_pipe.h"

namespace stereonav::test {
namespace {
namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kSide = 16;  // samples a side

std::string xmlText(const std::string& text) {
    std::string to;
    for (char c : text)
        to += c == '"' ? "&quot;" : c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return to;
}

std::string boundWkt(const std::string& grid) {
    OGRSpatialReference system;
    EXPECT_EQ(system.importFromProj4(("+proj=longlat +ellps=bessel +nadgrids=" + grid + " +no_defs").c_str()),
              OGRERR_NONE);
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    char* text = nullptr;
    EXPECT_EQ(system.exportToWkt(&text, options), OGRERR_NONE);
    std::string wkt = text;
    CPLFree(text);
    return wkt;
}

// Definitions that name `grid`.
std::vector<std::string> definitions(const std::string& grid) {
    const std::string degrees = "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]";
    const std::string spheroid = "SPHEROID[\"Bessel 1841\",6377397.155,299.1528128]";
    return {
        "+proj=longlat +ellps=bessel +nadgrids=" + grid + " +no_defs",
        "+proj=longlat +ellps=bessel +NADGRIDS = @null,@" + grid + " +nadgrids=@null,@" + grid,
        "GEOGCS[\"x\",DATUM[\"y\"," + spheroid + ",EXTENSION[\"PROJ4_GRIDS\",\"" + grid + "\"]]," + degrees +
            "]",
        "PROJCS[\"x\",GEOGCS[\"x\",DATUM[\"y\"," + spheroid + "]," + degrees +
            "],PROJECTION[\"Mercator_1SP\"],UNIT[\"metre\",1],EXTENSION[\"PROJ4\",\"+proj=merc "
            "+ellps=bessel +nadgrids=" +
            grid + " +units=m +no_defs\"]]",
        "COMPD_CS[\"x\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]]," +
            degrees + "],VERT_CS[\"v\",VERT_DATUM[\"d\",2005,EXTENSION[\"PROJ4_GRIDS\",\"" + grid +
            "\"]],UNIT[\"metre\",1]]]",
        boundWkt(grid),
        "+init=" + grid + ":1",
        grid};
}

class ReferenceFiles : public testing::Test {
protected:
    ReferenceFiles() {
        RasterSpec spec;
        spec.width = spec.height = kSide;
        spec.epsg = 0;
        spec.transform = {7, 0.001, 0, 46.016, 0, -0.001};
        spec.value = [](int c, int r, int) { return 100 + c + r; };
        writeRaster(mFolder / "plain.tif", spec);
        mFolder.text("grid.asc", grid());
    }

    static std::string grid() {
        std::string text =
            "ncols 16\nnrows 16\nxllcorner 7\nyllcorner 46\ncellsize 0.001\nNODATA_value -9999\n";
        for (int n = 0; n < kSide * kSide; ++n) text += n % kSide == kSide - 1 ? "100\n" : "100 ";
        return text;
    }
    static std::string dataset(const std::string& head) {
        return "<VRTDataset rasterXSize=\"16\" rasterYSize=\"16\">" + head +
               "<VRTRasterBand dataType=\"Int16\" band=\"1\"><SimpleSource><SourceFilename "
               "relativeToVRT=\"1\">"
               "plain.tif</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></"
               "VRTDataset>";
    }
    static std::string controlPoints(const std::string& definition) {
        std::string text = "<GCPList Projection=\"" + xmlText(definition) + "\">";
        for (const auto& [x, y] : {std::pair{0, 0}, {16, 0}, {0, 16}, {16, 16}})
            text += fmt::format("<GCP Id=\"{0}{1}\" Pixel=\"{0}\" Line=\"{1}\" X=\"{2}\" Y=\"{3}\"/>", x, y,
                                7 + x / 1000.0, 46 - y / 1000.0);
        return text + "</GCPList>";
    }
    static std::string warped(const std::string& reprojection) {
        const std::string place = "7,0.001,0,46.016,0,-0.001", back = "-7000,1000,0,46016,0,-1000";
        return "<VRTDataset rasterXSize=\"16\" rasterYSize=\"16\" "
               "subClass=\"VRTWarpedDataset\"><SRS>EPSG:4326"
               "</SRS><GeoTransform>" +
               place +
               "</GeoTransform><VRTRasterBand dataType=\"Int16\" band=\"1\" "
               "subClass=\"VRTWarpedRasterBand\"/>"
               "<BlockXSize>16</BlockXSize><BlockYSize>16</BlockYSize><GDALWarpOptions><WorkingDataType>Int16"
               "</WorkingDataType><SourceDataset relativeToVRT=\"1\">plain.tif</SourceDataset><Transformer>"
               "<GenImgProjTransformer><SrcGeoTransform>" +
               place + "</SrcGeoTransform><SrcInvGeoTransform>" + back +
               "</SrcInvGeoTransform><DstGeoTransform>" + place + "</DstGeoTransform><DstInvGeoTransform>" +
               back + "</DstInvGeoTransform><ReprojectTransformer><ReprojectionTransformer>" + reprojection +
               "</ReprojectionTransformer></ReprojectTransformer></GenImgProjTransformer></"
               "Transformer><BandList>"
               "<BandMapping src=\"1\" dst=\"1\"/></BandList></GDALWarpOptions></VRTDataset>";
    }

    // `ofAll` and `ofLine` are members.
    static std::string trackWith(const std::string& ofAll, const std::string& ofLine) {
        return "{\"type\":\"FeatureCollection\"," + ofAll +
               "\"features\":[{\"type\":\"Feature\",\"properties\":{},\"geometry\":{" + ofLine +
               "\"type\":\"LineString\",\"coordinates\":[[7.01,46.01],[7.03,46.03]]}}]}";
    }

    // Nobody may open `pipe` over the file; whether it is refused depends on whether GDAL takes the
    // definition.
    void expectUnopened(const fs::path& file, WatchedPipe& pipe) {
        const std::string message = errorOf([&] { readGround(file); });
        EXPECT_FALSE(pipe.wasOpened()) << message;
        EXPECT_THAT(message, Not(HasSubstr("\n")));
    }

    const TempFolder mFolder;
};

TEST_F(ReferenceFiles, PathsAreToldFromNames) {
    const auto messageOf = [&](const std::string& definition) {
        return errorOf([&] {
            readGround(mFolder.text("of.vrt",
                                    dataset("<SRS>" + xmlText(definition) +
                                            "</SRS><GeoTransform>7,0.001,0,46.016,0,-0.001</GeoTransform>")));
        });
    };
    for (const char* path :
         {"/far/here.gsb", "./here.gsb", "../here.gsb", "~/here.gsb", "sub/here.gsb", "C:\\here.gsb"})
        for (const char* before :
             {"+proj=longlat +nadgrids=", "+proj=longlat +nadgrids=@null,@", "+proj=tinshift +file = ",
              "+proj=defmodel +model=", "PARAMETERFILE[\"grid \",\"", "EXTENSION[\"PROJ4_GRIDS\",\""})
            EXPECT_THAT(messageOf(before + std::string(path) + "\"]"), HasSubstr("names the file"))
                << before << path;
    for (const char* sound :
         {"", "+proj=longlat +ellps=bessel +nadgrids=here.gsb", "+proj=longlat +ellps=bessel +nadgrids=@null",
          "EPSG:4326", "+nadgrids=", "+nadgrids", "PARAMETERFILE[\"grid\"", "PARAMETERFILE",
          "EXTENSION[\"PROJ4_GRIDS\"", "LOCAL_CS[\"a/b: model of the north/south grids\",UNIT[\"metre\",1]]"})
        EXPECT_THAT(messageOf(sound), Not(HasSubstr("names the file"))) << sound;
}

TEST_F(ReferenceFiles, VirtualRastersOpenNone) {
    const std::vector<std::string> all = definitions((mFolder / "pipe").string());
    WatchedPipe pipe(mFolder / "pipe");
    int number = 0;
    for (const std::string& definition : all) {
        const std::string text = xmlText(definition);
        for (const std::string& raster :
             {dataset("<SRS>" + text + "</SRS><GeoTransform>7,0.001,0,46.016,0,-0.001</GeoTransform>"),
              dataset("<srs dataAxisToSRSAxisMapping=\"2,1\">" + text +
                      "</srs><GeoTransform>7,0.001,0,46.016,0,-0.001</GeoTransform>"),
              dataset(controlPoints(definition)),
              warped("<SourceSRS>" + text + "</SourceSRS><TargetSRS>EPSG:4326</TargetSRS>"),
              warped("<SourceSRS>EPSG:4326</SourceSRS><TargetSRS>" + text + "</TargetSRS>")}) {
            SCOPED_TRACE(raster);
            const fs::path file = mFolder.text(fmt::format("of{}.vrt", number++), raster);
            EXPECT_THAT(errorOf([&] { readGround(file); }),
                        AllOf(HasSubstr(file.string()), HasSubstr("names the file"), Not(HasSubstr("\n"))));
            EXPECT_FALSE(pipe.wasOpened());
        }
    }
    const std::string step = "+proj=pipeline +step +proj=hgridshift +grids=" + (mFolder / "pipe").string();
    for (const std::string& options :
         {"<CoordinateOperation>" + step + "</CoordinateOperation>",
          "<Options><Option key=\"COORDINATE_OPERATION\">" + step + "</Option></Options>"})
        expectUnopened(
            mFolder.text("operation.vrt", warped("<SourceSRS>EPSG:4326</SourceSRS><TargetSRS>EPSG:4326"
                                                 "</TargetSRS>" +
                                                 options)),
            pipe);
}

TEST_F(ReferenceFiles, MetadataBesideRastersOpenNone) {
    const std::vector<std::string> all = definitions((mFolder / "pipe").string());
    WatchedPipe pipe(mFolder / "pipe");
    const fs::path file = mFolder / "grid.asc";
    const auto beside = [&](const std::string& name, const std::string& text, bool refused) {
        SCOPED_TRACE(text);
        mFolder.text(name, text);
        const std::string message = errorOf([&] { readGround(file); });
        EXPECT_FALSE(pipe.wasOpened()) << message;
        EXPECT_THAT(message, Not(HasSubstr("\n")));
        if (refused) {
            EXPECT_THAT(message, AllOf(HasSubstr(name), HasSubstr("names the file")));
        }
        fs::remove(mFolder / name);
    };
    for (const std::string& definition : all) {
        beside("grid.asc.aux.xml", "<PAMDataset><SRS>" + xmlText(definition) + "</SRS></PAMDataset>", true);
        beside("grid.asc.aux.xml", "<PAMDataset>" + controlPoints(definition) + "</PAMDataset>", true);
        beside("grid.prj", definition, definition != (mFolder / "pipe").string());
        mFolder.text(
            "numbers.hdr",
            "ENVI\nsamples = 16\nlines = 16\nbands = 1\nfile type = ENVI Standard\ndata type = 2\n"
            "interleave = bsq\nbyte order = 0\nmap info = {Geographic Lat/Lon, 1, 1, 7, 46, 0.001, 0.001, "
            "WGS-84}\ncoordinate system string = {" +
                definition + "}\n");
        expectUnopened(mFolder.text("numbers.dat", std::string(2 * kSide * kSide, '\1')), pipe);
    }
    EXPECT_NO_THROW(readGround(file)) << "what lay beside it is gone";
}

TEST_F(ReferenceFiles, OthersOpenNone) {
    std::vector<fs::path> rasters, tracks;
    for (const std::string& definition : definitions((mFolder / "pipe").string())) {
        RasterSpec spec;
        spec.width = spec.height = kSide;
        spec.epsg = 0;
        spec.value = [](int c, int r, int) { return 100 + c + r; };
        spec.adorn = [&](GDALDataset& raster) {
            const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
            OGRSpatialReference system;
            if (system.importFromWkt(definition.c_str()) == OGRERR_NONE) raster.SetSpatialRef(&system);
        };
        rasters.push_back(writeRaster(mFolder / fmt::format("own{}", rasters.size()), spec));
        std::string quoted;
        for (char c : definition) (c == '"' || c == '\\' ? quoted += '\\' : quoted) += c;
        const std::string crs = "\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"" + quoted + "\"}},";
        for (const std::string& text :
             {trackWith(crs, ""), trackWith("", crs), "\xEF\xBB\xBF" + trackWith(crs, ""),
              "jsonp(" + trackWith(crs, "") + ")", trackWith("\"note\":NaN," + crs, ""),
              trackWith("\"note\":NaN,\"pad\":\"" + std::string((1 << 20) - 75, 'a') + "\"," + crs, ""),
              trackWith("\"\\u0063" + crs.substr(2), "")})
            tracks.push_back(mFolder.text(fmt::format("track{}.geojson", tracks.size()), text));
    }
    WatchedPipe pipe(mFolder / "pipe");  // GDAL looks for the grid as it writes
    for (const fs::path& raster : rasters) expectUnopened(raster, pipe);
    for (const fs::path& track : tracks) {
        EXPECT_THAT(errorOf([&] { readTrackFile(track); }),
                    AllOf(HasSubstr(track.string()), Not(HasSubstr("\n"))));
        EXPECT_FALSE(pipe.wasOpened()) << track;
    }
    for (const char* sound :
         {R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},)", R"("note":NaN,)",
          R"("model":"a/b","file=":"/etc/passwd",)"})
        EXPECT_EQ(readTrackFile(mFolder.text("sound.geojson", trackWith(sound, ""))).lines.size(), 1u)
            << sound;
}

// SpatiaLite's modules read text, sheets, tables and shapes by their names.
TEST_F(ReferenceFiles, TablesOfADatabaseAreNoOtherFiles) {
    RasterSpec spec;
    spec.width = spec.height = 64;
    spec.driver = "GPKG", spec.type = GDT_Byte, spec.bands = 3;
    spec.value = [](int c, int r, int) { return 100 + c + r; };
    const std::string away = (mFolder / "away").string();
    for (const char* module : {"VirtualText('{}','UTF-8',1,POINT,DOUBLEQUOTE,',')",
                               "VirtualDBF('{}','UTF-8')", "VirtualGeoJSON('{}',4326)"}) {
        SCOPED_TRACE(module);
        const fs::path file = writeRaster(mFolder / "map.gpkg", spec);
        ASSERT_NO_THROW(openRasterPicture(file, "a picture", "give one"));
        std::string sql = module;
        sql.replace(sql.find("{}"), 2, away);
        CPLPushErrorHandler(CPLQuietErrorHandler);
        GDALDataset* const open =
            GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_UPDATE);
        ASSERT_NE(open, nullptr);
        // Written as a stranger would: without the module, which would look at the file.
        for (const std::string& text :
             {std::string("ALTER TABLE gpkg_tile_matrix RENAME TO held"),
              std::string("PRAGMA writable_schema=1"),
              "INSERT INTO sqlite_master(type,name,tbl_name,rootpage,sql) VALUES('table','gpkg_tile_matrix',"
              "'gpkg_tile_matrix',0,'CREATE VIRTUAL TABLE gpkg_tile_matrix USING " +
                  std::string(CPLString(sql).replaceAll("'", "''")) + "')"})
            open->ReleaseResultSet(open->ExecuteSQL(text.c_str(), nullptr, nullptr));
        GDALClose(open);
        CPLPopErrorHandler();
        WatchedPipe pipe(away), shape(away + ".dbf");
        EXPECT_NE(errorOf([&] { openRasterPicture(file, "a picture", "give one"); }), "")
            << "the table is not asked";
        EXPECT_FALSE(pipe.wasOpened() || shape.wasOpened());
        fs::remove(file);
    }
}

}  // namespace
}  // namespace stereonav::test
