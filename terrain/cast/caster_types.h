// Data that the casting kernels read: plain structs and pointers only, since kernels are compiled for wider
// instruction sets and must not share inline code with the rest (see cmake/rooms.cmake).
#pragma once

#include <cstdint>

#include "engine/image/texture_data.h"
#include "engine/simd/kernel_sets.h"
#include "terrain/light/air_data.h"

namespace stereonav {

// A heightfield and its pyramid of maxima. Grid coordinates as in heightfield.h; heights in metres.
struct GroundData {
    const float* heights = nullptr;                            // row by row, NaN where missing
    int width = 0, height = 0;                                 // samples
    const float* maxima = nullptr;                             // all levels of the pyramid
    std::int32_t maximaOffset[16] = {}, maximaPitch[16] = {};  // HeightPyramid's, by level
    int levels = 0;                                            // levels of the pyramid
    float minHeight = 0, maxHeight = 0;
    float maxSlope = 0;                 // metres per metre; infinite with open holes
    double spacingX = 1, spacingY = 1;  // metres between samples
    // The plain cell walk in double precision (plain_caster.h), for rays that single precision can not
    // decide. fall: of an EarthBend around the origin; cell: i, j; position: u, v. Returns the ray's
    // parameter, infinite for a miss.
    double (*exactHit)(const void* context, const double* origin, const double* direction, double fall,
                       double tMin, int* cell, double* position) = nullptr;
    const void* context = nullptr;  // first argument for exactHit
};

// A SkyMap: an octahedral map of PackedColor.
struct SkyData {
    const std::uint32_t* texels = nullptr;
    int size = 0, stride = 0;  // texels a side; texels from row to row
};

// A plain fog.
struct FogData {
    float perMetre = 0;    // extinction, 1/metre; 0: no fog
    float linear[3] = {};  // the colour, linear, 0 to 1
};

// Sides of the lattice for detail of the ground's shading below the sample spacing
// (terrain/cast/ground_detail.h): number of its values, and number of values stored for a row, which ends
// with its first value again.
constexpr int kDetailSide = 64, kDetailPitch = kDetailSide + 1;
constexpr int kDetailOctaves = 7;
// An octave has faded out where its cell has this many pixels; where twice as many, it is fully there.
constexpr float kDetailPixels = 1.5f;
constexpr float kDarkestDetail = -0.65f, kBrightestDetail = 0.8f;  // limits, as shares of the light

// Weathered relief: words of a map a side, those kept of a row, which ends with its first again, and words to
// a cell of the lattice. A word has the gradient along x and y in 11 bits each (bits 0 and 11 up), and the
// tone in 10 bits (bit 22 up); each counts from the middle of its bits.
constexpr int kReliefSide = 256, kReliefPitch = kReliefSide + 1, kReliefWords = 4;

// One octave: a lattice of values, turned and scaled, over the ground.
struct DetailOctave {
    int a = 1, b = 0;              // place on the lattice, or in the map: (a + b i) (x + y i)
    float cell = 1;                // a side of its cells, in cells of the ground
    float lightX = 0, lightY = 0;  // share of the light for a gradient of 1 along the lattice's axes
    float tone = 0;                // share of the light for a tone of 1: weathered relief alone
};
// Data of GroundDetail, which adds to the shading.
struct DetailData {
    const float* values = nullptr;          // values of the lattice, -1 to 1, kDetailPitch a row
    const std::uint32_t* relief = nullptr;  // the map of weathered relief, which takes the place of `values`
    const float* rough = nullptr;  // at the ground's samples: 0 on level ground, towards 1 on steep ground
    int roughPitch = 0;            // samples from row to row
    int octaves = 0;               // 0: no detail
    float perMetre = 1;            // cells of the ground a metre
    DetailOctave octave[kDetailOctaves];
};

struct CasterScene;

// The coarser ground around a finer one, which lies in its middle (terrain/ground/ground_rings.h).
struct CoarserGround {
    const CasterScene* scene = nullptr;  // null: there is none
    double originX = 0, originY = 0;     // its sample (0, 0) in grid coordinates of the finer ground
    double scale = 1;                    // its grid units per grid unit of the finer ground: a power of two
};

// The ground that rays can meet, and the air in front of it.
struct CasterScene {
    GroundData ground;
    DetailData detail;
    TextureData texture;
    SkyData sky;
    FogData fog;
    AirData air;  // air of a physical sky; it replaces fog
    CoarserGround beyond;
};

// A view turned so that `step` leads from steeper to higher rays (rows from bottom to top in an upright
// picture) and `lane` runs across. Direction of pixel (lane a, step q), in grid units and metres per unit of
// view depth: base + a * perLane + q * perStep.
// With a fall, rays are parabolas over level ground (engine/math/earth_bend.h). The fall is defined around
// the head; the difference for the eye, which grows with the distance, is already part of originZ and the
// directions' z.
struct CasterView {
    double originX = 0, originY = 0, originZ = 0;           // the eye: grid, grid, metres
    double base[3] = {}, perLane[3] = {}, perStep[3] = {};  // x, y in grid units, z in metres
    int lanes = 0, steps = 0;                               // number of pixels across and along
    // Pixel (x, y) = first + a * laneStep + q * stepStep, both axes swapped in rolled views.
    int firstX = 0, firstY = 0, laneX = 1, laneY = 0, stepX = 0, stepY = -1;
    // Direction towards lower rays at (a, q): (lowA - a * lowW, lowQ - q * lowW); see terrain_view.cpp.
    double lowA = 0, lowQ = -1, lowW = 0;
    bool verticalColumns = false;  // each lane's rays lie in one vertical plane: the paper's rule is exact
    bool coherent = false;         // the free length of a lower ray may be used for a higher one
    double fall = 0;               // 1/metre, of the view's EarthBend, around the eye; 0: rays are straight
    float nearDepth = 0;           // metres along the view: smallest depth of a hit
    float pixelWidth = 0, pixelHeight = 0;  // metres per metre of view depth
    AirEye air;                             // air at the eye, for a physical sky
};

// The pixels of a tile: at each step the lanes from ceil(left + leftSlope * step) up to, but not including,
// ceil(right + rightSlope * step), for steps from firstStep to endStep - 1.
struct CasterBand {
    double left = 0, leftSlope = 0, right = 0, rightSlope = 0;  // lanes; lanes per step
    int firstStep = 0, endStep = 0;
    // Range of lanes beside the band whose depths the picture may hold already (0: it does not); empty where
    // the whole picture is new.
    int knownFrom = 0, knownTo = 0;
};

// Share of a known depth at which a ray beside or above it starts: the depth of a warped pixel is that of its
// nearer neighbour in the left picture, exact to about the ground that a pixel covers.
constexpr float kInFront = 0.98f;

// Returns the first lane of a band's edge at a step, 0 to `lanes`.
__attribute__((always_inline)) inline int bandEdge(double at, double slope, int step, int lanes) {
    const double a = at + slope * step;
    if (!(a > 0)) return 0;
    if (a >= lanes) return lanes;
    const int whole = static_cast<int>(a);
    return whole < a ? whole + 1 : whole;
}

// Output of a kernel; strides in elements.
struct CasterTarget {
    std::uint32_t* color = nullptr;  // PackedColor
    float* depth = nullptr;          // metres along the view, infinite: sky
    std::int64_t colorStride = 0, depthStride = 0;
};

// A pixel of the picture.
struct CasterPixel {
    std::uint16_t x, y;
};

// Scattered pixels, and the view depth in metres at which each ray may start (0: unknown).
struct CasterBatch {
    const CasterPixel* pixels = nullptr;
    const float* start = nullptr;
    int count = 0;
};

// One instruction set's kernels.
struct CasterKernels {
    const char* name;
    int lanes;  // rays of a packet
    // scratch: at least 8 * (view.lanes + 128) floats.
    void (*castBand)(const CasterScene&, const CasterView&, const CasterBand&, const CasterTarget&,
                     float* scratch);
    void (*castPixels)(const CasterScene&, const CasterView&, const CasterBatch&, const CasterTarget&);
    // Colours row y of a view whose lanes are columns, from depths that another caster has found.
    void (*shadeRow)(const CasterScene&, const CasterView&, int y, const CasterTarget&);
};

STEREONAV_EACH_SET(extern const CasterKernels kCasterKernels;)

}  // namespace stereonav
