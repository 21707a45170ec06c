#include "app/options/scene_types.h"

#include "app/command/commands.h"
#include "app/scene/scene_loading.h"
#include "engine/base/error.h"

namespace stereonav {

std::optional<SceneSet> sceneTypeOf(const SceneOptions& options) {
    const bool medium = !options.medium.medium.empty();
    try {
        switch (kindOf(options.scene)) {
            case SceneKind::Terrain:
                return medium ? scene_type::kTerrainMedium : scene_type::kTerrain;
            case SceneKind::Medium:
                return scene_type::kBuiltInMedium;
            case SceneKind::Volume:
                break;
        }
    } catch (const Error&) {
        return std::nullopt;
    }
    if (options.scene == "colon") return medium ? scene_type::kColonMedium : scene_type::kColon;
    return medium ? scene_type::kStudyMedium : scene_type::kStudy;
}

}  // namespace stereonav
