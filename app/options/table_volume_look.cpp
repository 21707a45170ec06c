// Options: how a volume looks. Transfer function, shading, ambient light, modulated opacity, baked light.
#include "app/options/occlusion_words.h"
#include "app/options/option_table.h"
#include "app/options/option_take.h"
#include "app/options/usual_words.h"
#include "colon/scene/transfer_presets.h"
#include "engine/base/error.h"
#include "engine/camera/view_ranges.h"
#include "engine/light/occlusion/occlusion_modulation.h"
#include "engine/volume/transfer_text.h"

namespace stereonav {
namespace {

using namespace command;
using namespace scene_type;

constexpr NumberRange kLookRange = above(0, 1e6, "mm");  // radius of the neighbourhood
constexpr NumberRange kShareRange = within(0, 1);
constexpr NumberRange kSteepestRange = above(0, kSteepestOpenness);

bool isModulated(const Asked& asked) {
    return asked.has("modulate") && !asked.is("modulate", "none");
}
// Returns what is wrong with a curve; files are checked when the scene is read.
std::optional<ValueProblem> problemOfTransfer(const std::string& text) {
    if (!isCurveText(text)) return std::nullopt;
    try {
        transferFromCurve(text, "");
        return std::nullopt;
    } catch (const Error& error) {
        return ValueProblem{error.what(), ""};
    }
}
bool isSeenThrough(const Asked& asked) {
    return asked.has("transfer") || asked.has("opacity");
}

OptionRule unlessAmbient() {
    return {[](const Asked& asked) { return !asked.has("ambient"); }, "needs --ambient",
            "add --ambient, or leave it out"};
}
OptionRule unlessModulated() {
    return {[](const Asked& asked) { return !isModulated(asked); }, "needs --modulate",
            "add --modulate variance or gradient, or leave it out"};
}
OptionRule unlessBaked() {
    return {[](const Asked& asked) { return !asked.has("light"); },
            "needs light that was baked for a CT study", "name it with --light, or leave it out"};
}
OptionRule unlessItStands() {
    return {[](const Asked& asked) {
                return asked.is("light", "lazy") &&
                       (asked.given.number("turn") != 0 || asked.given.number("tilt") != 0);
            },
            "lazy expects a sky that stands still", "use --light lazy-transfer"};
}

std::vector<OptionRule> shadingRules() {
    return {
        {[](const Asked& asked) {
             const std::string shading = asked.given.text("shading");
             return isSeenThrough(asked) && (shading.ends_with("-shadows") || shading == "fog");
         },
         "{shading} expects an opaque surface",
         "leave out --transfer and --opacity, or use lambert or phong"},
        {[](const Asked& asked) { return asked.has("ambient") && asked.is("shading", "varying"); },
         "varying ambient light does not go with --ambient, which takes its place", kLeaveOneOut},
        {[](const Asked& asked) {
             return asked.has("ambient") && !(asked.given.number("ambient-lamp") > 0) &&
                    !asked.is("shading", "lamp") && !asked.is("shading", "fog");
         },
         "has no effect with --ambient, which is all the light there is",
         "add --ambient-lamp, or leave it out"},
    };
}

std::vector<Option> ambientOptions() {
    return {
        {.key = "ambient",
         .value = numberValue(kLookRange),
         .help = "ambient occlusion (Ruiz et al. 2010) in place of the lamp: its radius",
         .also = "ao ssao occlusion shadows",
         .advice = "try ten voxels' worth",
         .group = kStudyGroup,
         .commands = kShowing,
         .scenes = kSurfaces,
         .rules = {{[](const Asked& asked) { return asked.has("light"); }, "does not go with --light",
                    kLeaveOneOut}},
         .panel = OptionPanel::Light,
         .take = into<&SceneOptions::volume, &VolumeOptions::ambient_mm>},
        {.key = "ambient-method",
         .value = textValue().checked(problemOfOcclusionText).offering(occlusionMethodWords()),
         .help = "how openness is estimated: " + occlusionMethodNames() +
                 "; B: an exponent; S: standard deviations",
         .group = kStudyGroup,
         .fallback = "gaussian",
         .commands = kShowing,
         .scenes = kSurfaces,
         .rules = {{[](const Asked& asked) {
                        return !asked.has("ambient") && !asked.is("modulate", "gradient");
                    },
                    "needs --ambient or --modulate gradient", kLeaveItOut}},
         .panel = OptionPanel::Light,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.scene->volume.ambientMethod =
                     occlusionEstimateFromText(value.text).value_or(OcclusionEstimate());
             }},
        {.key = "ambient-strength",
         .value = numberValue(above(0, 100)),
         .help = "strength of ambient light: factor k on openness times colour",
         .advice = "1 is usual, 2 shows a flat wall in its own colour",
         .group = kStudyGroup,
         .fallback = "1",
         .commands = kShowing,
         .scenes = kSurfaces,
         .rules = {unlessAmbient()},
         .panel = OptionPanel::Light,
         .take = into<&SceneOptions::volume, &VolumeOptions::ambientStrength>},
        {.key = "ambient-lamp",
         .value = numberValue(kShareRange),
         .help = "share of the lamp's direct light added to ambient light",
         .advice = "0 is ambient light alone, 1 adds all of the lamp's direct light",
         .group = kStudyGroup,
         .fallback = "0",
         .commands = kShowing,
         .scenes = kSurfaces,
         .rules = {unlessAmbient()},
         .panel = OptionPanel::Light,
         .take = into<&SceneOptions::volume, &VolumeOptions::ambientLamp>},
    };
}

std::vector<Option> modulationOptions() {
    return {
        {.key = "modulate",
         .value = wordValue(modulationNames()),
         .help = "opacity by the variance of the values around, or by the gradient of openness (Ruiz et al. "
                 "2010)",
         .advice = "it is one of variance, gradient, none",
         .group = kStudyGroup,
         .fallback = "none",
         .commands = kShowing,
         .scenes = kSurfaces,
         .rules = {{[](const Asked& asked) { return isModulated(asked) && !isSeenThrough(asked); },
                    "needs a translucent volume", "add --transfer or --opacity, or leave it out"}},
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::volume, &VolumeOptions::modulate>},
        {.key = "modulate-radius",
         .value = numberValue(kLookRange),
         .help = "radius of the variance or openness for --modulate",
         .advice = "try ten voxels' worth",
         .group = kStudyGroup,
         .fallback = "that of --ambient, or 10 voxels",
         .commands = kShowing,
         .scenes = kSurfaces,
         .rules = {unlessModulated()},
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::volume, &VolumeOptions::modulateRadius_mm>},
        {.key = "modulate-sigma",
         .value = numberValue(above(0, 1e6)),
         .help = "threshold from which opacity stays whole: a standard deviation of values, or with gradient "
                 "a change of openness per voxel",
         .advice = "for gradient 0.05 is usual on surfaces",
         .group = kStudyGroup,
         .fallback = "chosen so that a tenth of what varies stays whole",
         .commands = kShowing,
         .scenes = kSurfaces,
         .rules = {unlessModulated(),
                   {[](const Asked& asked) {
                        return asked.is("modulate", "gradient") &&
                               !kSteepestRange.holds(asked.given.number("modulate-sigma"));
                    },
                    "expected " + rangeText(kSteepestRange) + " beside gradient, got {modulate-sigma}",
                    "a change of openness a voxel; 0.05 is usual on surfaces"}},
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::volume, &VolumeOptions::modulateSigma>},
    };
}

std::vector<Option> bakedLookOptions() {
    return {
        {.key = "exposure",
         .value = numberValue(within(1e-30, 1e6)),
         .help = "factor on baked light",
         .also = "brightness contrast gamma tone",
         .advice = "1 shows a white sky of 1 as white",
         .group = kStudyGroup,
         .fallback = "chosen by the light's mean",
         .commands = kShowing,
         .scenes = kVolumes,
         .rules = {unlessBaked()},
         .panel = OptionPanel::Light,
         .take = into<&SceneOptions::volume, &VolumeOptions::exposure>},
        {.key = "turn",
         .value = numberValue(kTurnRange),
         .help = "angle by which the sky over baked transfer is turned about the vertical",
         .advice = "90 turns a quarter",
         .group = kStudyGroup,
         .fallback = "0",
         .commands = kShowing,
         .scenes = kVolumes,
         .rules = {unlessItStands(), unlessBaked()},
         .panel = OptionPanel::Light,
         .take = into<&SceneOptions::volume, &VolumeOptions::turn_deg>},
        {.key = "tilt",
         .value = numberValue(kUprightRange),
         .help = "angle by which that sky is tilted before it is turned: its north rises",
         .advice = "turn the sky as well for more: --turn",
         .group = kStudyGroup,
         .fallback = "0",
         .commands = kShowing,
         .scenes = kVolumes,
         .rules = {unlessItStands(), unlessBaked()},
         .panel = OptionPanel::Light,
         .take = into<&SceneOptions::volume, &VolumeOptions::tilt_deg>},
    };
}

}  // namespace

std::vector<Option> volumeLookOptions() {
    std::vector<Option> all{
        {.key = "transfer",
         .value = fileOrWordValue({}).checked(problemOfTransfer),
         .help = "show the volume translucent, with colours and opacities by value: a file, " +
                 transferPresetNames() + ", or curve:... in one word",
         .also = "volume rendering colormap palette lut lookup table preset opacity transparency window "
                 "level shift",
         .advice =
             "such a word is curve:-600:1:0.8:0.7:0,-350:1:0.8:0.7:0.95: value, colour and opacity of points",
         .group = kStudyGroup,
         .commands = kShowing,
         .scenes = kSurfaces,
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::volume, &VolumeOptions::transfer>},
        {.key = "opacity",
         .value = numberValue(above(0, 1)),
         .help = "show the wall translucent: share of light that one millimetre takes away",
         .also = "transparency transparent alpha see-through",
         .advice = "0.95 is a wall that is nearly opaque within a millimetre",
         .group = kStudyGroup,
         .commands = kShowing,
         .scenes = kSurfaces,
         .excludes = {{"transfer"}},
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::volume, &VolumeOptions::opacity>},
        {.key = "shading",
         .value = wordValue(shadingNames()),
         .help = "how a surface is lit, for comparisons",
         .also = "phong lighting material specular",
         .advice = "lamp is the default",
         .group = kStudyGroup,
         .fallback = "lamp",
         .commands = kShowing,
         .scenes = kSurfaces,
         .rules = shadingRules(),
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::volume, &VolumeOptions::shading>}};
    for (const auto& part : {ambientOptions(), modulationOptions(), bakedLookOptions()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace stereonav
