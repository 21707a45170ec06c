// --fluid as a user gives it: tagged fluid taken out, left, or tinted.
#include <nlohmann/json.hpp>

#include "engine/image/image_file.h"
#include "tests/app/volume_input.h"
#include "tests/support/made_ct.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

class Fluid : public VolumeTest {
protected:
    // A tube of 12 mm radius with fluid from 3.5 mm behind its axis on.
    std::string scan() const {
        return nrrd("scan.nrrd", {120, 110, 120, 1, "short", ""},
                    [](int i, int j, int k) { return TubeBody::hu(glm::dvec3(i, j, k) * 0.001); });
    }
    // Returns a picture seen from the tube's axis: towards the fluid, where heading is 0, or away from it.
    Plane<PackedColor> rendered(const std::string& study, int heading, std::vector<std::string> more) const {
        std::vector<std::string> arguments{"render", study,   "--no-cache", "--size", "64x64", "--quiet",
                                           "--out",  "a.png", "--fov",      "40",     "--pose"};
        arguments.push_back("0.036,0.031,0.031," + std::to_string(heading) + ",0,0");
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return readColorImage(place() / "a.png");
    }
};

int differing(const Plane<PackedColor>& a, const Plane<PackedColor>& b) {
    int count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) count += a.at(x, y) != b.at(x, y);
    return count;
}

TEST_F(Fluid, IsTakenOutOrLeft) {
    const std::string study = scan();
    const auto told = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"coverage", study, "--no-cache", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out);
    };
    const double out = told({}).at("wall_mm2"), left = told({"--fluid", "left"}).at("wall_mm2");
    // Around: a circle of 12 mm, or its part before a chord 3.5 mm behind the middle, and the chord.
    const double half = std::acos(3.5 / 12), around = 2 * 12 * (3.14159265 - half) + 2 * 12 * std::sin(half);
    const double ends = 12 * 12 * (3.14159265 - half) + 3.5 * 12 * std::sin(half);
    EXPECT_NEAR(left / (around * 70 + 2 * ends), 1, 0.04);
    EXPECT_NEAR(out / (2 * 3.14159265 * 12 * (70 + 12)), 1, 0.03);
    const std::string info = run({"info", study, "--no-cache", "--fluid", "left"}).out;
    EXPECT_NE(info.find("left 1 pool(s) of tagged fluid in"), std::string::npos) << info;
    EXPECT_NE(info.find("1 piece(s)"), std::string::npos) << info;
}

TEST_F(Fluid, IsTintedWhereItWas) {
    const std::string study = scan();
    EXPECT_GT(differing(rendered(study, 0, {}), rendered(study, 0, {"--fluid", "tinted"})), 64 * 64 / 2);
    EXPECT_EQ(differing(rendered(study, 180, {}), rendered(study, 180, {"--fluid", "tinted"})), 0);
    EXPECT_EQ(differing(rendered(study, 0, {}), rendered(study, 0, {"--fluid", "out"})), 0);
    EXPECT_GT(differing(rendered(study, 0, {}), rendered(study, 0, {"--fluid", "left"})), 64 * 64 / 2);
}

// One over the other: what was not seen is blue on what was under fluid.
TEST_F(Fluid, IsTintedBesideWhatWasNotSeen) {
    const std::string study = scan();
    const std::vector<std::string> nothing{"--paint", "coverage"},
        both{"--paint", "coverage", "--fluid", "tinted"};
    EXPECT_GT(differing(rendered(study, 0, nothing), rendered(study, 0, both)), 64 * 64 / 2);
}

TEST_F(Fluid, RefusesWhatHasNone) {
    const std::string mask = maskedTube(), study = scan();
    for (const char* word : {"left", "tinted"})
        expectRefused({"render", mask, "--no-cache", "--out", "a.png", "--fluid", word},
                      {"--fluid", word, "a mask tells nothing of fluid"});
    expectRefused({"render", study, "--out", "a.png", "--fluid", "gone"}, {"--fluid", "out, left or tinted"});
    expectRefused({"coverage", study, "--fluid", "tinted"}, {"--fluid", "render, play and view"});
    expectRefused({"render", study, "--out", "a.png", "--fluid", "tinted", "--opacity", "0.9"},
                  {"--fluid", "opaque"});
    expectRefused({"render", study, "--out", "a.png", "--fluid", "left", "--isosurface"}, {"--isosurface"});
}

}  // namespace
}  // namespace stereonav::test
