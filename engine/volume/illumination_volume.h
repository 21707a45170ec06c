// Light baked at the texels of a grid, ready for lookup by ray casters (Wyman et al. 2006, section 4.2).
// Bricks of 8^3 texels, one page of memory each, taken only where something was written.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/volume/volume.h"

namespace stereonav {

// Order of texels in memory: i in bits 0..2 of a brick, j in 3..5, k in 6..8.
struct TexelLayout {
    glm::ivec3 bricks{0};

    TexelLayout() = default;
    explicit TexelLayout(const glm::ivec3& texels) : bricks((texels + 7) / 8) {}
    std::size_t count() const { return static_cast<std::size_t>(bricks.x) * bricks.y * bricks.z * 512; }
    std::size_t index(int i, int j, int k) const {
        const std::size_t brick =
            (static_cast<std::size_t>(k >> 3) * bricks.y + (j >> 3)) * bricks.x + (i >> 3);
        return brick << 9 | (k & 7) << 6 | (j & 7) << 3 | (i & 7);
    }
};

// Four half floats: red, green, blue (irradiance / pi, at most 65504) and a weight: 0 while the texel is not
// known, else how much it counts beside its neighbours (1 for a finished one). All zero: unknown.
using PackedTexel = std::uint64_t;

PackedTexel packTexel(const glm::vec3& light, float weight);  // what is not finite or negative is taken as 0
glm::vec3 texelLight(PackedTexel texel);                      // linear RGB
float texelWeight(PackedTexel texel);                         // 0 to 1

// Baked light on a grid of texels.
struct IlluminationVolume {
    VolumeFrame frame;  // the texels' grid
    TexelLayout layout;
    LazyArray<PackedTexel> texels;  // by layout; written by one thread a texel (8 bytes at a time)

    IlluminationVolume() = default;
    explicit IlluminationVolume(const VolumeFrame& f) : frame(f), layout(f.size), texels(layout.count()) {}
    bool empty() const { return texels.empty(); }
    std::size_t bytesHeld() const;  // pages in use

    // How neighbouring texels are put together (Y5 of docs/ledger.md, fig. 6). The default wins.
    enum class Lookup { Nearest, NearestIsovalue, Trilinear, Tricubic };
    struct Light {
        glm::vec3 value{0.0f};  // linear RGB: irradiance / pi
        // Weight of the texels that are known, 0..1; value is theirs alone. 0: nothing known, or of less
        // weight than places are exact to (kLeastKnown).
        float weight = 0;
    };
    // Scalar oracle of the kernels' lookup; world: any point, clamped to the grid. Not for NearestIsovalue.
    Light at(const glm::dvec3& world, Lookup lookup = Lookup::Trilinear) const;
    // Takes, among the eight texels around the point, the one whose value in `field` is nearest to isovalue
    // (a stored number).
    Light nearestIsovalue(const glm::dvec3& world, const GreyVolume& field, float isovalue) const;
};

// Returns the texels' grid for a volume: `perVoxel` texels a voxel along each axis (1/2 for the paper's 1/8,
// 1, 2 for its 8), the first texel on the first voxel, the last on or beyond the last voxel. Throws Error
// when that is more texels than 32-bit indices hold, or perVoxel is out of range.
VolumeFrame texelFrame(const VolumeFrame& volume, double perVoxel);

}  // namespace stereonav
