// What the volume's casting kernels read: plain structs and pointers only, since kernels are compiled for
// wider instruction sets and must not share inline code with the rest (see cmake/rooms.cmake).
#pragma once

#include <cstdint>

#include "engine/simd/kernel_sets.h"

namespace stereonav {

struct IntegralData;

// Active cells. Layout as in surface_cells.h: bricks of 16^3 cells; records of 64 bytes, 16 words: 4 of
// values, 8 normals.
struct CellData {
    const std::uint8_t* codes = nullptr;
    // Codes of groups of 4^3 cells, 64 a brick; null: no brick is far.
    const std::uint8_t* farCodes = nullptr;
    const std::uint32_t* records = nullptr;
    const std::uint32_t* bricks = nullptr;
    const std::uint16_t* places = nullptr;
    std::int32_t brickCount[2] = {};  // along x and y
    // The number of the first brick, so that cells of up to 2^20 bricks have indices of 32 bits with a sign:
    // codes, farCodes, bricks and places begin `firstBrick` bricks before the pointers.
    std::int32_t firstBrick = 0;
    // Dense bricks: normals of corners (null: there are none), and the volume's values, which begin
    // firstVoxel voxels before the pointer.
    const std::uint32_t* normals = nullptr;
    const std::int16_t* values = nullptr;
    std::int32_t row = 0, slice = 0;  // voxels from one to the next along y and z, the latter mod 2^32
    std::int32_t firstVoxel = 0;
    std::int32_t last[3] = {};  // the last cell along each axis
    float leapUnit = 0;         // metres
    float isovalue = 0;         // stored number
    bool leaping = true;        // else cell by cell
    // World directions of slopes of 1 a voxel along each axis, turned to smaller values: at most 1 long.
    float downX[3] = {}, downY[3] = {}, downZ[3] = {};
};

// The square of the length of a cell's corners' mean normal, or of their mix at a place where that is
// shorter: from kAgree on, which one corner against seven others does not reach, the mix is the normal; at
// kApart and less each counts by how far it follows the slope of the values; in between some of both.
constexpr float kAgree = 0.65f, kApart = 0.35f;
constexpr float kOtherSide =
    4;  // times what the mix has along the slope: less than 1 is taken from its share
constexpr float kLeastOfSlope = 0.01f;  // the slope itself counts as much beside them

// Where less than this of what a lookup weighs is known, nothing counts as known: places in single precision
// are no nearer.
constexpr float kLeastKnown = 1e-4f;
// Largest factor on baked light, so that no light overflows; 65504 times that and all weights is finite.
constexpr float kMostExposure = 1e18f;

// An illumination volume; places in voxels of the scene's grid.
struct TexelGrid {
    const std::uint32_t* texels = nullptr;   // two words each; null: none
    std::int32_t brickStride[3] = {};        // texels from a brick to the next along each axis
    std::int32_t last[3] = {};               // the last texel
    float offset[3] = {}, perVoxel[3] = {};  // texel = (voxel - offset) * perVoxel
};
// Baked light, and how it counts.
struct BakedData : TexelGrid {
    TexelGrid beyond;  // light where these texels are not known, itself known everywhere; texels null: none
    bool openness = false;              // weakens the lamp instead: BakedLook::Use
    float exposure = 1, lampShare = 0;  // factor, at most kMostExposure; share, 0 to 1
};

constexpr float kMostFalloff = 1e8f;  // 1 / metres^2, of a lamp that reaches 0.1 mm

// A volume of bytes on the scene's grid, 0..255 for 0..1.
struct ByteData {
    const std::uint8_t* values = nullptr;  // null: none
    std::int32_t row = 0, slice = 0;       // voxels from one to the next along y and z
    std::int32_t last[3] = {};             // the last voxel along each axis, at least 1
};

// Openness as ambient light; see volume_look.h.
struct OcclusionData {
    ByteData openness;
    float perByte = 0;    // k / 255
    float lampShare = 0;  // share of the lamp, 0 to 1
};

// Light that stands still around an object; see studio_look.h.
struct StudioData {
    const std::uint32_t* words = nullptr;    // two a cell; null: none
    std::int32_t row = 0, slice = 0;         // cells from one to the next along y and z
    std::int32_t last[3] = {};               // the last cell along each axis, at least 1
    float offset[3] = {}, perVoxel[3] = {};  // cell = (voxel - offset) * perVoxel
    float face[3][3] = {};                   // rows: a world normal's part along each axis of the cells
    float lift = 0;                          // cells
    float up[3] = {}, keyFrom[3] = {};       // unit world
    // Light on a face that looks level, and what is added to it on one that looks up; of the key light.
    float skyMean[3] = {}, skyChange[3] = {}, key[3] = {};
    float lampDeep = 0, lampOpen = 0;  // share of the lamp, and what is added to it under the whole sky
};

// The light: linear RGB, and shares of the lamp's light; see volume_look.h.
struct LightData {
    float albedo[3] = {}, background[3] = {};
    float ambient = 0, diffuse = 0, specular = 0, shininess = 1;
    int wholeHalf = 0;                // half the shininess where that is a whole number: cheaper; else 0
    float faintCosine = 0;            // highlight_bound.h
    float leastCosine4 = 0;           // fourth power of VolumeCasting::leastCosine
    float inverseFalloffSquared = 0;  // 1 / metres^2, at most kMostFalloff
    bool shadows = false;
    float largestSpacing = 0;                  // metres
    float varyingAmbient = 0, inverseFog = 0;  // share; 1 / metres
};

// Colour and density by value: entry (value - first) * scale, linear between entries.
struct TransferData {
    static constexpr int kEntries = 1024;
    const float* extinction = nullptr;     // a metre; kEntries + 1 of them
    const std::uint32_t* color = nullptr;  // packed (10-bit square roots)
    float first = 0, scale = 0;            // volume values; entries a value
    float step = 0;                        // metres of way between samples
    ByteData modulation;                   // factor on the extinction
    // Integrals over values, which are gathered cell by cell (integral_data.h); null: samples.
    const IntegralData* integrals = nullptr;
};

struct VolumeData {
    CellData cells;
    LightData light;
    BakedData baked;
    OcclusionData occlusion;  // not where light is baked
    StudioData studio;        // where neither is
    TransferData transfer;    // extinction null: the surface alone
};

// Voxel space has its origin at the cell of the eye: positions stay small and exact near it. Directions have
// unit view depth: position = eye + t * direction, t the view depth in metres.
struct VolumeView {
    std::int32_t base[3] = {};  // the eye's cell
    float eye[3] = {};          // place in that cell, 0..1
    double direction[3] = {}, perX[3] = {},
           perY[3] = {};                               // voxels a metre: pixel (0, 0)'s centre, a pixel on
    float forward[3] = {}, right[3] = {}, up[3] = {};  // world, unit
    float xMin = 0, yMax = 0, pixelWidth = 0, pixelHeight = 0;  // window at unit depth
    float head[3] = {};                                         // world, from the eye: where the lamp is
    float lampAway = 0;                                         // metres, its length
    // The lamp where it casts shadows: its cell and its place in it, as base and eye.
    std::int32_t lampBase[3] = {};
    float lampEye[3] = {};
    bool lampInside = false;
    float nearDepth = 0;  // metres
    bool inside = false;  // the eye lies in the volume
};

// First pixels of the planes that are written; strides: pixels from row to row.
struct VolumeTarget {
    std::uint32_t* color = nullptr;
    float* depth = nullptr;           // metres
    std::uint32_t* normal = nullptr;  // null: not wanted
    float* depthSpread = nullptr;     // metres, for rectangles, translucent; null: not wanted
    std::int64_t colorStride = 0, depthStride = 0, normalStride = 0;
};

struct VolumeRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
struct VolumePixel {
    std::uint16_t x, y;
};

struct VolumeKernels {
    const char* name;
    int lanes;
    // Casts a rectangle. fromDepth: target.depth holds where each ray may start (0: unknown; infinite: hits
    // nothing).
    void (*castRect)(const VolumeData&, const VolumeView&, const VolumeRect&, const VolumeTarget&,
                     bool fromDepth);
    void (*castPixels)(const VolumeData&, const VolumeView&, const VolumePixel*, int count,
                       const VolumeTarget&);
    // Colours pixels x0 .. x1 - 1 of row y from their normals and depths; depth 0 is left alone.
    void (*shadeRow)(const VolumeData&, const VolumeView&, int y, int x0, int x1, const VolumeTarget&);
};

STEREONAV_EACH_SET(extern const VolumeKernels kVolumeKernels;)

}  // namespace stereonav
