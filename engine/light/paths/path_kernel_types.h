// Data that the kernels of paths read and write: plain structs and pointers only, since kernels are compiled
// for wider instruction sets and must not share inline code with the rest (see cmake/rooms.cmake).
//
// Positions are a cell and a place in it; directions and normals are along the volume's axes, lengths in
// units of the smallest spacing.
#pragma once

#include <cstdint>

#include "engine/simd/kernel_sets.h"

namespace stereonav {

// Blocks of 2^shift cells a side, two bytes each: the distance in blocks (largest of the three axes'
// differences) to the nearest occupied block, 0: this one; and one bit for each occupied octant, x + 2 y + 4
// z.
struct PathField {
    const std::uint8_t* blocks = nullptr;
    std::int32_t across[2] = {};  // blocks along x and y
    std::int32_t shift = 1;       // at least 1
};

// The volume, in stored numbers.
struct PathVolume {
    const std::int16_t* values = nullptr;
    std::int32_t size[3] = {};  // voxels, at least 2
    float step[3] = {};         // voxels a unit along each axis, at most 1
    float axes[9] = {};         // world directions of the axes, one after the other
};

// Distant light by direction: LightProbe's tables.
struct PathProbe {
    const float* pixels = nullptr;   // red, green, blue (linear), density a steradian; null: no probe
    const float* rows = nullptr;     // running chance of rows, 0 to 1, height + 1
    const float* columns = nullptr;  // chance of columns within their row, width + 1 a row
    const float* edges = nullptr;    // cosine at the upper edge of each row, height + 1
    std::int32_t width = 0, height = 0;
    std::int32_t rowSteps = 0, columnSteps = 0;  // steps of a binary search
};

// A point light.
struct PathPoint {
    float voxel[3] = {};      // position, voxel space
    float intensity[3] = {};  // intensity / (pi unit^2): divided by squared distance in units it is light
    float weight = 0;         // luminance of the intensity, above 0
    float color[3] = {};      // intensity for a weight of 1
    float radius = 0;         // units
};

// The lights of the volume, and flags for the choices of TexelSampling.
struct PathLights {
    PathProbe probe;
    const PathPoint* points = nullptr;
    std::int32_t pointCount = 0;
    // One point light by chance, in proportion to its unshadowed light; else all.
    bool oneByChance = false;
    float sky[3] = {}, albedo[3] = {};  // linear RGB: radiance; share, 0 to 1
    std::int32_t bounces = 0;
    float reach = 0;  // units beyond which rays see distant light; 0: infinite
    float dim = 0;    // roulette below this throughput; 0: no roulette
    bool lowDiscrepancy = true, cosine = true, nextEvent = true;
};

// Where the paths of a texel begin.
struct PathStart {
    std::int32_t cell[3] = {};
    float local[3] = {}, normal[3] = {};  // place in the cell, 0 to 1; unit normal
    float isovalue = 0;                   // stored number
    std::int32_t field = 0;  // index of the first block of the field for this isovalue, in all fields
    std::uint32_t key = 0, firstSample = 0;
};

// Moments of one texel's samples: the mean of each channel, and the sum of squared distances of luminance
// from its mean.
struct PathMoments {
    float mean[3] = {};  // linear RGB
    float squares = 0;   // luminance squared
};

// Working memory of one thread.
struct alignas(64) PathStore {
    static constexpr int kPaths = 1024;
    static constexpr int kRoom = kPaths + 16;  // whole vectors may be written at the end
    template <typename T>
    using Row = T[kRoom];
    // Position of each path: place in its cell (0 to 1), unit normal, isovalue (stored number).
    Row<std::int32_t> cell[3];
    Row<float> local[3], normal[3], isovalue;
    Row<std::int32_t> field, key, sample;
    Row<float> throughput[3], light[3];  // linear RGB
    // Unit directions that are traced from there, with the largest distance in units, and the results.
    Row<float> way[3], shadowWay[3], shadowLight[3], shadowLimit;
    Row<float> met;  // units along the ray, infinite where nothing is met
    Row<std::int32_t> metCell[3];
    Row<float> metLocal[3];
    // Lists of paths
    Row<std::int32_t> alive, next, shadows;
};

struct PathKernels {
    const char* name;
    int lanes;
    // Lights texels; texels * samples <= PathStore::kPaths.
    void (*irradiance)(const PathVolume&, const PathField&, const PathLights&, const PathStart*, int texels,
                       int samples, PathStore&, PathMoments*);
    // Adds to harmonics of `order`, with `channels` (1 or 3) floats per coefficient, one texel after the
    // other.
    void (*transfer)(const PathVolume&, const PathField&, const PathLights&, const PathStart*, int texels,
                     int samples, int order, int channels, PathStore&, float* sums);
    // Casts the first `count` paths of the store along `way`, from cell, local and isovalue, no further than
    // shadowLimit: fills met, metCell, metLocal.
    void (*cast)(const PathVolume&, const PathField&, int count, PathStore&);
    // Writes the numbers of a pair of dimensions, for samples 0 .. count - 1.
    void (*numbers)(bool lowDiscrepancy, std::uint32_t key, std::uint32_t pair, int count, float* x,
                    float* y);
    // Write density and radiance of the probe: for directions, and by choosing.
    void (*seeProbe)(const PathProbe&, int count, const float* const* directions, float* const* seen);
    void (*chooseProbe)(const PathProbe&, int count, const float* x, const float* y, float* const* chosen);
    // Writes unit normals along the axes at places (metCell, metLocal) of the store; 0 where they vanish.
    void (*normals)(const PathVolume&, int count, PathStore&, float* const* normals);
};

STEREONAV_EACH_SET(extern const PathKernels kPathKernels;)

}  // namespace stereonav
