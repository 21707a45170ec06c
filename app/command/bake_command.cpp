// `stereonav bake`: light worked out before it is looked at. Each kind of scene has its own.
#include "app/command/bake_terrain.h"
#include "app/command/bake_volume.h"
#include "app/scene/scene_loading.h"
#include "engine/base/error.h"

namespace stereonav {

int runBake(const BakeOptions& options) {
    switch (kindOf(options.scene.scene)) {
        case SceneKind::Volume:
            return bakeVolume(options);
        case SceneKind::Terrain:
            return bakeTerrain(options);
        case SceneKind::Medium:
            break;
    }
    throw Error(options.scene.scene, "", "expected a terrain or a CT study, found a medium",
                "its light is worked out in each frame");
}

}  // namespace stereonav
