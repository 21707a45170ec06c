// Options of `bake`. The light that is baked has other words than the light that scenes are shown in.
#include "app/options/option_numbers.h"
#include "app/options/option_table.h"
#include "app/options/usual_words.h"
#include "engine/light/skies/spherical_harmonics.h"

namespace stereonav {
namespace {

using namespace command;
using namespace scene_type;

bool isTransfer(const Asked& asked) {
    return asked.is("what", "transfer");
}
bool isOpenness(const Asked& asked) {
    return asked.is("what", "openness");
}
bool isStudyOpenness(const Asked& asked) {
    return isOpenness(asked) && asked.shows(kVolumes);
}

// Of terrains the light is chosen when it is shown.
OptionRule chosenWhenShown() {
    return {nullptr, "expected with a CT study, the scene is a terrain",
            "a terrain's sun and sky are chosen when it is shown: --sun, --sky"};
}

// Lights go with irradiance alone.
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

constexpr const char* kGoals = "choose one of --samples, --error and --minutes";
constexpr const char* kOneGoal = "does not go with another way to end the bake";
constexpr const char* kRanges = "choose one of --isovalue, --isovalues and --full";
constexpr const char* kOneRange = "does not go with another choice of surfaces";

std::vector<Option> bakedLights() {
    return {
        {.key = "light",
         .value = numbersValue(pointLightNumbers()),
         .help = kPointLightHelp,
         .commands = kBake,
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = bakedLightRules(),
         .repeated = true,
         .take = [](OptionTargets& to, const OptionValue& value) { to.bake->lights.push_back(value.text); }},
        {.key = "probe",
         .value = fileValue(),
         .help = "light from all around: a light probe (.hdr) or a picture",
         .commands = kBake,
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = bakedLightRules(),
         .take = [](OptionTargets& to, const OptionValue& value) { to.bake->probe = value.text; }},
        {.key = "sky",
         .value = numbersValue(skyNumbers()),
         .help = "of a volume: light from everywhere",
         .commands = kBake,
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = bakedLightRules(),
         .take = [](OptionTargets& to, const OptionValue& value) { to.scene->sky = value.text; }},
        {.key = "bounces",
         .value = wholeValue(kBouncesRange),
         .help = kBouncesHelp,
         .advice = kBouncesAdvice,
         .commands = kBake,
         .rules = {unlessBounced(), unlessOpenGround()},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.bake->bounces = static_cast<int>(value.whole); }},
        {.key = "albedo",
         .value = numbersValue(albedoNumbers()),
         .help = kAlbedoHelp,
         .commands = kBake,
         .rules = {unlessBounced(), unlessOpenGround()},
         .take = [](OptionTargets& to, const OptionValue& value) { to.bake->albedo = value.text; }},
        {.key = "order",
         .value = wholeValue(within(1, kMaxHarmonicsOrder)),
         .help = "of transfer's harmonics",
         .advice = "5 is usual",
         .commands = kBake,
         .rules = {unlessOpenGround(),
                   {[](const Asked& asked) { return asked.shows(kVolumes) && !isTransfer(asked); },
                    "expected with --what transfer", kLeaveItOut}},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.bake->order = static_cast<int>(value.whole); }},
    };
}

std::vector<Option> bakeGoals() {
    return {
        {.key = "samples",
         .value = wholeValue(kSamplesRange),
         .help = "of each texel, 256 when nothing is said; of a terrain 32, each bounce",
         .advice = kSamplesAdvice,
         .fallback = "256; of a terrain 32",
         .commands = kBake,
         .rules = {unlessOpenGround()},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.bake->samples = static_cast<int>(value.whole); }},
        {.key = "error",
         .value = numberValue({0, 1, true, true}),
         .help = "go on until the relative error is this",
         .advice = "0.02 is two percent",
         .commands = kBake,
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = {{[](const Asked& asked) { return asked.has("samples"); }, kOneGoal, kGoals}},
         .take = [](OptionTargets& to, const OptionValue& value) { to.bake->error = value.number(); }},
        {.key = "minutes",
         .value = numberValue(above(0, 1e6, "minutes")),
         .help = "go on for so long",
         .advice = "a fraction is fine",
         .commands = kBake,
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = {{[](const Asked& asked) { return asked.has("samples") || asked.has("error"); }, kOneGoal,
                    kGoals}},
         .take = [](OptionTargets& to, const OptionValue& value) { to.bake->minutes = value.number(); }},
    };
}

std::vector<Option> bakedPlaces() {
    return {
        {.key = "resolution",
         .value = numberValue(within(0.001, 8, "texels a voxel")),
         .help = "along each axis; of a terrain baked samples a height sample, at most 1",
         .advice = "use 0.5, 1 or 2",
         .fallback = "1",
         .commands = kBake,
         .take = [](OptionTargets& to, const OptionValue& value) { to.bake->resolution = value.number(); }},
        {.key = "isovalues",
         .value = numbersValue(isovaluesNumbers()),
         .help = "all surfaces between, to choose from later",
         .commands = kBake,
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = {{[](const Asked& asked) { return asked.has("isovalue"); }, kOneRange, kRanges}},
         .take = [](OptionTargets& to, const OptionValue& value) { to.bake->isovalues = value.text; }},
        {.key = "reach",
         .value = numberValue(kReachRange),
         .help = "that rays look for light from outside: what meets nothing within them is open; "
                 "left out: no limit, in a colon its mean radius for openness",
         .advice = kReachAdvice,
         .fallback = "no limit; in a colon its mean radius for openness",
         .commands = kBake,
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .take = [](OptionTargets& to, const OptionValue& value) { to.bake->reach_mm = value.number(); }},
        {.key = "full",
         .value = flagValue(),
         .help = "every texel, for any isovalue",
         .commands = kBake,
         .scenes = kVolumes,
         .elsewhere = chosenWhenShown(),
         .rules = {{[](const Asked& asked) { return asked.has("isovalues"); }, kOneRange, kRanges}},
         .take = [](OptionTargets& to, const OptionValue&) { to.bake->full = true; }},
        {.key = "out",
         .value = fileValue(),
         .help = "the bake's file; left out: in the cache",
         .fallback = "in the cache",
         .commands = kBake,
         .take = [](OptionTargets& to, const OptionValue& value) { to.bake->out = value.text; }},
    };
}

}  // namespace

std::vector<Option> bakeOptions() {
    std::vector<Option> all = bakedLights();
    all.push_back({.key = "what",
                   .value = wordValue({"irradiance", "transfer", "openness"}),
                   .help = "irradiance, transfer (light can be turned later), or openness",
                   .advice = "use irradiance, transfer or openness",
                   .fallback = "irradiance; of a terrain transfer",
                   .commands = kBake,
                   .rules = {{[](const Asked& asked) {
                                  return asked.shows(kTerrains) && asked.is("what", "irradiance");
                              },
                              "expected transfer or openness for a terrain, got \"irradiance\"",
                              "transfer has shadows and bounced light, openness the sky's light alone"}},
                   .take = [](OptionTargets& to, const OptionValue& value) { to.bake->what = value.text; }});
    for (const auto& part : {bakeGoals(), bakedPlaces()}) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace stereonav
