// Options: a scene shown as a medium that light goes through.
#include "app/options/option_numbers.h"
#include "app/options/option_table.h"
#include "app/options/option_take.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"
#include "engine/medium/model/medium_transfer.h"

namespace stereonav {
namespace {

using namespace command;
using namespace scene_type;

// Refuses an option that the chosen model ignores; in a window a key chooses another model.
OptionRule unlessModel(bool (*leavesOut)(const Asked&)) {
    return {leavesOut, "has no effect on the model {model}", "leave it out, or choose another --model"};
}
bool ownModel(const Asked& asked) {
    return asked.has("model") && !asked.runs(kView);
}

std::vector<Option> mediumItself() {
    return {
        {.key = "medium",
         .value = fileOrWordValue({"ground"}),
         .help = "show the scene as a medium that light goes through: a file, ground (a terrain in its own "
                 "colours), " +
                 mediumPresetNames(),
         .also = "fog cloud smoke volumetric",
         .group = kMediumGroup,
         .commands = kShowing,
         .scenes = kNoMesh,
         .rules = {{[](const Asked& asked) {
                        return asked.is("medium", "ground") && !asked.shows(kTerrains);
                    },
                    "ground is for terrains", "the presets are " + mediumPresetNames() + ", or name a file"}},
         .panel = OptionPanel::Medium,
         .take = into<&SceneOptions::medium, &MediumOptions::medium>},
        {.key = "model",
         .value = wordValue({"emission", "surface", "direct", "indirect"}),
         .help = "how light goes through the medium",
         .advice = "the models are emission, surface, direct, indirect",
         .group = kMediumGroup,
         .fallback = "indirect",
         .commands = kShowing,
         .scenes = kMedia,
         .panel = OptionPanel::Medium,
         .take = into<&SceneOptions::medium, &MediumOptions::model>},
        {.key = "phase",
         .value = fileOrWordValue({}),
         .help = "how the medium scatters: none, \"hg G\", a preset or a file",
         .group = kMediumGroup,
         .fallback = "none",
         .commands = kShowing,
         .scenes = kMedia,
         .rules = {unlessModel([](const Asked& asked) {
             return ownModel(asked) && !asked.is("model", "indirect") && !asked.is("model", "direct");
         })},
         .panel = OptionPanel::Medium,
         .take = into<&SceneOptions::medium, &MediumOptions::phase>},
        {.key = "noise",
         .value = fileOrWordValue({"cloud", "fur", "none"}),
         .help = "noise that adds detail to the medium's shape and properties: cloud, fur, none, or a file",
         .group = kMediumGroup,
         .commands = kShowing,
         .scenes = kMedia,
         .panel = OptionPanel::Medium,
         .take = into<&SceneOptions::medium, &MediumOptions::noise>},
        {.key = "mist",
         .value = numbersValue(mistNumbers()),
         .help = "mist over a terrain, up to a height",
         .group = kMediumGroup,
         .commands = kShowing,
         .scenes = kTerrainMedium,
         .panel = OptionPanel::Medium,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.scene->medium.mist = Mist{value.numbers[0], value.numbers[1]};
             }},
    };
}

std::vector<Option> mediumLight() {
    return {
        {.key = "light-from",
         .value = numbersValue(sunNumbers()),
         .help = "direction that parallel light comes from, clockwise from north",
         .also = "sun direction shadows",
         .group = kMediumGroup,
         .commands = kShowing,
         .scenes = kMedia,
         .panel = OptionPanel::Light,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->medium.lightFrom = lightPlaceOf(value); }},
        {.key = "lamp",
         .value = numbersValue(lampNumbers()),
         .help = "position of a lamp, in place of parallel light; head: midway between the eyes",
         .group = kMediumGroup,
         .commands = kShowing,
         .scenes = kMedia,
         .excludes = {{"light-from"}},
         .panel = OptionPanel::Light,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.scene->medium.lamp = value.word == kHeadLamp ? LampChoice{} : LampChoice{placeOf(value)};
             }},
        {.key = "light-color",
         .value = numbersValue(colorNumbers()),
         .help = "colour of the light, in linear RGB",
         .group = kMediumGroup,
         .commands = kShowing,
         .scenes = kMedia,
         .rules = {unlessModel(
             [](const Asked& asked) { return ownModel(asked) && asked.is("model", "emission"); })},
         .panel = OptionPanel::Light,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->medium.lightColor = glm::vec3(colorOf(value)); }},
    };
}

std::vector<Option> mediumFineness() {
    return {
        {.key = "slices",
         .value = wholeValue(within(1, 65536, "slices")),
         .help = "number of slices across the medium",
         .advice = "256 is the default; finer is slower",
         .group = kMediumGroup,
         .fallback = "256; terrains 1200, colons 500",
         .commands = kShowing,
         .scenes = kMedia,
         .panel = OptionPanel::Quality,
         .take = into<&SceneOptions::medium, &MediumOptions::slices>},
        {.key = "light-size",
         .value = wholeValue(within(8, 4096, "texels")),
         .help = "side of the light buffer",
         .advice = "256 is the default",
         .group = kMediumGroup,
         .fallback = "256; terrains 512",
         .commands = kShowing,
         .scenes = kMedia,
         .panel = OptionPanel::Quality,
         .take = into<&SceneOptions::medium, &MediumOptions::lightSize>},
        {.key = "cone",
         .value = numberValue(within(0, 171.88, "degrees")),  // less than 3 radians
         .help = "angle of the cone in which scattered light spreads",
         .advice = "34.4 is the default; 0 lets scattered light go straight on",
         .group = kMediumGroup,
         .fallback = "34.4",
         .commands = kShowing,
         .scenes = kMedia,
         .rules = {unlessModel(
             [](const Asked& asked) { return ownModel(asked) && !asked.is("model", "indirect"); })},
         .panel = OptionPanel::Medium,
         .take = into<&SceneOptions::medium, &MediumOptions::cone_deg>},
        {.key = "shading-width",
         .value = numberValue(within(0, 16, "voxels")),
         .help = "distance between the points where surfaces are shaded; 0: at each sample",
         .advice = "1 is the default; 0 shades at each sample",
         .group = kMediumGroup,
         .fallback = "1",
         .commands = kShowing,
         .scenes = kMedia,
         .rules = {{[](const Asked& asked) { return asked.shows(kTerrainMedium); },
                    "only for volumes: a terrain's surfaces are shaded at each sample", kLeaveItOut}},
         .panel = OptionPanel::Quality,
         .take = into<&SceneOptions::medium, &MediumOptions::shadingWidth>},
    };
}

}  // namespace

std::vector<Option> mediumOptions() {
    std::vector<Option> all = mediumItself();
    for (const auto& part : {mediumLight(), mediumFineness()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace stereonav
