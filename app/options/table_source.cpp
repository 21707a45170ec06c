// Options: the scene, and how it is read.
#include "app/options/option_numbers.h"
#include "app/options/option_table.h"
#include "app/options/option_take.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"
#include "terrain/read/scene_ranges.h"

namespace stereonav {
namespace {

constexpr const char *kBuiltInGround = "terrain", *kBuiltInColon = "colon";

}  // namespace

std::vector<Option> sourceOptions() {
    using namespace command;
    using namespace scene_type;
    return {
        {.key = "SCENE",
         .value = textValue().offering({kBuiltInGround, kBuiltInColon, "cloud", "wax"}),
         .help = "a scene file (.toml), an elevation model, a CT study (a folder of DICOM slices, .nrrd, "
                 ".nhdr, .nii, .nii.gz, .mha, .mhd), a mesh (.glb, .gltf), colon, cloud or wax",
         .fallback = "the built-in terrain",
         .commands = kShowing | kBake,
         .inFile = false,
         .take = into<&SceneOptions::scene>},
        {.key = "SCENE",
         .value = textValue().offering({kBuiltInGround}),
         .help = "a scene file (.toml) or an elevation model",
         .fallback = "the built-in terrain",
         .commands = kOfGround,
         .inFile = false,
         .take = into<&SceneOptions::scene>},
        {.key = "SCENE",
         .value = textValue().offering({kBuiltInColon}),
         .help = "a CT study (a folder of DICOM slices, .nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd) or colon",
         .commands = kOfColon,
         .inFile = false,
         .take = into<&SceneOptions::scene>},
        {.key = "vertical-scale",
         .value = numberValue(kVerticalScaleRange),
         .help = "factor on heights",
         .also = "exaggeration exaggerate z factor relief stretch",
         .advice = "use 1 for true heights",
         .fallback = "1",
         .commands = kShowing | kOfGround | kBake,
         .scenes = kTerrains,
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::verticalScale>},
        {.key = "open-holes",
         .value = flagValue(),
         .help = "leave missing ground open instead of filling it",
         .also = "nodata gaps missing voids",
         .commands = kShowing | kOfGround | kBake,
         .scenes = kTerrains,
         .panel = OptionPanel::Material,
         .take = into<&SceneOptions::openHoles>},
        {.key = "tiles",
         .value = wordValue({"auto", "on", "off"}),
         .help = "whether an elevation model is read from tiles on disk, which stay in the cache; auto: "
                 "where it does not fit into memory",
         .fallback = "auto",
         .commands = kShowing | kOfGround | kBake,
         .scenes = kTerrains,
         .take = into<&SceneOptions::tiles>},
        {.key = "memory",
         .value = textValue().checked(problemOfMemory),
         .help = "memory that the program may use, such as 2G or 500M; what needs more is refused, with the "
                 "size that would fit",
         .fallback = "what the system has available",
         .commands = kWithScene,
         .inFile = false,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->memory_bytes = bytesOfMemoryText(value.text); }},
        {.key = "threads",
         .value = wholeValue(kThreadsRange),
         .help = kThreadsHelp,
         .advice = kThreadsAdvice,
         .fallback = "0",
         .commands = kWithScene,
         .panel = OptionPanel::Quality,
         .take = into<&SceneOptions::threads>},
        {.key = "simd",
         .value = wordValue({"auto", "plain", "avx2", "avx512"}),
         .help = "instruction set",
         .advice = "auto takes the widest that this processor has",
         .fallback = "auto",
         .commands = kShowing,
         .panel = OptionPanel::Quality,
         .take = into<&SceneOptions::simd>},
    };
}

}  // namespace stereonav
