// `report --papers` as a user runs it: its rows, with figures that are known whatever the machine. With
// hardly any time given, and built-in scenes in the place of real data.
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"
#include "tests/support/xml_check.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

class Papers : public ProgramTest {
protected:
    Outcome papers(std::vector<std::string> more) const {
        fs::create_directories(place() / "nothing");
        std::vector<std::string> arguments{"report", "--papers", "--quick", "--minutes", "0.01",
                                           "--data", "nothing",  "--out",   "page"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    Json json() const { return Json::parse(contentOf(place() / "page/report.json")); }

    // Returns the rows by "table/row/column".
    std::map<std::string, Json> rowsOf(const std::string& parts, std::vector<std::string> more = {}) const {
        more.insert(more.end(), {"--parts", parts});
        const Outcome outcome = papers(more);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        std::map<std::string, Json> rows;
        const Json report = json();
        for (const Json& row : report.at("papers"))
            rows[row.at("table").get<std::string>() + "/" + row.at("row").get<std::string>() + "/" +
                 row.at("column").get<std::string>()] = row;
        return rows;
    }
};

double ours(const std::map<std::string, Json>& rows, const std::string& name) {
    const auto at = rows.find(name);
    if (at == rows.end()) throw std::runtime_error("no row " + name);
    return at->second.at("ours").get<double>();
}

TEST_F(Papers, EveryRowSaysWhatWhereAndWhy) {
    const Outcome outcome = papers({"--parts", "papers-occlusion,papers-media"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json report = json();
    ASSERT_GT(report.at("papers").size(), 40u);
    for (const Json& row : report.at("papers")) {
        for (const char* field : {"paper", "table", "row", "column", "unit", "measured", "why"})
            EXPECT_FALSE(row.at(field).get<std::string>().empty()) << row;
        EXPECT_TRUE(row.at("theirs").is_number() || !row.at("said").get<std::string>().empty()) << row;
        EXPECT_TRUE(row.at("ours").is_number() || !row.at("none").get<std::string>().empty()) << row;
        EXPECT_NE(row.at("measured").get<std::string>().find("stands in"), std::string::npos) << row;
    }
    const std::string page = contentOf(place() / "page/index.html");
    EXPECT_EQ(xmlProblem(page), "");
    for (const char* words : {"Ruiz et al. 2010, Table 1", "Kniss et al. 2003, Section 4",
                              "data:image/png;base64,", "instruction set"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
    EXPECT_EQ(linesIn(contentOf(place() / "page/papers.csv")),
              static_cast<long>(report.at("papers").size()) + 1);
}

TEST_F(Papers, StereoCountsHolesWithoutTheSkyAndProcessorsThatAreThere) {
    const auto rows = rowsOf("papers-stereo", {"--threads", "1"});
    for (const std::string figure : {" (fig. 6, shaded)", " (fig. 7, with its photo)"}) {
        double share = 0;
        for (const std::string gap :
             {"[P_r, D]: right-end gap", "[P_r, P_s]: middle gaps", "[C, P_s]: left-end gap"})
            share += ours(rows, "Table 1/fill gap between " + gap + figure + "/share of the holes");
        EXPECT_NEAR(share, 100, 1e-9) << "every hole lies in one of the gaps";
        const std::string left = "Table 2/left image, static partition" + figure + "/";
        EXPECT_GT(ours(rows, left + "1 processor"), 0);
        for (const std::string processors : {"4", "8", "12", "16"}) {
            const Json& row = rows.at(left + processors + " processors");
            EXPECT_TRUE(row.at("ours").is_null()) << row;
            EXPECT_EQ(row.at("none"), "this machine runs 1 thread");
            EXPECT_GT(row.at("theirs").get<double>(), 0);
        }
        EXPECT_DOUBLE_EQ(ours(rows, "Table 2/speed-up of the left image" + figure +
                                        "/1 to 16 processors there, 1 to 1 here"),
                         1);
        const double holes = ours(rows, "Section 5/hole pixels of warped ones" + figure + "/their way");
        EXPECT_GT(holes, 0);
        EXPECT_LT(holes, 20) << "all pixels that are cast, sky and all, are a third of the picture";
        EXPECT_GT(ours(rows, "Section 5/hole filling without ray coherence" + figure + "/1 processor"), 0);
    }
    EXPECT_EQ(rows.at("Table 2/left image, static partition (fig. 6, shaded)/16 processors").at("theirs"),
              0.23);
    EXPECT_EQ(rows.at("Section 5/hole pixels of warped ones (fig. 6, shaded)/their way").at("theirs"), 2.6);
}

// The stand-in has 72x96x56 voxels: 8 bytes each of irradiance, 25 half floats of harmonics.
TEST_F(Papers, LightHasTheMemoryOfItsTexelsAndNoiseThatFalls) {
    const auto rows = rowsOf("papers-light", {"--threads", "2"});
    constexpr double kTexels = 72 * 96 * 56, kMegabyte = 1 << 20;
    EXPECT_NEAR(ours(rows, "Table 2, extra memory/Irradiance/a texel for every voxel"),
                kTexels * 8 / kMegabyte, 1e-9);
    EXPECT_NEAR(ours(rows, "Table 2, extra memory/Spherical harmonics/a texel for every voxel"),
                kTexels * 50 / kMegabyte, 1e-9);
    EXPECT_LT(ours(rows, "Table 2, extra memory/Spherical harmonics/where the surface is"),
              ours(rows, "Table 2, extra memory/Spherical harmonics/a texel for every voxel"));
    const auto noise = [&](const std::string& what, int samples) {
        return ours(rows, "Fig. 7, noise/" + what + "/" + std::to_string(samples) + " samples");
    };
    // naive sampling hardly ever meets the sun: so few texels do not tell its noise
    for (const std::string what : {"Irradiance", "Spherical harmonics"}) {
        EXPECT_GT(noise(what, 100), noise(what, 2500)) << what;
        EXPECT_GT(noise(what, 2500), 0) << what;
    }
    EXPECT_GT(noise("Irradiance, naive sampling as theirs", 625), noise("Irradiance", 625));
    EXPECT_DOUBLE_EQ(
        ours(rows, "Table 2, frames a second/Diffuse (no shadows)/rate, of diffuse without shadows"), 1);
    const Json& row = rows.at("Table 1/Irradiance (full texture)/10000 samples");
    EXPECT_EQ(row.at("theirs"), 1806.0);
    EXPECT_NE(row.at("how").get<std::string>().find("scaled"), std::string::npos) << row;
}

TEST_F(Papers, OcclusionRanksMethodsByTheirErrors) {
    const auto rows = rowsOf("papers-occlusion");
    const std::vector<std::string> methods{"Stewart, 42 directions", "Ruiz 2008, 42 directions", "Penner",
                                           "CDF reconstruction", "Gaussian CDF"};
    const auto of = [&](const std::string& method, const std::string& what) {
        return ours(rows, "Figs. 5 and 6/CT-body, " + method + "/radius 10, " + what);
    };
    for (const std::string& a : methods)
        for (const std::string& b : methods)
            EXPECT_EQ(of(a, "error") < of(b, "error"), of(a, "rank by error") < of(b, "rank by error"))
                << a << b;
    // what the paper says of its pictures
    EXPECT_GT(of("Gaussian CDF", "brightness"), of("Penner", "brightness"));
    EXPECT_GT(of("CDF reconstruction", "brightness"), of("Penner", "brightness"));
    EXPECT_LT(of("Gaussian CDF", "error"), of("Penner", "error"));
    EXPECT_EQ(rows.at("Table 1/CT-head, Gaussian CDF/radius 10").at("theirs"), 270.0);
    EXPECT_FALSE(rows.contains("Figs. 5 and 6/CT-body, Stewart, 42 directions/radius 5, error"))
        << "fig. 6 has the boxes alone";
}

TEST_F(Papers, MediaAreMeasuredByModelAndScalingByThreads) {
    const auto rows = rowsOf("papers-media,papers-scaling", {"--threads", "2"});
    for (const std::string model : {"emission", "surface", "direct", "indirect"}) {
        const std::string name = "Section 4 and fig. 14, on the processor/" + model + ", 64x64/";
        EXPECT_GT(ours(rows, name + "one eye"), 0);
        EXPECT_GT(ours(rows, name + "both eyes"), 0);
        EXPECT_TRUE(rows.contains("Section 4 and fig. 15, in GLSL/" + model + ", 32x32/several targets"));
    }
    EXPECT_DOUBLE_EQ(
        ours(rows, "Section 4 and fig. 14, on the processor/emission, 64x64/rate, of the unshaded one"), 1);
    for (const std::string threads : {"1 thread", "2 threads"})
        EXPECT_GT(ours(rows, "Scaling/sweep, both lights/" + threads), 0);
    EXPECT_FALSE(rows.contains("Scaling/sweep, both lights/3 threads"));
}

TEST_F(Papers, SaysWhichInstructionSetItsFiguresAreFrom) {
    setenv("STEREONAV_SIMD", "plain", 1);
    const Outcome outcome = papers({"--parts", "papers-media"});
    unsetenv("STEREONAV_SIMD");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(json().at("machine").at("instruction set").get<std::string>().starts_with("plain"));
    EXPECT_NE(contentOf(place() / "page/index.html").find("plain"), std::string::npos);
}

TEST_F(Papers, SaysInOneLineWhatIsWrong) {
    const std::pair<std::vector<std::string>, std::string> cases[] = {
        {{"report", "--papers", "--data", "/nowhere"}, "--data"},
        {{"report", "--data", "."}, "needs --papers"},
        {{"report", "--papers", "--scene", "terrain"}, "--scene"},
        {{"report", "--papers", "--parts", "right-eye"}, "papers-stereo"},
        {{"report", "--parts", "papers-stereo"}, "there is no part"},
    };
    for (const auto& [arguments, words] : cases) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 1) << words;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        EXPECT_EQ(linesIn(outcome.err), 1) << outcome.err;
    }
}

TEST_F(Papers, LeavesNothingWhenItIsStopped) {
    const pid_t child = start({"report", "--papers", "--out", "page"});
    awaitWork(child, 1);
    kill(child, SIGINT);
    const Outcome outcome = awaitStopped(child);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("stopped"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(place() / "page"));
}

}  // namespace
}  // namespace stereonav::test
