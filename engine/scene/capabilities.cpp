#include "engine/scene/capabilities.h"

#include "engine/scene/scene.h"

namespace stereonav {

const EyeRenderer& rendererOf(const Scene& scene) {
    return *scene.offered<RayCast>()->renderer;
}

}  // namespace stereonav
