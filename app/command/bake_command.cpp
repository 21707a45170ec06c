// `stereonav bake`: light worked out before it is looked at. Each type of scene has its own.
#include "app/scene/scene_type.h"
#include "engine/base/error.h"

namespace stereonav {

int runBake(const BakeOptions& options) {
    const SceneType& type = sceneTypeNamed(options.scene.scene);
    if (type.bake) return type.bake(options);
    throw Error(options.scene.scene, "",
                "expected a terrain or a CT study, found a " + std::string(type.noun),
                "its light is worked out in each frame");
}

}  // namespace stereonav
