// Stands in for CT studies and the colon where the program is built without them: everything that needs it
// says so.

#include "app/command/colon_commands.h"
#include "app/command/info_series.h"
#include "app/options/built_without.h"
#include "app/scene/colon_loading.h"
#include "app/scene/scene_type.h"
#include "app/scene/volume_ambient.h"
#include "app/scene/volume_light.h"
#include "colon/scene/transfer_presets.h"
#include "colon/study/study.h"

namespace stereonav {
namespace {

[[noreturn]] void without() {
    throwBuiltWithout("CT studies and the colon", "STEREONAV_COLON");
}

}  // namespace

int listSeriesOf(const InfoOptions&) {
    without();
}

// Names are all that is left of studies: what they stand for is refused when it is opened.
const SceneType& volumeType() {
    static const SceneType type{
        .noun = "volume",
        .builtIn = {"colon"},
        .owns = [](const std::string& file) { return looksLikeStudy(file); },
        .optionsFor = [](const std::string&) { return scene_type::kColon | scene_type::kColonMedium; },
        .load = [](const SceneOptions&, SimdTarget, Progress&) -> std::unique_ptr<Scene> { without(); },
        .makeMedium = [](const SceneOptions&, SimdTarget, Progress&, ShownMedium&) { without(); },
        .bake = [](const BakeOptions&) -> int { without(); },
        .hasLine = true};
    return type;
}

void applyChange(const SurfaceChange&, const SceneOptions&, SceneOptions&) {
    without();
}

int runCentreline(const CentrelineOptions&) {
    without();
}

int runCoverage(const CoverageOptions&) {
    without();
}

int runFindings(const FindingsOptions&) {
    without();
}

int runRegister(const RegisterOptions&) {
    without();
}

int runUnfold(const UnfoldOptions&) {
    without();
}

bool looksLikeStudy(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    for (const char* end : {".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd"})
        if (name.ends_with(end)) return true;
    std::error_code code;
    return std::filesystem::is_directory(path, code);
}

std::string transferPresetNames() {
    return "none";
}

std::string methodUnderLight(const SceneOptions&, const std::string& method) {
    return method;
}

}  // namespace stereonav
