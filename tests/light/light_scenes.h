// Volumes whose surfaces are known shapes, for tests of light: values are signed distances to the solid's
// surface in voxels, positive within, times kSteps. So the surface through a texel is the shape moved by the
// texel's own distance.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/light/paths/texel_light.h"
#include "tests/volume/test_volumes.h"

namespace stereonav::test {

constexpr double kSteps = 400;  // stored numbers a voxel

inline VolumeFrame cubeFrame(int size, double spacing = 1e-3) {
    VolumeFrame frame;
    frame.size = glm::ivec3(size);
    frame.spacing = glm::dvec3(spacing);
    return frame;
}

template <typename Distance>
GreyVolume solidVolume(const VolumeFrame& frame, Distance distance) {
    return greyVolume(
        frame, [&](const glm::dvec3& v) { return std::clamp(kSteps * distance(v), -32768.0, 32767.0); });
}

inline GreyVolume ballVolume(int size, const glm::dvec3& centre, double radius) {
    return solidVolume(cubeFrame(size),
                       [=](const glm::dvec3& v) { return radius - glm::length(v - centre); });
}

// A block that fills the volume below the plane z = top, with a spherical bowl of this centre in it.
inline GreyVolume bowlVolume(int size, const glm::dvec3& centre, double radius, double top) {
    return solidVolume(cubeFrame(size), [=](const glm::dvec3& v) {
        return std::min(glm::length(v - centre) - radius, top - v.z);
    });
}

// Mean and its standard error of a texel's samples, in luminance.
inline double luminanceOf(const glm::vec3& c) {
    return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z);
}
inline double standardError(const TexelSum& sum) {
    return std::sqrt(double(sum.squares) / double(sum.samples)) / std::sqrt(double(sum.samples));
}

inline TexelSum irradianceAt(const TexelLighter& lighter, const glm::ivec3& texel, int samples) {
    TexelSum sum;
    lighter.addIrradiance({&texel, 1}, samples, {&sum, 1});
    return sum;
}

}  // namespace stereonav::test
