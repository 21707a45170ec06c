#include "app/scene/volume/colon_of.h"

#include <fmt/format.h>

#include "engine/base/error.h"

namespace stereonav {

const ColonScene& colonOf(const Scene& scene, const SceneOptions& options) {
    const auto* const colon = scene.offered<const ColonScene>();
    if (!colon || !colon->isColon())
        throw Error(options.scene, "", "no colon was found", "give --seed x,y,z inside it");
    return *colon;
}

FactNumbers placeNumbers(const glm::dvec3& world) {
    return {1e3 * world.x, 1e3 * world.y, 1e3 * world.z};
}

std::string placeText(const glm::dvec3& world) {
    return fmt::format("{:.1f}, {:.1f}, {:.1f}", 1e3 * world.x, 1e3 * world.y, 1e3 * world.z);
}

}  // namespace stereonav
