// How finely a medium is swept: what is traded against time.
#pragma once

namespace stereonav {

struct SweepSetting {
    int slices = 256;     // across the medium along the sweep's axis; 1 to 65536
    double turn = 0;      // share of a slab by which slices lie nearer to the sweep's start; 0 to below 1
    int lightSize = 256;  // texels a side of the light's buffer; 8 to 4096
    // Full angle theta of eq. 9, radians, below 3; 0: scattered light stays on its way.
    double coneAngle = 0.6;
    // Metres of way at which the blur is the paper's offset d tan(theta / 2) (d: their slice distance).
    // Offsets are sqrt(step * blurLength) tan(theta / 2), so that the light spreads as much in many thin
    // steps as in few thick ones; the paper's spread less and less as slices are added. 0: 1/64 of the
    // medium's longest side.
    double blurLength = 0;
    // Voxels between the places at which surfaces are shaded, at most; between them the shading is
    // interpolated. 0: at each sample. CPU, grids without noise and baked light.
    double shadingWidth = 1;
    // The right eye reads what the left one saw in slabs where a pixel is no wider than this times the finest
    // detail of the medium (sweep_sharing.h). 0: each eye takes samples of its own. Not by the GPU.
    double sharedWidth = 1;
    bool singleTarget = true;  // GPU: one target split by viewports (K8 of docs/ledger.md), or one a buffer
};

}  // namespace stereonav
