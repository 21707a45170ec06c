// The four-dimensional linear regression of gradientModulation(), one voxel at a time.
#pragma once

#include <glm/vec3.hpp>

namespace stereonav {

// The gradient of a linear function fitted to the 26 neighbours and the voxel with weights 1 / distance (the
// voxel's weight does not enter; Neumann et al. 2000), in 1/voxel; beyond the faces the outermost
// voxels count on. values(offset) is asked for offsets of -1..1 an axis.
template <typename Values>
glm::dvec3 regressionGradient(const Values& values) {
    constexpr double kEdge = 0.70710678118654752, kCorner = 0.57735026918962576;
    // Sum of weight * x^2 over the 26: 2 faces, 8 edges and 8 corners have x = -1 or 1.
    constexpr double kSum = 2 + 8 * kEdge + 8 * kCorner;
    glm::dvec3 sum(0.0);
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const int away = x * x + y * y + z * z;
                if (away == 0) continue;
                const double weight = away == 1 ? 1 : away == 2 ? kEdge : kCorner;
                sum += weight * static_cast<double>(values(glm::ivec3(x, y, z))) * glm::dvec3(x, y, z);
            }
    return sum / kSum;
}

}  // namespace stereonav
