#include "app/options/scene_types.h"

#include "app/command/commands.h"
#include "app/scene/scene_type.h"
#include "engine/base/error.h"

namespace stereonav {

std::optional<SceneSet> sceneTypeOf(const SceneOptions& options) {
    try {
        return sceneTypeNamed(options.scene).optionsFor(options);
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace stereonav
