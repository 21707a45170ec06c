#include "app/options/scene_arguments.h"

#include <CLI/CLI.hpp>
#include <string>

#include "app/options/number_option.h"
#include "app/options/option_numbers.h"
#include "app/scene/medium_options.h"
#include "app/scene/volume_ambient.h"
#include "app/scene/volume_light.h"
#include "colon/transfer_presets.h"
#include "engine/camera/view_ranges.h"
#include "terrain/scene_ranges.h"

namespace stereonav {
namespace {

constexpr const char* kStudyGroup = "Options of CT studies";
constexpr NumberRange kLookRange = above(0, 1e6, "mm");  // how far around
constexpr NumberRange kShareRange = within(0, 1);

// Which surface is shown instead of a colon.
void addSurface(CLI::App& command, VolumeOptions& options) {
    command
        .add_flag("--isosurface", options.isosurface,
                  "show the volume from outside, without looking for a colon")
        ->group(kStudyGroup);
    addNumber(command, "--isovalue", options.isovalue, kValueRange, "the value of that surface",
              "300 shows bone in CT")
        ->group(kStudyGroup);
    command.add_option("--up", options.up, kUpHelp)->group(kStudyGroup);
}

void addVolumeLook(CLI::App& command, VolumeOptions& options) {
    const auto add = [&](const char* name, auto& value, const std::string& help) {
        return command.add_option(name, value, help)->group(kStudyGroup);
    };
    const auto number = [&](const char* name, auto& value, const NumberRange& range, const char* help,
                            const char* advice) {
        addNumber(command, name, value, range, help, advice)->group(kStudyGroup);
    };
    add("--transfer", options.transfer,
        "colours and opacities by value: translucent; a file, or one of " + transferPresetNames());
    number("--opacity", options.opacity, above(0, 1),
           "a translucent wall that takes this share of light a mm",
           "0.95 is a wall that is nearly opaque within a millimetre");
    add("--shading", options.shading, "to compare: " + shadingNames());
    number("--ambient", options.ambient_mm, kLookRange,
           "ambient light, k times openness times colour in place of the lamp's (Ruiz et al. 2010): how far "
           "openness looks around; not with --light",
           "try ten voxels' worth");
    add("--ambient-method", options.ambientMethod,
        "how openness is estimated, gaussian when left out: " + occlusionMethodNames() +
            "; B: an exponent in place of the fitted one; S: standard deviations, 3 when left out");
    number("--ambient-strength", options.ambientStrength, above(0, 100),
           "k of ambient light, 1 when left out", "1 is usual, 2 shows a flat wall in its own colour");
    number("--ambient-lamp", options.ambientLamp, kShareRange, "share of the lamp's direct light beside it",
           "0 is ambient light alone, 1 adds all of the lamp's direct light");
    add("--modulate", options.modulate,
        "opacity of translucent volumes by the variance of the values around, or by the gradient of their "
        "openness (Ruiz et al. 2010): variance, gradient or none");
    number("--modulate-radius", options.modulateRadius_mm, kLookRange,
           "how far that looks around; left out: as --ambient, or 10 voxels", "try ten voxels' worth");
    number(
        "--modulate-sigma", options.modulateSigma, above(0, 1e6),
        "from where on opacity stays whole: a standard deviation in the volume's values, or for gradient a "
        "change of openness a voxel; left out: such that a tenth of what differs stays whole",
        "for gradient 0.05 is usual on surfaces");
    number("--exposure", options.exposure, within(1e-30, 1e6), "factor on baked light; left out: by its mean",
           "1 shows a white sky of 1 as white");
    number("--turn", options.turn_deg, kTurnRange,
           "by which the sky over baked transfer is turned about the vertical", "90 turns a quarter");
    number("--tilt", options.tilt_deg, kUprightRange,
           "by which that sky is tilted before it is turned: what lies north rises",
           "turn the sky as well for more: --turn");
}

}  // namespace

// Which study, and where the colon is in it.
void addStudy(CLI::App& command, VolumeOptions& options) {
    const auto add = [&](const char* name, auto& value, const std::string& help) {
        return command.add_option(name, value, help)->group(kStudyGroup);
    };
    const auto flag = [&](const char* name, bool& value, const char* help) {
        command.add_flag(name, value, help)->group(kStudyGroup);
    };
    add("--series", options.series, "of a DICOM folder with several: its number in the list, or its UID");
    addNumber(command, "--label", options.label, within(-2147483648.0, 2147483647.0),
              "the label of a mask with several", "stereonav info lists them")
        ->group(kStudyGroup);
    addNumbers(
        command, "--seed", options.seeds, seedNumbers(),
        "a place inside the colon, to the patient's left, back and head, as radiology tools show it (RAS "
        "ones: turn the first two signs); may be given several times")
        ->group(kStudyGroup);
    flag("--resample", options.resample, "mend missing, uneven or tilted slices");
    flag("--backwards", options.backwards, "fly from the caecum to the rectum");
    command.add_flag("!--no-cache", options.cache, "neither read nor keep what was computed")
        ->group(kStudyGroup);
}

void addThreads(CLI::App& command, SceneOptions& options) {
    addNumber(command, "--threads", options.threads, kThreadsRange, kThreadsHelp, kThreadsAdvice);
}

// How the ground of a terrain is read.
void addGround(CLI::App& command, SceneOptions& options) {
    addNumber(command, "--vertical-scale", options.verticalScale, kVerticalScaleRange, "factor on heights",
              "use 1 for true heights");
    command.add_flag("--open-holes", options.openHoles, "leave missing ground open instead of filling it");
}

// Which scene, and how it is read.
void addSource(CLI::App& command, SceneOptions& options) {
    command.add_option(
        "SCENE", options.scene,
        "a scene (.toml), an elevation model, a CT study (.nrrd, .nhdr, .nii, .nii.gz, .mha, "
        ".mhd, a folder of DICOM slices), or colon, cloud or wax, which are built in; left out: the "
        "built-in terrain");
    addGround(command, options);
    addThreads(command, options);
    command.add_option("--simd", options.simd, "instruction set: auto, plain, avx2, avx512");
    addStudy(command, options.volume);
    addSurface(command, options.volume);
}

void addScene(CLI::App& command, SceneOptions& options) {
    addSource(command, options);
    command.add_option("--image", options.image, kImageHelp);
    command.add_flag("--shade-image", options.shadeImage, kShadeImageHelp);
    command.add_option("--sky", options.sky, "an equirectangular picture or a light probe (.hdr)");
    command.add_option(
        "--light", options.light,
        "baked light: a file; of a terrain also auto, the bake in the cache; of a volume, in view and "
        "render, also lazy, computed where one looks, or lazy-transfer, for a sky that turns; in render "
        "also traced, paths from every pixel");
    addNumbers(command, "--sun", options.sun, sunNumbers(), kSunHelp);
    addNumber(command, "--separation", options.separation_m, kSeparationRange,
              "of the eyes: 0.001 is a millimetre, and usual in a colon",
              "1/30 of the zero-parallax distance is comfortable");
    addNumber(command, "--zero-parallax", options.zeroParallax_m, kZeroParallaxRange,
              "distance seen in the screen", "use the distance to what should lie in the screen");
    addNumber(command, "--fov", options.fov_deg, kFovRange, "vertical field of view", "45 is common");
    addVolumeLook(command, options.volume);
}

void addMedium(CLI::App& command, MediumOptions& options) {
    constexpr const char* kGroup = "Options of media";
    const auto add = [&](const char* name, auto& value, const std::string& help) {
        command.add_option(name, value, help)->group(kGroup);
    };
    add("--medium", options.medium,
        "show the scene as a medium that light goes through: a file, or one of " + mediumPresetNames() +
            "; ground: a terrain in its own colours");
    add("--model", options.model, "emission, surface, direct, or indirect, which is the default");
    add("--phase", options.phase, "how the medium scatters: none, \"hg G\", a preset or a file");
    const auto number = [&](const char* name, auto& value, const NumberRange& range, const char* help,
                            const char* advice) {
        addNumber(command, name, value, range, help, advice)->group(kGroup);
    };
    const auto numbers = [&](const char* name, std::string& text, const NumberList& list, const char* help) {
        addNumbers(command, name, text, list, help)->group(kGroup);
    };
    numbers("--light-from", options.lightFrom, sunNumbers(),
            "where parallel light comes from, clockwise from north");
    numbers("--lamp", options.lamp, lampNumbers(), "a lamp instead; head: midway between the eyes");
    numbers("--light-color", options.lightColor, colorNumbers(), "linear");
    add("--noise", options.noise, "detail that moves places and properties: cloud, fur, none, or a file");
    numbers("--mist", options.mist, mistNumbers(), "over a terrain, up to a height");
    number("--slices", options.slices, within(1, 65536, "slices"), "across the medium",
           "256 is the default; finer is slower");
    number("--light-size", options.lightSize, within(8, 4096, "texels"), "a side of the light's buffer",
           "256 is the default");
    number("--cone", options.cone_deg, {0, 180, false, true, "degrees"}, "in which scattered light spreads",
           "35 is the default; 0 lets scattered light go straight on");
    number("--shading-width", options.shadingWidth, within(0, 16, "voxels"),
           "between the places where surfaces are shaded; 0: at each sample",
           "1 is the default; 0 shades at each sample");
}

void addTraced(CLI::App& command, TracedOptions& options) {
    constexpr const char* kGroup = "Options of --light traced";
    addNumber(command, "--samples", options.samples, kSamplesRange, "paths from each pixel, 64 when left out",
              kSamplesAdvice)
        ->group(kGroup);
    addNumber(command, "--bounces", options.bounces, kBouncesRange, kBouncesHelp, kBouncesAdvice)
        ->group(kGroup);
    addNumbers(command, "--albedo", options.albedo, albedoNumbers(), kAlbedoHelp)->group(kGroup);
    addNumbers(command, "--point-light", options.lights, pointLightNumbers(), kPointLightHelp)->group(kGroup);
    addNumber(command, "--reach", options.reach_mm, kReachRange, "that rays look for light from outside",
              kReachAdvice)
        ->group(kGroup);
}

}  // namespace stereonav
