// Lumens made from signed distances (negative inside), for tests of centrelines.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "colon/centreline.h"

namespace stereonav::test {

using Shape = std::function<double(const glm::dvec3& world)>;  // signed distance, metres

// The box [low, high] sampled: a lumen of one segment whose wall is where the shape is 0.
inline LumenField lumenOf(const Shape& shape, const glm::dvec3& low, const glm::dvec3& high,
                          const glm::dvec3& spacing) {
    LumenField lumen;
    VolumeFrame frame;
    frame.spacing = spacing;
    frame.origin = low;
    frame.size = glm::ivec3(glm::ceil((high - low) / spacing)) + 1;
    lumen.field = GreyVolume(frame);
    lumen.lumen = MaskVolume(frame);
    lumen.isovalue = -450;
    LumenSegment segment;
    segment.first = frame.size;
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                const double d = shape(frame.worldFromVoxel(glm::dvec3(i, j, k)));
                const double value = std::clamp(-450 + d * 300e3, -1000.0, 40.0);
                lumen.field.at(i, j, k) = static_cast<std::int16_t>(std::lround(value));
                if (lumen.field.at(i, j, k) >= lumen.isovalue) continue;
                lumen.lumen.at(i, j, k) = 1;
                ++segment.voxels;
                segment.first = glm::min(segment.first, glm::ivec3(i, j, k));
                segment.last = glm::max(segment.last, glm::ivec3(i, j, k));
            }
    segment.volume = segment.voxels * spacing.x * spacing.y * spacing.z;
    if (segment.voxels) lumen.segments.push_back(segment);
    return lumen;
}

// A lumen of the given voxels; the field is 40 outside and -1000 inside.
inline LumenField lumenOfVoxels(const std::vector<glm::ivec3>& voxels, const glm::ivec3& size,
                                const glm::dvec3& spacing = glm::dvec3(0.001)) {
    const auto shape = [&](const glm::dvec3& world) {
        for (const glm::ivec3& v : voxels)
            if (glm::length(world - glm::dvec3(v) * spacing) < 1e-9) return -1.0;
        return 1.0;
    };
    return lumenOf(shape, glm::dvec3(0.0), glm::dvec3(size - 1) * spacing - 1e-12, spacing);
}

// Distances to the outside voxels' centres and beyond the faces, as distanceToOutside gives them.
inline DistanceVolume distancesOf(const MaskVolume& mask) {
    const VolumeFrame& frame = mask.frame;
    std::vector<float> d(frame.count());
    for (std::size_t n = 0; n < d.size(); ++n) d[n] = mask.values[n] ? 1e30f : 0.0f;
    const std::size_t strides[] = {1, std::size_t(frame.size.x), std::size_t(frame.size.x) * frame.size.y};
    std::vector<float> row;
    for (int axis = 0; axis < 3; ++axis) {
        const int n = frame.size[axis];
        row.resize(n + 2);
        for (std::size_t start = 0; start < d.size(); ++start) {
            if (start / strides[axis] % n) continue;
            row.front() = row.back() = 0;
            for (int i = 0; i < n; ++i) row[i + 1] = d[start + i * strides[axis]];
            for (int i = 0; i < n; ++i) {
                float best = row[i + 1];
                for (int side : {-1, 1})
                    for (int j = 1; i + 1 + side * j >= 0 && i + 1 + side * j <= n + 1; ++j) {
                        const float away = static_cast<float>(j * frame.spacing[axis]);
                        if (away * away >= best) break;
                        best = std::min(best, row[i + 1 + side * j] + away * away);
                    }
                d[start + i * strides[axis]] = best;
            }
        }
    }
    DistanceVolume distance;
    distance.frame = frame;
    distance.values = LazyArray<std::uint16_t>(frame.count());
    distance.unit = std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z}) / 64;
    for (std::size_t n = 0; n < d.size(); ++n)
        if (d[n] > 0)
            distance.values[n] =
                static_cast<std::uint16_t>(std::min(65534.0, std::floor(std::sqrt(d[n]) / distance.unit)));
    return distance;
}

}  // namespace stereonav::test
