#include "engine/volume/baked_data.h"

#include <algorithm>

namespace stereonav {
namespace {

void setGrid(TexelGrid& to, const IlluminationVolume& light, const VolumeFrame& frame) {
    to.texels = reinterpret_cast<const std::uint32_t*>(light.texels.data());
    const glm::dvec3 offset = frame.voxelFromWorld(light.frame.origin);
    const glm::ivec3 bricks = light.layout.bricks;
    const int strides[3] = {512, 512 * bricks.x, 512 * bricks.x * bricks.y};
    for (int k = 0; k < 3; ++k) {
        to.brickStride[k] = strides[k];
        to.last[k] = light.frame.size[k] - 1;
        to.offset[k] = static_cast<float>(offset[k]);
        to.perVoxel[k] = static_cast<float>(frame.spacing[k] / light.frame.spacing[k]);
    }
}

}  // namespace

float shownExposure(const BakedLook& look) {
    return look.exposure > 0 ? std::min(look.exposure, kMostExposure) : 0.0f;
}

BakedData bakedDataOf(const BakedLook& look, const VolumeFrame& frame) {
    BakedData d;
    if (!look.light || look.light->empty()) return d;
    setGrid(d, *look.light, frame);
    if (look.beyond && !look.beyond->empty()) setGrid(d.beyond, *look.beyond, frame);
    d.openness = look.use == BakedLook::Use::Openness;
    if (!d.openness) d.exposure = shownExposure(look);
    d.lampShare = look.lampShare;
    return d;
}

IlluminationVolume::Light bakedLightAt(const BakedLook& look, const glm::dvec3& world,
                                       const GreyVolume* field, float isovalue) {
    using Lookup = IlluminationVolume::Lookup;
    if (!look.light) return {};
    const IlluminationVolume::Light near = look.lookup == Lookup::NearestIsovalue && field
                                               ? look.light->nearestIsovalue(world, *field, isovalue)
                                               : look.light->at(world, look.lookup);
    if (!look.beyond || look.beyond->empty() || near.weight >= 1) return near;
    const IlluminationVolume::Light far = look.beyond->at(world);
    return {far.value + near.weight * (near.value - far.value), far.weight};
}

}  // namespace stereonav
