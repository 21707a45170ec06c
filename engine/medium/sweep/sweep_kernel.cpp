// The kernels of a sweep, one of each model, for grids alone and for all media. Compiled once for each
// instruction set.
#include "engine/medium/sweep/kernel_pass.h"

namespace stereonav::STEREONAV_ISA {
namespace {

bool see(const SweepScene& scene, const SweepEye& eye, const SweepChunk& chunk, const EyeTile& tile) {
    const bool grid = scene.gridAlone;
    switch (scene.look.model) {
        case kEmission:
            return grid ? seeTile<kEmission, true>(scene, eye, chunk, tile)
                        : seeTile<kEmission, false>(scene, eye, chunk, tile);
        case kSurface:
            return grid ? seeTile<kSurface, true>(scene, eye, chunk, tile)
                        : seeTile<kSurface, false>(scene, eye, chunk, tile);
        case kDirect:
            return grid ? seeTile<kDirect, true>(scene, eye, chunk, tile)
                        : seeTile<kDirect, false>(scene, eye, chunk, tile);
        default:
            return grid ? seeTile<kIndirect, true>(scene, eye, chunk, tile)
                        : seeTile<kIndirect, false>(scene, eye, chunk, tile);
    }
}

void findDepths(const SweepScene& scene, const LightPass& lightPass, const LightTile& tile) {
    if (scene.gridAlone)
        findTileDepths<true>(scene, lightPass, tile);
    else
        findTileDepths<false>(scene, lightPass, tile);
}

bool pass(const SweepScene& scene, const LightPass& lightPass, const LightTile& tile) {
    if (lightPass.depths[0]) return passTile<true, true, true>(scene, lightPass, tile);
    if (scene.gridAlone)
        return passTile<true, true, false>(scene, lightPass, tile);  // direct light is done with
    return scene.look.model == kDirect ? passTile<false, false, false>(scene, lightPass, tile)
                                       : passTile<true, false, false>(scene, lightPass, tile);
}

}  // namespace

const SweepKernels kSweepKernels{kName, kLanes, see, findColumns, findDepths, pass, readTile};

}  // namespace stereonav::STEREONAV_ISA
