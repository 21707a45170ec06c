// `stereonav coverage`: the part of a colon's wall that a flight shows one way, there and back, and after
// looking at the remaining patches.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/options/command.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/volume/colon_of.h"
#include "app/scene/volume/flights.h"
#include "colon/instruments/coverage.h"
#include "colon/instruments/shared_wall.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/camera/view_ranges.h"
#include "engine/peers/peers.h"

namespace stereonav {
namespace {

struct CoverageOptions {
    SceneOptions scene;  // its field of view is that of the flight's views
    Telling telling;
    SizeOption size{512, 512};  // only the shape counts
    std::string path;           // file of a flight; "": along the centreline
    double step_mm = 2;         // distance between poses, > 0
    double within_mm = 100;     // largest distance at which wall counts as seen, > 0
    double angle_deg = 85;      // largest angle to the wall's normal, in (0, 90]
    double patch_mm2 = 300;     // area of the smallest patch that is listed, >= 0
    std::string out;            // .csv of the patches, or -; "": none
};

void checkCoverageOptions(const CoverageOptions& options) {
    expectColonName(options.scene.scene);
    if (options.out.empty() || !peersOfThisRun().first()) return;
    if (!isStandardOutput(options.out) && !options.out.ends_with(".csv"))
        throw Error("--out", "", "expected a file named .csv, got \"" + options.out + "\"",
                    "name it patches.csv");
    checkNoInput({"--out", options.out}, inputsOf(options.scene));
    checkOutputFile("--out", options.out);
}

Facts factsOfPatch(const UnseenPatch& patch, double along) {
    Facts facts{
        factForJson("area_mm2", 1e6 * patch.area),
        factForJson("place_mm", FactNumbers{1e3 * patch.place.x, 1e3 * patch.place.y, 1e3 * patch.place.z}),
        factForJson("along_mm", 1e3 * along)};
    if (!patch.view) return facts;
    const PoseAngles angles = anglesOf(*patch.view);
    const glm::dvec3& p = patch.view->position;
    constexpr double kDegrees = 180 / std::numbers::pi;
    facts.push_back(factForJson("view_pose", FactNumbers{p.x, p.y, p.z, angles.heading * kDegrees,
                                                         angles.pitch * kDegrees, angles.roll * kDegrees}));
    return facts;
}

std::string csvOf(const std::vector<UnseenPatch>& patches, const std::vector<double>& along) {
    std::string text = "area_mm2,left_mm,back_mm,head_mm,along_mm\n";
    for (std::size_t n = 0; n < patches.size(); ++n)
        text += fmt::format("{:.1f},{:.2f},{:.2f},{:.2f},{:.1f}\n", 1e6 * patches[n].area,
                            1e3 * patches[n].place.x, 1e3 * patches[n].place.y, 1e3 * patches[n].place.z,
                            1e3 * along[n]);
    return text;
}

void tell(CommandResult& result, const CoverageOptions& options, const std::vector<UnseenPatch>& patches,
          const std::vector<double>& along) {
    std::vector<Facts> list;
    for (std::size_t n = 0; n < patches.size(); ++n) {
        list.push_back(factsOfPatch(patches[n], along[n]));
        result.say(fmt::format("  {:7.0f} mm^2  {:6.0f} mm along, at {}\n", 1e6 * patches[n].area,
                               1e3 * along[n], placeText(patches[n].place)));
    }
    result.add("patches", std::move(list));
    if (!options.out.empty()) writeTextFile(options.out, csvOf(patches, along));
}

int runCoverage(const CoverageOptions& options) {
    Peers& peers = peersOfThisRun();
    checkCoverageOptions(options);
    CommandResult result("coverage", options.telling, {{"--out", options.out}});
    ProgressBar bar(peers.first() && !options.telling.quiet);
    const std::unique_ptr<Scene> scene = loadScene(options.scene, SizeOption{}, bar.progress(), kNoPicture);
    if (peers.first()) checkNotRead({{"--out", options.out}});
    const ColonScene& colon = colonOf(*scene, options.scene);
    const ColonInterior& inside = *scene->offered<const ColonInterior>();
    const auto freeDistance = [&](const glm::dvec3& place, double upTo) {
        return colon.freeDistanceAt(place, upTo);
    };
    const ColonFlights flights =
        colonFlights(colon, options.path, 1e-3 * options.step_mm, freeDistance, inside);
    const std::shared_ptr<const JoinedWall> wall = joinedWall(colon, bar.progress());
    const LineOfSight sight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue);
    CoverageSetting setting;
    setting.verticalFov = scene->lens.verticalFov;
    setting.aspect = static_cast<double>(options.size.width) / options.size.height;
    setting.within = 1e-3 * options.within_mm;
    setting.angle = options.angle_deg * std::numbers::pi / 180;
    setting.smallestPatch = 1e-6 * options.patch_mm2;
    Coverage coverage(wall->mesh, wall->neighbours, sight, setting);
    coverage.shareWith(peers);
    coverage.look(flights.there, bar.progress());
    const double oneWay = coverage.percent();
    coverage.look(flights.back, bar.progress());
    if (!peers.first()) return 0;
    const double twoWay = coverage.percent();
    const std::vector<UnseenPatch> patches = coverage.patches(freeDistance, colon.clearance);
    std::vector<double> along;
    along.reserve(patches.size());
    for (const UnseenPatch& patch : patches) along.push_back(inside.placeOnLine(patch.place).along);
    const int views = coverage.visit(patches, freeDistance, colon.clearance, bar.progress());
    const double after = coverage.percent();
    bar.clear();
    result.say(
        fmt::format("{}: {:.1f} % of {:.0f} cm^2 of wall seen one way, {:.1f} % there and back, {:.1f} % "
                    "after {} views of {} "
                    "patches of at least {:g} mm^2; {}\n",
                    scene->name, oneWay, 1e4 * wall->mesh.area(), twoWay, after, views, patches.size(),
                    options.patch_mm2, kNoMedicalDevice));
    result.addScene(scene->name);
    result.add("fov_deg", setting.verticalFov * 180 / std::numbers::pi);
    result.add("within_mm", options.within_mm);
    result.add("angle_deg", options.angle_deg);
    result.add("wall_mm2", 1e6 * wall->mesh.area());
    result.add("poses", static_cast<std::int64_t>(flights.there.size() + flights.back.size()));
    result.add("one_way_percent", oneWay);
    result.add("two_way_percent", twoWay);
    result.add("after_patches_percent", after);
    result.add("views_of_patches", static_cast<std::int64_t>(views));
    tell(result, options, patches, along);
    if (!options.out.empty()) result.addFile("table", options.out);
    result.finish();
    return 0;
}

std::vector<Option> coverageOptions() {
    return {
        {.key = "fov",
         .value = numberValue(kFovRange),
         .help = "vertical field of view",
         .advice = "90 to 140 is usual",
         .fallback = "the scene's own",
         .take = into<&SceneOptions::fov_deg>},
        {.key = "size",
         .value = sizeValue(),
         .help = "size of the picture, of which only the shape counts",
         .advice = "try 1280x720",
         .fallback = "512x512",
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 *to.size = {static_cast<int>(value.numbers[0]), static_cast<int>(value.numbers[1])};
             }},
        {.key = "path",
         .value = fileValue(),
         .help = "a recorded path (.gltf, .glb, .path)",
         .fallback = "along the centreline",
         .take = into<&CoverageOptions::path>},
        {.key = "step",
         .value = numberValue(within(0.1, 100, "mm")),
         .help = "distance between the views along the flight",
         .advice = "2 is fine",
         .fallback = "2",
         .take = into<&CoverageOptions::step_mm>},
        {.key = "within",
         .value = numberValue(above(0, 1e6, "mm")),
         .help = "largest distance from the eye at which wall counts as seen",
         .advice = "100 is two widths of a colon",
         .fallback = "100",
         .take = into<&CoverageOptions::within_mm>},
        {.key = "angle",
         .value = numberValue(above(0, 90, "degrees")),
         .help = "largest angle between a ray and the wall's normal at which wall counts as seen",
         .advice = "90 leaves nothing out that is on screen",
         .fallback = "85",
         .take = into<&CoverageOptions::angle_deg>},
        {.key = "patch",
         .value = numberValue(within(0, 1e9, "mm^2")),
         .help = "area of the smallest unseen patch that is listed",
         .advice = "300 is usual in the literature",
         .fallback = "300",
         .take = into<&CoverageOptions::patch_mm2>},
        {.key = "out",
         .value = fileValue(),
         .help = "the unseen patches as a table, .csv or -",
         .take = into<&CoverageOptions::out>},
    };
}

}  // namespace

Command coverageCommand() {
    return {.name = "coverage",
            .help = "measure what a flight shows of a colon's wall, and what it misses",
            .scenes = scene_type::kVolumes,
            .traits = command::kOfColon | command::kTelling,
            .chapter = Chapter::Colon,
            .options = coverageOptions,
            .start = startOf<CoverageOptions, runCoverage>};
}

}  // namespace stereonav
