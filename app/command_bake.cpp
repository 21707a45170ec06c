// `stereonav bake`: light worked out before it is looked at. Each kind of scene has its own.
#include "app/bake_terrain.h"
#include "app/bake_volume.h"
#include "app/scene_loading.h"

namespace stereonav {

int runBake(const BakeOptions& options) {
    switch (kindOf(options.scene.scene)) {
        case SceneKind::Volume:
            return bakeVolume(options);
        case SceneKind::Terrain:
            return bakeTerrain(options);
    }
    return 1;
}

}  // namespace stereonav
