// Options in units of their own (mm, mm^2, km, degrees): what comes of them is what the program's parts give
// in metres and radians, which have tests of their own. The metres are written out here.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/options/bake_options.h"
#include "app/options/option_table.h"
#include "app/options/parsed_options.h"
#include "app/report/report_options.h"
#include "app/scene/scene_loading.h"
#include "app/scene/shown_as.h"
#include "app/scene/volume/colon_of.h"
#include "app/scene/volume/flights.h"
#include "app/scene/volume/inside.h"
#include "app/scene/volume/light_loading.h"
#include "app/scene/volume/volume_loading.h"
#include "app/view/setting_texts.h"
#include "colon/instruments/coverage.h"
#include "colon/instruments/shared_wall.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

// What `coverage` looks with.
struct LookedWith {
    double step = 0.002, within = 0.1, smallest = 300e-6;  // metres, square metres
    double angle = 85 * std::numbers::pi / 180;
};

class OptionUnits : public VolumeTest {
protected:
    // A tube with a pocket at its side, of voxels of 1 mm.
    std::string pocketTube() const {
        return nrrd("pocket.nrrd", {40, 40, 70, 1, "uchar", ""}, [](int i, int j, int k) {
            const double x = i - 19.5, y = j - 19.5;
            const bool tube = std::hypot(x, y) < 8 && k > 2 && k < 67;
            return tube || (x > 0 && x < 15 && std::hypot(y, k - 34.5) < 4) ? 1 : 0;
        });
    }
    Json coverageOf(const std::string& study, std::vector<std::string> options) const {
        options.insert(options.begin(), {"coverage", study, "--no-cache", "--json", "--fov", "90"});
        const Outcome outcome = run(options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out, nullptr, false);
    }
    static std::unique_ptr<Scene> opened(const std::string& study) {
        SceneOptions options;
        options.scene = study;
        options.volume.cache = false;
        Progress quiet;
        return loadScene(options, SizeOption{}, quiet, kNoPicture);
    }
};

struct Seen {
    double oneWay = 0, twoWay = 0;  // percent
    std::size_t poses = 0, patches = 0;
};

Seen seenWith(const Scene& scene, const LookedWith& with) {
    SceneOptions named;
    named.scene = "test";
    const ColonScene& colon = colonOf(scene, named);
    const auto freeDistance = [&](const glm::dvec3& place, double upTo) {
        return colon.freeDistanceAt(place, upTo);
    };
    Progress quiet;
    const ColonFlights flights =
        colonFlights(colon, "", with.step, freeDistance, *scene.offered<const ColonInterior>());
    const auto wall = joinedWall(colon, quiet);
    const LineOfSight sight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue);
    CoverageSetting setting;
    setting.verticalFov = std::numbers::pi / 2;
    setting.within = with.within;
    setting.angle = with.angle;
    setting.smallestPatch = with.smallest;
    Coverage coverage(wall->mesh, wall->neighbours, sight, setting);
    Seen seen;
    coverage.look(flights.there, quiet);
    seen.oneWay = coverage.percent();
    coverage.look(flights.back, quiet);
    seen.twoWay = coverage.percent();
    seen.poses = flights.there.size() + flights.back.size();
    seen.patches = coverage.patches(freeDistance, colon.clearance).size();
    return seen;
}

void expectSeen(const Json& told, const Seen& seen) {
    EXPECT_NEAR(told.at("one_way_percent").get<double>(), seen.oneWay, 1e-4);
    EXPECT_NEAR(told.at("two_way_percent").get<double>(), seen.twoWay, 1e-4);
    EXPECT_EQ(told.at("poses"), seen.poses);
    EXPECT_EQ(told.at("patches").size(), seen.patches);
}

TEST_F(OptionUnits, CoverageLooksInMillimetresAndDegrees) {
    const std::string study = pocketTube();
    const auto scene = opened(study);
    LookedWith plain;
    plain.smallest = 5e-6;
    const Seen usual = seenWith(*scene, plain);
    ASSERT_GT(usual.patches, 0u);
    expectSeen(coverageOf(study, {"--patch", "5"}), usual);
    {
        SCOPED_TRACE("--within");
        LookedWith near = plain;
        near.within = 0.012;
        const Seen seen = seenWith(*scene, near);
        EXPECT_LT(seen.oneWay, usual.oneWay - 1) << "it makes a difference";
        expectSeen(coverageOf(study, {"--patch", "5", "--within", "12"}), seen);
    }
    {
        SCOPED_TRACE("--step");
        LookedWith far = plain;
        far.step = 0.0075;
        const Seen seen = seenWith(*scene, far);
        EXPECT_LT(seen.poses, usual.poses / 2);
        expectSeen(coverageOf(study, {"--patch", "5", "--step", "7.5"}), seen);
    }
    {
        SCOPED_TRACE("--patch");
        LookedWith large = plain;
        large.smallest = 5e-3;
        const Seen seen = seenWith(*scene, large);
        EXPECT_EQ(seen.patches, 0u);
        expectSeen(coverageOf(study, {"--patch", "5000"}), seen);
    }
    {
        SCOPED_TRACE("--angle");
        LookedWith steep = plain;
        steep.angle = std::numbers::pi / 6;
        const Seen seen = seenWith(*scene, steep);
        EXPECT_LT(seen.oneWay, usual.oneWay - 1);
        expectSeen(coverageOf(study, {"--patch", "5", "--angle", "30"}), seen);
    }
}

TEST_F(OptionUnits, LightReachesMillimetres) {
    SceneOptions options;
    options.scene = pocketTube();
    options.volume.cache = false;
    Progress quiet;
    const ColonScene colon = loadColon(colonOptionsOf(options), quiet);
    BakeOptions bake;
    bake.what = BakeKind::Openness;
    bake.reach_mm = 5;
    std::vector<std::string> notes;
    EXPECT_NEAR(lightSetupOf(colon, bake, notes).reach, 0.005, 1e-12);
}

TEST_F(OptionUnits, VisibilityIsInKilometres) {
    const ViewOptions options =
        viewOptionsOf({{"SCENE", {"terrain"}}, {"sky", {"physical"}}, {"visibility", {"12.5"}}});
    EXPECT_NEAR(*options.scene.visibility_m, 12500, 1e-9);
}

// Reads values of a command's own options, as the command line does.
template <typename Options>
Options optionsWith(CommandSet which, const std::vector<std::pair<const char*, const char*>>& values) {
    ParsedOptions parsed(sceneTypeOf);
    chooseCommand(which, parsed);
    for (const auto& [key, text] : values) {
        const Option* const option = findOption(which, key);
        if (option)
            takeOption(*option, text, option->name(), parsed);
        else
            ADD_FAILURE() << "no option " << key;
    }
    return parsed.to.of<Options>();
}

TEST_F(OptionUnits, NumbersOfBakeArriveUnchanged) {
    const auto bake = optionsWith<BakeOptions>(command::kBake, {{"reach", "7.5"},
                                                                {"samples", "12"},
                                                                {"error", "0.25"},
                                                                {"minutes", "3.5"},
                                                                {"resolution", "2"},
                                                                {"bounces", "4"},
                                                                {"order", "3"},
                                                                {"threads", "5"}});
    EXPECT_EQ(bake.reach_mm, 7.5);
    EXPECT_EQ(bake.samples, 12);
    EXPECT_EQ(bake.error, 0.25);
    EXPECT_EQ(bake.minutes, 3.5);
    EXPECT_EQ(bake.resolution, 2);
    EXPECT_EQ(bake.bounces, 4);
    EXPECT_EQ(bake.order, 3);
    EXPECT_EQ(bake.scene.threads, 5);
}

TEST_F(OptionUnits, NumbersOfReportArriveUnchanged) {
    const auto report = optionsWith<ReportOptions>(
        command::kReport, {{"seed", "9"}, {"minutes", "2.5"}, {"threads", "3"}, {"refraction", "0.2"}});
    EXPECT_EQ(report.seed, 9u);
    EXPECT_EQ(report.minutes, 2.5);
    EXPECT_EQ(report.threads, 3);
    EXPECT_EQ(report.refraction, 0.2);
}

TEST_F(OptionUnits, SeedsAreInMillimetres) {
    const ViewOptions options = viewOptionsOf({{"SCENE", {maskedTube()}}, {"seed", {"1,-20,300"}}});
    ASSERT_EQ(options.scene.volume.seeds.size(), 1u);
    EXPECT_NEAR(glm::distance(options.scene.volume.seeds[0], glm::dvec3(0.001, -0.02, 0.3)), 0, 1e-12);
}

}  // namespace
}  // namespace stereonav::test
