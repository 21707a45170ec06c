// Shading of a mesh at a hit: light from a sun with its ambient share, on both sides.
#pragma once

#include <glm/vec3.hpp>

#include "engine/mesh/triangle_mesh.h"

namespace stereonav {

struct MeshHit {
    static constexpr std::uint32_t kNone = ~0u;

    double t = 0;  // ray parameter
    std::uint32_t triangle = kNone;
    float weight[3] = {};        // barycentric, of the triangle's vertices
    glm::dvec3 faceNormal{0.0};  // unit
};

struct MeshLight {
    glm::dvec3 toSun{0, 0, 1};  // its length is the light's strength: 1, and 0 once the sun has set
    float ambient = 1;          // 0..1, share of the light that comes from all directions
    // 0..1, how far sunlight reaches around: 0 is Lambert's cosine; with 1 it fades to 0 only at the far
    // side, so that shapes can be seen there too (half Lambert, Mitchell et al. 2006, without its square).
    double wrap = 0;
};

// Returns the linear colour of a hit; above 1 where colours multiply to more. direction: of the ray, any
// length. pixelSize: side of a pixel at unit ray parameter, metres, for the mip level of textures.
glm::vec3 colorOf(const TriangleMesh& mesh, const MeshHit& hit, const glm::dvec3& direction, double pixelSize,
                  const MeshLight& light);

}  // namespace stereonav
