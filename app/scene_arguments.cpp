#include "app/scene_arguments.h"

#include <CLI/CLI.hpp>
#include <string>

#include "app/medium_options.h"
#include "app/volume_ambient.h"
#include "app/volume_light.h"
#include "colon/transfer_presets.h"

namespace stereonav {
namespace {

constexpr const char* kStudyGroup = "Options of CT studies";

// Which surface is shown instead of a colon.
void addSurface(CLI::App& command, VolumeOptions& options) {
    command
        .add_flag("--isosurface", options.isosurface,
                  "show the volume from outside, without looking for a colon")
        ->group(kStudyGroup);
    command.add_option("--isovalue", options.isovalue, "the value of that surface")->group(kStudyGroup);
    command.add_option("--up", options.up, kUpHelp)->group(kStudyGroup);
}

void addVolumeLook(CLI::App& command, VolumeOptions& options) {
    const auto add = [&](const char* name, auto& value, const std::string& help) {
        return command.add_option(name, value, help)->group(kStudyGroup);
    };
    add("--transfer", options.transfer,
        "colours and opacities by value: translucent; a file, or one of " + transferPresetNames());
    add("--opacity", options.opacity, "a translucent wall that takes this share of light a millimetre, 0..1");
    add("--shading", options.shading, "to compare: " + shadingNames());
    add("--ambient", options.ambient_mm,
        "ambient light, k times openness times colour in place of the lamp's (Ruiz et al. 2010): how far "
        "openness looks around, in millimetres; not with --light");
    add("--ambient-method", options.ambientMethod,
        "how openness is estimated, gaussian when left out: " + occlusionMethodNames() +
            "; B: an exponent in place of the fitted one; S: standard deviations, 3 when left out");
    add("--ambient-strength", options.ambientStrength,
        "k of ambient light, 1 when left out; 2 shows a flat wall in its own colour");
    add("--ambient-lamp", options.ambientLamp, "0 to 1: share of the lamp's direct light beside it");
    add("--modulate", options.modulate,
        "opacity of translucent volumes by the variance of the values around, or by the gradient of their "
        "openness (Ruiz et al. 2010): variance, gradient or none");
    add("--modulate-radius", options.modulateRadius_mm,
        "how far that looks around, in millimetres; left out: as --ambient, or 10 voxels");
    add("--modulate-sigma", options.modulateSigma,
        "from where on opacity stays whole: a standard deviation in the volume's values, or for gradient a "
        "change of openness a voxel; left out: such that a tenth of what differs stays whole");
    add("--exposure", options.exposure, "factor on baked light; left out: by its mean");
    add("--turn", options.turn_deg,
        "degrees by which the sky over baked transfer is turned about the vertical");
    add("--tilt", options.tilt_deg,
        "degrees by which that sky is tilted before it is turned, -90 to 90: what lies north rises");
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
    add("--label", options.label, "the label of a mask with several");
    add("--seed", options.seeds,
        "x,y,z inside the colon, millimetres to the patient's left, back and head (LPS), as radiology tools "
        "show them (RAS ones: turn the first two signs); may be given several times")
        ->allow_extra_args(false);
    flag("--resample", options.resample, "mend missing, uneven or tilted slices");
    flag("--backwards", options.backwards, "fly from the caecum to the rectum");
    command.add_flag("!--no-cache", options.cache, "neither read nor keep what was computed")
        ->group(kStudyGroup);
}

void addThreads(CLI::App& command, SceneOptions& options) {
    command.add_option("--threads", options.threads, "threads to use, 0 for all processors");
}

// How the ground of a terrain is read.
void addGround(CLI::App& command, SceneOptions& options) {
    command.add_option("--vertical-scale", options.verticalScale, "factor on heights")
        ->check(CLI::PositiveNumber);
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
        "baked light: a file; of a terrain also auto, for the one that bake has put by; of a "
        "volume in view also lazy, worked out while one flies, or lazy-transfer, for a sky that turns; in "
        "render also traced, paths from every pixel");
    command.add_option("--sun", options.sun, kSunHelp);
    command.add_option("--separation", options.separation_m,
                       "of the eyes, in metres: 0.001 is a millimetre, and usual in a colon");
    command.add_option("--zero-parallax", options.zeroParallax_m, "distance seen in the screen, in metres");
    command.add_option("--fov", options.fov_deg, "vertical field of view in degrees");
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
    add("--light-from", options.lightFrom,
        "azimuth,elevation in degrees: where parallel light comes from, clockwise from north");
    add("--lamp", options.lamp, "a lamp instead: head, midway between the eyes, or x,y,z in metres");
    add("--light-color", options.lightColor, "linear, one number or red,green,blue");
    add("--noise", options.noise, "detail that moves places and properties: cloud, fur, none, or a file");
    add("--mist", options.mist, "top,optical depth: over a terrain, up to a height in metres");
    add("--slices", options.slices, "across the medium, 1 to 65536");
    add("--light-size", options.lightSize, "texels a side of the light's buffer, 8 to 4096");
    add("--cone", options.cone_deg, "degrees in which scattered light spreads, 0 to 180");
    add("--shading-width", options.shadingWidth,
        "voxels between the places where surfaces are shaded, 0 to 16; 0: at each sample");
}

void addTraced(CLI::App& command, TracedOptions& options) {
    constexpr const char* kGroup = "Options of --light traced";
    const auto add = [&](const char* name, auto& value, const char* help) {
        return command.add_option(name, value, help)->group(kGroup);
    };
    add("--samples", options.samples, "paths from each pixel, 64 when left out");
    add("--bounces", options.bounces, "of light between surfaces, 0 to 8");
    add("--albedo", options.albedo, "of the surface, 0 to 1: one number, or red,green,blue");
    add("--point-light", options.lights,
        "x,y,z in metres and its intensity; or centreline and the lights' distance in metres, in a colon; "
        "may "
        "be given several times")
        ->allow_extra_args(false);
    add("--reach", options.reach_mm, "millimetres that rays look for light from outside");
}

}  // namespace stereonav
