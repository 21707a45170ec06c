// `stereonav bake`: light worked out before it is looked at. Each kind of scene has its own.
#include "app/bake_volume.h"
#include "app/scene_loading.h"
#include "engine/base/error.h"

namespace stereonav {

int runBake(const BakeOptions& options) {
    switch (kindOf(options.scene.scene)) {
        case SceneKind::Volume:
            return bakeVolume(options);
        case SceneKind::Terrain:
            break;
    }
    throw Error(options.scene.scene.empty() ? "SCENE" : options.scene.scene, "",
                "expected a CT study, found a terrain", "name a study, or colon for the built-in one");
}

}  // namespace stereonav
