#include "engine/volume/studio_data.h"

namespace stereonav {
namespace {

void setGrid(StudioData& to, const SkyGrid& grid, const VolumeFrame& frame) {
    to.words = grid.words.data();
    to.row = grid.size.x;
    to.slice = grid.size.x * grid.size.y;
    to.lift = static_cast<float>(kSkyLift);
    const glm::dmat3 faces = skyNormals(grid, frame);
    for (int k = 0; k < 3; ++k) {
        to.last[k] = grid.size[k] - 1;
        to.offset[k] = static_cast<float>(grid.first[k]);
        to.perVoxel[k] = static_cast<float>(1 / grid.cellVoxels[k]);
        for (int column = 0; column < 3; ++column) to.face[k][column] = static_cast<float>(faces[column][k]);
    }
}

}  // namespace

StudioData studioDataOf(const VolumeLook& look, const VolumeFrame& frame) {
    StudioData d;
    if (!look.showsStudio()) return d;
    const StudioLook& studio = look.studio;
    setGrid(d, *studio.seen, frame);
    for (int k = 0; k < 3; ++k) {
        d.up[k] = static_cast<float>(studio.up[k]);
        d.keyFrom[k] = static_cast<float>(studio.keyFrom[k]);
        d.skyMean[k] = 0.5f * (studio.sky[k] + studio.ground[k]);
        d.skyChange[k] = 0.5f * (studio.sky[k] - studio.ground[k]);
        d.key[k] = studio.key[k];
    }
    d.lampDeep = studio.lamp * studio.lampDeep;
    d.lampOpen = studio.lamp * (1 - studio.lampDeep);
    return d;
}

}  // namespace stereonav
