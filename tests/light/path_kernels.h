// The kernels of paths called directly, for tests: rays cast in packets from float places.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "engine/base/error.h"
#include "engine/light/paths/isovalue_field.h"
#include "engine/light/paths/path_scene.h"

namespace stereonav::test {

struct TestRay {
    glm::dvec3 voxel, direction;  // direction: unit, along the volume's axes
    double isovalue = 0;
    double limit = INFINITY;  // metres
};
struct TestHit {
    double distance = INFINITY;  // metres
    glm::dvec3 voxel{0.0};
};

// Rays of which all isovalues are served by the field.
inline std::vector<TestHit> castRays(const GreyVolume& volume, const PathField& field, SimdTarget target,
                                     const std::vector<TestRay>& rays) {
    const auto store = std::make_unique<PathStore>();
    const PathVolume v = pathVolume(volume);
    const double unit = pathUnit(volume.frame);
    std::vector<TestHit> hits(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += PathStore::kPaths) {
        const int count = static_cast<int>(std::min<std::size_t>(PathStore::kPaths, rays.size() - first));
        for (int n = 0; n < count; ++n) {
            const TestRay& ray = rays[first + n];
            std::int32_t cell[3];
            float local[3];
            splitPlace(volume.frame, ray.voxel, cell, local);
            for (int k = 0; k < 3; ++k) {
                store->cell[k][n] = cell[k];
                store->local[k][n] = local[k];
                store->way[k][n] = static_cast<float>(ray.direction[k]);
            }
            store->isovalue[n] = static_cast<float>(ray.isovalue);
            store->field[n] = 0;
            store->shadowLimit[n] = static_cast<float>(ray.limit / unit);
        }
        pathKernels(target).cast(v, field, count, *store);
        for (int n = 0; n < count; ++n) {
            if (std::isinf(store->met[n])) continue;
            TestHit& hit = hits[first + n];
            hit.distance = static_cast<double>(store->met[n]) * unit;
            for (int k = 0; k < 3; ++k)
                hit.voxel[k] = store->metCell[k][n] + static_cast<double>(store->metLocal[k][n]);
        }
    }
    return hits;
}

// The float place and way that the kernels take for a ray.
inline TestRay asFloats(const GreyVolume& volume, TestRay ray) {
    std::int32_t cell[3];
    float local[3];
    splitPlace(volume.frame, ray.voxel, cell, local);
    for (int k = 0; k < 3; ++k) {
        ray.voxel[k] = cell[k] + static_cast<double>(local[k]);
        ray.direction[k] = static_cast<float>(ray.direction[k]);
    }
    ray.isovalue = static_cast<float>(ray.isovalue);
    return ray;
}

}  // namespace stereonav::test
