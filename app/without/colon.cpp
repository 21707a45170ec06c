// Stands in for CT studies and the colon where the program is built without them: everything that needs it
// says so.
#include <nlohmann/json.hpp>

#include "app/command/bake_volume.h"
#include "app/command/info_series.h"
#include "app/command/info_text.h"
#include "app/options/built_without.h"
#include "app/scene/colon_loading.h"
#include "app/scene/medium_of.h"
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

std::unique_ptr<Scene> loadColonScene(const SceneOptions&, SimdTarget, Progress&) {
    without();
}

void makeFromVolume(const SceneOptions&, SimdTarget, Progress&, ShownMedium&) {
    without();
}

void applyChange(const SurfaceChange&, const SceneOptions&, SceneOptions&) {
    without();
}

ColonOptions colonOptionsOf(const SceneOptions&) {
    without();
}

int bakeVolume(const BakeOptions&) {
    without();
}

int runCentreline(const CentrelineOptions&) {
    without();
}

nlohmann::ordered_json colonJson(const Scene&) {
    without();
}

std::string colonText(const Scene&) {
    without();
}

// Names are all that is left of studies: what they stand for is refused when it is opened.
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
