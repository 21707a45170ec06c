// `stereonav viewshed`: the ground that is seen from a place, and lines of sight between two places.
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "app/options/command.h"
#include "app/options/option_numbers.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/options/usual_words.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/terrain/survey_part.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/stopwatch.h"
#include "engine/math/earth_bend.h"
#include "engine/text/length_text.h"
#include "terrain/survey/ground_samples.h"
#include "terrain/survey/viewshed.h"

namespace stereonav {
namespace {

// A place on the ground: x, y in the elevation model's reference system, and metres above the ground.
struct SurveyPlace {
    glm::dvec2 reference{0.0};
    std::optional<double> height_m;
};

struct ViewshedOptions {
    SceneOptions scene;
    Telling telling;
    SurveyPlace from;
    std::optional<SurveyPlace> to;  // end of a line of sight
    double targetHeight_m = 0;      // height of the target above the ground
    std::optional<double> reach_m;  // empty: all of the ground
    bool curvature = false;
    std::optional<double> refraction;  // share of the curvature; empty: the default
    std::string out;                   // GeoTIFF; "": none
};

constexpr double kUsualEye = 1.7;  // metres: eye height of a standing person

void checkViewshedOptions(const ViewshedOptions& options) {
    if (options.out.empty() && !options.to)
        throw Error("--out", "", "is required, or --to", "give a file, shed.tif, or a second place");
    if (options.out.empty()) return;
    if (!options.out.ends_with(".tif") && !options.out.ends_with(".tiff"))
        throw Error("--out", "", "expected a file named .tif, got \"" + options.out + "\"",
                    "name it shed.tif");
    checkNoInput({"--out", options.out}, inputsOf(options.scene));
    checkOutputFile("--out", options.out);
}

double refractionOf(const ViewshedOptions& options, const SurveyGround& survey) {
    return options.refraction.value_or(survey.body.usualRefraction());
}

double fallOf(const ViewshedOptions& options, const SurveyGround& survey) {
    return options.curvature ? curvatureFall(refractionOf(options, survey), survey.body) : 0;
}

void addPlace(CommandResult& result, const std::string& key, const SurveyPlace& place, double ground,
              double height) {
    result.add(key, FactNumbers{place.reference.x, place.reference.y});
    result.add(key + "_ground_m", ground);
    result.add(key + "_height_m", height);
}

void tellSight(const ViewshedOptions& options, const SurveyGround& survey, const glm::dvec3& eye,
               CommandResult& result) {
    const glm::dvec2 place = survey.gridAt(options.to->reference, "--to");
    const double ground = survey.heightAt(place, "--to"), height = options.to->height_m.value_or(0);
    const GroundSamples samples = survey.samples();
    const Sight sight = sightOver(samples, fallOf(options, survey), eye, {place, ground + height});
    const double distance = glm::length((place - glm::dvec2(eye)) * samples.spacing());
    result.answer(fmt::format("{}: {} of distance, the line passes {} {} the ground at {} from the eye\n",
                              sight.seen ? "they see each other" : "they do not see each other",
                              lengthText(distance), lengthText(std::abs(sight.clearance)),
                              sight.clearance < 0 ? "under" : "over", lengthText(sight.at)));
    addPlace(result, "to", *options.to, ground, height);
    result.add("sees", sight.seen);
    result.add("distance_m", distance);
    result.add("clearance_m", sight.clearance);
    result.add("clearance_at_m", sight.at);
}

void writeShed(const ViewshedOptions& options, const SurveyGround& survey, const glm::dvec3& eye,
               double height, Progress& progress, CommandResult& result) {
    const glm::dvec2 world = survey.samples().worldFromGrid(eye);
    progress.report(0, "reading ground");
    const double reach = options.reach_m.value_or(0);
    const SurveyPart part(survey, world, reach);
    ViewshedSetting setting;
    setting.eye = part.ground().gridFromWorld(world);
    setting.eyeHeight = height;
    setting.targetHeight = options.targetHeight_m;
    setting.reach = reach;
    setting.fall = fallOf(options, survey);
    const Stopwatch watch;
    const Viewshed shed = viewshedOf(part.ground(), setting, progress);
    const double time_ms = watch.elapsed_ms();
    WrittenRaster raster;
    raster.bytes = &shed.seen;
    raster.missing = static_cast<double>(Seen::NoGround);
    raster.description = "seen";
    writeFileAtomically(options.out,
                        [&](const std::filesystem::path& file) { writeGeoTiff(file, part.grid(), raster); });
    const double share = shed.samples > 0 ? 100.0 * shed.visible / shed.samples : 0;
    const double area = shed.visible * part.ground().spacing().x * part.ground().spacing().y;
    result.say(fmt::format("{}: {} of {} samples seen ({:.2f} %, {:.4g} km2), {}, {:.3g} ms\n", options.out,
                           shed.visible, shed.samples, share, area * 1e-6, part.words(), time_ms));
    result.addFile("viewshed", options.out);
    for (Fact& fact : part.facts()) result.add(fact.key, std::move(fact.value));
    result.add("samples", static_cast<std::int64_t>(shed.samples));
    result.add("seen_samples", static_cast<std::int64_t>(shed.visible));
    result.add("seen_percent", share);
    result.add("seen_m2", area);
    result.add("time_ms", time_ms);
}

int runViewshed(const ViewshedOptions& options) {
    checkViewshedOptions(options);
    CommandResult result("viewshed", options.telling, {});
    ProgressBar bar(!options.telling.quiet);
    const SurveyGround survey = loadSurveyGround(options.scene, bar.progress());
    if (!options.out.empty()) checkNotRead({{"--out", options.out}});
    const glm::dvec2 place = survey.gridAt(options.from.reference, "--from");
    const double ground = survey.heightAt(place, "--from"),
                 height = options.from.height_m.value_or(kUsualEye);
    const glm::dvec3 eye(place, ground + height);
    result.addScene(survey.name);
    result.add("crs", survey.crs);
    addPlace(result, "from", options.from, ground, height);
    result.add("curvature", options.curvature);
    const auto whereRound = [&](double value) {
        return options.curvature ? FactValue(value) : FactValue(std::monostate());
    };
    result.add("refraction", whereRound(refractionOf(options, survey)));
    result.add("radius_m", whereRound(survey.body.radius()));
    if (!options.out.empty()) writeShed(options, survey, eye, height, bar.progress(), result);
    bar.clear();
    if (options.to) tellSight(options, survey, eye, result);
    result.finish();
    return 0;
}

SurveyPlace surveyPlaceOf(const OptionValue& value) {
    SurveyPlace place;
    place.reference = {value.numbers[0], value.numbers[1]};
    if (value.numbers.size() > 2) place.height_m = value.numbers[2];
    return place;
}

bool seesNoGround(const Asked& asked) {
    return !asked.has("out");
}

std::vector<Option> viewshedOptions() {
    return {
        {.key = "from",
         .value = numbersValue(groundPlaceNumbers()),
         .help = "the eye: x,y in the elevation model's reference system, or, if it has none, metres east "
                 "and north of its middle",
         .required = true,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<ViewshedOptions>().from = surveyPlaceOf(value); }},
        {.key = "to",
         .value = numbersValue(groundPlaceNumbers()),
         .help = "a second place: print whether both see each other, and how far the line of sight passes "
                 "over the ground",
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<ViewshedOptions>().to = surveyPlaceOf(value); }},
        {.key = "target-height",
         .value = numberValue(within(0, 1e6, "metres")),
         .help = "height above the ground of what is looked at",
         .fallback = "0, the ground itself",
         .rules = {{seesNoGround, "applies to --out only", "leave it out; --to has a height of its own"}},
         .take = into<&ViewshedOptions::targetHeight_m>},
        {.key = "reach",
         .value = numberValue(above(0, 1e9, "metres")),
         .help = "largest horizontal distance of what is seen",
         .fallback = "all of the ground",
         .rules = {{seesNoGround, "applies to --out only", kLeaveItOut}},
         .take = into<&ViewshedOptions::reach_m>},
        {.key = "curvature",
         .value = flagValue(),
         .help = "curve the ground as the Earth, or the body that it lies on, less the refraction of the air",
         .take = into<&ViewshedOptions::curvature>},
        {.key = "refraction",
         .value = numberValue({0, 1, false, true}),
         .help = "coefficient of refraction: the share of the curvature that light follows",
         .advice = "0.13 is usual by day, 0 leaves it out",
         .fallback = "0.13, on other bodies than the Earth 0",
         .rules = {{[](const Asked& asked) { return !asked.has("curvature"); }, "needs --curvature",
                    "add it, or leave this out"}},
         .take = into<&ViewshedOptions::refraction>},
        {.key = "out",
         .value = fileValue(),
         .help = "a GeoTIFF over the ground's samples, .tif: 255 seen, 0 hidden, 128 no ground",
         .take = into<&ViewshedOptions::out>},
    };
}

}  // namespace

Command viewshedCommand() {
    return {.name = "viewshed",
            .help = "find what of the ground is seen from a place, and whether two places see each other",
            .scenes = scene_type::kTerrains,
            .traits = command::kOfGround | command::kTelling,
            .chapter = Chapter::Ground,
            .options = viewshedOptions,
            .start = startOf<ViewshedOptions, runViewshed>};
}

}  // namespace stereonav
