// No command asks an address that a file names, also where the user's environment allows GDAL and PROJ to.
#include <gmock/gmock.h>

#include "app/scene/file_glance.h"
#include "engine/base/error.h"
#include "tests/app/program.h"
#include "tests/support/loopback_listener.h"

namespace stereonav::test {
namespace {

// What allows a library to ask, until the test's end.
class AllowingEnvironment {
public:
    explicit AllowingEnvironment(const std::string& settings, const std::string& address) {
        setenv("PROJ_NETWORK", "ON", 1);
        setenv("PROJ_NETWORK_ENDPOINT", address.c_str(), 1);
        setenv("GDAL_CONFIG_FILE", settings.c_str(), 1);
        setenv("CPL_VSIL_CURL_ALLOWED_EXTENSIONS", ".tif", 1);
        setenv("GDAL_VRT_ENABLE_PYTHON", "YES", 1);
    }
    ~AllowingEnvironment() {
        for (const char* name : {"PROJ_NETWORK", "PROJ_NETWORK_ENDPOINT", "GDAL_CONFIG_FILE",
                                 "CPL_VSIL_CURL_ALLOWED_EXTENSIONS", "GDAL_VRT_ENABLE_PYTHON"})
            unsetenv(name);
    }
};

class NoNetworkCommand : public ProgramTest {
protected:
    std::string virtualRaster(const std::string& before, const std::string& source) const {
        return before +
               "<VRTDataset rasterXSize=\"32\" rasterYSize=\"24\"><GeoTransform>0,30,0,720,0,-30"
               "</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\">" +
               source + "</VRTRasterBand></VRTDataset>";
    }

    // Every way of a command to it.
    void expectSilence(const std::string& file) {
        const std::string ground = grid("plain.asc", 32, 24, 30.0, [](int i, int j) { return 100 + i + j; });
        const std::vector<std::string> picture{"--out", "-", "--size", "32x24", "--method", "full"};
        for (std::vector<std::string> words : {std::vector<std::string>{"info", file, "--tiles", "on"},
                                               {"render", ground, "--image", file},
                                               {"render", ground, "--tracks", file}}) {
            if (words[0] == "render") words.insert(words.end(), picture.begin(), picture.end());
            const Outcome outcome = run(words);
            EXPECT_THAT(outcome.status, testing::AnyOf(0, 1)) << outcome.err;
            EXPECT_EQ(mListener.connections(), 0) << words[0] << " " << words[1] << " " << words[2];
        }
        try {
            Progress progress;
            glanceAt(file, progress);  // the window does so where the pointer rests
        } catch (const Error& error) {
            EXPECT_EQ(linesIn(error.what()), 0);
        }
        EXPECT_EQ(mListener.connections(), 0) << "a look at " << file;
    }

    LoopbackListener mListener;
};

TEST_F(NoNetworkCommand, WhateverTheEnvironmentAllows) {
    const std::string settings = input("gdalrc",
                                       "[configoptions]\nCPL_VSIL_CURL_ALLOWED_EXTENSIONS=.tif\n"
                                       "GDAL_VRT_ENABLE_PYTHON=YES\nOGR_SQLITE_PRAGMA=trusted_schema=ON\n");
    const AllowingEnvironment environment(settings, mListener.address(""));
    const std::string name = "/vsicurl/" + mListener.address("x.tif");
    expectSilence(input("padded.vrt", virtualRaster("<!-- " + std::string(300, 'x') + " -->\n",
                                                    "<SimpleSource><SourceFilename>" + name +
                                                        "</SourceFilename></SimpleSource>")));
    expectSilence(input("attribute.vrt",
                        virtualRaster("", "<SimpleSource SourceFilename=\"" + name + "\"></SimpleSource>")));
    expectSilence(input("lines.geojson",
                        R"({"type":"FeatureCollection","crs":{"type":"link","properties":{"href":")" +
                            mListener.address("crs") +
                            R"(","type":"proj4"}},"features":[{"type":"Feature","properties":{},"geometry":)"
                            R"({"type":"LineString","coordinates":[[15,36.1],[15.001,36.101]]}}]})"));
    const std::string file = hills();
    const auto beside = [&](const std::string& inner) {
        input("hills.asc.aux.xml", "<PAMDataset>" + inner + "</PAMDataset>");
        expectSilence(file);
    };
    beside("<Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">" + name + "</MDI></Metadata>");
    // Grids of datums are what PROJ would fetch.
    beside("<SRS>+proj=utm +zone=33 +ellps=intl +nadgrids=somewhere.tif +units=m +no_defs</SRS>");
}

TEST_F(NoNetworkCommand, OneLineNamesWhatIsRefused) {
    const std::string name = "/vsicurl/" + mListener.address("x.tif");
    expectRefused({"info", input("padded.vrt", virtualRaster("<!-- " + std::string(900, 'x') + " -->\n",
                                                             "<SimpleSource SourceFilename=\"" + name +
                                                                 "\"></SimpleSource>"))},
                  {"padded.vrt: expected names of local files", "fetch it first"});
    expectRefused(
        {"render", hills(), "--out", "a.png", "--tracks",
         input("lines.geojson", R"({"type":"FeatureCollection","crs":{"type":"link","properties":)"
                                R"({"href":")" +
                                    mListener.address("crs") +
                                    R"("}},"features":[{"type":"Feature","properties":{},)"
                                    R"("geometry":{"type":"LineString","coordinates":[[1,2],[3,4]]}}]})")},
        {"lines.geojson: ", "found an address", "fetch it first"});
    EXPECT_EQ(mListener.connections(), 0);
}

}  // namespace
}  // namespace stereonav::test
