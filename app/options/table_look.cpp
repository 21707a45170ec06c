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
         "a colour needs --light traced", "name a picture"},
        {[](const Asked& asked) { return isPhysicalSky(asked) && !asked.shows(kTerrains); },
         "physical expects a terrain, whose air it is", "name a picture"},
        {[](const Asked& asked) { return isPhysicalSky(asked) && asked.shows(kTerrainMedium); },
         "physical does not go with a terrain shown as a medium, which has no air", kLeaveOneOut},
        {[](const Asked& asked) { return asked.shows(kVolumes) && !asked.has("light"); },
         "needs light that was baked for a CT study", "name it with --light, or leave it out"},
    };
}

constexpr const char* kGroundAdvice = "leave it out, or choose --medium ground";

std::vector<OptionRule> lightRules() {
    return {
        {[](const Asked& asked) { return asked.shows(kTerrainMedium); },
         "does not go with a terrain shown as a medium", kLeaveOneOut},
        {[](const Asked& asked) { return asked.shows(kBuiltInMedium) && !isTraced(asked); },
         "only for terrains and CT studies, {SCENE} is built in", kLeaveItOut},
        {[](const Asked& asked) { return isTraced(asked) && !asked.runs(kRender); }, "traced is for render",
         "bake the light, and name its file"},
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
         "plain is for view: other commands compute no light unasked", kLeaveItOut},
        {[](const Asked& asked) { return asked.is("light", "plain") && !asked.shows(kTerrains); },
         "plain expects an elevation model: only its light is computed while the window is open",
         kLeaveItOut},
        {[](const Asked& asked) { return asked.is("light", "auto") && !asked.shows(kTerrains); },
         "auto expects a terrain, whose bake lies in the cache", "name the bake's file"},
        {[](const Asked& asked) { return isLazy(asked) && asked.shows(kMedia); },
         "{light} expects an opaque surface, this is a medium", "bake the light and name its file"},
        {[](const Asked& asked) { return isLazy(asked) && !asked.runs(kView | kRender); },
         "{light} is for view and render", "bake the light, and name its file"},
        {[](const Asked& asked) { return isLazy(asked) && isTranslucent(asked); },
         "{light} expects an opaque surface", "leave out --transfer and --opacity"},
    };
}

std::vector<OptionRule> sunRules() {
    constexpr const char* kOtherMedium =
        "with --light-from or --lamp has no effect on a terrain shown as another medium than ground";
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
        {.key = "look",
         .value = wordValue({"auto", "plain"}),
         .help = "how the scene looks where no other option says: auto: first view, light, surface and tone "
                 "that suit it; plain: the data as they are, under the sun or a lamp alone",
         .also = "style appearance preset automatic",
         .fallback = "auto; with compare plain",
         .commands = kShowing | kBake,
         .panel = OptionPanel::View,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->chosenLook = value.text == "auto"; }},
        {.key = "image",
         .value = fileValue(),
         .help = "picture that colours the ground, such as an aerial photo",
         .also = "drape texture orthophoto satellite raster layer overlay basemap imagery",
         .commands = kShowing | kMesh,
         .scenes = kTerrains,
         .rules = {{[](const Asked& asked) { return asked.shows(kTerrainMedium) && !isGround(asked); },
                    "has no effect on a terrain shown as another medium than ground", kGroundAdvice}},
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::image>},
        {.key = "shade-image",
         .value = flagValue(),
         .help = "shade the picture of --image by the sun, on top of the light that it was taken in",
         .also = "hillshade relief layer",
         .commands = kShowing | kMesh,
         .scenes = kTerrains,
         .rules =
             {{[](const Asked& asked) { return asked.shows(kTerrainMedium); },
               "does not go with a terrain shown as a medium, whose light falls on the picture's own colours",
               kLeaveItOut}},
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::shadeImage>},
        {.key = "sky",
         .value = fileOrWordValue({kPhysicalSky}).checked(problemOfSky),
         .help = "the sky: a panorama or a light probe (.hdr); physical: a terrain's sky and haze, computed "
                 "from sunlight scattered in the air; with --light traced also a colour",
         .also = "background environment panorama hdri atmosphere haze",
         .commands = kShowing,
         .scenes = kTerrains | kVolumes,
         .rules = skyRules(),
         .panel = OptionPanel::Light,
         .take = [](OptionTargets& to, const OptionValue& value) { takeSky(to, value); }},
        {.key = "visibility",
         .value = numberValue(kVisibilityRange),
         .help = "visibility at sea level in the air of --sky physical (meteorological range)",
         .also = "fog haze atmosphere",
         .advice = "5 is haze, 60 a clear day, 250 the cleanest air",
         .fallback = "60; with --look auto as far as suits the ground, 60 to 250",
         .commands = kShowing,
         .scenes = kTerrains,
         .rules = {{[](const Asked& asked) { return !isPhysicalSky(asked); }, "needs --sky physical",
                    "add --sky physical, or leave it out"}},
         .panel = OptionPanel::Light,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->visibility_m = 1e3 * value.number(); }},
        {.key = "light",
         .value = fileOrWordValue({"auto", "plain", "lazy", "lazy-transfer", "traced"}),
         .help = "the light: a file that bake wrote; auto: the bake of a terrain in the cache; plain: none "
                 "is computed while the window is open; lazy, lazy-transfer: light of a volume, computed "
                 "where it is seen; traced: path tracing (render)",
         .also = "lighting illumination shadows bake hillshade",
         .commands = kShowing,
         .scenes = kNoMesh,
         .rules = lightRules(),
         .panel = OptionPanel::Light,
         .take = [](OptionTargets& to, const OptionValue& value) { to.scene->light = lightChoiceOf(value); }},
        {.key = "sun",
         .value = numbersValue(sunNumbers()),
         .help = "direction of the sun over a terrain or mesh, clockwise from north",
         .also = "hillshade azimuth altitude shadows lighting relief",
         .commands = kShowing | kMesh,
         .scenes = kTerrains | kMeshFile,
         .rules = sunRules(),
         .panel = OptionPanel::Light,
         .take = [](OptionTargets& to, const OptionValue& value) { to.scene->sun = lightPlaceOf(value); }},
        {.key = "separation",
         .value = numberValue(kSeparationRange),
         .help = "distance between the eyes; 0.001 (a millimetre) is usual in a colon",
         .also = "stereo interocular interaxial ipd baseline depth strength",
         .advice = "1/30 of the zero-parallax distance is comfortable",
         .commands = kShowing,
         .excludes = {{"relative-separation"}},
         .panel = OptionPanel::View,
         .take = into<&SceneOptions::separation_m>},
        {.key = "zero-parallax",
         .value = numberValue(kZeroParallaxRange),
         .help = "distance of what appears at the depth of the screen",
         .also = "convergence focus focal depth stereo",
         .advice = "use the distance of what should appear at the depth of the screen",
         .commands = kShowing,
         .panel = OptionPanel::View,
         .take = into<&SceneOptions::zeroParallax_m>},
        {.key = "fov",
         .value = numberValue(kFovRange),
         .help = "vertical field of view",
         .also = "zoom lens camera angle perspective",
         .advice = "45 is common",
         .commands = kShowing,
         .panel = OptionPanel::View,
         .take = into<&SceneOptions::fov_deg>},
    };
}

}  // namespace stereonav
