// How fast texels are lit: rates of a random part of them within a few seconds, scaled to all, where a whole
// bake would take too long (Wyman et al. 2006, Table 1).
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/light/paths/texel_light.h"

namespace stereonav {

using TexelPiece = std::vector<glm::ivec3>;  // texels that are lit in one go

// Returns all texels of a grid in pieces of 8^3, as a bake hands them out, in a random order.
std::vector<TexelPiece> shuffledBricks(const glm::ivec3& size, unsigned seed = 1);
// Returns the texels in pieces of 64, in a random order: with many samples a few seconds would see few
// bricks.
std::vector<TexelPiece> inSmallPieces(const std::vector<TexelPiece>& pieces);

// Returns the processor time of all threads of this process so far, seconds: what a busy machine does not
// change much.
double processorSeconds();

// Measured rates of a bake, and the time that all of it would take.
struct BakeRate {
    double all_s = 0;        // seconds by the clock, for all texels
    double part = 0;         // share of the texels that was measured; 1: all, and all_s is what they took
    double texels = 0;       // measured ones per second, those without a surface included
    double onSurface = 0;    // share of the measured texels
    double processor_s = 0;  // seconds of all threads together, for all texels
    double samples_s = 0;    // samples a second of processor time, for texels on a surface
};

// Calls light(n) for pieces n of sizes[n] texels (or pixels) on all threads, one after another, until
// `seconds` are over; light gives the number of those on a surface. At least one piece a thread is lit, if
// there is one. sizes: not empty.
BakeRate bakeRate(std::span<const std::size_t> sizes, double seconds, int samples,
                  const std::function<std::size_t(std::size_t)>& light);

// Return the rates of irradiance and of transfer at texels, measured for `seconds`.
BakeRate irradianceRate(const TexelLighter& lighter, const std::vector<TexelPiece>& pieces, int samples,
                        double seconds);
BakeRate transferRate(const TexelLighter& lighter, const std::vector<TexelPiece>& pieces, int samples,
                      int order, int channels, double seconds);
// Pieces of points instead of texels, as paths from pixels start at.
using PointPiece = std::vector<TexelLighter::SurfacePoint>;
BakeRate pointRate(const TexelLighter& lighter, const std::vector<PointPiece>& pieces, int samples,
                   double seconds);

}  // namespace stereonav
