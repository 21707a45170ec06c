#include "app/scene/volume/volume_type.h"

#include "app/scene/volume/medium_of_volume.h"
#include "app/scene/volume/volume_facts.h"
#include "app/scene/volume/volume_loading.h"
#include "colon/study/study.h"

namespace stereonav {
namespace {

constexpr const char* kBuiltIn = "colon";

bool isStudyFile(const std::string& file) {
    return looksLikeStudy(file);
}

SceneSet volumeOptions(const std::string& scene) {
    return scene == kBuiltIn ? scene_type::kColon | scene_type::kColonMedium : scene_type::kStudies;
}

}  // namespace

const SceneType& volumeType() {
    static const SceneType type{.noun = "volume",
                                .builtIn = {kBuiltIn},
                                .owns = isStudyFile,
                                .below = [](const std::string& folder) { return studyFoldersAdvice(folder); },
                                .optionsFor = volumeOptions,
                                .glance = glanceAtVolume,
                                .load = loadColonScene,
                                .makeMedium = makeFromVolume,
                                .hasLine = true};
    return type;
}

}  // namespace stereonav
