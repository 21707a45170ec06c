// Openness by rays: the truth that the estimates of occlusion.h are compared with (R4 of docs/ledger.md), and
// the two methods that came before them and look along 42 directions. All look from the isosurface through a
// voxel: the surface is where the trilinear value reaches the voxel's, its normal points along minus the
// smoothed gradient.
//
// Lengths are metres; a volume with a negative scale has its denser side turned around.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "engine/light/occlusion/occlusion.h"

namespace stereonav {

// Openness traced by rays at one voxel, cosine-weighted over the hemisphere about its normal.
struct TracedOpenness {
    // Obscurance, 0 to 1: eq. 1 with rho = min(d / R, 1)^3, the function for which section 2.1 passes to the
    // tangent sphere.
    double obscurance = 1;
    double visible = 1;  // eq. 2: the share of directions without a hit within R
    double sphere =
        1;  // eq. 3: the share of the tangent sphere of diameter R that is below the voxel's value
    // Whether there is a surface: false where the gradient is zero; nothing was traced then and all three are
    // 1.
    bool surface = false;
};

// Traces rays that start lifted as those of the baked light do (liftedStart), are intersected exactly cell by
// cell, and d is measured from the voxel. directions: > 0, of a Hammersley set; eight times as many points
// probe the sphere. Beyond the faces all is open. Throws Error (radius not above 0, less than 2 voxels along
// an axis).
TracedOpenness traceOpenness(const GreyVolume& volume, const glm::ivec3& voxel, double radius,
                             int directions = 256);

// The 42 directions of both older methods: vertices and edge midpoints of an icosahedron, unit length.
const std::array<glm::dvec3, 42>& occlusionDirections();

enum class DirectionMethod {
    Vicinity,    // Stewart 2003: whether anything within R is denser
    Obscurance,  // Ruiz et al. 2008: rho of the distance to it, the same rho as above
};

// Returns openness, 0 to 1, by samples one smallest spacing apart along the directions of the hemisphere,
// weighted by the cosine; the first whose value is above the voxel's ends the ray. Where the gradient is zero
// all 42 directions count alike.
double opennessByDirections(const GreyVolume& volume, const glm::ivec3& voxel, DirectionMethod method,
                            double radius);

// Returns the same for every voxel, on all threads. Throws Error (empty volume, radius), Cancelled.
OpennessVolume opennessByDirections(const GreyVolume& volume, DirectionMethod method, double radius,
                                    Progress& progress);

}  // namespace stereonav
