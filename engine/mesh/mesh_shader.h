// Shading of a mesh where a ray meets it: light from a sun with its ambient share, on both sides.
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
    float ambient = 1;          // 0..1, the share of light that comes from everywhere
    // 0..1, how far the sun reaches around: 0 is Lambert's cosine; 1 falls off to nothing only at the far
    // side, so that shapes show there too (half Lambert, Mitchell et al. 2006, without its square).
    double wrap = 0;
};

// direction: of the ray, of any length. pixelSize: side of a pixel at unit ray parameter, metres; it chooses
// the mip level of textures. Linear; above 1 where colours multiply to more.
glm::vec3 colorOf(const TriangleMesh& mesh, const MeshHit& hit, const glm::dvec3& direction, double pixelSize,
                  const MeshLight& light);

}  // namespace stereonav
