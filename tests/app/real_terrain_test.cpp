// The default right eye on real ground, against the figures that the project promises. Times are not
// asserted here: they belong to a quiet machine (tests/bench).
#include <map>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

class RealTerrain : public ProgramTest {
protected:
    // The folder of real elevation models, "" where this machine has none.
    static fs::path data() {
        const char* named = std::getenv("STEREONAV_TEST_DATA");
        const fs::path folder =
            named && *named ? fs::path(named) : fs::path(STEREONAV_SOURCE_DIR) / "../shared/data";
        return fs::exists(folder / "terrain") ? folder / "terrain" : fs::path();
    }

    std::map<std::string, Json> compare(std::vector<std::string> scene, const std::string& size) const {
        scene.insert(scene.begin(), "compare");
        scene.insert(scene.end(),
                     {"--size", size, "--frames", "3", "--repeats", "1", "--relative-separation", "1/30",
                      "--methods", "full,paper,cubic", "--truth-rays", "16", "--json", "a.json"});
        const Outcome outcome = run(scene);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        std::map<std::string, Json> byName;
        const Json json = Json::parse(contentOf(place() / "a.json"));
        for (const Json& method : json.at("methods")) byName[method.at("name")] = method;
        return byName;
    }

    void expectPromised(const std::vector<std::string>& scene) const {
        for (const auto& [size, least] : {std::pair{"500x400", 38.0}, std::pair{"1280x720", 40.0}}) {
            const auto methods = compare(scene, size);
            const double cubic = methods.at("cubic").at("psnr_db"), paper = methods.at("paper").at("psnr_db");
            EXPECT_GE(cubic, least) << scene.front() << " " << size;
            EXPECT_GE(cubic, paper + 1.0) << scene.front() << " " << size;
            EXPECT_LT(methods.at("cubic").at("hole_percent").get<double>(), 15.0)
                << scene.front() << " " << size;
            // what one ray a pixel can do at best, and the warp loses next to nothing of it
            EXPECT_GE(methods.at("cubic").at("true_psnr_db").get<double>(),
                      methods.at("full").at("true_psnr_db").get<double>() - 0.5)
                << scene.front() << " " << size;
        }
    }
};

TEST_F(RealTerrain, SanGabrielMountains) {
    if (data().empty()) GTEST_SKIP() << "no real data beside the project";
    expectPromised({(data() / "srtm_bigtujunga30m_utm11.tif").string()});
}

TEST_F(RealTerrain, AraratWithItsColour) {
    if (data().empty()) GTEST_SKIP() << "no real data beside the project";
    const fs::path folder = data() / "ararat";
    expectPromised({(folder / "agri-small-dem-utm38n-30m.tif").string(), "--image",
                    (folder / "agri-small-winter.jpg").string()});
}

// Words and numbers as they are printed, and the whole profile.
TEST_F(RealTerrain, InstrumentsOverTilesSayWhatTheySayOfGroundInMemory) {
    if (data().empty()) GTEST_SKIP() << "no real data";
    const std::string dem = (data() / "srtm_bigtujunga30m_utm11.tif").string();
    const std::vector<std::vector<std::string>> asked{
        {"measure", dem, "--line", "390000,3799000,396500,3801000,401000,3801500"},
        {"measure", dem, "--area", "385000,3794000,390000,3796000,388000,3799000", "--plane", "900"},
        {"profile", dem, "--line", "380000,3790000,410000,3806000", "--csv", "line.csv"},
        {"viewshed", dem, "--from", "394268,3798272,20", "--to", "401000,3801500,2", "--curvature"}};
    for (const auto& words : asked) {
        std::string said[2], profile[2];
        for (const bool tiled : {false, true}) {
            std::vector<std::string> all = words;
            all.insert(all.end(), {"--tiles", tiled ? "on" : "off", "--json"});
            const Outcome outcome = run(all);
            EXPECT_EQ(outcome.status, 0) << outcome.err;
            said[tiled] = outcome.out, profile[tiled] = contentOf(place() / "line.csv");
        }
        EXPECT_EQ(said[0], said[1]);
        EXPECT_EQ(profile[0], profile[1]);
    }
    EXPECT_GT(linesIn(contentOf(place() / "line.csv")), 1000);
}

TEST_F(RealTerrain, ATruncatedGeoTiffIsRefused) {
    if (data().empty()) GTEST_SKIP() << "no real data beside the project";
    const std::string whole = contentOf(data() / "srtm_bigtujunga30m_utm11.tif");
    for (const double share : {0.001, 0.3, 0.9})
        expectRefused(
            {"render",
             input("cut.tif",
                   whole.substr(0, static_cast<std::size_t>(static_cast<double>(whole.size()) * share))),
             "--size", "32x24", "--out", "out.png"},
            {"cut.tif"});
}

TEST_F(RealTerrain, AnImageThatDoesNotOverlapIsRefused) {
    if (data().empty()) GTEST_SKIP() << "no real data beside the project";
    // one real grid as the georeferenced "image" of another, half the world away
    expectRefused(
        {"render", (data() / "srtm_bigtujunga30m_utm11.tif").string(), "--image",
         (data() / "ararat/agri-small-dem-utm38n-30m.tif").string(), "--size", "32x24", "--out", "out.png"},
        {"agri-small-dem-utm38n-30m.tif"});
}

}  // namespace
}  // namespace stereonav::test
