#include "engine/medium/sweep/medium_scene.h"

#include <cmath>
#include <utility>
#include <vector>

namespace stereonav {

void MediumScene::turnLight(double azimuth, double elevation) {
    look.light.direction = -glm::dvec3(std::sin(azimuth) * std::cos(elevation),
                                       std::cos(azimuth) * std::cos(elevation), std::sin(elevation));
}

MediumTransfer allSurface(const MediumTransfer& transfer) {
    const auto shaded = [](auto materials) {
        for (auto& material : materials) material.material.surface = 1;
        return materials;
    };
    if (!transfer.regions().empty())
        return MediumTransfer(shaded(transfer.regions()), transfer.referenceLength(), "surface");
    return MediumTransfer(shaded(transfer.points()), transfer.referenceLength(), "surface");
}

Medium allSurface(const Medium& layers) {
    std::vector<HeightLayer> shaded = layers.layers();
    for (HeightLayer& layer : shaded)
        for (OpticalProperties& entry : layer.table.entries) entry.surface = 1;
    return Medium(std::move(shaded), layers.perturbation());
}

}  // namespace stereonav
