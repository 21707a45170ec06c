// From horizons to transfer: what of the sky's light reaches a sample directly (in closed form but for the
// sum over azimuths), and what the ground it sees sends on (rays into exactly the part below the horizon).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/ground/ground_rays.h"
#include "terrain/light/terrain_horizon.h"

namespace stereonav {

// A sample as its surroundings are summed over: at kSteps azimuths a horizon, the sines of the lower end of
// its own hemisphere (where the normal's plane is) and of the horizon, whichever is higher. With n the
// normal, d the azimuth's direction and z the sine of elevation, the light from z on has the weight
// (n.d sqrt(1 - z^2) + n.z z) dz dphi / pi.
class SkyWedges {
public:
    static constexpr int kSteps = 2;  // azimuths summed for each horizon; between them it is interpolated

    // A step of azimuth.
    struct Wedge {
        double dx, dy;       // d
        double along;        // n.d
        double bottom, top;  // sines of the ground that is seen; the sky is above top
        double ground;       // the ground's share of a constant light from everywhere
    };

    explicit SkyWedges(int azimuths);
    // Sets the sample by its unit normal and its horizons, sines times 255: plane a at horizon[a *
    // planeSize].
    void set(const glm::dvec3& normal, const std::uint8_t* horizon, std::size_t planeSize);
    std::span<const Wedge> wedges() const { return mWedges; }
    const glm::dvec3& normal() const { return mNormal; }
    // Returns the share of a constant sky's light, 0..1, that the wedges leave.
    double openness() const { return mOpenness; }

private:
    glm::dvec3 mNormal{0, 0, 1};  // unit
    std::vector<Wedge> mWedges;
    double mOpenness = 1;  // share
};

// Integrals of the even harmonics (terrain_light.h) from an elevation up to the zenith, by table.
class SkyTransfer {
public:
    // order, azimuths: TerrainLightSettings has them.
    SkyTransfer(int order, int azimuths);
    int count() const { return mCount; }
    // Writes the direct transfer of a sample: count() values, divided by pi.
    void direct(const SkyWedges& wedges, float* transfer) const;

private:
    static constexpr int kEntries = 256;  // over the sine, linear between them: errors below 1e-5
    int mCount;
    // Entry e: for each k two values, the integrals from e / kEntries to 1 of Y_k sqrt(1 - z^2) and Y_k z
    // without the azimuth's factor.
    std::vector<float> mIntegrals;
    std::vector<float> mAzimuth;  // factors of coefficient k at wedge a: mAzimuth[a * count + k]
};

// Transfer, in steps of transferUnit(), of one row of samples after another: coefficient k of sample s at [s
// * count + k].
using TransferField = std::vector<std::int16_t>;

// How a bounce is gathered.
struct GatherSetting {
    int rays = 32;        // a sample, a multiple of 16
    double albedo = 0.3;  // 0..1, of the ground that sends light on
    std::uint64_t seed = 1;
    int count = 10;  // coefficients
};

// Light that ground sends out, known at the samples of a grid.
struct SentLight {
    const Heightfield& ground;
    const LightGrid& grid;
    const TransferField& field;
    glm::dvec2 offset{0.0};  // metres, from the world of what is lit to its own
};

// Adds up what the ground around a sample of rays.ground() sends to it: setting.count values in steps of
// transferUnit(). number: the sample's, by which its rays are chosen.
void gatherBounce(const GroundRays& rays, const glm::ivec2& sample, std::uint64_t number,
                  const SkyWedges& wedges, const SentLight& sent, const GatherSetting& setting,
                  float* transfer);

}  // namespace stereonav
