// Detail that the data do not have: a small repeating noise volume displaces the places at which data are
// read, or changes optical properties (Kniss et al. 2003, section 3.4; row K6 of docs/ledger.md). It moves
// with a time that callers give, so that the same time gives the same picture.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "engine/medium/model/optical_properties.h"

namespace stereonav {

// Noise of 32^3 texels of four bytes, uniform numbers blurred a little along each axis, repeating; it depends
// only on its seed.
class NoiseVolume {
public:
    static constexpr int kSize = 32;
    explicit NoiseVolume(std::uint32_t seed = 1);
    // Returns four channels, trilinear, in -1..1; place in texels, any finite numbers: the texture repeats.
    // Texel n lies at the place n (a texture unit's coordinate is (place + 0.5) / kSize).
    glm::vec4 at(const glm::dvec3& texel) const;
    const std::vector<std::uint8_t>& bytes() const { return mBytes; }  // RGBA, x fastest

private:
    std::vector<std::uint8_t> mBytes;
};

struct NoiseScale {
    double size = 0.1;         // metres that the whole volume of noise covers
    double displacement = 0;   // metres: red, green and blue times this are added to the place
    float extinction = 0;      // alpha: extinction times (1 + this * noise), at least 0
    glm::vec3 color{0.0f};     // red: colour times (1 + this * noise), kept in 0..1
    glm::vec3 indirect{0.0f};  // green: the same for indirect extinction, at least 0
    glm::dvec3 velocity{0.0};  // metres a second
};

// Noise of several sizes; none: the medium is not perturbed.
struct Perturbation {
    static constexpr int kMostScales = 4;
    std::vector<NoiseScale> scales;  // up to kMostScales
    std::uint32_t seed = 1;

    bool any() const { return !scales.empty(); }
    double largestDisplacement() const;      // metres along any axis, over all scales
    double largestExtinctionFactor() const;  // at least 1, without unit
};
// Returns how far a scale's noise has moved, in metres, modulo its repeat, so that it stays exact at any
// time. time: seconds.
glm::dvec3 noiseOffset(const NoiseScale& scale, double time);
// Returns the place where a scale reads the noise, in texels: (world - noiseOffset) * kSize / size.
glm::dvec3 noiseTexel(const NoiseScale& scale, const glm::dvec3& world, double time);
// Returns the displacement, in metres, of the place at which data are read: the sum over all scales, each
// read at `world` itself.
glm::dvec3 displacementAt(const Perturbation& perturbation, const NoiseVolume& noise, const glm::dvec3& world,
                          double time);
// Multiplies properties by 1 + the sum of the noise over all scales, read at `world` itself (not displaced).
void perturb(const Perturbation& perturbation, const NoiseVolume& noise, const glm::dvec3& world, double time,
             OpticalProperties& properties);
// Throws Error for too many scales, sizes not above 0, numbers that are not finite.
void checkPerturbation(const Perturbation& perturbation, const std::string& source);

}  // namespace stereonav
