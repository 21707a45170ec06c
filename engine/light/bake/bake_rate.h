// Estimates how fast texels are lit, where a whole bake would take too long (Wyman et al. 2006, Table 1):
// measures a random part of them for a few seconds and scales to all.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/light/paths/texel_light.h"

namespace stereonav {

using TexelPiece = std::vector<glm::ivec3>;  // texels that are lit in one call

// Returns all texels of a grid in bricks of 8^3, like those of a bake, in a random order.
std::vector<TexelPiece> shuffledBricks(const glm::ivec3& size, unsigned seed = 1);
// Returns the texels in pieces of 64, in a random order: with many samples, few bricks would be lit in a few
// seconds.
std::vector<TexelPiece> inSmallPieces(const std::vector<TexelPiece>& pieces);

// Returns the processor time of all threads of this process so far, in seconds, which depends little on how
// busy the machine is.
double processorSeconds();

// Measured rates of a bake, and the time that all of it would take.
struct BakeRate {
    double all_s = 0;        // seconds by the clock, for all texels
    double part = 0;         // share of the texels that was measured; 1: all, and all_s is the time they took
    double texels = 0;       // measured texels per second, including those without a surface
    double onSurface = 0;    // share of the measured texels
    double processor_s = 0;  // seconds of all threads together, for all texels
    double samples_s = 0;    // samples per second of processor time, for texels on a surface
};

// Calls light(n) for pieces n of sizes[n] texels (or pixels) on all threads until `seconds` are over; light
// returns how many of them lie on a surface. Lights at least one piece per thread, if there are that many.
// sizes: not empty.
BakeRate bakeRate(std::span<const std::size_t> sizes, double seconds, int samples,
                  const std::function<std::size_t(std::size_t)>& light);

// Return the rates of irradiance and of transfer at texels, measured for `seconds`.
BakeRate irradianceRate(const TexelLighter& lighter, const std::vector<TexelPiece>& pieces, int samples,
                        double seconds);
BakeRate transferRate(const TexelLighter& lighter, const std::vector<TexelPiece>& pieces, int samples,
                      int order, int channels, double seconds);
// Pieces of points instead of texels, such as the points from which pixels' paths start.
using PointPiece = std::vector<TexelLighter::SurfacePoint>;
BakeRate pointRate(const TexelLighter& lighter, const std::vector<PointPiece>& pieces, int samples,
                   double seconds);

}  // namespace stereonav
