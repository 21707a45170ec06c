// Small media, views and lights for the tests of sweeps.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>

#include "tests/oracle/plain_sweep.h"

namespace stereonav::test {

// Values at the voxels of a grid of `size`, `length` metres long along x, its middle at `center`.
inline std::shared_ptr<GreyVolume> makeField(const glm::ivec3& size, double length, const glm::dvec3& center,
                                             const std::function<double(const glm::ivec3&)>& value) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = glm::dvec3(length / std::max(size.x - 1, 1));
    frame.origin = center - 0.5 * glm::dvec3(size - 1) * frame.spacing;
    auto field = std::make_shared<GreyVolume>(frame);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                field->at(i, j, k) = static_cast<std::int16_t>(std::lround(value({i, j, k})));
    return field;
}

// The same material everywhere: a medium whose extinction is known. tau, tauIndirect: a metre.
struct Uniform {
    double tau = 1;
    glm::dvec3 tauIndirect{0.5};
    glm::vec3 color{1.0f}, glow{0.0f};
    double surface = 0;
};
// reference: metres, such that neither opacity nor transport come near their ends.
inline MediumMaterial materialOf(const Uniform& u, double reference = 1) {
    MediumMaterial m;
    m.color = u.color;
    m.opacity = -std::expm1(-u.tau * reference);
    m.transport = glm::vec3(glm::exp(-u.tauIndirect * reference));
    m.surface = u.surface;
    m.glow = u.glow;
    return m;
}
inline double referenceFor(double tau, const glm::dvec3& tauIndirect = glm::dvec3(0)) {
    return 1 / std::max({tau, tauIndirect.x, tauIndirect.y, tauIndirect.z, 1e-9});
}

// A slab `thick` metres along z about the origin, 200 times as wide. Layers from -z to +z: of one material,
// or two of half the thickness.
inline Medium slabOf(const std::vector<Uniform>& layers, double thick) {
    VolumeFrame frame;
    frame.size = {2, 2, 2};
    frame.spacing = {200 * thick, 200 * thick, thick};
    frame.origin = -0.5 * frame.spacing;
    auto field = std::make_shared<GreyVolume>(frame);
    for (int n = 0; n < 8; ++n) field->at(n & 1, n >> 1 & 1, n >> 2) = n >> 2 ? 1024 : 0;
    double tau = 0;
    glm::dvec3 indirect(0.0);
    for (const Uniform& u : layers) {
        tau = std::max(tau, u.tau);
        indirect = glm::max(indirect, u.tauIndirect);
    }
    const double reference = referenceFor(tau, indirect);
    std::vector<MediumPoint> points;
    const int last = static_cast<int>(layers.size()) - 1;
    points.push_back({0, materialOf(layers[0], reference)});
    if (last > 0) {  // the step between two entries of the table
        points.push_back({512, materialOf(layers[0], reference)});
        points.push_back({513, materialOf(layers[1], reference)});
    }
    points.push_back({1024, materialOf(layers[last], reference)});
    return Medium(field, MediumTransfer(points, reference, "test"));
}

// A view from `eye` to `target`; `half`: tangent of half its width and height.
inline EyeView viewFrom(const glm::dvec3& eye, const glm::dvec3& target, double half, int width, int height) {
    EyeView v;
    v.eye = v.head = eye;
    v.forward = glm::normalize(target - eye);
    const glm::dvec3 hint = std::abs(v.forward.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    v.right = glm::normalize(glm::cross(v.forward, hint));
    v.up = glm::cross(v.right, v.forward);
    v.xMin = -half;
    v.xMax = half;
    v.yMin = -half * height / width;
    v.yMax = half * height / width;
    v.width = width;
    v.height = height;
    return v;
}

// The slab cut along z: eye and light at these cosines to z, for which closed forms are known. The view has
// 3 x 3 pixels that see all but the same.
inline SweepGeometry slabGeometry(const Medium& medium, const MediumLook& look, SweepSetting setting,
                                  double eyeCosine, bool forward, double thick) {
    const double sine = std::sqrt(std::max(0.0, 1 - eyeCosine * eyeCosine));
    const glm::dvec3 way(0, sine, forward ? eyeCosine : -eyeCosine);
    setting.lightSize = 8;
    const EyeView eye[] = {viewFrom(-10 * thick * way, {0, 0, 0}, 1e-6, 3, 3)};
    SweepGeometry g = makeSweepGeometry(medium, look, setting, eye, eye[0].eye);
    g.axis = {0, 0, 1};
    g.forward = forward;
    g.faces.clear();
    for (int k = 0; k <= setting.slices; ++k)
        g.faces.push_back(thick * (static_cast<double>(k) / setting.slices - 0.5) - g.anchor.z);
    return g;
}

inline MediumLight sun(const glm::dvec3& direction, float radiance = 1) {
    MediumLight light;
    light.direction = glm::normalize(direction);
    light.radiance = glm::vec3(radiance);
    return light;
}

}  // namespace stereonav::test
