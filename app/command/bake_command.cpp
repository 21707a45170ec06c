// `stereonav bake`: light computed in advance. Each type of scene has its own kind.
#include <fmt/format.h>

#include "app/command/bake_terrain.h"
#include "app/command/bake_volume.h"
#include "app/options/bake_options.h"
#include "app/options/command.h"
#include "app/options/option_numbers.h"
#include "app/options/option_take.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"
#include "app/scene/scene_type_table.h"
#include "app/scene/terrain/terrain_type.h"
#include "app/scene/volume/volume_type.h"
#include "engine/base/error.h"
#include "engine/light/skies/spherical_harmonics.h"

namespace stereonav {
namespace {

using scene_type::kTerrains, scene_type::kVolumes;

int runBake(const BakeOptions& options) {
    const SceneType& type = sceneTypeNamed(options.scene.scene);
    if (&type == &terrainType()) return bakeTerrain(options);
    if (&type == &volumeType()) return bakeVolume(options);
    throw Error(options.scene.scene, "",
                "expected a terrain or a CT study, found a " + std::string(type.noun),
                "its light is worked out in each frame");
}

bool isTransfer(const Asked& asked) {
    return asked.is("what", "transfer");
}
bool isOpenness(const Asked& asked) {
    return asked.is("what", "openness");
}
bool isStudyOpenness(const Asked& asked) {
    return isOpenness(asked) && asked.shows(kVolumes);
}

// Refuses light for a terrain: it is chosen when the terrain is shown.
OptionRule chosenWhenShown() {
    return {nullptr, "only for CT studies, the scene is a terrain",
            "a terrain's sun and sky are chosen when it is shown: --sun, --sky"};
}

// Refuses lights for kinds other than irradiance.
std::vector<OptionRule> bakedLightRules() {
    return {{isTransfer, "does not go with transfer, whose light is chosen when it is shown", kLeaveOneOut},
            {isOpenness, "does not go with openness, which is without lights", kLeaveOneOut}};
}

OptionRule unlessBounced() {
    return {isStudyOpenness, "does not go with openness, which is without bounces", kLeaveOneOut};
}
OptionRule unlessOpenGround() {
    return {[](const Asked& asked) { return isOpenness(asked) && asked.shows(kTerrains); },
            "has no effect on a terrain's openness, which is without bounced light",
            "leave it out, or bake --what transfer"};
}

// Refuses a number outside the range for terrains, which is smaller.
OptionRule unlessFewOnGround(bool (*broken)(const Asked&), const char* range, const char* key) {
    return {broken, fmt::format("expected {} for a terrain, got {{{}}}", range, key),
            "leave it out for the default"};
}
bool beyondOnGround(const Asked& asked, const char* key, const NumberRange& range) {
    return asked.shows(kTerrains) && !range.holds(asked.given.number(key));
}

std::vector<OptionRule> resolutionRules() {
    return {{[](const Asked& asked) {
                 const double finer = asked.given.number("resolution");
                 return beyondOnGround(asked, "resolution", within(0.001, 1)) && finer != 2 && finer != 4 &&
                        finer != 8;
             },
             "expected 0.001 to 1, or 2, 4 or 8, for a terrain, got {resolution}",
             "1 bakes every height sample in memory, 0.5 every second one each way, 2 also those between"},
            {[](const Asked& asked) {
                 return asked.shows(kVolumes) && !within(0.125, 8).holds(asked.given.number("resolution"));
             },
             "expected 0.125 to 8 texels a voxel, got {resolution}", "use 0.5, 1 or 2"}};
}

OptionRule unlessOneAlbedo() {
    return {[](const Asked& asked) {
                const std::vector<double>& albedo = asked.given.find("albedo")->values.back().numbers;
                return asked.shows(kTerrains) && albedo.size() > 1;
            },
            "expected one number from 0 to 1 for a terrain, got \"{albedo}\"",
            "rock and grass send back 0.2 to 0.3 of the light"};
}

std::optional<ValueProblem> problemOfRange(const std::string& text) {
    const std::vector<double> numbers = numbersFromText(text);
    if (numbers.size() != 2 || numbers[0] <= numbers[1]) return std::nullopt;
    return ValueProblem{"expected LOW,HIGH with LOW at most HIGH, got " + shownText(text),
                        isovaluesNumbers().advice};
}

constexpr const char* kGoals = "choose one of --samples, --error and --minutes";
constexpr const char* kOneGoal = "does not go with another way to end the bake";
constexpr const char* kRanges = "choose one of --isovalue, --isovalues and --full";
constexpr const char* kOneRange = "does not go with another choice of surfaces";

std::vector<Option> bakedLights() {
    return {
        {.key = "light",
         .value = numbersValue(pointLightNumbers()),
         .help = kPointLightHelp,
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = bakedLightRules(),
         .repeated = true,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<BakeOptions>().lights.push_back(lampsOf(value)); }},
        {.key = "probe",
         .value = fileValue(),
         .help = "light from all around: a light probe (.hdr) or a picture",
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = bakedLightRules(),
         .take = into<&BakeOptions::probe>},
        {.key = "sky",
         .value = numbersValue(skyNumbers()),
         .help = "light of one colour from everywhere, on a volume",
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = bakedLightRules(),
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<BakeOptions>().sky = glm::vec3(colorOf(value)); }},
        {.key = "bounces",
         .value = wholeValue(kBouncesRange),
         .help = kBouncesHelp,
         .advice = kBouncesAdvice,
         .rules = {unlessBounced(), unlessOpenGround(),
                   unlessFewOnGround(
                       [](const Asked& asked) { return beyondOnGround(asked, "bounces", within(0, 4)); },
                       "0 to 4", "bounces")},
         .take = into<&BakeOptions::bounces>},
        {.key = "albedo",
         .value = numbersValue(albedoNumbers()),
         .help = kAlbedoHelp,
         .rules = {unlessBounced(), unlessOpenGround(), unlessOneAlbedo()},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<BakeOptions>().albedo = colorOf(value); }},
        {.key = "order",
         .value = wholeValue(within(1, kMaxHarmonicsOrder)),
         .help = "order of the spherical harmonics of --what transfer",
         .advice = "5 is usual",
         .rules = {unlessOpenGround(),
                   {[](const Asked& asked) { return asked.shows(kVolumes) && !isTransfer(asked); },
                    "needs --what transfer", kLeaveItOut},
                   unlessFewOnGround(
                       [](const Asked& asked) { return beyondOnGround(asked, "order", within(1, 6)); },
                       "1 to 6", "order")},
         .take = into<&BakeOptions::order>},
    };
}

std::vector<Option> bakeGoals() {
    return {
        {.key = "samples",
         .value = wholeValue(kSamplesRange),
         .help = "samples of each texel; of a terrain for each bounce",
         .advice = kSamplesAdvice,
         .fallback = "256; terrains 32",
         .rules = {unlessOpenGround(),
                   unlessFewOnGround(
                       [](const Asked& asked) { return beyondOnGround(asked, "samples", within(1, 65536)); },
                       "1 to 65536", "samples")},
         .take = into<&BakeOptions::samples>},
        {.key = "error",
         .value = numberValue({0, 1, true, true}),
         .help = "relative error at which the bake ends",
         .advice = "0.02 is two percent",
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = {{[](const Asked& asked) { return asked.has("samples"); }, kOneGoal, kGoals}},
         .take = into<&BakeOptions::error>},
        {.key = "minutes",
         .value = numberValue(above(0, 1e6, "minutes")),
         .help = "time after which the bake ends",
         .advice = "a fraction is fine",
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = {{[](const Asked& asked) { return asked.has("samples") || asked.has("error"); }, kOneGoal,
                    kGoals}},
         .take = into<&BakeOptions::minutes>},
    };
}

std::vector<Option> bakedPlaces() {
    return {
        {.key = "resolution",
         .value = numberValue(within(0.001, 8)),
         .help = "texels per voxel along each axis; of a terrain baked samples per height sample in memory: "
                 "at most 1, or 2, 4, 8 where tiles hold finer ones",
         .advice = "use 0.5, 1 or 2",
         .fallback = "1",
         .rules = resolutionRules(),
         .take = into<&BakeOptions::resolution>},
        {.key = "isovalues",
         .value = numbersValue(isovaluesNumbers()).checked(problemOfRange),
         .help = "bake the surfaces of all isovalues between two, to choose from later",
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = {{[](const Asked& asked) { return asked.has("isovalue"); }, kOneRange, kRanges}},
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<BakeOptions>().isovalues = ValueRange{value.numbers[0], value.numbers[1]};
             }},
        {.key = "reach",
         .value = numberValue(kReachRange),
         .help = "distance at which rays stop looking for light from outside: a ray that meets nothing "
                 "before is open",
         .advice = kReachAdvice,
         .fallback = "no limit; in a colon its mean radius for openness",
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .take = into<&BakeOptions::reach_mm>},
        {.key = "full",
         .value = flagValue(),
         .help = "bake every texel, for any isovalue",
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = {{[](const Asked& asked) { return asked.has("isovalues"); }, kOneRange, kRanges}},
         .take = into<&BakeOptions::full>},
        {.key = "out",
         .value = fileValue(),
         .help = "the bake's file",
         .fallback = "in the cache",
         .take = into<&BakeOptions::out>},
    };
}

std::vector<Option> bakeOptions() {
    std::vector<Option> all = bakedLights();
    all.push_back({.key = "what",
                   .value = wordValue({"irradiance", "transfer", "openness"}),
                   .help = "what to bake: irradiance, transfer (light can be turned later), or openness",
                   .advice = "use irradiance, transfer or openness",
                   .fallback = "irradiance; terrains transfer",
                   .rules = {{[](const Asked& asked) {
                                  return asked.shows(kTerrains) && asked.is("what", "irradiance");
                              },
                              "expected transfer or openness for a terrain, got \"irradiance\"",
                              "transfer has shadows and bounced light, openness the sky's light alone"}},
                   .take = into<&BakeOptions::what>});
    for (const auto& part : {bakeGoals(), bakedPlaces()}) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace

Command bakeCommand() {
    return {.name = "bake",
            .help = "compute light beforehand, with bounces and soft shadows; Ctrl-C keeps what is done",
            .scenes = scene_type::kTerrains | scene_type::kVolumes,
            .command = command::kBake,
            .traits = command::kTelling,
            .chapter = Chapter::Light,
            .options = bakeOptions,
            .start = startOf<BakeOptions, runBake>};
}

}  // namespace stereonav
