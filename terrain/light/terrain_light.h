// Light baked over a heightfield: how each sample of the ground sees the sky, the sun and, over bounces, the
// ground around it. It holds no light itself: terrain_relight.h turns it into brightness for the present sun
// and sky, so the sun can move.
//
// The model. Of a heightfield, the sky seen from a point is all that lies above a horizon, one elevation for
// each azimuth. So a sample keeps (1) its horizon in `azimuths` directions, from which the sun's disc is
// taken hard or half set, as low harmonics could not; and (2) two transfer vectors in real harmonics:
// `full`, which lights the sample by a distant sky and the bounces of that light, and `bounced`, its second
// part alone, which evaluated towards the sun is the sun's light after bounces. Light comes from above the
// horizontal only; beyond the terrain's edges there is nothing, neither ground nor light. So what lies below
// may be anything, and is taken as the mirror image of what lies above: then only harmonics that are even in
// z count (three fifths of them), and no edge at the horizontal rings.
// Differs from Wyman et al. 2006 (section 4.1), whose transfer carries direct and bounced light in one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

class Peers;

// Kinds of light that can be baked.
enum class TerrainLightKind : std::uint32_t {
    Openness = 1,  // the share of the sky's light that reaches a sample, one byte
    Transfer = 2,  // openness, horizons and harmonics
};

// Measured against path tracing over the built-in terrain (bench_terrain_light), whole light between samples
// 94 m apart: order 1, 3, 4 and 6 leave an rms error of 4.9, 2.8, 2.8 and 2.8 % with the sun 45 degrees high
// and of 20, 15, 15 and 15 % at 10 degrees, most of it at the edges of shadows. 16 rays do not differ from
// 256 by more than 0.0001; 64 azimuths make the 15 % 14, 16 azimuths 15.3. Order 4 is for skies with more
// shape.
struct TerrainLightSettings {
    TerrainLightKind kind = TerrainLightKind::Transfer;
    int order = 4;        // order of the harmonics, 1..6
    int bounces = 2;      // 0..4
    int rays = 32;        // a sample and bounce, towards the ground it sees; a multiple of 16
    int azimuths = 32;    // horizons a sample, 8..64, a multiple of 4
    int stride = 1;       // every so many-th sample of the heightfield each way
    double albedo = 0.3;  // 0..1, of the ground that light bounces from
    std::uint64_t seed = 1;
};

// Where the baked samples lie among the heightfield's: every stride-th, and the last.
struct LightGrid {
    glm::ivec2 first{0};                                // sample of the heightfield that the grid begins at
    int groundWidth = 0, groundHeight = 0, stride = 1;  // samples of the heightfield from there on
    int width = 0, height = 0;                          // baked samples

    LightGrid() = default;
    // step: samples from one to the next.
    LightGrid(const Heightfield& ground, int step);
    // Takes each sample of a part of a heightfield.
    LightGrid(const glm::ivec2& low, const glm::ivec2& size)
        : first(low), groundWidth(size.x), groundHeight(size.y), width(size.x), height(size.y) {}
    // Column or row of the heightfield that a baked sample lies at.
    int column(int i) const { return first.x + at(i, groundWidth); }
    int row(int j) const { return first.y + at(j, groundHeight); }
    std::size_t count() const { return static_cast<std::size_t>(width) * height; }

    // The baked sample at or before a grid coordinate, and the share of the next, 0 to 1.
    struct Place {
        int index;
        float next;
    };
    Place placeX(double grid) const { return place(grid - first.x, groundWidth, width); }
    Place placeY(double grid) const { return place(grid - first.y, groundHeight, height); }

private:
    int at(int k, int samples) const {
        const long long g = static_cast<long long>(k) * stride;
        return g < samples - 1 ? static_cast<int>(g) : samples - 1;
    }
    Place place(double grid, int samples, int count) const;
};

// Baked light.
struct TerrainLight {
    TerrainLightSettings settings;
    LightGrid grid;
    std::uint64_t key = 0;  // terrainLightKey() of what it was baked from

    std::vector<std::uint8_t> openness;  // by sample; 255: the whole sky's light
    // The rest is empty for Openness. Planes of grid.count() values, one after the other.
    // Sine of the horizon's elevation in 1/255, plane a at azimuth a * 2 pi / azimuths from +x towards +y.
    std::vector<std::uint8_t> horizon;
    // Irradiance / pi for light of each even harmonic, in steps of transferUnit(n): lightHarmonics(order)
    // planes each.
    std::vector<std::int16_t> full, bounced;

    std::size_t byteCount() const {
        return openness.size() + horizon.size() + 2 * (full.size() + bounced.size());
    }
};

// Returns how many harmonics of an order are even in z (l + m is even); and which coefficient (of
// spherical_harmonics.h) the n-th of them is.
constexpr int lightHarmonics(int order) {
    return order * (order + 1) / 2;
}
int lightHarmonic(int n);

// Returns the unit of the n-th number of transfer, in band l: sqrt((2 l + 1) / (4 pi)) / 32767. No transfer
// is larger than the first factor, since no harmonic is (addition theorem) and all transfers of a sample
// together take in light once at most.
double transferUnit(int n);

// Returns a key of heights, spacing and all settings.
std::uint64_t terrainLightKey(const Heightfield& ground, const TerrainLightSettings& settings);

// Returns where the light of this ground is kept between runs, whatever its settings: the last one baked.
std::filesystem::path terrainLightCache(const Heightfield& ground);

// Returns the smallest stride whose bake fits into memory; nothing where even large ones do not.
std::optional<int> strideWithinMemory(const Heightfield& ground, const TerrainLightSettings& settings);

// Bakes the light of a ground. Throws Error for settings outside their ranges and where the memory would not
// suffice; Cancelled. The result does not depend on the thread count. keeps: where it is cancelled what is
// done is kept in the cache, and the same bake goes on from there, to the same bytes. peers: all of them, who
// bake rows for the first; the others' result is of no use. Throws PeerFailure where another one failed.
TerrainLight bakeTerrainLight(const Heightfield& ground, const TerrainLightSettings& settings,
                              Progress& progress, bool keeps = false, Peers* peers = nullptr);

// Writes beside the place, then renames. Throws Error.
void saveTerrainLight(const std::filesystem::path& file, const TerrainLight& light);
// Returns whether the file is there and begins as baked terrain light does.
bool isTerrainLight(const std::filesystem::path& file);

// Reads baked light. Throws Error naming the file: cut off, damaged, of another kind or version, or (where
// `ground` is given) baked from other ground.
TerrainLight loadTerrainLight(const std::filesystem::path& file, const Heightfield* ground);

}  // namespace stereonav
