// Whatever a file names, and however it is spelled, no reader asks an address: somebody listens at those that
// these files name.
#include <ogrsf_frmts.h>

#include "engine/image/image_file.h"
#include "engine/mesh/mesh_file.h"
#include "raster_files.h"
#include "terrain/read/dem_rows.h"
#include "terrain/read/raster_file.h"
#include "tests/support/loopback_listener.h"

namespace stereonav::test {
namespace {
namespace fs = std::filesystem;

constexpr int kAsked = 64;  // samples a side of what is written here

RasterSpec hillsOfFiles() {
    RasterSpec spec;
    spec.width = spec.height = kAsked;
    spec.type = GDT_Int16;
    spec.value = [](int c, int r, int) { return 100 + c + r; };
    return spec;
}

std::string vrtOf(const std::string& inner) {
    return "<VRTDataset rasterXSize=\"64\" rasterYSize=\"64\"><SRS>EPSG:32633</SRS>"
           "<GeoTransform>500000,30,0,4000240,0,-30</GeoTransform>" +
           inner + "</VRTDataset>";
}
std::string bandOf(const std::string& inner, const std::string& more = "") {
    return "<VRTRasterBand dataType=\"Int16\" band=\"1\"" + more + ">" + inner + "</VRTRasterBand>";
}
std::string sourceOf(const std::string& name) {
    return "<SimpleSource><SourceFilename relativeToVRT=\"0\">" + name +
           "</SourceFilename><SourceBand>1</SourceBand></SimpleSource>";
}
std::string auxOf(const std::string& inner) {
    return "<PAMDataset>" + inner + "</PAMDataset>";
}
std::string overviewsIn(const std::string& file) {
    return "<Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">" + file + "</MDI></Metadata>";
}
std::string escaped(std::string text) {
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "&lt;");
    return text;
}

void askForCoarseRows(const fs::path& file) {
    DemRows rows(file, 300);
    std::vector<float> heights(static_cast<std::size_t>(rows.place().width) * rows.place().height);
    rows.read(0, rows.place().height, heights.data());
}

void askForPicture(const fs::path& file) {
    const auto picture = openRasterPicture(file, "a picture", "give one");
    bool known = false;
    const Georeference place = picture->georeference(known);
    picture->read({0, 0, place.width, place.height}, {4, 4}, picture->tone());
}

struct AskingReader {
    const char* name;
    void (*read)(const fs::path& file);
};
constexpr AskingReader kAskingReaders[] = {
    {"a look", [](const fs::path& file) { glanceAtDem(file); }},
    {"heights",
     [](const fs::path& file) {
         Progress progress;
         readDem(file, 1, progress);
     }},
    {"coarse rows", askForCoarseRows},
    {"a picture of the ground", askForPicture},
    {"tracks", [](const fs::path& file) { readTrackFile(file); }},
    {"a sky", [](const fs::path& file) { readLinearImage(file); }},
    {"a landmark", [](const fs::path& file) { readMesh(file); }},
};

class NoNetwork : public testing::Test {
protected:
    // Every reader tries it.
    void expectSilence(const fs::path& file) {
        for (const AskingReader& reader : kAskingReaders) {
            try {
                reader.read(file);
            } catch (const Error& error) {
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            }
            EXPECT_EQ(mListener.connections(), 0) << reader.name << " of " << file.filename();
        }
    }
    void expectSilence(const std::string& name, const std::string& text) {
        SCOPED_TRACE(text);
        expectSilence(mFolder.text(name, text));
    }
    // All ways of GDAL to an address.
    std::vector<std::string> addresses() const {
        const std::string http = mListener.address("x.tif");
        return {http,
                "/vsicurl/" + http,
                "/vsicurl?url=" + http,
                "/vsicurl_streaming/" + http,
                "/vsigzip//vsicurl/" + http,
                "/vsizip//vsicurl/" + http + "/x.tif",
                "/vsizip/{/vsicurl/" + http + "}/x.tif",
                "/vsitar//vsicurl/" + http + "/x.tif",
                "/vsisubfile/0_900,/vsicurl/" + http,
                "/vsicrypt/key=A,file=/vsicurl/" + http,
                "NETCDF:\"" + http + "\":x",
                "GTIFF_DIR:1:/vsicurl/" + http,
                "vrt:///vsicurl/" + http + "?bands=1"};
    }

    TempFolder mFolder;
    LoopbackListener mListener;
};

TEST_F(NoNetwork, TheListenerSeesWhoConnects) {
    LoopbackListener other;
    EXPECT_EQ(mListener.connections(), 0);
    const int client = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(mListener.port()));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(connect(client, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
    close(client);
    EXPECT_EQ(mListener.connections(), 1);
    EXPECT_EQ(mListener.connections(), 0);
    EXPECT_EQ(other.connections(), 0);
}

TEST_F(NoNetwork, OfVirtualRastersHoweverTheyAreSpelled) {
    const std::string name = "/vsicurl/" + mListener.address("x.tif");
    const std::string plain = vrtOf(bandOf(sourceOf(name)));
    expectSilence("plain.vrt", plain);
    for (const int before : {250, 900, 1500, 5000})
        expectSilence("padded.vrt",
                      "<!-- " + std::string(static_cast<std::size_t>(before), 'x') + " -->\n" + plain);
    expectSilence("marked.vrt", "<!-- <VRTDataset -->" + std::string("<vrtdataset") +
                                    plain.substr(11, plain.size() - 24) + "</vrtdataset>");
    const auto inBand = [&](const std::string& inner, const std::string& more = "") {
        expectSilence("band.vrt", vrtOf(bandOf(inner, more)));
    };
    inBand("<SIMPLESOURCE><SOURCEFILENAME>" + name + "</SOURCEFILENAME></SIMPLESOURCE>");
    inBand("<SimpleSource SourceFilename=\"" + name + "\"/>");
    inBand("<ComplexSource sourcefilename=\"" + name + "\"></ComplexSource>");
    inBand("<SourceFilename>" + name + "</SourceFilename>", " subClass=\"VRTRawRasterBand\"");
    inBand("<SourceFilename>" + name + "</SourceFilename>", " SUBCLASS=\"vrtrawrasterband\"");
    inBand("<Overview><SourceFilename>" + name + "</SourceFilename><SourceBand>1</SourceBand></Overview>");
    inBand("<MaskBand>" + bandOf(sourceOf(name)) + "</MaskBand>");
    inBand(escaped(sourceOf(plain)));
    expectSilence("mask.vrt", vrtOf("<MaskBand>" + bandOf(sourceOf(name)) + "</MaskBand>" + bandOf("")));
    expectSilence("system.vrt", "<VRTDataset rasterXSize=\"64\" rasterYSize=\"64\"><SRS>" +
                                    mListener.address("srs") + "</SRS>" + bandOf("") + "</VRTDataset>");
    expectSilence("warped.vrt",
                  "<VRTDataset rasterXSize=\"64\" rasterYSize=\"64\" subClass=\"VRTWarpedDataset\">"
                  "<VRTRasterBand dataType=\"Int16\" band=\"1\" subClass=\"VRTWarpedRasterBand\"/>"
                  "<GDALWarpOptions><SourceDataset>" +
                      name + "</SourceDataset></GDALWarpOptions></VRTDataset>");
    for (const std::string& address : addresses()) inBand(sourceOf(address));
    fs::rename(mFolder.text("text", plain), mFolder / "heights.hgt.gz");
    expectSilence(mFolder / "heights.hgt.gz");
}

TEST_F(NoNetwork, OfWhatLiesBesideARaster) {
    const fs::path raster = writeRaster(mFolder / "ground.tif", hillsOfFiles());
    const std::string name = "/vsicurl/" + mListener.address("x.tif");
    const auto beside = [&](const std::string& end, const std::string& text) {
        SCOPED_TRACE(end + ": " + text);
        const fs::path file = mFolder.text("ground.tif" + end, text);
        expectSilence(raster);
        fs::remove(file);
    };
    for (const std::string& address : addresses()) beside(".aux.xml", auxOf(overviewsIn(address)));
    beside(".aux.xml", auxOf(overviewsIn(escaped(vrtOf(bandOf(sourceOf(name)))))));
    beside(".aux.xml", auxOf("<SRS>" + mListener.address("srs") + "</SRS>"));
    for (const char* end : {".ovr", ".msk"}) {
        beside(end, vrtOf(bandOf(sourceOf(name))));
        beside(end, vrtOf(bandOf("<SimpleSource SourceFilename=\"" + name + "\"/>")));
    }
    const fs::path text =
        mFolder.text("grid.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n");
    mFolder.text("grid.prj", mListener.address("prj"));
    expectSilence(text);
}

TEST_F(NoNetwork, OfATagOfATiff) {
    for (const std::string& address : addresses()) {
        SCOPED_TRACE(address);
        const fs::path file = writeRaster(mFolder / "tag.tif", hillsOfFiles());
        {
            const GDALDatasetH open = GDALOpen(file.c_str(), GA_Update);
            ASSERT_NE(open, nullptr);
            GDALSetMetadataItem(open, "OVERVIEW_FILE", address.c_str(), "OVERVIEWS");
            GDALClose(open);
        }
        mListener.connections();  // drops those of this test's own writing
        expectSilence(file);
    }
}

TEST_F(NoNetwork, OfTheReferenceSystemOfDrawnLines) {
    const std::string href = mListener.address("crs");
    const auto lines = [&](const std::string& crs) {
        expectSilence("l.geojson",
                      R"({"type":"FeatureCollection","crs":)" + crs +
                          R"(,"features":[{"type":"Feature","properties":{},"geometry":{"type":"LineString",)"
                          R"("coordinates":[[15,36.1],[15.001,36.101]]}}]})");
    };
    for (const char* type : {"proj4", "ogcwkt", "esriwkt", "ogrwkt"})
        lines(R"({"type":"link","properties":{"href":")" + href + R"(","type":")" + type + R"("}})");
    lines(R"({"type":"url","properties":{"url":")" + href + R"("}})");
    lines(R"({"type":"name","properties":{"name":")" + href + R"("}})");
    const fs::path named = mFolder.text("l.geojson", R"({"type":"FeatureCollection","crs":{"type":"link",)"
                                                     R"("properties":{"href":")" +
                                                         href + R"("}},"features":[]})");
    EXPECT_THAT(errorOf([&] { readTrackFile(named); }),
                AllOf(HasSubstr(named.string()), HasSubstr("found an address"), Not(HasSubstr("\n"))));
}

// A view in the place of a table calls what functions there are, one that reads a schema by its address among
// them.
TEST_F(NoNetwork, OfFunctionsInADatabase) {
    RasterSpec spec = hillsOfFiles();
    spec.driver = "GPKG", spec.type = GDT_Byte, spec.bands = 3;
    const fs::path file = writeRaster(mFolder / "map.gpkg", spec);
    ASSERT_NO_THROW(askForPicture(file));
    GDALDataset* const open =
        GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_UPDATE);
    ASSERT_NE(open, nullptr);
    for (const std::string& text : {std::string("ALTER TABLE gpkg_contents RENAME TO held"),
                                    "CREATE VIEW gpkg_contents AS SELECT * FROM held WHERE "
                                    "coalesce(XB_Create(CAST('<a/>' AS BLOB), 1, '" +
                                        mListener.address("x.xsd") + "'), 1) IS NOT NULL"})
        open->ReleaseResultSet(open->ExecuteSQL(text.c_str(), nullptr, nullptr));
    CPLPushErrorHandler(CPLQuietErrorHandler);
    GDALClose(open);
    CPLPopErrorHandler();
    mListener.connections();  // drops those of this test's own writing
    expectSilence(file);
    EXPECT_NE(errorOf([&] { askForPicture(file); }), "") << "the view is not asked";
}

}  // namespace
}  // namespace stereonav::test
