// What `info` says of elevation models, and the one line of those that are refused: ours alone, none of a
// library's.
#include <nlohmann/json.hpp>
#include <string>

#include "program.h"

namespace stereonav {
namespace {

class RasterInfo : public test::ProgramTest {
protected:
    std::string slope(const std::string& name, int missing) const {
        std::string text = "ncols 16\nnrows 12\nxllcorner 0\nyllcorner 0\ncellsize 10\n";
        for (int k = 0; k < 16 * 12; ++k) text += k < missing ? "-9999 " : std::to_string(k) + " ";
        return input(name, text + "\n");
    }

    std::string textOf(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"info"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        arguments.insert(arguments.end(), {"--size", "16x12"});
        const test::Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return outcome.out;
    }
};

TEST_F(RasterInfo, CountsMissingSamplesInWords) {
    const std::string holed = slope("holed.asc", 3);
    EXPECT_NE(textOf({holed}).find(
                  "missing     3 of 192 in the file (nodata -9999, as the format has it), 3 filled\n"),
              std::string::npos);
    EXPECT_NE(textOf({holed, "--open-holes"}).find("as the format has it), 3 left open\n"),
              std::string::npos);
    EXPECT_NE(textOf({slope("whole.asc", 0)}).find("missing     0 of 192 in the file (nodata"),
              std::string::npos);
    EXPECT_NE(textOf({"terrain"}).find("missing     none\n"), std::string::npos);
}

TEST_F(RasterInfo, SaysWhichBandAndUnit) {
    slope("slope.asc", 0);
    const auto band = [](int number, const std::string& more) {
        return "<VRTRasterBand dataType=\"Float32\" band=\"" + std::to_string(number) + "\">" + more +
               "<SimpleSource><SourceFilename relativeToVRT=\"1\">slope.asc</SourceFilename></SimpleSource>"
               "</VRTRasterBand>";
    };
    const std::string both =
        input("both.vrt",
              "<VRTDataset rasterXSize=\"16\" rasterYSize=\"12\"><GeoTransform>0, 10, 0, 120, 0, -10"
              "</GeoTransform>" +
                  band(1, "<Description>slope</Description>") +
                  band(2, "<Description>elevation</Description><UnitType>ft</UnitType>") + "</VRTDataset>");
    const std::string text = textOf({both});
    EXPECT_NE(text.find("band        band 2 of 2: it is called \"elevation\"\n"), std::string::npos) << text;
    EXPECT_NE(text.find("height unit ft, 0.3048 m each, by the band\n"), std::string::npos) << text;
    EXPECT_NE(text.find("heights     0 .. 58.2168 m\n"), std::string::npos) << text;
}

TEST_F(RasterInfo, RefusalsAreOneLineOfOurs) {
    const std::string good = slope("good.asc", 0);
    expectRefused(
        {"info", good, "--vertical-scale", "1e6"},
        {"good.asc:vertical scale: expected heights within 10,000 km", "give a smaller --vertical-scale"});
    expectRefused({"info", good, "--image", "https://localhost:9/a.jpg"},
                  {"found an address", "fetch it first"});
    expectRefused({"info", input("away.vrt",
                                 "<VRTDataset rasterXSize=\"16\" rasterYSize=\"12\"><VRTRasterBand "
                                 "dataType=\"Byte\" band=\"1\"><SimpleSource><SourceFilename>"
                                 "/vsicurl/http://localhost:9/a.tif</SourceFilename></SimpleSource>"
                                 "</VRTRasterBand></VRTDataset>")},
                  {"away.vrt: expected names of local files", "fetch it first"});
    // Damage that the libraries of TIFF, PNG and XML would speak of themselves.
    expectRefused({"info", input("cut.tif", std::string("II*\0\x08\0\0\0\x05\0", 10))}, {"cut.tif: "});
    expectRefused({"info", input("cut.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x10", 20))},
                  {"cut.png: "});
    expectRefused({"info", input("cut.vrt", "<VRTDataset rasterXSize=\"16\" <a")},
                  {"cut.vrt: ", "damaged XML"});
}

}  // namespace
}  // namespace stereonav
