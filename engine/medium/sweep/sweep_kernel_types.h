// What the kernels of a sweep read: plain structs and pointers only, since kernels are compiled for wider
// instruction sets and must not share inline code with the rest (see cmake/rooms.cmake). Places are relative
// to the sweep's anchor, metres.
#pragma once

#include <cstdint>

#include "engine/image/texture_data.h"
#include "engine/simd/kernel_sets.h"
#include "engine/volume/volume_kernel_types.h"

namespace stereonav {

// The members of a MediumTable apart, rows of kColumns each.
struct SweepTable {
    static constexpr int kColumns = 1025;
    const float* extinction = nullptr;   // 1 / metres
    const float* indirect[3] = {};       // 1 / metres
    const float* color[3] = {};          // linear RGB, 0 to 1
    const float* surface = nullptr;      // weight, 0 to 1; null: none
    const float* mostSurface = nullptr;  // the largest of each column, over the rows
    // Surface weights as a weight by column times a share by row: null where they are not. A word holds an
    // entry and the next, 15 bits each.
    const std::uint32_t* surfacePairs = nullptr;
    const std::uint32_t* sharePairs = nullptr;
    const float* glow[3] = {};     // linear RGB; null: none
    float perValue = 0, zero = 0;  // column = value * perValue + zero; value: as stored, or relative height
    float perGradient = 0;         // row = gradient * perGradient
    int rows = 1;
    bool rowsOfSurface = false;  // rows differ in nothing else
    bool uniform = false;        // every entry is like the first
};

struct SweepGrid {
    const std::int16_t* values = nullptr;  // null: layers alone
    std::int32_t strideY = 0, strideZ = 0, lastCell[3] = {};
    bool large = false;   // whether the grid is large enough for kernel_block.h's values
    bool blocks = false;  // whether values are also near enough to each other for its differences
    float last[3] = {};   // the last voxel along each axis
    float fromPlace[3][3] = {}, zero[3] = {};  // voxel = fromPlace[row] . place + zero
    float slope[3] = {};                       // value units a metre, of a difference over two voxels
    float axes[3][3] = {};                     // world = axes[row] . voxel direction
    SweepTable table;
};

// A HeightLayer, heights relative to its base.
struct SweepLayer {
    static constexpr int kMostLevels = 32;
    const float* heights = nullptr;  // all levels; metres above `base`
    std::uint32_t start[kMostLevels] = {}, width[kMostLevels] = {}, height[kMostLevels] = {};
    int levels = 0;
    float perMetre = 0, zero[2] = {};          // sample = place * perMetre + zero
    float base = 0;                            // metres: the heights' zero, relative to the anchor
    float below = 0, above = 0, perTaper = 0;  // metres; 1 / metres, 0: no taper
    float lowest = 0, highest = 0;             // metres, relative to the anchor
    bool flat = false;                         // every height is like the first
    bool holes = false;                        // some are unknown, or too large to be subtracted
    SweepTable table;
    TextureData color;  // by places; its colours multiply the table's
};

// A Perturbation.
struct SweepNoise {
    static constexpr int kMostScales = 4;
    const std::uint32_t* texels = nullptr;  // null: not perturbed
    int scales = 0;
    struct Scale {
        float perMetre = 0, zero[3] = {};  // texel = place * perMetre + zero
        float displacement = 0, extinction = 0, color[3] = {}, indirect[3] = {};  // metres; the rest: factors
    };
    Scale scale[kMostScales];
};

// A MediumLook.
struct SweepLook {
    int model = 0;           // a MediumModel
    float radiance[3] = {};  // linear RGB
    float indirectShare = 0;
    float ambient = 0, diffuse = 0, specular = 0, shininess = 1;  // shares of the light; exponent
    const float* phase[3] = {};  // null: the same everywhere; by the angle, 1025 entries
    // Baked light, read by kernel_baked.h at texel = texelFromPlace[row] . place + texelZero.
    BakedData baked;
    float texelFromPlace[3][3] = {}, texelZero[3] = {};  // places: metres
};

// The light, and its buffer. Buffer coordinates: texel centres at (x + 0.5, y + 0.5).
struct SweepLight {
    bool parallel = true;
    float origin[3] = {}, right[3] = {}, up[3] = {}, forward[3] = {};  // metres, relative to the anchor; unit
    float xMin = 0, yMax = 0, perX = 0, perY = 0;                      // RayFan's
    int width = 0, height = 0;
    float axis[3] = {};                                // right, up, forward . the sweep's axis
    float length = 0;                                  // parallel: metres of way for one along the axis
    float start = 0;                                   // metres along the axis, for a lamp
    float inverseFalloffSquared = 0, lampCosine = -1;  // 1 / metres^2; cosine of half the cone
    // Planes of light, 0 to 1: rows from -1 to height + 1, columns from -16 on; row 0, column 0 here. Outside
    // light is as it sets out.
    float* direct = nullptr;
    std::int32_t stride = 0;
    // Light for the eyes before the slabs of a chunk, two planes a slab of 15-bit halves (direct and red;
    // green and blue). Row -1, column -1 first.
    std::uint32_t* packed = nullptr;
    std::int32_t packedStride = 0;
    std::int64_t packedPlane = 0;
    float blur = 0;     // root of metres: sqrt(blurLength) tan(theta / 2)
    float leaning = 0;  // SweepGeometry's, 0..1
};

// What the light meets in a tile in the slabs of a chunk, found before it passes them: places in the grid's
// table, from 0 on, -1 where nothing is. Grids alone; direct light is done with then.
struct LightColumns {
    static constexpr int kMost = 16;  // slabs
    int x0 = 0, y0 = 0, count = 0;
    double middle[kMost] = {};    // metres along the axis
    float thickness[kMost] = {};  // metres
    unsigned strips[kMost] = {};  // LightTile's
    float* columns = nullptr;     // a slab's tile, kSide^2 row by row
    std::int64_t next = 0;        // numbers from a slab to the next
};

// One slab's pass of the light.
struct LightPass {
    double middle = 0;    // metres along the axis
    float thickness = 0;  // metres
    int slab = 0, inChunk = 0;
    const float* before[3] = {};  // indirect light, as SweepLight::direct
    float* after[3] = {};         // light after the slab
    float* depths[3] = {};  // tau_i at the slab, where slabs lean (V11 of docs/volume_light.md); the same
                            // layout; null: they do not
};
// A tile of texels in strips of rows: where nothing is in a strip light is only spread.
struct LightTile {
    static constexpr int kSide = 16, kStrip = 4;  // rows
    int x0 = 0, y0 = 0;
    unsigned strips = 0;             // bits of the strips where something may be
    const float* columns = nullptr;  // see LightColumns
};

// Slabs that are seen one after the other.
struct SweepChunk {
    static constexpr int kMost = 16;
    double reference = 0;         // metres along the axis
    float middle[kMost] = {};     // metres from the reference on
    float thickness[kMost] = {};  // metres
};

// An eye's RayFan, relative to the anchor.
struct SweepEye {
    bool forward = true;
    double origin[3] = {}, right[3] = {}, up[3] = {}, ahead[3] = {};  // metres, relative to the anchor; unit
    double xMin = 0, yMax = 0, perX = 0, perY = 0;                    // RayFan's
    double axis[3] = {}, start = 0;  // right, up, ahead . the axis; the eye along it
    int width = 0, height = 0;
    float footprint = 0;  // metres across a pixel at depth 1
};

// Rows of the first eye's pixels as they saw the slabs of a chunk, for the second eye: light sent (3) and
// opacity (-1 where it was not looked at), laid out as in kernel_shared.h. See sweep_sharing.h.
struct SharedRows {
    static constexpr int kRows = 8, kNumbers = 4;  // half a tile
    float* numbers = nullptr;  // each column, row and slab of a chunk; kReadAhead columns more
    std::int32_t columns = 0;  // columns of whole tiles
    std::uint32_t slabs = 0;   // bits of the slabs that are kept
    static constexpr int kReadAhead = 4;
    // A ray of the second eye with the cosine c finds its place at x + column + c parallax perParallax, where
    // whole numbers are pixels' centres.
    int width = 0;
    float column = 0, perParallax = 0;          // pixels; pixels a tangent
    float farthest = 0;                         // the largest number that is added to x
    float parallax[SweepChunk::kMost] = {};     // tangents
    float lengthening[SweepChunk::kMost] = {};  // factor on ways, by their cosines
};

// A block of pixels and what its rays have gathered so far: for each packet light (3), what is left, depth.
struct EyeTile {
    static constexpr int kSide = 16, kHalf = 8, kMembers = 5;
    int x0 = 0, y0 = 0;
    int firstRow = 0, lastRow = kSide;  // rows to be seen now; a multiple of SharedRows::kRows each
    std::uint32_t slabs[4] = {};        // bits of the chunk's slabs where something may be, for each quarter
    bool fresh = false;                 // nothing gathered yet
    float* state = nullptr;             // kMembers * kSide^2 numbers
    // Metres: view depths before which nothing is; null: none; row of (x0, y0).
    const float* starts = nullptr;
    std::int32_t startStride = 0;
    const SharedRows* keeps = nullptr;  // what is seen is kept there: its rows
    const SharedRows* reads = nullptr;  // what the other eye kept
};

struct SweepScene {
    // The fast path: no layers, no noise, and a table that is one-dimensional except for the surface weight.
    bool gridAlone = false;
    // Voxels between the places at which surfaces of a grid alone are shaded, at most; 0: at each sample.
    float shadingWidth = 0;
    SweepGrid grid;
    const SweepLayer* layers = nullptr;
    int layerCount = 0;
    SweepNoise noise;
    SweepLook look;
    SweepLight light;
};

// Where a tile's pixels go: four floats of light each, as MediumPicture::light, and a view depth, metres.
struct PictureTile {
    float* light = nullptr;
    float* depth = nullptr;
    std::int64_t lightStride = 0, depthStride = 0;  // numbers from a row to the next
    int width = 0, height = 0;                      // the part of the tile that is in the picture
};

struct SweepKernels {
    const char* name;
    int lanes;
    // Returns whether any ray of the tile goes on.
    bool (*seeTile)(const SweepScene&, const SweepEye&, const SweepChunk&, const EyeTile&);
    void (*findColumns)(const SweepScene&, const LightColumns&);
    // Finds tau_i of the slab where slabs lean, for all tiles before lightTile; 0 in strips where nothing is.
    void (*findDepths)(const SweepScene&, const LightPass&, const LightTile&);
    // Returns whether scattered light of the tile differs from 1 afterwards.
    bool (*lightTile)(const SweepScene&, const LightPass&, const LightTile&);
    void (*readTile)(const float* state, const PictureTile&);
};

STEREONAV_EACH_SET(extern const SweepKernels kSweepKernels;)

}  // namespace stereonav
