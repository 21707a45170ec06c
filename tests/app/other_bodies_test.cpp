// Ground on other bodies than the Earth: it is as round as they are, and what is the Earth's alone refuses.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

struct Globe {
    const char* name;
    double radius, inverseFlattening;  // 0: a sphere
    // (2a + b) / 3
    double mean() const { return inverseFlattening > 0 ? radius * (1 - 1 / inverseFlattening / 3) : radius; }
};

class OtherBodies : public ProgramTest {
protected:
    // Level ground at the equator, a row of samples 1 km apart.
    std::string sea(const Globe& globe) {
        const std::string file = grid("sea.asc", 81, 3, 1000, [](int, int) { return 0; });
        std::ostringstream system;
        system << "PROJCS[\"" << globe.name << "\",GEOGCS[\"GCS_" << globe.name << "\",DATUM[\"D_"
               << globe.name << "\",SPHEROID[\"" << globe.name << "_body\"," << std::fixed << globe.radius
               << "," << globe.inverseFlattening
               << "]],PRIMEM[\"Reference_Meridian\",0.0],UNIT[\"Degree\",0.0174532925199433]],PROJECTION["
                  "\"Transverse_Mercator\"],PARAMETER[\"False_Easting\",0.0],PARAMETER[\"False_Northing\","
                  "0.0],PARAMETER[\"Central_Meridian\",0.0],PARAMETER[\"Scale_Factor\",1.0],PARAMETER["
                  "\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]";
        input("sea.prj", system.str());
        return file;
    }
    Json json(const std::vector<std::string>& words) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out);
    }
};

constexpr Globe kMars{"Mars_2000_Sphere", 3396190, 0};

TEST_F(OtherBodies, TheHorizonIsThatOfTheBody) {
    for (const Globe& globe :
         {kMars, Globe{"Mars_2000", 3396190, 169.894447223612}, Globe{"Moon_2000", 1737400, 0},
          Globe{"Venus_2000", 6051800, 0}, Globe{"Ceres_2000", 470000, 0}}) {
        const std::string dem = sea(globe);
        for (const double refraction : {-1.0, 0.0, 0.25}) {
            std::vector<std::string> words{"viewshed", dem,     "--from", "500,1500,100",
                                           "--out",    "s.tif", "--json", "--curvature"};
            if (refraction >= 0) words.insert(words.end(), {"--refraction", std::to_string(refraction)});
            const Json shed = json(words);
            const double bent = std::max(refraction, 0.0);
            const int horizon = static_cast<int>(std::sqrt(2 * globe.mean() * 100 / (1 - bent)) / 1000);
            EXPECT_EQ(shed["seen_samples"], 3 * (horizon + 1)) << globe.name << " " << refraction;
            EXPECT_EQ(shed["refraction"], bent) << "without a word 0";
            EXPECT_NEAR(shed["radius_m"].get<double>(), globe.mean(), 1) << globe.name;
        }
        const Json facts = json({"info", dem, "--json", "--curvature"}).at("terrain").at("curvature");
        EXPECT_NEAR(facts["radius_m"].get<double>(), globe.mean(), 1);
        EXPECT_EQ(facts["refraction"], 0);
    }
}

TEST_F(OtherBodies, EarthsOfAllKindsAreTheEarth) {
    for (const Globe& globe :
         {Globe{"WGS_1984", 6378137, 298.257223563}, Globe{"Sphere", 6371000, 0}, Globe{"Web", 6378137, 0},
          Globe{"Everest", 6377276, 300.8017}, Globe{"Clarke", 6378249, 293.465}}) {
        const Json facts = json({"info", sea(globe), "--json", "--curvature"}).at("terrain").at("curvature");
        EXPECT_EQ(facts["radius_m"], 6371008.8) << globe.name;
        EXPECT_EQ(facts["refraction"], 0.13) << globe.name;
    }
}

TEST_F(OtherBodies, WhatIsTheEarthsAloneRefuses) {
    const std::string dem = sea(kMars);
    const std::string track =
        input("walk.geojson", R"({"type":"LineString","coordinates":[[0.1,0.01],[0.2,0.01]]})");
    const std::string body = "the ground lies on a body of 3396.19 km radius";
    expectRefused({"sun", dem, "--at", "2026-06-21T12:00"}, {"sun", body});
    expectRefused({"render", dem, "--out", "a.png", "--size", "32x24", "--sky", "physical"},
                  {"--sky physical", body});
    expectRefused({"render", dem, "--out", "a.png", "--size", "32x24", "--tracks", track},
                  {"walk.geojson", body});
    expectRefused({"render", dem, "--out", "a.png", "--size", "32x24", "--paint", "hours:2026-06-21"},
                  {body});
    expectRefused({"play", dem, "--hash", "--size", "32x24", "--frames", "2", "--follow", track},
                  {"walk.geojson", body});
    expectRefused({"profile", dem, "--track", track}, {"walk.geojson", body});
    expectRefused({"measure", dem, "--track", track}, {"walk.geojson", body});
}

}  // namespace
}  // namespace stereonav::test
