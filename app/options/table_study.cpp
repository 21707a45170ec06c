// Options: the study, where the colon is in it, and which surface is shown instead.
#include "app/options/option_numbers.h"
#include "app/options/option_table.h"
#include "app/options/option_take.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"

namespace stereonav {
namespace {

constexpr CommandSet kReading = command::kShowing | command::kOfColon | command::kBake;

constexpr NumberRange kMaskSmoothingRange = within(0, 100, "mm");

OptionRule unlessColonIsLookedFor() {
    return {[](const Asked& asked) { return asked.has("isosurface"); },
            "does not go with --isosurface, which looks for no colon", kLeaveOneOut};
}

// Returns one of the options that add pieces to the colon or remove them.
template <std::vector<glm::dvec3> PieceChoices::*places>
Option pieceChoice(const char* key, const char* help) {
    return {.key = key,
            .value = numbersValue(seedNumbers()),
            .help = help,
            .group = kStudyGroup,
            .commands = kReading,
            .scenes = scene_type::kVolumes,
            .rules = {unlessColonIsLookedFor()},
            .repeated = true,
            .panel = OptionPanel::Study,
            .take = [](OptionTargets& to, const OptionValue& value) {
                (to.scene->volume.choices.*places).push_back(placeOf(value) / 1000.0);
            }};
}

std::vector<OptionRule> fluidRules() {
    const char* const advice = "use out or left";
    return {unlessColonIsLookedFor(),
            {[](const Asked& asked) {
                 return asked.is("fluid", "tinted") &&
                        !asked.runs(command::kRender | command::kPlay | command::kView);
             },
             "tinted shows in pictures of render, play and view alone", advice},
            {[](const Asked& asked) {
                 return asked.is("fluid", "tinted") && (!asked.shows(scene_type::kSurfaces) ||
                                                        asked.has("transfer") || asked.has("opacity"));
             },
             "tinted expects an opaque wall", advice}};
}

}  // namespace

std::vector<Option> studyOptions() {
    using namespace command;
    using namespace scene_type;
    return {
        {.key = "series",
         .value = textValue(),
         .help = "which series of a DICOM folder: its number in the list of info, or its UID",
         .also = "dicom phase",
         .group = kStudyGroup,
         .commands = kReading,
         .scenes = kStudies,
         .panel = OptionPanel::Study,
         .take = into<&SceneOptions::volume, &VolumeOptions::series>},
        {.key = "label",
         .value = textValue(),
         .help = "which label of a mask: its number, or its name where the header names it",
         .also = "segmentation mask segment",
         .advice = "stereonav info lists them",
         .group = kStudyGroup,
         .commands = kReading,
         .scenes = kStudies,
         .panel = OptionPanel::Study,
         .take = into<&SceneOptions::volume, &VolumeOptions::label>},
        {.key = "seed",
         .value = numbersValue(seedNumbers()),
         .help = "a place inside the colon: left, back, head (from RAS change the first two signs); may be "
                 "given several times",
         .also = "segmentation start fiducial point",
         .group = kStudyGroup,
         .commands = kReading,
         .scenes = kVolumes,
         .rules = {unlessColonIsLookedFor()},
         .repeated = true,
         .panel = OptionPanel::Study,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->volume.seeds.push_back(placeOf(value) / 1000.0); }},
        pieceChoice<&PieceChoices::include>(
            "include", "a place in gas or tagged fluid that was left out of the colon, to add it"),
        pieceChoice<&PieceChoices::exclude>(
            "exclude", "a place in gas or tagged fluid that was taken for the colon, to leave it out"),
        {.key = "fluid",
         .value = wordValue(fluidNames()),
         .help = "what becomes of tagged fluid in a colon; out: it is removed; left: its surface is wall; "
                 "tinted: it is removed, and the wall under it is green",
         .also = "tagging cleansing electronic contrast",
         .group = kStudyGroup,
         .fallback = "out",
         .commands = kReading,
         .scenes = kVolumes,
         .rules = fluidRules(),
         .panel = OptionPanel::Study,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->volume.fluid = fluidFromName(value.text); }},
        {.key = "mask-smoothing",
         .value = numberValue(kMaskSmoothingRange),
         .help = "length along a mask's wall over which its bends are averaged; the wall moves by less than "
                 "half a voxel; 0: not at all",
         .also = "smooth segmentation label",
         .advice = "leave it out for two voxels",
         .group = kStudyGroup,
         .fallback = "with --look auto two voxels of the coarsest spacing, else 0",
         .commands = kShowing | kBake,
         .scenes = kStudy,
         .panel = OptionPanel::Study,
         .take = into<&SceneOptions::volume, &VolumeOptions::maskSmoothing_mm>},
        {.key = "resample",
         .value = flagValue(),
         .help = "mend missing, uneven or tilted slices",
         .group = kStudyGroup,
         .commands = kReading,
         .scenes = kStudies,
         .panel = OptionPanel::Study,
         .take = into<&SceneOptions::volume, &VolumeOptions::resample>},
        {.key = "backwards",
         .value = flagValue(),
         .help = "fly from the caecum to the rectum",
         .group = kStudyGroup,
         .commands = kReading,
         .scenes = kVolumes,
         .rules = {unlessColonIsLookedFor()},
         .panel = OptionPanel::Study,
         .take = into<&SceneOptions::volume, &VolumeOptions::backwards>},
        {.key = "no-cache",
         .value = flagValue(),
         .help = "read nothing from the cache and keep nothing in it",
         .group = kStudyGroup,
         .commands = kReading,
         .scenes = kVolumes,
         .rules = {{[](const Asked& asked) { return asked.runs(kBake) && !asked.has("out"); },
                    "leaves no place for what is baked", "name a file with --out"}},
         .panel = OptionPanel::Study,
         .take = [](OptionTargets& to, const OptionValue&) { to.scene->volume.cache = false; }},
    };
}

std::vector<Option> isosurfaceOptions() {
    using namespace command;
    using namespace scene_type;
    return {
        {.key = "isosurface",
         .value = flagValue(),
         .help = "show the volume from outside, without looking for a colon",
         .also = "threshold contour surface model outside",
         .group = kStudyGroup,
         .commands = kShowing | kBake,
         .scenes = kVolumes,
         .panel = OptionPanel::Study,
         .take = into<&SceneOptions::volume, &VolumeOptions::isosurface>},
        {.key = "isovalue",
         .value = numberValue(kValueRange),
         .help = "value of the isosurface",
         .also = "threshold level contour surface hounsfield",
         .advice = "300 shows bone in CT",
         .group = kStudyGroup,
         .commands = kShowing | kBake,
         .scenes = kVolumes,
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::volume, &VolumeOptions::isovalue>},
        {.key = "up",
         .value = wordValue({"x", "-x", "y", "-y", "z", "-z"}),
         .help = kUpHelp,
         .also = "orientation flip axis rotate upside",
         .advice = kUpAdvice,
         .group = kStudyGroup,
         .fallback = "z; with --look auto guessed where the file does not say it",
         .commands = kShowing | kBake,
         .scenes = kVolumes,
         .panel = OptionPanel::Study,
         .take = [](OptionTargets& to, const OptionValue& value) { to.scene->volume.up = upAxisOf(value); }},
    };
}

}  // namespace stereonav
