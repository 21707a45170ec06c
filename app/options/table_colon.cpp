// Options: the instruments of colons.
#include "app/options/option_numbers.h"
#include "app/options/option_table.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"
#include "engine/camera/view_ranges.h"

namespace stereonav {
namespace {

std::vector<Option> coverageOptions() {
    using command::kCoverage;
    return {
        {.key = "fov",
         .value = numberValue(kFovRange),
         .help = "vertical field of view",
         .advice = "90 to 140 is usual",
         .fallback = "the scene's own",
         .commands = kCoverage,
         .take = [](OptionTargets& to, const OptionValue& value) { to.scene->fov_deg = value.number(); }},
        {.key = "size",
         .value = sizeValue(),
         .help = "of the picture: its shape alone counts",
         .advice = "try 1280x720",
         .fallback = "512x512",
         .commands = kCoverage,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 *to.size = {static_cast<int>(value.numbers[0]), static_cast<int>(value.numbers[1])};
             }},
        {.key = "path",
         .value = fileValue(),
         .help = "a recorded path (.gltf, .glb, .path)",
         .fallback = "along the centreline",
         .commands = kCoverage,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.path = value.text; }},
        {.key = "step",
         .value = numberValue(within(0.1, 100, "mm")),
         .help = "between the places of the flight that are looked from",
         .advice = "2 is fine",
         .fallback = "2",
         .commands = kCoverage,
         .take = [](OptionTargets& to, const OptionValue& value) { to.coverage->step_mm = value.number(); }},
        {.key = "within",
         .value = numberValue(above(0, 1e6, "mm")),
         .help = "how far from the eye wall counts as seen",
         .advice = "100 is two widths of a colon",
         .fallback = "100",
         .commands = kCoverage,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.coverage->within_mm = value.number(); }},
        {.key = "angle",
         .value = numberValue(above(0, 90, "degrees")),
         .help = "how far off its normal wall counts as seen",
         .advice = "90 leaves nothing out that is on screen",
         .fallback = "85",
         .commands = kCoverage,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.coverage->angle_deg = value.number(); }},
        {.key = "patch",
         .value = numberValue(within(0, 1e9, "mm^2")),
         .help = "the smallest unseen patch that is listed and looked at",
         .advice = "300 is usual in the literature",
         .fallback = "300",
         .commands = kCoverage,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.coverage->patch_mm2 = value.number(); }},
        {.key = "out",
         .value = fileValue(),
         .help = "the unseen patches as a table, .csv or -",
         .commands = kCoverage,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.out = value.text; }},
    };
}

glm::dvec3 placeFrom(const OptionValue& value, int first) {
    return glm::dvec3(value.numbers[first], value.numbers[first + 1], value.numbers[first + 2]) / 1000.0;
}

std::vector<Option> findingsOptions() {
    using command::kFindings;
    return {
        {.key = "at",
         .value = numbersValue(seedNumbers()),
         .help =
             "a polyp: a place on or in it, left, back, head (of RAS turn the first two signs); several are "
             "taken",
         .commands = kFindings,
         .repeated = true,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.findings->at.push_back(placeFrom(value, 0)); }},
        {.key = "comment",
         .value = textValue(),
         .help = "on the finding of --at",
         .commands = kFindings,
         .take = [](OptionTargets& to, const OptionValue& value) { to.findings->comment = value.text; }},
        {.key = "at-truth",
         .value = flagValue(),
         .help = "the polyps of the built-in colon where they are, each measured size beside the true one",
         .commands = kFindings,
         .take = [](OptionTargets& to, const OptionValue&) { to.findings->atTruth = true; }},
        {.key = "candidates",
         .value = flagValue(),
         .help = "places that look like polyps by their shape, the most likely first: to be looked at",
         .commands = kFindings,
         .take = [](OptionTargets& to, const OptionValue&) { to.findings->candidates = true; }},
        {.key = "between",
         .value = numbersValue(betweenNumbers()),
         .help = "two places: their distance; several are taken",
         .commands = kFindings,
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.findings->between.emplace_back(placeFrom(value, 0), placeFrom(value, 3));
             }},
        {.key = "file",
         .value = fileValue(),
         .help = "where findings are kept, .json: those in it are measured again, new ones are added",
         .commands = kFindings,
         .take = [](OptionTargets& to, const OptionValue& value) { to.findings->file = value.text; }},
        {.key = "csv",
         .value = fileValue(),
         .help = "the findings as a table, .csv or -",
         .commands = kFindings,
         .take = [](OptionTargets& to, const OptionValue& value) { to.findings->csv = value.text; }},
        {.key = "page",
         .value = fileValue(),
         .help = "one .html page with pictures of each, or -",
         .commands = kFindings,
         .take = [](OptionTargets& to, const OptionValue& value) { to.findings->page = value.text; }},
        {.key = "sr",
         .value = fileValue(),
         .help =
             "the findings as a DICOM structured report, .dcm or -, with the names in the study's own heads",
         .commands = kFindings,
         .take = [](OptionTargets& to, const OptionValue& value) { to.findings->sr = value.text; }},
    };
}

std::vector<Option> registerOptions() {
    using command::kRegister;
    return {
        {.key = "with",
         .value = fileValue(),
         .help = "the other study, or colon for the built-in one",
         .commands = kRegister,
         .required = true,
         .take = [](OptionTargets& to, const OptionValue& value) { to.registration->with = value.text; }},
        {.key = "with",
         .value = fileValue(),
         .help = "another study of the same colon, whose matching place is shown beside the eye",
         .fallback = "none",
         .commands = command::kView,
         .scenes = scene_type::kSurfaces,
         .take = [](OptionTargets&, const OptionValue&) {}},  // the window has it among its texts
        {.key = "at",
         .value = numbersValue(seedNumbers()),
         .help = "a place of the first study that is looked for in the other; several are taken",
         .commands = kRegister,
         .repeated = true,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.registration->at.push_back(placeFrom(value, 0)); }},
        {.key = "bend",
         .value = numberValue(within(0, 30, "mm")),
         .help = "of --with colon: its loops lie elsewhere, by this much at most",
         .advice = "10 is a patient who has turned round",
         .fallback = "0",
         .commands = kRegister,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.registration->bend_mm = value.number(); }},
        {.key = "inflate",
         .value = numberValue(within(0.7, 1.4)),
         .help = "of --with colon: a factor on its radii",
         .advice = "1.2 is more gas",
         .fallback = "1",
         .commands = kRegister,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.registration->inflate = value.number(); }},
        {.key = "force",
         .value = flagValue(),
         .help = "places are told though the two studies do not match",
         .commands = kRegister,
         .take = [](OptionTargets& to, const OptionValue&) { to.registration->force = true; }},
        {.key = "out",
         .value = fileValue(),
         .help = "places of both every 5 mm as a table, .csv or -",
         .commands = kRegister,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.out = value.text; }},
    };
}

std::vector<Option> unfoldOptions() {
    using command::kUnfold;
    return {
        {.key = "out",
         .value = fileValue(),
         .help = "the picture, .png or .ppm",
         .commands = kUnfold,
         .required = true,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.out = value.text; }},
        {.key = "distortion",
         .value = fileValue(),
         .help = "a picture of how true its areas are: red is drawn too large, blue too small",
         .commands = kUnfold,
         .take = [](OptionTargets& to, const OptionValue& value) { to.unfold->distortion = value.text; }},
        {.key = "panorama",
         .value = fileValue(),
         .help = "a picture of the wall as it is seen along the line, ahead from the rectum and back from "
                 "the caecum",
         .commands = kUnfold,
         .take = [](OptionTargets& to, const OptionValue& value) { to.unfold->panorama = value.text; }},
        {.key = "pixel",
         .value = numberValue(within(0.1, 10, "mm")),
         .help = "of the wall, the side of a pixel",
         .advice = "0.5 is about a voxel",
         .fallback = "0.5",
         .commands = kUnfold,
         .take = [](OptionTargets& to, const OptionValue& value) { to.unfold->pixel_mm = value.number(); }},
        {.key = "at",
         .value = numbersValue(seedNumbers()),
         .help = "a place on the wall: which pixel shows it; several are taken",
         .commands = kUnfold,
         .repeated = true,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.unfold->at.push_back(placeFrom(value, 0)); }},
        {.key = "pick",
         .value = numbersValue(pixelNumbers()),
         .help = "a pixel: which place it shows; several are taken",
         .commands = kUnfold,
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.unfold->pick.emplace_back(static_cast<int>(value.numbers[0]),
                                              static_cast<int>(value.numbers[1]));
             }},
        {.key = "findings",
         .value = fileValue(),
         .help = "a file of stereonav findings, .json: outlined in yellow",
         .commands = kUnfold,
         .take = [](OptionTargets& to, const OptionValue& value) { to.unfold->findings = value.text; }},
        {.key = "candidates",
         .value = flagValue(),
         .help = "places that look like polyps by their shape: outlined in blue",
         .commands = kUnfold,
         .take = [](OptionTargets& to, const OptionValue&) { to.unfold->candidates = true; }},
        {.key = "truth",
         .value = flagValue(),
         .help = "the polyps of the built-in colon: outlined in green, and how each is shown",
         .commands = kUnfold,
         .take = [](OptionTargets& to, const OptionValue&) { to.unfold->truth = true; }},
    };
}

}  // namespace

std::vector<Option> colonInstrumentOptions() {
    std::vector<Option> all;
    for (std::vector<Option> part :
         {coverageOptions(), findingsOptions(), registerOptions(), unfoldOptions()})
        for (Option& option : part) all.push_back(std::move(option));
    return all;
}

}  // namespace stereonav
