// The light's buffer of a sweep on the CPU: planes in floats that pass slab after slab, and for the eyes what
// was there before each slab of a chunk. Tiles where nothing was met yet, and nothing is, are left alone.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/medium/sweep_geometry.h"
#include "engine/medium/sweep_kernel_types.h"
#include "engine/medium/sweep_space.h"

namespace stereonav {

class SweepLightBuffers {
public:
    // All light; sets the pointers of `light`. Gives how many slabs the eyes can be kept for, 1 or more.
    int start(SweepLight& light);
    // Past a slab, the `inChunk`-th that is kept; space: null: nothing is left out. Gives texels looked at.
    long long pass(const SweepScene& scene, const SweepGeometry& geometry, int slab, int inChunk,
                   const SweepSpace* space, const SweepKernels& kernels);
    std::size_t heldBytes() const;

private:
    struct Rect {  // of tiles, ends not in it
        int x0 = 1 << 20, y0 = 1 << 20, x1 = 0, y1 = 0;
        bool empty() const { return x0 >= x1; }
        bool holds(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
    };
    bool mayHold(const SweepGeometry& geometry, const SweepSpace& space, int tile, double t) const;
    void chooseTiles(const SweepScene& scene, const SweepGeometry& geometry, double t,
                     const SweepSpace* space, double reach_texels);

    int mAcross = 0, mDown = 0;
    std::vector<float> mPlanes;  // direct, then twice three of scattered light
    std::vector<std::uint32_t> mPacked;
    int mPackedWidth = 0, mPackedHeight = 0, mChunk = 0;
    bool mSwapped = false;
    Rect mTouched;  // scattered light may differ from 1 in it
    std::vector<LightTile> mTiles;
    std::vector<std::uint8_t> mChanged;
};

}  // namespace stereonav
