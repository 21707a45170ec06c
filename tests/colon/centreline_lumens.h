// Lumens made from signed distances (negative inside), for tests of centrelines.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "colon/centreline/centreline.h"

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

}  // namespace stereonav::test
