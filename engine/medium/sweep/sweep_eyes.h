// The eyes of a sweep on the CPU: tiles of pixels, what their rays have gathered so far, and the slabs where
// each tile's rays may meet something. Where two eyes share samples (sweep_sharing.h), a row of tiles is seen
// by the first eye, then by the second, half a tile's rows at a time, so that the shared samples stay in the
// cache. Keeps its buffers between frames.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "engine/image/plane.h"
#include "engine/medium/model/medium_picture.h"
#include "engine/medium/sweep/sweep_geometry.h"
#include "engine/medium/sweep/sweep_kernel_types.h"
#include "engine/medium/sweep/sweep_reach.h"
#include "engine/medium/sweep/sweep_sharing.h"
#include "engine/medium/sweep/sweep_space.h"

namespace stereonav {

class SweepEyes {
public:
    // space and kernels must outlive this object.
    SweepEyes(const SweepSpace& space, const SweepKernels& kernels) : mSpace(space), mKernels(kernels) {}

    // Forgets what was gathered. geometry must outlive the frame. starts: see MediumSweep::render.
    void start(const SweepGeometry& geometry, const SweepSharing& sharing,
               std::span<const Plane<float>> starts);
    // Follows the rays through `count` slabs from `first` on. Returns the number of samples taken.
    long long seeChunk(const SweepScene& scene, const SweepChunk& chunk, int first, int count);
    // Tells `reach` which tiles have no ray left that goes on: they read no more light.
    void dropPassed(SweepReach& reach) const;
    void readPicture(std::size_t eye, MediumPicture& picture) const;
    std::size_t heldBytes() const;

private:
    // One eye's tiles.
    struct Eye {
        int across = 0, down = 0;
        std::vector<float> states;  // like EyeTile::state
        std::vector<std::uint8_t> fresh, done;
        std::vector<SweepBeam> beams;  // beams of the quarters of each tile
        // By slab of a chunk, as bits: where the quarters may meet something.
        std::vector<std::uint32_t> slabs;
        SweepEye seen;

        void start(const RayFan& fan);
        int tiles() const { return across * down; }
    };
    // The slabs that are seen now, and the places of shared samples.
    struct Walk {
        const SweepScene& scene;
        const SweepChunk& chunk;
        int count = 0;
        double middles[SweepChunk::kMost] = {};
        SharedRows shared;
    };
    void setBeams(std::size_t eye);
    long long findSlabs(Eye& eye, int tile, const Walk& walk) const;
    EyeTile tileOf(std::size_t eye, int tile) const;
    long long seeTile(std::size_t eye, int tile, const Walk& walk);
    long long seeRow(int row, const Walk& walk);
    // A row of tiles that shares samples.
    struct RowTask {
        int row = 0;
        SharedRows rows;
        std::vector<std::uint8_t> goesOn;  // for each tile, of both eyes: whether a ray goes on
        int firstRow = 0;
    };
    bool isSeen(std::size_t eye, int tile) const;
    void seeHalf(std::size_t eye, int tile, const Walk& walk, RowTask& task);
    std::unique_ptr<std::vector<float>> takeRows();
    void giveBack(std::unique_ptr<std::vector<float>> rows);
    std::size_t rowsNumbers() const;

    const SweepSpace& mSpace;
    const SweepKernels& mKernels;
    const SweepGeometry* mGeometry = nullptr;
    std::span<const Plane<float>> mStarts;
    SweepSharing mSharing;
    std::vector<Eye> mEyes;
    std::mutex mRowsLock;
    // Shared samples: one buffer for each task that runs at the same time.
    std::vector<std::unique_ptr<std::vector<float>>> mRows;
};

}  // namespace stereonav
