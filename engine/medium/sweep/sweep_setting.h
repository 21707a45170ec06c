// How finely a medium is swept: accuracy against time.
#pragma once

namespace stereonav {

struct SweepSetting {
    int slices = 256;  // number across the medium along the sweep's axis; 1 to 65536
    // Share of a slab by which slices are shifted towards the sweep's start; 0 to below 1.
    double turn = 0;
    int lightSize = 256;  // texels per side of the light's buffer; 8 to 4096
    // Full angle theta of eq. 9, radians, below 3; 0: scattered light is not spread.
    double coneAngle = 0.6;
    // Metres of way at which the blur is the paper's offset d tan(theta / 2) (d: their slice distance).
    // Offsets are sqrt(step * blurLength) tan(theta / 2), so that the light spreads as much in many thin
    // steps as in few thick ones; the paper's spread less and less as slices are added. 0: 1/64 of the
    // medium's longest side.
    double blurLength = 0;
    // Largest distance in voxels between the places at which surfaces are shaded; between them the shading is
    // interpolated. 0: each sample is shaded. Only on the CPU, for grids without noise and baked light.
    double shadingWidth = 1;
    // The right eye reads samples of the left one in slabs where a pixel is at most this multiple of the
    // medium's finest detail (sweep_sharing.h). 0: each eye takes samples of its own. Not on the GPU.
    double sharedWidth = 1;
    // GPU: one target divided by viewports (K8 of docs/ledger.md), or one for each buffer.
    bool singleTarget = true;
};

}  // namespace stereonav
