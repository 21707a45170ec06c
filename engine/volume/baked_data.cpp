#include "engine/volume/baked_data.h"

namespace stereonav {

BakedData bakedDataOf(const BakedLook& look, const VolumeFrame& frame) {
    BakedData d;
    if (!look.light || look.light->empty()) return d;
    const IlluminationVolume& light = *look.light;
    d.texels = reinterpret_cast<const std::uint32_t*>(light.texels.data());
    const glm::dvec3 offset = frame.voxelFromWorld(light.frame.origin);
    const glm::ivec3 bricks = light.layout.bricks;
    const int strides[3] = {512, 512 * bricks.x, 512 * bricks.x * bricks.y};
    for (int k = 0; k < 3; ++k) {
        d.brickStride[k] = strides[k];
        d.last[k] = light.frame.size[k] - 1;
        d.offset[k] = static_cast<float>(offset[k]);
        d.perVoxel[k] = static_cast<float>(frame.spacing[k] / light.frame.spacing[k]);
    }
    d.openness = look.use == BakedLook::Use::Openness;
    if (!d.openness) d.exposure = look.exposure;
    d.lampShare = look.lampShare;
    return d;
}

}  // namespace stereonav
