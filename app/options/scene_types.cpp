#include "app/options/scene_types.h"

#include "app/command/commands.h"
#include "app/scene/scene_type.h"
#include "app/scene/shown_as.h"
#include "engine/base/error.h"

namespace stereonav {

std::optional<SceneSet> sceneTypeOf(const SceneOptions& options) {
    try {
        const SceneSet all = sceneTypeNamed(options.scene).optionsFor(options.scene);
        const SceneSet asked = shownAs(options).swept ? all & scene_type::kMedia : all & ~scene_type::kMedia;
        return asked != 0 ? asked : all;  // a mesh with --medium is a mesh, which has none
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace stereonav
