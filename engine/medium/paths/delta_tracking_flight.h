// Free flight and transmittance through a medium with known bounds of its extinction, without slices or bias.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/medium/paths/delta_tracking_bounds.h"

namespace stereonav {

// The numbers of one path: splitmix64 (Steele, Lea and Flood 2014) from a hash of pixel, sample and seed, so
// that a picture does not depend on which thread makes which path.
class PathRandom {
public:
    PathRandom(std::uint64_t pixel, std::uint64_t sample, std::uint64_t seed)
        : mState(mixed(mixed(mixed(seed + kStep) ^ pixel) ^ (sample + kStep))) {}

    double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }      // [0, 1)
    float uniformFloat() { return static_cast<float>(next() >> 40) * 0x1p-24f; }  // [0, 1)
    double opticalDepth() { return -std::log1p(-uniform()); }                     // exponential, mean 1

private:
    static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ull;
    static std::uint64_t mixed(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    std::uint64_t next() { return mixed(mState += kStep); }

    std::uint64_t mState;
};

// A medium at a moment, with the bounds of its extinction.
struct TrackedMedium {
    const Medium& medium;
    const ExtinctionBounds& bounds;
    double time = 0;  // seconds

    OpticalProperties at(const glm::dvec3& world) const { return medium.at(world, time); }
};

// A place where light met the medium.
struct MediumCollision {
    glm::dvec3 place{0.0};  // world, metres
    OpticalProperties properties;
};

// Returns the next collision with the medium of light that travels along the ray from `first` metres on;
// empty where it leaves the medium. Delta tracking (Woodcock et al. 1965) with a majorant for each cell.
inline std::optional<MediumCollision> freeFlight(const TrackedMedium& medium, const WorldRay& ray,
                                                 double first, PathRandom& random) {
    double depth = random.opticalDepth();
    for (CellWalk walk(medium.bounds, ray, first, std::numeric_limits<double>::infinity()); walk.inside();
         walk.step()) {
        const double most = walk.range().most;
        double at = walk.begin();
        while (depth < most * (walk.end() - at)) {
            at += depth / most;
            const glm::dvec3 place = ray.at(at);
            const OpticalProperties properties = medium.at(place);
            if (random.uniform() * most < properties.extinction) return MediumCollision{place, properties};
            depth = random.opticalDepth();
        }
        depth -= most * (walk.end() - at);
    }
    return std::nullopt;
}

// Returns an unbiased estimate of exp(-integral of extinction) between two distances in metres; it lies in
// [0, 1] except after roulette. Residual ratio tracking (Novak et al. 2014) with the least extinction of each
// cell as its control, so that homogeneous cells are exact. Below kRouletteBelow roulette decides whether it
// goes on.
inline double transmittance(const TrackedMedium& medium, const WorldRay& ray, double first, double last,
                            PathRandom& random) {
    constexpr double kRouletteBelow = 0.01, kNothing = 1e-30;
    double weight = 1, depth = random.opticalDepth();
    for (CellWalk walk(medium.bounds, ray, first, last); walk.inside(); walk.step()) {
        const ExtinctionRange& range = walk.range();
        const double residual = range.most - range.least;
        double at = walk.begin();
        weight *= std::exp(-range.least * (walk.end() - at));
        while (depth < residual * (walk.end() - at)) {
            at += depth / residual;
            weight *= 1 - (medium.at(ray.at(at)).extinction - range.least) / residual;
            if (weight < kRouletteBelow) {
                if (weight < kNothing || random.uniform() >= weight / kRouletteBelow) return 0;
                weight = kRouletteBelow;
            }
            depth = random.opticalDepth();
        }
        depth -= residual * (walk.end() - at);
    }
    return weight;
}

}  // namespace stereonav
