// Options: how a scene looks, its light and its eyes.
#include "app/options/option_numbers.h"
#include "app/options/option_table.h"
#include "app/options/option_take.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"
#include "engine/base/error.h"
#include "engine/camera/view_ranges.h"

namespace stereonav {
namespace {

using namespace command;
using namespace scene_type;

constexpr const char* kPhysicalSky = "physical";
constexpr NumberRange kVisibilityRange = within(0.01, 1e4, "km");

bool isLazy(const Asked& asked) {
    return asked.is("light", "lazy") || asked.is("light", "lazy-transfer");
}
bool isTraced(const Asked& asked) {
    return asked.is("light", "traced");
}
bool isTranslucent(const Asked& asked) {
    return asked.has("transfer") || asked.has("opacity");
}
bool turnsSky(const Asked& asked) {
    return asked.given.number("turn") != 0 || asked.given.number("tilt") != 0;
}
bool isPhysicalSky(const Asked& asked) {
    return asked.is("sky", kPhysicalSky);
}
bool isGround(const Asked& asked) {
    return asked.is("medium", "ground");
}

// Stores --sky: a picture; for traced light also a colour; for a terrain also scattering.
void takeSky(OptionTargets& to, const OptionValue& value) {
    if (value.text == kPhysicalSky)
        to.scene->physicalSky = true;
    else if (numbersFromText(value.text).empty())
        to.scene->sky = value.text;
    else
        to.scene->skyColor =
            glm::vec3(colorOf(readValue("--sky", numbersValue(skyNumbers()), "", value.text)));
}
std::optional<ValueProblem> problemOfSky(const std::string& text) {
    if (numbersFromText(text).empty()) return std::nullopt;
    try {
        readValue("", numbersValue(skyNumbers()), "", text);
        return std::nullopt;
    } catch (const Error&) {
        return ValueProblem{"expected " + listText(skyNumbers()) + " or a picture, got " + shownText(text),
                            skyNumbers().advice};
    }
}

std::vector<OptionRule> skyRules() {
    return {
        {[](const Asked& asked) {
             return !isTraced(asked) && !numbersFromText(asked.given.text("sky")).empty();
         },
         "a colour is expected with --light traced", "name a picture"},
        {[](const Asked& asked) { return isPhysicalSky(asked) && !asked.shows(kTerrains); },
         "physical expects a terrain, whose air it is", "name a picture"},
        {[](const Asked& asked) { return isPhysicalSky(asked) && asked.shows(kTerrainMedium); },
         "physical does not go with a terrain shown as a medium, which has no air", kLeaveOneOut},
        {[](const Asked& asked) { return asked.shows(kVolumes) && !asked.has("light"); },
         "expected with light that was baked for a CT study", "name it with --light, or leave it out"},
    };
}

constexpr const char* kGroundAdvice = "leave it out, or choose --medium ground";

std::vector<OptionRule> lightRules() {
    return {
        {[](const Asked& asked) { return asked.shows(kTerrainMedium); },
         "does not go with a terrain shown as a medium", kLeaveOneOut},
        {[](const Asked& asked) { return asked.shows(kBuiltInMedium) && !isTraced(asked); },
         "expected with a terrain or a CT study, {SCENE} is built in", kLeaveItOut},
        {[](const Asked& asked) { return isTraced(asked) && !asked.runs(kRender); },
         "traced is expected with render", "bake the light, and name its file"},
        {[](const Asked& asked) { return isTraced(asked) && !asked.shows(kSurfaces); },
         "traced expects the surface of a CT study or of the built-in colon", kLeaveItOut},
        {[](const Asked& asked) {
             return isTraced(asked) && (turnsSky(asked) || isTranslucent(asked) || asked.has("shading"));
         },
         "traced expects an opaque surface under a sky that stands still",
         "leave out --turn, --tilt, --transfer, --opacity and --shading"},
        {[](const Asked& asked) { return isLazy(asked) && asked.shows(kTerrains); },
         "{light} expects the surface of a CT study or of the built-in colon", kLeaveItOut},
        {[](const Asked& asked) { return asked.is("light", "plain") && !asked.runs(kView); },
         "plain is expected with view: other commands work out no light by themselves", kLeaveItOut},
        {[](const Asked& asked) { return asked.is("light", "plain") && !asked.shows(kTerrains); },
         "plain expects an elevation model, whose light is worked out behind the window", kLeaveItOut},
        {[](const Asked& asked) { return asked.is("light", "auto") && !asked.shows(kTerrains); },
         "auto is the bake of a terrain, which lies in the cache", "name the bake's file"},
        {[](const Asked& asked) { return isLazy(asked) && asked.shows(kMedia); },
         "{light} expects an opaque surface, this is a medium", "bake the light and name its file"},
        {[](const Asked& asked) { return isLazy(asked) && !asked.runs(kView | kRender); },
         "{light} is expected with view or render", "bake the light, and name its file"},
        {[](const Asked& asked) { return isLazy(asked) && isTranslucent(asked); },
         "{light} expects an opaque surface", "leave out --transfer and --opacity"},
    };
}

std::vector<OptionRule> sunRules() {
    constexpr const char* kOtherMedium =
        "has no effect on a terrain shown as another medium than ground, under --light-from or --lamp";
    return {
        {[](const Asked& asked) {
             return asked.shows(kTerrainMedium) && !isGround(asked) &&
                    (asked.has("light-from") || asked.has("lamp"));
         },
         kOtherMedium, kGroundAdvice},
        {[](const Asked& asked) { return asked.has("light-from"); }, "does not go with --light-from",
         "leave one of them out: both say where a medium's light comes from"},
        {[](const Asked& asked) { return asked.has("lamp"); }, "does not go with --lamp",
         "leave one of them out: a lamp takes the sun's place"},
    };
}

}  // namespace

std::vector<Option> lookOptions() {
    return {
        {.key = "image",
         .value = fileValue(),
         .help = "colour of the ground",
         .commands = kShowing | kMesh,
         .scenes = kTerrains,
         .rules = {{[](const Asked& asked) { return asked.shows(kTerrainMedium) && !isGround(asked); },
                    "has no effect on a terrain shown as another medium than ground", kGroundAdvice}},
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::image>},
        {.key = "shade-image",
         .value = flagValue(),
         .help = "light that picture by the sun, though it holds the light of its own day",
         .commands = kShowing | kMesh,
         .scenes = kTerrains,
         .rules = {{[](const Asked& asked) { return asked.shows(kTerrainMedium); },
                    "a medium's own light falls on the picture's colours as they are", kLeaveItOut}},
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::shadeImage>},
        {.key = "sky",
         .value = fileOrWordValue({kPhysicalSky}).checked(problemOfSky),
         .help = "a panorama or a light probe (.hdr); physical: a terrain's sky and its air by scattering of "
                 "sunlight, in the place of fog; with --light traced also a colour",
         .commands = kShowing,
         .scenes = kTerrains | kVolumes,
         .rules = skyRules(),
         .panel = OptionPanel::Light,
         .take = [](OptionTargets& to, const OptionValue& value) { takeSky(to, value); }},
        {.key = "visibility",
         .value = numberValue(kVisibilityRange),
         .help = "how far one sees at the sea through the air of --sky physical (meteorological range)",
         .advice = "5 is haze, 60 a clear day, 250 the cleanest air",
         .fallback = "60",
         .commands = kShowing,
         .scenes = kTerrains,
         .rules = {{[](const Asked& asked) { return !isPhysicalSky(asked); }, "expected with --sky physical",
                    "add --sky physical, or leave it out"}},
         .panel = OptionPanel::Light,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->visibility_m = 1e3 * value.number(); }},
        {.key = "light",
         .value = fileOrWordValue({"auto", "plain", "lazy", "lazy-transfer", "traced"}),
         .help =
             "baked light: its file; auto: a terrain's in the cache; plain: none is worked out behind the "
             "window; lazy, lazy-transfer: a volume's, where one looks; traced: paths from every pixel",
         .commands = kShowing,
         .scenes = kNoMesh,
         .rules = lightRules(),
         .panel = OptionPanel::Light,
         .take = [](OptionTargets& to, const OptionValue& value) { to.scene->light = lightChoiceOf(value); }},
        {.key = "sun",
         .value = numbersValue(sunNumbers()),
         .help = "where a terrain's or mesh's sun stands, clockwise from north",
         .commands = kShowing | kMesh,
         .scenes = kTerrains | kMeshFile,
         .rules = sunRules(),
         .panel = OptionPanel::Light,
         .take = [](OptionTargets& to, const OptionValue& value) { to.scene->sun = lightPlaceOf(value); }},
        {.key = "separation",
         .value = numberValue(kSeparationRange),
         .help = "of the eyes; 0.001, a millimetre, is usual in a colon",
         .advice = "1/30 of the zero-parallax distance is comfortable",
         .commands = kShowing,
         .excludes = {{"relative-separation"}},
         .panel = OptionPanel::View,
         .take = into<&SceneOptions::separation_m>},
        {.key = "zero-parallax",
         .value = numberValue(kZeroParallaxRange),
         .help = "distance seen in the screen",
         .advice = "use the distance to what should lie in the screen",
         .commands = kShowing,
         .panel = OptionPanel::View,
         .take = into<&SceneOptions::zeroParallax_m>},
        {.key = "fov",
         .value = numberValue(kFovRange),
         .help = "vertical field of view",
         .advice = "45 is common",
         .commands = kShowing,
         .panel = OptionPanel::View,
         .take = into<&SceneOptions::fov_deg>},
    };
}

}  // namespace stereonav
