// The light's buffer of a sweep on the CPU: planes in floats that pass slab after slab, and for the eyes what
// was there before each slab of a chunk. Tiles are left alone where nothing was met yet, or nothing is met
// any more near them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/medium/sweep/sweep_geometry.h"
#include "engine/medium/sweep/sweep_kernel_types.h"
#include "engine/medium/sweep/sweep_reach.h"
#include "engine/medium/sweep/sweep_space.h"

namespace stereonav {

class SweepLightBuffers {
public:
    // Begins with all light; sets the pointers of scene.light. space: null: nothing is left out. Returns how
    // many slabs the eyes' light can be kept for, 1 or more. Throws Error where memory is short.
    int start(SweepScene& scene, const SweepGeometry& geometry, const SweepSpace* space);
    // Prepares for the slabs of a chunk. reach: what eyes may still read, chunks as here; null: all. Returns
    // texels looked at.
    long long beginChunk(const SweepScene& scene, const SweepGeometry& geometry, int first, int count,
                         const SweepKernels& kernels, SweepReach* reach = nullptr);
    // Passes a slab, the `inChunk`-th that is kept. Returns texels looked at.
    long long pass(const SweepScene& scene, const SweepGeometry& geometry, int slab, int inChunk,
                   const SweepKernels& kernels);
    std::size_t heldBytes() const;

private:
    void checkMemoryFor(const SweepLight& light, bool leans, bool columns, int slabs);
    void setPlanes(SweepLight& light);
    void setPacked(SweepLight& light);
    void setStart(const SweepLight& light);
    void setRing(const SweepLight& light);
    void findDepths(const SweepScene& scene, const SweepGeometry& geometry, const LightPass& pass,
                    const SweepKernels& kernels);
    float* columnsOf(int inChunk, int x0, int y0);
    std::size_t columnsOfTile() const;
    void findStrips(const SweepGeometry& geometry, const SweepSpace* space);
    void findStripsOf(const SweepGeometry& geometry, const SweepSpace& space, int tile,
                      const std::vector<double>& middles);
    void findRead(int first, SweepReach* reach);
    void findNeeded(const SweepLight& light, const SweepGeometry& geometry, int slab);
    unsigned stripsAt(const SweepGeometry& geometry, int slab, int tile) const;
    void chooseTiles(const SweepGeometry& geometry, int slab, int reach);
    int tiles() const { return mAcross * mDown; }

    int mAcross = 0, mDown = 0;
    double mAskedFor = 0;             // bytes that were there
    std::vector<float> mPlanes;       // direct, then twice three of scattered light
    std::vector<float> mDepths;       // three planes as those: tau_i, where slabs lean
    std::vector<std::uint8_t> mDeep;  // tiles: may have some of it that is not 0
    bool mLeans = false;
    std::vector<std::uint32_t> mPacked;
    std::vector<float> mColumns;  // by tile: a chunk's slabs
    int mPackedWidth = 0, mPackedHeight = 0, mChunk = 0;
    bool mSwapped = false;
    std::vector<float> mStart;               // see scatteredAtStart
    bool mRingSet = false;                   // around mPacked, to others than 1
    std::vector<std::uint8_t> mStrips;       // by slab and tile: LightTile::strips; empty: all of all
    std::vector<int> mLast, mRead, mNeeded;  // by tile: last slab met, read, needed
    std::vector<std::uint8_t> mTouched;      // tiles: scattered light may differ from 1
    std::vector<LightTile> mTiles;
    std::vector<std::uint8_t> mChanged;
};

}  // namespace stereonav
