// The light's buffer of a sweep on the CPU: planes of floats that pass slab after slab, and for the eyes the
// light before each slab of a chunk. Tiles are skipped while nothing was met in or near them, or when nothing
// more will be met.
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
    // Begins with unweakened light; sets the pointers of scene.light. space: null: nothing is left out.
    // Returns the number of slabs for which the eyes' light can be stored, 1 or more. Throws Error where
    // memory is short.
    int start(SweepScene& scene, const SweepGeometry& geometry, const SweepSpace* space);
    // Prepares for the slabs of a chunk. reach: which light eyes may still read, with the same chunks; null:
    // all. Returns the number of texels sampled.
    long long beginChunk(const SweepScene& scene, const SweepGeometry& geometry, int first, int count,
                         const SweepKernels& kernels, SweepReach* reach = nullptr);
    // Passes a slab, whose light is stored as number `inChunk` of the chunk. Returns the number of texels
    // sampled.
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
    double mAskedFor = 0;             // bytes for which memory was checked already
    std::vector<float> mPlanes;       // direct light, then two sets of three planes of scattered light
    std::vector<float> mDepths;       // three planes like those: tau_i, where slabs lean
    std::vector<std::uint8_t> mDeep;  // by tile: tau_i may differ from 0
    bool mLeans = false;
    std::vector<std::uint32_t> mPacked;
    std::vector<float> mColumns;  // by tile: a chunk's slabs
    int mPackedWidth = 0, mPackedHeight = 0, mChunk = 0;
    bool mSwapped = false;
    std::vector<float> mStart;  // see scatteredAtStart
    bool mRingSet = false;      // the ring around mPacked was set to values other than 1
    // By slab and tile: LightTile::strips; empty: all strips of all tiles.
    std::vector<std::uint8_t> mStrips;
    // By tile: last slab in which something was met; is read; is needed.
    std::vector<int> mLast, mRead, mNeeded;
    std::vector<std::uint8_t> mTouched;  // tiles: scattered light may differ from 1
    std::vector<LightTile> mTiles;
    std::vector<std::uint8_t> mChanged;
};

}  // namespace stereonav
